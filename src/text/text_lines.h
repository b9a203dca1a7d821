// What all text formats share: lines, fields, numbers, and errors that name the line.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gaussmesh {

/// Where a message points.
struct LinePlace {
  std::string_view file;
  std::size_t line = 0;  ///< from 1
};

/// `file:line`
std::string to_string(const LinePlace& place);

/// `text` in quotes, fit for one line of a terminal: other bytes than printable ASCII as \xNN, the end of a long
/// text cut off.
std::string quoted(std::string_view text);

/// Throws InputError `file:line: expected <expected>, got '<got>'<remedy>`; `remedy` brings its own "; ".
[[noreturn]] void fail_at(const LinePlace& place, std::string_view expected, std::string_view got,
                          std::string_view remedy = {});

/// Returns `text` without a UTF-8 byte order mark.
///
/// @throws InputError if it is UTF-16 or holds a NUL byte
std::string_view require_text(std::string_view text, std::string_view file);

/// True for the characters that separate fields.
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
constexpr char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// `text` with its letters a to z in upper case.
std::string upper_case(std::string_view text);

/// `text` without the blanks at its two ends.
std::string_view trim(std::string_view text);

/// Hands out the lines of a text, which end in LF, CRLF or CR. Cost: one pass over the text, no copy.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}

  /// The next line, without its end; nothing after the last.
  std::optional<std::string_view> next();

  /// Number of the line that next() returned, from 1.
  std::size_t number() const { return number_; }

  /// True if the line that next() returned is the last and has no line end.
  bool is_cut() const { return is_cut_; }

 private:
  void find_line_feed();

  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_feed_ = 0;  // the first LF at or after position_, text_.size() if there is none
  bool line_feed_known_ = false;
  std::size_t number_ = 0;
  bool is_cut_ = false;
};

/// Splits lines into fields at blanks; one object serves many lines without allocating.
class FieldSplitter {
 public:
  /// The fields of `line`, views into it. The span is valid until the next call.
  std::span<const std::string_view> split(std::string_view line);

 private:
  std::vector<std::string_view> fields_;
};

/// The whole of `field` as a number, in C's or Fortran's notation (1.5D+00), a leading plus allowed; nothing if it
/// is no number, not finite, or does not fit a double. Does not depend on the locale.
std::optional<double> parse_number(std::string_view field);

/// True for a field that may stand behind the numbers of an atom: it begins with a letter and is not nan or inf.
bool is_symbol(std::string_view field);

}  // namespace gaussmesh
