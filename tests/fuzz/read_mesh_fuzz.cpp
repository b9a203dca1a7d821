// Any bytes are a mesh of finite coordinates or an InputError, in every format.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "gaussmesh/error.h"
#include "gaussmesh/read_mesh.h"

namespace {

using gaussmesh::MeshFile;

void require(bool promise) {
  if (!promise) std::abort();
}

void check(const MeshFile& file) {
  const std::size_t vertices = file.mesh.vertices.size();
  for (const gaussmesh::Point& p : file.mesh.vertices)
    require(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
  require(file.data.normals.empty() || file.data.normals.size() == vertices);
  require(file.data.atoms.empty() || file.data.atoms.size() == vertices);
  require(file.data.components.empty() || file.data.components.size() == vertices);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const std::string_view name : {"fuzz.off", "fuzz.obj", "fuzz.stl", "fuzz.smesh", "fuzz"}) {
    try {
      check(gaussmesh::parse_mesh(bytes, name));
    } catch (const gaussmesh::InputError& error) {
      require(std::string_view(error.what()).starts_with(name));
    }
  }
  const std::size_t half = bytes.size() / 2;
  try {
    check(gaussmesh::parse_msms(bytes.substr(0, half), "fuzz.vert", bytes.substr(half), "fuzz.face"));
  } catch (const gaussmesh::InputError& error) {
    require(std::string_view(error.what()).starts_with("fuzz."));
  }
  return 0;
}
