#include <charconv>
#include <cmath>
#include <string>

#include "gaussmesh/error.h"
#include "gaussmesh/write_mesh.h"
#include "write/whole_file.h"

namespace gaussmesh {
namespace {

constexpr int kDecimals = 9;
constexpr double kUnits = 1e9;

/// Longest line: three coordinates of at most 8 digits before the point, or four numbers of 10 digits.
constexpr std::size_t kLongestLine = 80;

char* put_integer(char* p, std::uint64_t value) { return std::to_chars(p, p + 20, value).ptr; }

/// `value` is a whole number of 1e-9: printed exactly.
char* put_coordinate(char* p, double value) {
  std::int64_t units = std::llround(value * kUnits);
  if (units < 0) {
    *p++ = '-';
    units = -units;
  }
  p = put_integer(p, static_cast<std::uint64_t>(units) / 1000000000u);
  *p = '.';
  std::uint64_t fraction = static_cast<std::uint64_t>(units) % 1000000000u;
  for (int i = kDecimals; i > 0; --i, fraction /= 10) p[i] = static_cast<char>('0' + fraction % 10);
  return p + 1 + kDecimals;
}

/// A buffer that is written out when it is nearly full.
class LineBuffer {
 public:
  explicit LineBuffer(WholeFile& file) : file_(file), text_(1 << 20, '\0') {}
  char* next() {
    if (used_ + kLongestLine > text_.size()) flush();
    return text_.data() + used_;
  }
  void end(const char* p) { used_ = static_cast<std::size_t>(p - text_.data()); }
  void flush() {
    file_.write({text_.data(), used_});
    used_ = 0;
  }

 private:
  WholeFile& file_;
  std::string text_;
  std::size_t used_ = 0;
};

}  // namespace

void write_off(const TriangleMesh& mesh, const std::filesystem::path& path) {
  WholeFile file(path);
  LineBuffer lines(file);
  char* p = lines.next();
  for (const char c : std::string_view("OFF\n")) *p++ = c;
  p = put_integer(p, mesh.vertices.size());
  *p++ = ' ';
  p = put_integer(p, mesh.triangles.size());
  for (const char c : std::string_view(" 0\n")) *p++ = c;
  lines.end(p);
  for (const Point& v : mesh.vertices) {
    p = lines.next();
    for (int k = 0; k < 3; ++k) {
      p = put_coordinate(p, v[k]);
      *p++ = k < 2 ? ' ' : '\n';
    }
    lines.end(p);
  }
  for (const Triangle& t : mesh.triangles) {
    p = lines.next();
    *p++ = '3';
    for (const std::uint32_t v : t) {
      *p++ = ' ';
      p = put_integer(p, v);
    }
    *p++ = '\n';
    lines.end(p);
  }
  lines.flush();
  file.commit();
}

void write_text(const std::string& text, const std::filesystem::path& path) {
  WholeFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace gaussmesh
