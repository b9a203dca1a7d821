// STL: corners are welded where they are the very same floats.

#include <array>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "core/hash.h"
#include "gaussmesh/error.h"
#include "read/mesh_text.h"

namespace gaussmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is read as it is in memory");

constexpr std::size_t kHeader = 84;  // 80 bytes of text and the count
constexpr std::size_t kRecord = 50;
constexpr std::size_t kNormal = 12;

struct PointHash {
  std::size_t operator()(const Point& p) const {
    std::uint64_t hash = 0;
    for (const double x : p) hash = add_to_hash(hash, std::bit_cast<std::int64_t>(x));
    return spread_hash(hash);
  }
};

/// Numbers places in the order in which they first appear.
class Welder {
 public:
  std::uint32_t number_of(Point p) {
    for (double& x : p) x += 0.0;  // 0 and -0 are the same place
    const auto [entry, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return entry->second;
  }
  std::vector<Point> take() { return std::move(points_); }

 private:
  std::unordered_map<Point, std::uint32_t, PointHash> numbers_;
  std::vector<Point> points_;
};

std::uint32_t announced_triangles(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return count;
}

MeshFile parse_binary(std::string_view bytes, std::string_view name) {
  const std::size_t count = bytes.size() >= kHeader ? announced_triangles(bytes) : 0;
  if (bytes.size() != kHeader + count * kRecord || bytes.size() < kHeader) {
    throw InputError(std::string(name) + ": expected binary STL, 84 bytes and 50 for each of its triangles, got " +
                     std::to_string(bytes.size()) + " bytes that announce " + std::to_string(count));
  }
  MeshFile file;
  Welder welder;
  for (std::size_t i = 0; i < count; ++i) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> corner{};
      std::memcpy(corner.data(), bytes.data() + kHeader + i * kRecord + kNormal + k * sizeof corner, sizeof corner);
      if (!std::isfinite(corner[0] + corner[1] + corner[2])) {
        throw InputError(std::string(name) + ": expected finite coordinates, got others in triangle " +
                         std::to_string(i + 1));
      }
      triangle[k] = welder.number_of({corner[0], corner[1], corner[2]});
    }
    file.mesh.triangles.push_back(triangle);
  }
  file.mesh.vertices = welder.take();
  return file;
}

MeshFile parse_ascii(std::string_view text, std::string_view name) {
  constexpr std::string_view kVertex = "three lines of 'vertex' and three finite coordinates in a facet";
  MeshLines lines(text, name);
  MeshFile file;
  Welder welder;
  Triangle triangle{};
  std::size_t corners = 0;
  while (lines.next()) {
    const std::string_view keyword = lines.fields()[0];
    if (keyword == "vertex") {
      if (corners == 3) lines.fail(kVertex);
      triangle[corners++] = welder.number_of(lines.point(1, kVertex));
    }
    if (keyword == "endfacet") {
      if (corners != 3) lines.fail(kVertex);
      file.mesh.triangles.push_back(triangle);
      corners = 0;
    }
  }
  if (corners != 0) lines.fail("'endfacet'");
  file.mesh.vertices = welder.take();
  return file;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + std::size_t{announced_triangles(bytes)} * kRecord;
}

MeshFile parse_stl(std::string_view bytes, std::string_view name) {
  const bool is_ascii = !is_binary_stl(bytes) && bytes.starts_with("solid");
  return is_ascii ? parse_ascii(require_text(bytes, name), name) : parse_binary(bytes, name);
}

}  // namespace gaussmesh
