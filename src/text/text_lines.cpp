#include "text/text_lines.h"

#include <algorithm>
#include <array>
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

std::string upper_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), to_upper);
  return result;
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

}  // namespace gaussmesh
