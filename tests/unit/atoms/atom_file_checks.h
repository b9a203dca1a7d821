// Helpers of the reader's tests: edge files by name, messages of errors, comparison of atoms.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"

namespace gaussmesh {

inline std::filesystem::path edge_path(const std::string& name) {
  return std::filesystem::path(GAUSSMESH_TEST_DATA) / "edge" / name;
}

inline AtomFile read_edge(const std::string& name) { return read_atoms(edge_path(name)); }

/// The message of the InputError that `read` throws; empty if it throws none.
template <class Read>
std::string input_error_of(Read read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// True if `a` and `b` are the same to the last bit.
inline bool same_atom(const Atom& a, const Atom& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius && a.charge == b.charge;
}

inline void require_same_atoms(const std::vector<Atom>& atoms, const std::vector<Atom>& expected) {
  REQUIRE(atoms.size() == expected.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    INFO("atom " << i);
    REQUIRE(same_atom(atoms[i], expected[i]));
  }
}

}  // namespace gaussmesh
