// The two encodings of Gmsh's .msh, behind the same functions: numbers as fields of lines, or as they are in memory.
//
// What the numbers mean is parse_gmsh.cpp. Names of sections, the version, and in version 2.2 the counts are text in
// both.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "read/mesh_text.h"

namespace gaussmesh {

/// A record is a line, and its numbers are the fields, however long they would be in binary.
class AsciiGmshInput {
 public:
  static constexpr bool kIsBinary = false;

  AsciiGmshInput(std::string_view text, std::string_view name) : lines_(require_text(text, name), name) {}

  /// Goes to the next line of text; false at the end of the file.
  bool next_line() { return lines_.next(); }
  std::span<const std::string_view> fields() const { return lines_.fields(); }

  void skip_section(std::string_view) {}  // its lines are passed over one by one
  void read_byte_order() {}

  void begin_record(std::string_view expected) {
    lines_.require_next(expected);
    field_ = 0;
  }

  /// The next number, which is not negative.
  template <class Binary>
  std::uint64_t whole(std::string_view expected) {
    return lines_.integer<std::uint64_t>(field_++, expected);
  }

  Point point(std::string_view expected) {
    field_ += 3;
    return lines_.point(field_ - 3, expected);
  }

  /// Passes over so many numbers.
  template <class Binary>
  void skip(std::uint64_t count) {
    field_ += std::min<std::uint64_t>(count, lines_.fields().size());
  }

  [[noreturn]] void fail_at_line(std::string_view expected) const { lines_.fail(expected); }

  /// The same, where the line does not show what is wrong.
  [[noreturn]] void fail(std::string_view expected, std::string_view got) const {
    throw InputError(to_string(lines_.place()) + ": expected " + std::string(expected) + ", got " + std::string(got));
  }

 private:
  MeshLines lines_;
  std::size_t field_ = 0;
};

/// Numbers of the type `Binary`, one after the other, least significant byte first.
class BinaryGmshInput {
 public:
  static constexpr bool kIsBinary = true;

  BinaryGmshInput(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  /// Goes to the next line of text that is not blank; false at the end of the file.
  bool next_line() {
    while (position_ < bytes_.size()) {
      begin_ = position_;
      const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
      line_ = bytes_.substr(position_, end - position_);
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      position_ = std::min(end + 1, bytes_.size());
      fields_ = splitter_.split(line_);
      if (!fields_.empty()) return true;
    }
    line_ = "end of file";
    fields_ = {};
    return false;
  }
  std::span<const std::string_view> fields() const { return fields_; }

  /// Goes behind the end of the section that has just begun: nothing else tells how long it is.
  void skip_section(std::string_view name) {
    if (name[0] != '$') fail_at_line("a section, '$' and its name");
    const std::string end = "$End" + std::string(name.substr(1));
    const std::size_t at = bytes_.find(end, position_);
    if (at == std::string_view::npos) fail("'" + end + "'", "the end of the file");
    position_ = at + end.size();
  }

  /// Takes the number behind the version, which is 1 in the order of bytes that the file has.
  void read_byte_order() {
    constexpr std::uint32_t kTurnedOne = 0x01000000;
    constexpr std::string_view kOne = "the number 1, least significant byte first";
    const auto one = number<std::uint32_t>();
    if (one == kTurnedOne) fail(kOne, "the most significant one first; save the file as ASCII");
    if (one != 1) fail(kOne, std::to_string(one));
  }

  void begin_record(std::string_view) { begin_ = position_; }

  template <class Binary>
  std::uint64_t whole(std::string_view expected) {
    const auto value = number<Binary>();
    if (std::cmp_less(value, 0)) fail(expected, std::to_string(value));
    return static_cast<std::uint64_t>(value);
  }

  Point point(std::string_view expected) {
    Point point{};
    for (double& x : point) {
      x = number<double>();
      if (!std::isfinite(x)) fail(expected, number_text(x));
    }
    return point;
  }

  template <class Binary>
  void skip(std::uint64_t count) {
    if (count > (bytes_.size() - position_) / sizeof(Binary)) fail_at_end();
    position_ += static_cast<std::size_t>(count) * sizeof(Binary);
  }

  [[noreturn]] void fail_at_line(std::string_view expected) const { fail(expected, quoted(line_)); }

  /// Names the byte at which the line or the record begins, from 0.
  [[noreturn]] void fail(std::string_view expected, std::string_view got) const {
    throw InputError(std::string(name_) + ": byte " + std::to_string(begin_) + ": expected " + std::string(expected) +
                     ", got " + std::string(got));
  }

 private:
  static_assert(std::endian::native == std::endian::little, "numbers are read as they are in memory");

  template <class Binary>
  Binary number() {
    if (bytes_.size() - position_ < sizeof(Binary)) fail_at_end();
    Binary value{};
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return value;
  }

  [[noreturn]] void fail_at_end() const {
    throw InputError(std::string(name_) + ": expected more data, got the end of the file at byte " +
                     std::to_string(bytes_.size()));
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t position_ = 0;
  std::size_t begin_ = 0;
  std::string_view line_;
  FieldSplitter splitter_;
  std::span<const std::string_view> fields_;
};

}  // namespace gaussmesh
