// Any bytes are either atoms within the promised ranges or an InputError, and reading them again gives the same.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"

namespace {

using gaussmesh::Atom;
using gaussmesh::AtomFile;

void require(bool promise) {
  if (!promise) {
    std::abort();
  }
}

bool is_coordinate(double value) { return std::abs(value) <= gaussmesh::kLargestCoordinate; }

void check(AtomFile (*parse)(std::string_view, std::string_view), std::string_view text) {
  try {
    const AtomFile file = parse(text, "fuzz");
    require(!file.atoms.empty());
    require(file.names.empty() || file.names.size() == file.atoms.size());
    for (const Atom& atom : file.atoms) {
      require(is_coordinate(atom.x) && is_coordinate(atom.y) && is_coordinate(atom.z));
      require(atom.radius >= 0.0 && atom.radius <= gaussmesh::kLargestRadius && std::isfinite(atom.charge));
    }
    require(parse(text, "fuzz").atoms.size() == file.atoms.size());
  } catch (const gaussmesh::InputError& error) {
    require(std::string_view(error.what()).starts_with("fuzz:"));
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr auto kKeep = gaussmesh::AtomNames::kKeep;
  check([](std::string_view t, std::string_view name) { return gaussmesh::parse_pqr(t, name, kKeep); }, text);
  check(gaussmesh::parse_xyzr, text);
  check([](std::string_view t, std::string_view name) { return gaussmesh::parse_pdb(t, name, "bondi", {}, kKeep); },
        text);
  check([](std::string_view t, std::string_view name) { return gaussmesh::parse_mmcif(t, name, "bondi", {}, kKeep); },
        text);
  return 0;
}
