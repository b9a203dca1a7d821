#include "atoms/atom_fields.h"

#include <charconv>
#include <cmath>
#include <string>

namespace gaussmesh {
namespace {

constexpr std::array<std::string_view, 5> kFieldNames = {"x (A)", "y (A)", "z (A)", "a radius (A)",
                                                         "a charge (elementary charges)"};

std::string shortest(double value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), result.ptr};
}

}  // namespace

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
