// Atoms on each other: all pairs as the oracle, places where cells meet, heaps, and what is said.
#include "atoms/close_atoms.h"

#include <random>
#include <sstream>
#include <string>

#include "catch2.h"

using namespace gaussmesh;

namespace {

/// What the definition says, by all pairs.
std::size_t count_by_pairs(const std::vector<Atom>& atoms) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = atoms[i].x - atoms[j].x, dy = atoms[i].y - atoms[j].y, dz = atoms[i].z - atoms[j].z;
      if (dx * dx + dy * dy + dz * dz < 0.01) {
        ++count;
        break;
      }
    }
  }
  return count;
}

std::vector<std::string> warnings_of(const std::string& text, const std::string& name,
                                     const ReadOptions& options = {}) {
  std::istringstream input(text);
  return read_atoms(input, name, options).warnings;
}

}  // namespace

TEST_CASE("close atoms are those that all pairs show") {
  const auto seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  for (const double size : {0.05, 0.5, 4.0, 9.0, 1e6}) {
    std::uniform_real_distribution<double> place(-size, size);
    std::uniform_real_distribution<double> step(-0.09, 0.09);
    std::vector<Atom> atoms;
    for (int i = 0; i < 1500; ++i) {
      if (i % 10 == 9) {
        const Atom& last = atoms.back();
        atoms.push_back({last.x + step(random), last.y + step(random), last.z + step(random), 1, 0});
      } else {
        atoms.push_back({place(random), place(random), place(random), 1, 0});
      }
    }
    CAPTURE(size);
    CHECK(find_close_atoms(atoms).count == count_by_pairs(atoms));
  }
}

TEST_CASE("close atoms are found across the borders of cells") {
  for (const double x : {-1e6, -8.0, -2.0, 0.0, 2.0, 8.0, 1e6 - 1}) {
    for (const double gap : {0.0, 0.0999, 0.1001}) {
      const std::vector<Atom> atoms = {{x - gap / 2, x, 0, 1, 0}, {5, 5, 5, 1, 0}, {x + gap / 2, x, 0, 1, 0}};
      CAPTURE(x, gap);
      const CloseAtoms close = find_close_atoms(atoms);
      CHECK(close.count == (gap < 0.1 ? 1 : 0));
      if (close.count > 0) {
        CHECK(close.first == 2);
        CHECK(close.partner == 0);
        CHECK(close.distance == Approx(gap).margin(1e-9));
      }
    }
  }
}

TEST_CASE("a heap of copies takes no longer than other atoms") {
  std::vector<Atom> atoms(300'000);
  for (std::size_t i = 0; i < atoms.size(); ++i) atoms[i].x = i < atoms.size() / 2 ? 0.0 : 0.5;
  CHECK(find_close_atoms(atoms).count == atoms.size() - 2);
}

TEST_CASE("files of every format are warned of atoms on each other") {
  CHECK(warnings_of("ATOM 1 N ASN 1 1.0 2.0 3.0 0.1 1.8\nREMARK\nATOM 2 N ASN 1 1.0 2.02 3.0 0.1 1.8\n", "a.pqr") ==
        std::vector<std::string>{"a.pqr:3: 0.02 A from the atom of line 1, are both meant? Both count in the surface"});
  CHECK(warnings_of("3\n0 0 0 1\n0 0 0 1\n0 0 0 2\n", "a.xyzr") ==
        std::vector<std::string>{"a.xyzr:3: 0 A from the atom of line 2, are both meant? Both count in the surface (2 "
                                 "atoms are nearer than 0.1 A to one before them)"});
  const std::string record = "ATOM      1  CA  GLY A   7       1.500  -2.250   3.125\n";
  CHECK(warnings_of("REMARK\n" + record + record, "a.pdb", {"", "bondi"}) ==
        std::vector<std::string>{"a.pdb:3: 0 A from the atom of line 2, are both meant? Both count in the surface"});
  const std::string row = "C CA GLY 1 2 3\n";
  CHECK(warnings_of("data_a\nloop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
                    "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\nO O HOH 7 7 7\n" +
                        row + row,
                    "a.cif", {"", "bondi"})
            .at(1) == "a.cif: atom 3: 0 A from atom 2, are both meant? Both count in the surface");
  CHECK(warnings_of("0 0 0 1\n0 0 0.11 1\n", "a.xyzr").empty());
}
