// Reading atoms from files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gaussmesh/atom.h"

namespace gaussmesh {

/// What a reader found.
struct AtomFile {
  std::vector<Atom> atoms;             ///< in the order of the file; at least one
  std::vector<std::string> warnings;   ///< `file:line: ...`, each worth a line on the terminal
};

/// Reads a PQR or XYZR file, plain or gzipped.
AtomFile read_atoms(const std::filesystem::path& path);

/// Reads PQR text that is already in memory; `name` stands for the file in messages.
AtomFile parse_pqr(std::string_view text, std::string_view name);

/// Reads XYZR text (x y z radius a line) that is already in memory; `name` stands for the file in messages.
AtomFile parse_xyzr(std::string_view text, std::string_view name);

}  // namespace gaussmesh
