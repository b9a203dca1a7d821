// What the formats share: the mesh as they get it, and records written in blocks.
//
// One file here is one format; mesh_formats.cpp is the table of them.
#pragma once

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "gaussmesh/vertex_data.h"
#include "write/put_number.h"
#include "write/whole_file.h"

namespace gaussmesh {

/// What a format writes.
struct MeshView {
  const TriangleMesh& mesh;
  const VertexData& data;
  bool msms_header = true;

  /// The component of a vertex, from 1; 1 for all where components are not known, 0 for a vertex in none.
  std::uint32_t tag(std::uint32_t vertex) const {
    return data.components.empty() ? 1 : data.components[vertex] + 1;  // kNoComponent + 1 is 0
  }
  std::uint32_t tag(const Triangle& triangle) const { return tag(triangle[0]); }
};

/// Writes `count` records: put(p, i) writes record i at p, at most `longest` bytes, and returns its end.
///
/// put() is called on as many threads as OpenMP takes, which is nothing that it notices; blocks of records are
/// written in their order.
template <class Put>
void write_records(WholeFile& file, std::size_t count, std::size_t longest, const Put& put) {
  constexpr std::size_t kBlock = 8192;  // records: as many as stay in the cache until they are written
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  std::exception_ptr error;
#pragma omp parallel if (blocks > 1)
  {
    std::string buffer;
#pragma omp for ordered schedule(dynamic, 1)
    for (std::size_t block = 0; block < blocks; ++block) {
      std::size_t size = 0;
      std::exception_ptr failed;  // what is thrown must not leave the loop
      try {
        buffer.resize(std::min(kBlock, count) * longest);
        const std::size_t end = std::min((block + 1) * kBlock, count);
        char* p = buffer.data();
        for (std::size_t i = block * kBlock; i < end; ++i) p = put(p, i);
        size = static_cast<std::size_t>(p - buffer.data());
      } catch (...) {
        failed = std::current_exception();
      }
#pragma omp ordered
      {
        try {
          if (!error) error = failed;
          if (!error) file.write({buffer.data(), size});
        } catch (...) {
          error = std::current_exception();
        }
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

/// Writes numbers with `separator` between them and `end` behind the last.
template <class Numbers, class Put>
char* put_row(char* p, const Numbers& numbers, char separator, char end, const Put& put) {
  for (const auto& number : numbers) {
    p = put(p, number);
    *p++ = separator;
  }
  p[-1] = end;
  return p;
}

inline char* put_point(char* p, const Point& point, char end) { return put_row(p, point, ' ', end, put_coordinate); }
inline char* put_normal(char* p, const Normal& normal, char end) { return put_row(p, normal, ' ', end, put_fraction); }

/// The vertex numbers of a triangle, counted from `first`.
inline char* put_triangle(char* p, const Triangle& triangle, std::uint64_t first, char end) {
  return put_row(p, triangle, ' ', end, [first](char* q, std::uint32_t v) { return put_integer(q, v + first); });
}

inline constexpr std::size_t kLongestPoint = 3 * (kLongestNumber + 1);
inline constexpr std::size_t kLongestIndex = 11;  // 10 digits and what separates them

// The formats. Each writes one file.
void write_off(const MeshView& view, WholeFile& file);
void write_msms_vertices(const MeshView& view, WholeFile& file);
void write_msms_faces(const MeshView& view, WholeFile& file);
void write_ply_binary(const MeshView& view, WholeFile& file);
void write_ply_ascii(const MeshView& view, WholeFile& file);
void write_obj(const MeshView& view, WholeFile& file);
void write_stl_binary(const MeshView& view, WholeFile& file);
void write_stl_ascii(const MeshView& view, WholeFile& file);
void write_gmsh_22(const MeshView& view, WholeFile& file);
void write_gmsh_41(const MeshView& view, WholeFile& file);
void write_smesh(const MeshView& view, WholeFile& file);
void write_vtp(const MeshView& view, WholeFile& file);

}  // namespace gaussmesh
