// What the readers of meshes share: lines of fields, numbers, errors, and one function for each format.
//
// Which format a file is in is read_mesh.cpp.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gaussmesh/read_mesh.h"
#include "text/text_lines.h"

namespace gaussmesh {

/// The whole of `field` as a whole number; nothing if it is none.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view field) {
  Integer value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc{} || stop != end || field.empty()) return std::nullopt;
  return value;
}

/// Goes through a text by lines that are not empty, cut into fields; what follows a # is a comment.
class MeshLines {
 public:
  MeshLines(std::string_view text, std::string_view name) : size_(text.size()), name_(name), lines_(text) {}

  /// Goes to the next line that has fields; false at the end of the text.
  bool next() {
    while (const auto line = lines_.next()) {
      line_ = line->substr(0, line->find('#'));
      fields_ = splitter_.split(line_);
      if (!fields_.empty()) return true;
    }
    line_ = "end of file";
    fields_ = {};
    return false;
  }

  /// The same, where the text must go on.
  void require_next(std::string_view expected) {
    if (!next()) fail(expected);
  }

  std::span<const std::string_view> fields() const { return fields_; }

  /// Field `i` as a finite number. @throws InputError if there is none
  double number(std::size_t i, std::string_view expected) const {
    const auto value = i < fields_.size() ? parse_number(fields_[i]) : std::nullopt;
    if (!value) fail(expected);
    return *value;
  }

  /// Field `i` as a whole number. @throws InputError if there is none that fits
  template <class Integer>
  Integer integer(std::size_t i, std::string_view expected) const {
    const auto value = i < fields_.size() ? parse_integer<Integer>(fields_[i]) : std::nullopt;
    if (!value) fail(expected);
    return *value;
  }

  /// Three numbers from field `first` on.
  Point point(std::size_t first, std::string_view expected) const {
    return {number(first, expected), number(first + 1, expected), number(first + 2, expected)};
  }

  /// A vertex number in field `i`, which counts from `base`.
  std::uint32_t vertex(std::size_t i, std::uint32_t base, std::string_view expected) const {
    const auto number = integer<std::uint32_t>(i, expected);
    if (number < base) fail(expected);
    return number - base;
  }

  /// As many things of at least `bytes` as the text can hold: what it announces is believed only so far.
  std::size_t at_most(std::size_t announced, std::size_t bytes) const { return std::min(announced, size_ / bytes + 1); }

  LinePlace place() const { return {name_, std::max<std::size_t>(lines_.number(), 1)}; }

  /// `remedy` brings its own "; ".
  [[noreturn]] void fail(std::string_view expected, std::string_view remedy = {}) const {
    fail_at(place(), expected, trim(line_), remedy);
  }

 private:
  std::size_t size_;
  std::string_view name_;
  LineReader lines_;
  FieldSplitter splitter_;
  std::string_view line_;
  std::span<const std::string_view> fields_;
};

/// `p` made a normal: scaled to length 1 where it is not so already, zero where it has no direction.
inline Normal to_normal(const Point& p) {
  constexpr double kTolerance = 1e-5;  // what a few decimals leave of length 1
  const double length = std::hypot(p[0], p[1], p[2]);
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  const double scale = std::abs(length - 1.0) <= kTolerance ? 1.0 : length;
  return {static_cast<float>(p[0] / scale), static_cast<float>(p[1] / scale), static_cast<float>(p[2] / scale)};
}

/// Throws InputError if there is nothing but blanks.
void require_content(std::string_view bytes, std::string_view name);

/// Leaves out the vertices that are in no triangle. A number of one that is not there stays too large.
void leave_out_unused_vertices(TriangleMesh& mesh);

/// Whether the length is that of the binary STL that is announced there: headers may begin with "solid" too.
bool is_binary_stl(std::string_view bytes);

MeshFile parse_gmsh(std::string_view bytes, std::string_view name);
MeshFile parse_obj(std::string_view text, std::string_view name);
MeshFile parse_off(std::string_view bytes, std::string_view name);
MeshFile parse_ply(std::string_view bytes, std::string_view name);
MeshFile parse_smesh(std::string_view text, std::string_view name);
/// The same where the nodes are in a file of their own, as where TetGen wrote it.
MeshFile parse_smesh(std::string_view text, std::string_view name, std::string_view nodes, std::string_view nodes_name);
MeshFile parse_stl(std::string_view bytes, std::string_view name);
MeshFile parse_vtp(std::string_view bytes, std::string_view name);

}  // namespace gaussmesh
