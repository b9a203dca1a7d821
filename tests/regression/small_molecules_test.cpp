// Real molecules of up to 400 atoms: one topology at every spacing, that of the reference where there is one; and the
// same with good angles once the triangles are improved.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "support/meshing.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

struct Level {
  double decay;
  double isovalue;
};

constexpr Level kLevels[] = {{0.6, 1.7}, {0.4, 1.8}, {0.4, 1.2}, {1.0, 1.0}, {2.0, 1.0}};

/// Harder atoms take ten times as many triangles.
constexpr double kLargestImproved = 0.6;

struct Reference {
  std::size_t components = 0;
  std::int64_t chi = 0;
  std::size_t cavities = 0;
  double volume = 0.0;  // A^3
};

/// The rows of reference_topology.tsv by molecule, decay and isovalue.
std::map<std::tuple<std::string, double, double>, Reference> read_references() {
  std::map<std::tuple<std::string, double, double>, Reference> references;
  std::ifstream file(GAUSSMESH_DATA "/reference_topology.tsv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string molecule;
    double decay = 0.0, isovalue = 0.0;
    Reference r;
    fields >> molecule >> decay >> isovalue >> r.components >> r.chi >> r.cavities >> r.volume;
    references[{molecule, decay, isovalue}] = r;
  }
  return references;
}

void check_improved(const std::vector<Atom>& atoms, const MeshOptions& options, const std::vector<Piece>& traced) {
  const MeshReport report = mesh_surface(atoms, options).report;
  CHECK(report.certified);
  CHECK(report.check.fit_for_solver());
  CHECK((topology(report.check) == traced));
  CHECK(report.vertex_distance_max < 1e-6);
  CHECK(report.check.min_angle_deg > 30.0);
  CHECK(report.check.mean_edge_ratio > 0.85);
}

/// Meshes one molecule at all levels and spacings. @return how many references it was held against
int check_molecule(const std::string& name) {
  const auto references = read_references();
  const std::vector<Atom> atoms = read_atoms(std::filesystem::path(GAUSSMESH_DATA) / (name + ".pqr")).atoms;
  int compared = 0;
  for (const Level& level : kLevels) {
    std::vector<Piece> pieces;
    for (const double spacing : {1.2, 0.8, 0.5}) {
      CAPTURE(name, level.decay, level.isovalue, spacing);
      const MeshResult result = mesh_surface(atoms, options(level.decay, level.isovalue, spacing));
      const MeshCheck check = check_mesh(result.mesh);
      CHECK(check.fit_for_solver());
      CHECK(result.report.certified);
      CHECK(distance_to_surface(result.mesh, atoms, level.decay, level.isovalue).max_vertex_distance < 1e-6);
      if (pieces.empty()) pieces = topology(check);
      CHECK((topology(check) == pieces));
      const auto reference = references.find({name, level.decay, level.isovalue});
      if (reference == references.end()) continue;
      ++compared;
      std::size_t cavities = 0;
      for (const Piece& piece : pieces) cavities += piece.cavity;
      CHECK(check.components.size() == reference->second.components);
      CHECK(check.chi == reference->second.chi);
      CHECK(cavities == reference->second.cavities);
      CHECK(check.volume == Approx(reference->second.volume).epsilon(0.15 * spacing * spacing));
    }
    CAPTURE(name, level.decay, level.isovalue);
    if (level.decay > kLargestImproved) continue;
    check_improved(atoms, improved(level.decay, level.isovalue, 0.8), pieces);
  }
  return compared;
}

}  // namespace

TEST_CASE("born_ion") { CHECK(check_molecule("born_ion") == 9); }
TEST_CASE("methanol") { CHECK(check_molecule("methanol") == 9); }
TEST_CASE("dmso") { CHECK(check_molecule("dmso") == 9); }
TEST_CASE("gly3") { CHECK(check_molecule("gly3") == 9); }
TEST_CASE("adp") { CHECK(check_molecule("adp") == 9); }
TEST_CASE("1plx") { CHECK(check_molecule("1plx") == 9); }
TEST_CASE("2y29_wat") { CHECK(check_molecule("2y29_wat") == 6); }
TEST_CASE("1a1p") { CHECK(check_molecule("1a1p") == 9); }
TEST_CASE("small491") { CHECK(check_molecule("small491") == 6); }
TEST_CASE("1l2y") { CHECK(check_molecule("1l2y") == 9); }

TEST_CASE("triangles are even where they are few and the surface bends much") {
  // After the sweeps that others need the ratio was 0.845 here.
  const std::vector<Atom> peptide = read_atoms(std::filesystem::path(GAUSSMESH_DATA) / "gly3.pqr").atoms;
  CHECK(mesh_surface(peptide, improved(2.0, 1.0, 1.5)).report.check.mean_edge_ratio > 0.85);
}
