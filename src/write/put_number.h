// Numbers as text, fast: each function writes at `p` and returns the end.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace gaussmesh {

inline constexpr double kUnitsPerOne = 1e9;  ///< units of the last decimal

/// Most characters of a number written here: a double in shortest form has at most 24.
inline constexpr std::size_t kLongestNumber = 24;

inline char* put_text(char* p, std::string_view text) {
  std::memcpy(p, text.data(), text.size());
  return p + text.size();
}

inline char* put_integer(char* p, std::uint64_t value) {
  constexpr std::ptrdiff_t kMostDigits = 20;
  return std::to_chars(p, p + kMostDigits, value).ptr;
}

/// 00 to 99.
inline char* put_two_digits(char* p, std::uint32_t value) {
  static constexpr char kDigits[] =
      "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
      "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";
  std::memcpy(p, kDigits + 2 * value, 2);
  return p + 2;
}

/// The nearest whole number of units, or one beside it; inlined, unlike std::llround.
inline std::int64_t to_units(double value) {
  return static_cast<std::int64_t>(value * kUnitsPerOne + std::copysign(0.5, value));
}

/// A whole number of units of 1e-9, with nine decimals.
inline char* put_units(char* p, std::int64_t units) {
  constexpr std::uint64_t kUnits = 1000000000;
  if (units < 0) {
    *p++ = '-';
    units = -units;
  }
  p = put_integer(p, static_cast<std::uint64_t>(units) / kUnits);
  *p++ = '.';
  const auto fraction = static_cast<std::uint32_t>(static_cast<std::uint64_t>(units) % kUnits);
  *p++ = static_cast<char>('0' + fraction / 100000000);
  const std::uint32_t rest = fraction % 100000000, high = rest / 10000, low = rest % 10000;
  p = put_two_digits(p, high / 100);
  p = put_two_digits(p, high % 100);
  p = put_two_digits(p, low / 100);
  return put_two_digits(p, low % 100);
}

/// A coordinate, so that a reader gets back the same double: with nine decimals where that suffices, as it does for
/// all meshes that are made here, else in the shortest form that does.
inline char* put_coordinate(char* p, double value) {
  constexpr double kMost = 2e6;  // below, doubles lie closer than units, and their product with 1e9 is exact enough
  if (std::abs(value) < kMost) {
    const std::int64_t units = to_units(value);
    if (static_cast<double>(units) / kUnitsPerOne == value) return put_units(p, units);
  }
  return std::to_chars(p, p + kLongestNumber, value).ptr;
}

/// A number of size 1 or so, with nine decimals: more than a float has.
inline char* put_fraction(char* p, float value) { return put_units(p, to_units(double{value})); }

/// The bytes of a number, as they are in memory.
template <class Number>
char* put_bytes(char* p, const Number& number) {
  std::memcpy(p, &number, sizeof number);
  return p + sizeof number;
}

}  // namespace gaussmesh
