#include "atoms/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

/// Longest stretch of a file that a message repeats: a PDB record and a little more.
constexpr std::size_t kLongestQuote = 90;

/// Longest number in Fortran's notation; double precision prints 25 characters at most.
constexpr std::size_t kLongestFortranNumber = 64;

constexpr std::array<std::string_view, 5> kFieldNames = {"x (A)", "y (A)", "z (A)", "a radius (A)",
                                                         "a charge (elementary charges)"};

std::string shortest(double value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), result.ptr};
}

/// `field` as a number in C's notation.
std::optional<double> parse_c_number(std::string_view field) {
  double value = 0.0;
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// `field` as a number whose exponent is written with D.
std::optional<double> parse_fortran_number(std::string_view field) {
  const std::size_t exponent = field.find_first_of("dD");
  if (exponent == std::string_view::npos || field.size() > kLongestFortranNumber) {
    return std::nullopt;
  }
  std::array<char, kLongestFortranNumber> copy{};
  std::copy(field.begin(), field.end(), copy.begin());
  copy[exponent] = 'e';
  return parse_c_number({copy.data(), field.size()});
}

bool equals_ignoring_case(std::string_view text, std::string_view upper) {
  return std::equal(text.begin(), text.end(), upper.begin(), upper.end(),
                    [](char a, char b) { return to_upper(a) == b; });
}

}  // namespace

std::string to_string(const LinePlace& place) { return std::string(place.file) + ":" + std::to_string(place.line); }

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, kLongestQuote)) {
    if (c >= ' ' && c <= '~') {
      result += c;
    } else {
      std::array<char, 5> escape{};
      std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      result += escape.data();
    }
  }
  return result + (text.size() > kLongestQuote ? "...'" : "'");
}

void fail_at(const LinePlace& place, std::string_view expected, std::string_view got, std::string_view remedy) {
  throw InputError(to_string(place) + ": expected " + std::string(expected) + ", got " + quoted(got) +
                   std::string(remedy));
}

std::string_view require_text(std::string_view text, std::string_view file) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw InputError(std::string(file) + ": expected ASCII or UTF-8 text, got UTF-16; save the file as UTF-8");
  }
  if (text.starts_with("\xef\xbb\xbf")) {
    text.remove_prefix(3);
  }
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    LineReader lines(text.substr(0, nul + 1));
    while (lines.next()) {
    }
    throw InputError(to_string({file, lines.number()}) +
                     ": expected text, got a NUL byte; the file is damaged, or not a text file");
  }
  return text;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

// The position is kept from line to line, so that a text with CR alone is not searched to its end for every line.
void LineReader::find_line_feed() {
  if (line_feed_known_ && line_feed_ >= position_) {
    return;
  }
  line_feed_ = std::min(text_.find('\n', position_), text_.size());
  line_feed_known_ = true;
}

std::optional<std::string_view> LineReader::next() {
  if (position_ >= text_.size()) {
    return std::nullopt;
  }
  find_line_feed();
  const std::size_t begin = position_;
  const std::string_view up_to_line_feed = text_.substr(begin, line_feed_ - begin);
  const std::size_t length = std::min(up_to_line_feed.find('\r'), up_to_line_feed.size());
  const std::size_t end = begin + length;
  const bool is_crlf = end + 1 == line_feed_ && line_feed_ < text_.size();
  is_cut_ = end == text_.size();
  position_ = end + (is_crlf ? 2 : 1);
  ++number_;
  return text_.substr(begin, length);
}

std::span<const std::string_view> FieldSplitter::split(std::string_view line) {
  fields_.clear();
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && is_blank(*at)) {
      ++at;
    }
    if (at == end) {
      return fields_;
    }
    const char* const begin = at;
    while (at != end && !is_blank(*at)) {
      ++at;
    }
    fields_.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
}

std::optional<double> parse_number(std::string_view field) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') {  // from_chars knows no plus
    field.remove_prefix(1);
  }
  const std::optional<double> value = parse_c_number(field);
  return value ? value : parse_fortran_number(field);
}

bool is_symbol(std::string_view field) {
  return !field.empty() && is_letter(field[0]) && !equals_ignoring_case(field, "NAN") &&
         !equals_ignoring_case(field, "INF") && !equals_ignoring_case(field, "INFINITY");
}

std::optional<Atom> parse_atom(const AtomFields& fields) {
  std::array<double, 5> values{};
  for (std::size_t i = 0; i < fields.size() && !fields[i].empty(); ++i) {
    const std::optional<double> value = parse_number(fields[i]);
    if (!value) {
      return std::nullopt;
    }
    values[i] = *value;
  }
  return Atom{values[0], values[1], values[2], values[3], values[4]};
}

void fail_at_number(const AtomFields& fields, const LinePlace& place) {
  std::size_t i = 0;
  while (i + 1 < fields.size() && parse_number(fields[i])) {
    ++i;
  }
  const bool has_comma = fields[i].find(',') != std::string_view::npos;
  fail_at(place, std::string(kFieldNames[i]) + " as a finite number", fields[i],
          has_comma ? "; write decimals with a point" : "");
}

void require_in_range(const Atom& atom, const AtomFields& fields, const LinePlace& place) {
  const std::array<double, 3> position = {atom.x, atom.y, atom.z};
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (std::abs(position[i]) > kLargestCoordinate) {
      fail_at(place, std::string(kFieldNames[i]) + " within +-" + shortest(kLargestCoordinate), fields[i]);
    }
  }
  if (atom.radius < 0.0) {
    fail_at(place, "a radius >= 0 (A)", fields[3]);
  }
  if (atom.radius > kLargestRadius) {
    fail_at(place, "a radius <= " + shortest(kLargestRadius) + " (A)", fields[3]);
  }
}

void LargeRadii::add(double radius, std::size_t line) {
  if (radius <= kSuspectRadius) {
    return;
  }
  if (count_ == 0) {
    first_ = radius;
    first_line_ = line;
  }
  if (radius > largest_) {
    largest_ = radius;
    largest_line_ = line;
  }
  ++count_;
}

void LargeRadii::warn(std::string_view name, AtomFile& file) const {
  if (count_ == 0) {
    return;
  }
  std::string message = to_string({name, first_line_}) + ": radius " + shortest(first_) + " A is larger than " +
                        shortest(kSuspectRadius) + " A: is it meant?";
  if (count_ > 1) {
    message += " (" + std::to_string(count_) + " radii are, the largest " + shortest(largest_) + " A in line " +
               std::to_string(largest_line_) + ")";
  }
  file.warnings.push_back(std::move(message));
}

}  // namespace gaussmesh
