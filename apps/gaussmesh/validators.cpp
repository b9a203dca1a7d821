#include "validators.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "gaussmesh/nearest_name.h"

namespace gaussmesh::app {
namespace {

/// The number that the whole text is, if it is finite. As CLI11 does, a plus in front is taken.
std::optional<double> finite_number(const std::string& text) {
  const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

/// Without zeros behind, as people write it.
std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The bytes that a size of memory means, if it is one.
std::optional<std::uint64_t> bytes_of(const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  constexpr double kMost = 0x1p62;
  const bool is_plain = finite_number(text).has_value() && !text.starts_with('-');  // with an exponent, perhaps
  const std::size_t digits = is_plain ? text.size() : std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<double> number = finite_number(text.substr(0, digits));
  std::string unit = text.substr(digits);
  for (const std::string_view end : {"iB", "B"}) {
    if (unit.size() > end.size() && unit.ends_with(end)) unit.resize(unit.size() - end.size());
  }
  if (unit == "k") unit = "K";
  const std::size_t power = unit.empty() ? 0 : kUnits.find(unit) + 1;
  if (!number || unit.size() > 1 || (!unit.empty() && power == 0)) return std::nullopt;
  const double bytes = *number * std::pow(1024.0, static_cast<double>(power));
  return bytes < kMost ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

}  // namespace

std::string join_names(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return CLI::Validator(
      [names](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) != names.end()) return std::string();
        return "expected " + join_names(names, ", ") + ", got '" + name + "'" + did_you_mean(name, names);
      },
      "");
}

CLI::Validator number_between(double low, double high, const std::string& expected) {
  const std::string range =
      expected.empty() ? "a number from " + number_text(low) + " to " + number_text(high) : expected;
  return CLI::Validator(
      [low, high, range](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        if (value && *value >= low && *value <= high) return std::string();
        return "expected " + range + ", got '" + text + "'";
      },
      "");
}

CLI::Validator zero_or_number_between(double low, double high, const std::string& expected) {
  const CLI::Validator others = number_between(low, high, expected);
  return CLI::Validator(
      [others](std::string& text) { return finite_number(text) == 0.0 ? std::string() : others(text); }, "");
}

CLI::Validator whole_number_between(int low, int high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        const bool is_whole = text.find_first_not_of("+-0123456789") == std::string::npos;
        if (value && is_whole && *value >= low && *value <= high) return std::string();
        return "expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) + ", got '" +
               text + "'";
      },
      "");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) { return text.empty() ? "expected the name of a file, got ''" : std::string(); }, "");
}

CLI::Validator file_name_of_option() {
  return CLI::Validator(
      [](const std::string& text) {
        if (!text.empty() && (text[0] != '-' || text == "-")) return std::string();
        return "expected the name of a file, got '" + text + "'" +
               (text.empty() ? "" : "; if it is one, write ./" + text);
      },
      "");
}

CLI::Validator positive_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        return value && *value > 0.0 ? std::string() : "expected a number > 0, got '" + text + "'";
      },
      "");
}

CLI::Validator number_from(double low) {
  return CLI::Validator(
      [low](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        return value && *value >= low ? std::string()
                                      : "expected a number >= " + number_text(low) + ", got '" + text + "'";
      },
      "");
}

CLI::Validator memory_size(std::uint64_t least) {
  return CLI::Validator(
      [least](std::string& text) {
        const std::optional<std::uint64_t> bytes = bytes_of(text);
        if (!bytes || *bytes < least) {
          return "expected a size of at least " + std::to_string(least >> 20) + "M such as 500M or 4G, got '" + text +
                 "'";
        }
        text = std::to_string(*bytes);
        return std::string();
      },
      "");
}

}  // namespace gaussmesh::app
