// The OFF format: a header, the counts, a line for each vertex, a line for each face.
//
// https://shape.cs.princeton.edu/benchmark/documentation/off_format.html

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "gaussmesh/check_mesh.h"
#include "gaussmesh/error.h"

namespace gaussmesh {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

/// Text for a message: short, on one line, nothing a terminal could take for a command.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string result(text.substr(0, kMost));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text.size() > kMost ? result + "..." : result;
}

/// Goes through OFF text line by line, and through a line word by word.
class LineReader {
 public:
  LineReader(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

  /// Goes to the next line that is not blank once its comment is gone; false at the end of the text.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      line_ = line_.substr(0, line_.find('#'));
      line_ = line_.substr(0, line_.find_last_not_of(kBlanks) + 1);
      words_ = line_;
      if (!line_.empty()) return true;
    }
    line_ = words_ = "end of file";
    return false;
  }

  /// The next word of the line, empty after the last.
  std::string_view next_word() {
    const std::size_t begin = std::min(words_.find_first_not_of(kBlanks), words_.size());
    words_.remove_prefix(begin);
    const std::string_view word = words_.substr(0, words_.find_first_of(kBlanks));
    words_.remove_prefix(word.size());
    return word;
  }

  /// The next word as a number; false if it is not one, all of it.
  template <class Number>
  bool next_number(Number& number) {
    std::string_view word = next_word();
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return !word.empty() && error == std::errc{} && end == word.data() + word.size();
  }

  std::size_t bytes_left() const { return rest_.size(); }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(std::string(name_) + ":" + std::to_string(std::max<std::size_t>(number_, 1)) + ": expected " +
                     expected + ", got '" + shown(line_) + "'");
  }

 private:
  std::string_view rest_;   // the lines after this one
  std::string_view line_;   // this one, without comment and trailing blanks
  std::string_view words_;  // what is left of it
  std::string_view name_;
  std::size_t number_ = 0;
};

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// `OFF`, and the numbers of vertices, faces and, if it is there, edges, on the same line or on the next.
Counts read_header(LineReader& lines) {
  if (!lines.next_line() || lines.next_word() != "OFF") lines.fail("the header 'OFF'");
  LineReader rest = lines;
  if (rest.next_word().empty() && !lines.next_line()) lines.fail("the numbers of vertices, faces and edges");
  Counts counts;
  std::size_t edges = 0;
  if (!lines.next_number(counts.vertices) || !lines.next_number(counts.faces))
    lines.fail("the numbers of vertices, faces and edges");
  rest = lines;
  if ((!rest.next_word().empty() && !lines.next_number(edges)) || !lines.next_word().empty())
    lines.fail("the numbers of vertices, faces and edges");
  return counts;
}

std::string place_in(const char* what, std::size_t i, std::size_t count) {
  return std::string(what) + " " + std::to_string(i + 1) + " of " + std::to_string(count);
}

Point read_vertex(LineReader& lines, std::size_t i, std::size_t count) {
  Point point{};
  bool good = lines.next_line();
  for (double& x : point) good = good && lines.next_number(x) && std::isfinite(x);
  if (!good || !lines.next_word().empty()) lines.fail(place_in("vertex", i, count) + ": three finite coordinates");
  return point;
}

Triangle read_face(LineReader& lines, std::size_t i, std::size_t count) {
  Triangle triangle{};
  std::size_t corners = 0;
  bool good = lines.next_line() && lines.next_number(corners) && corners == 3;
  for (std::uint32_t& vertex : triangle) good = good && lines.next_number(vertex);
  if (!good) lines.fail(place_in("face", i, count) + ": a triangle, '3' and three vertex numbers");
  return triangle;  // the rest of the line is its colour
}

}  // namespace

TriangleMesh parse_off(std::string_view text, std::string_view name) {
  constexpr std::size_t kShortestVertex = 6;  // bytes: "0 0 0\n"
  constexpr std::size_t kShortestFace = 8;    // "3 0 1 2\n"
  LineReader lines(text, name);
  const Counts counts = read_header(lines);
  TriangleMesh mesh;
  mesh.vertices.reserve(std::min(counts.vertices, lines.bytes_left() / kShortestVertex + 1));
  for (std::size_t i = 0; i < counts.vertices; ++i) mesh.vertices.push_back(read_vertex(lines, i, counts.vertices));
  mesh.triangles.reserve(std::min(counts.faces, lines.bytes_left() / kShortestFace + 1));
  for (std::size_t i = 0; i < counts.faces; ++i) mesh.triangles.push_back(read_face(lines, i, counts.faces));
  if (lines.next_line()) lines.fail("nothing after " + std::to_string(counts.faces) + " faces");
  return mesh;
}

TriangleMesh read_off(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& got) {
    throw InputError(path.string() + ": expected an OFF file, got '" + got + "'");
  };
  if (std::filesystem::is_directory(path)) fail("a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::strerror(errno));
  std::string text(std::filesystem::is_regular_file(path) ? std::filesystem::file_size(path) : 0, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) fail("a read error");
  return parse_off(text, path.string());
}

}  // namespace gaussmesh
