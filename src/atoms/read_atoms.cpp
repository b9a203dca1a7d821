// Which format a file of atoms is in; the formats themselves are parse_pqr.cpp and parse_xyzr.cpp.
#include "gaussmesh/read_atoms.h"

#include "atoms/read_file.h"

namespace gaussmesh {
namespace {

AtomFile parse_data(std::string_view data, std::string_view name) {
  return has_extension(name, ".xyzr") ? parse_xyzr(data, name) : parse_pqr(data, name);
}

}  // namespace

AtomFile read_atoms(const std::filesystem::path& path) { return parse_data(read_file(path), path.string()); }

AtomFile read_atoms(std::istream& input, std::string_view name) {
  return parse_data(read_stream(input, name), name);
}

}  // namespace gaussmesh
