// Molecules of any kind: the mesh is fit for a solver, and its topology depends neither on the spacing, nor on how
// the molecule is turned, nor on whether triangles are improved.
#include <string>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "support/exact_field.h"
#include "support/meshing.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

namespace {

/// A molecule with its level and two spacings to mesh it at.
struct Problem {
  std::vector<Atom> atoms;
  double decay = 0.6;
  double isovalue = 1.0;
  double spacing = 0.5;
  double other_spacing = 1.0;
};

/// Turned about the origin by a random rotation: a unit quaternion.
std::vector<Atom> turned(const std::vector<Atom>& atoms, Random& random) {
  double q[4], length_sq = 0.0;
  do {
    length_sq = 0.0;
    for (double& x : q) {
      x = random.uniform(-1.0, 1.0);
      length_sq += x * x;
    }
  } while (length_sq > 1.0 || length_sq < 0.01);
  for (double& x : q) x /= std::sqrt(length_sq);
  const auto [w, x, y, z] = q;
  std::vector<Atom> result = atoms;
  for (Atom& a : result) {
    const Vec3 p = {a.x, a.y, a.z};
    a.x = (1 - 2 * (y * y + z * z)) * p[0] + 2 * (x * y - w * z) * p[1] + 2 * (x * z + w * y) * p[2];
    a.y = 2 * (x * y + w * z) * p[0] + (1 - 2 * (x * x + z * z)) * p[1] + 2 * (y * z - w * x) * p[2];
    a.z = 2 * (x * z - w * y) * p[0] + 2 * (y * z + w * x) * p[1] + (1 - 2 * (x * x + y * y)) * p[2];
  }
  return result;
}

/// What became of a molecule.
struct Outcome {
  enum class Kind { kMeshed, kNothing, kCritical } kind = Kind::kMeshed;
  std::vector<Piece> pieces;
  std::size_t folds = 0;
  std::size_t splits = 0;
  double fraction_under_30 = 0.0;
};

Outcome mesh(const std::vector<Atom>& atoms, const MeshOptions& options) {
  try {
    const MeshResult result = mesh_surface(atoms, options);
    const MeshReport& report = result.report;
    CHECK(report.certified);
    CHECK(report.check.fit_for_solver());
    CHECK(report.vertex_distance_max < 1e-6);
    return {Outcome::Kind::kMeshed, topology(result), report.cells_cut_by_folds, report.cells_split,
            report.check.fraction_under_30_deg};
  } catch (const CannotMeshError& error) {
    const std::string message = error.what();
    if (message.find("nothing to mesh") != std::string::npos) return {Outcome::Kind::kNothing, {}};
    INFO(message);
    CHECK(message.find("critical value") != std::string::npos);
    return {Outcome::Kind::kCritical, {}};
  }
}

Outcome mesh_as_traced(const std::vector<Atom>& atoms, const Problem& problem, double spacing) {
  return mesh(atoms, options(problem.decay, problem.isovalue, spacing));
}

/// What a test has seen in all, so that it can tell that it looked at something.
struct Seen {
  int meshed = 0;
  int nothing = 0;
  std::size_t folds = 0;
  std::size_t splits = 0;
  int with_small_angles = 0;  ///< improved meshes
};

void check_problem(const Problem& problem, Random& random, Seen& seen) {
  CAPTURE(problem.decay, problem.isovalue, problem.spacing, problem.other_spacing);
  const Outcome first = mesh_as_traced(problem.atoms, problem, problem.spacing);
  CHECK(first.kind != Outcome::Kind::kCritical);
  const Outcome other = mesh_as_traced(problem.atoms, problem, problem.other_spacing);
  const Outcome rotated = mesh_as_traced(turned(problem.atoms, random), problem, problem.spacing);
  const Outcome finished = mesh(problem.atoms, improved(problem.decay, problem.isovalue, problem.spacing));
  for (const Outcome* o : {&other, &rotated, &finished}) {
    CHECK((o->kind == first.kind));
    CHECK((o->pieces == first.pieces));
  }
  seen.folds += other.folds + rotated.folds;
  seen.splits += other.splits + rotated.splits;
  CHECK(finished.fraction_under_30 < 0.02);  // where a surface is finer than triangles may be
  seen.with_small_angles += finished.fraction_under_30 > 0.0;
  seen.meshed += first.kind == Outcome::Kind::kMeshed;
  seen.nothing += first.kind == Outcome::Kind::kNothing;
}

Problem random_problem(Random& random) {
  Problem problem;
  problem.decay = random.logarithmic(0.25, 3.0);
  problem.isovalue = random.logarithmic(0.4, 3.0);
  problem.spacing = random.logarithmic(0.3, 2.0);
  problem.other_spacing = random.logarithmic(0.3, 2.0);
  return problem;
}

std::vector<Atom> cloud(Random& random, int least, int most) {
  const int atoms = static_cast<int>(random.integer(least, most));
  const double size = std::cbrt(static_cast<double>(atoms)) * random.uniform(1.2, 3.5);
  return random_cloud(random, {atoms, size, 0.6, 2.5, 0.1});
}

/// Runs `count` problems with seeds from `first_seed` on.
template <typename Make>
Seen run(std::uint64_t first_seed, int count, const Make& make) {
  Seen seen;
  for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(count); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Problem problem = random_problem(random);
    make(random, problem);
    check_problem(problem, random, seen);
  }
  CHECK(10 * seen.with_small_angles <= seen.meshed);
  return seen;
}

}  // namespace

TEST_CASE("random clouds") {
  const Seen seen = run(1000, 25, [](Random& random, Problem& p) { p.atoms = cloud(random, 2, 30); });
  CHECK(seen.meshed > 20);
  CHECK(seen.folds > 0);
  CHECK(seen.splits > 0);
}

TEST_CASE("random clouds at spacings up to 5 A, larger than the atoms") {
  const Seen seen = run(2000, 25, [](Random& random, Problem& p) {
    p.atoms = cloud(random, 2, 30);
    p.spacing = random.uniform(2.0, 5.0);
    p.other_spacing = random.uniform(0.8, 3.0);
  });
  CHECK(seen.meshed > 20);
  CHECK(seen.splits > 100);
}

TEST_CASE("atoms on a grid, lined up with the lattice") {
  const Seen seen = run(3000, 15, [](Random& random, Problem& p) {
    const double step = 0.5 * static_cast<double>(random.integer(2, 8)),
                 radius = 0.5 * static_cast<double>(random.integer(2, 5));
    const auto nx = random.integer(1, 3), ny = random.integer(1, 3), nz = random.integer(1, 4);
    for (std::int64_t x = 0; x < nx; ++x) {
      for (std::int64_t y = 0; y < ny; ++y) {
        for (std::int64_t z = 0; z < nz; ++z) {
          p.atoms.push_back(
              {step * static_cast<double>(x), step * static_cast<double>(y), step * static_cast<double>(z), radius, 0});
        }
      }
    }
    p.decay = 0.5;
    p.spacing = 0.5;
    p.other_spacing = 1.0;
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("atoms in a row along an axis") {
  const Seen seen = run(4000, 15, [](Random& random, Problem& p) {
    const auto axis = random.integer(0, 2);
    const double step = random.uniform(1.0, 5.0), radius = random.uniform(1.0, 2.2);
    for (int i = 0; i < 6; ++i) {
      Vec3 at{};
      at[axis] = step * i;
      p.atoms.push_back({at[0], at[1], at[2], radius, 0});
    }
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("coincident atoms") {
  const Seen seen = run(5000, 15, [](Random& random, Problem& p) {
    for (int i = 0; i < 3; ++i) {
      const Atom a{static_cast<double>(random.integer(-3, 3)), static_cast<double>(random.integer(-3, 3)),
                   static_cast<double>(random.integer(-3, 3)), 1.5, 0};
      p.atoms.insert(p.atoms.end(), static_cast<std::size_t>(random.integer(1, 4)), a);
    }
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("symmetric molecules centred on the origin") {
  const Seen seen = run(6000, 20, [](Random& random, Problem& p) {
    const double size = random.uniform(1.0, 5.0), radius = random.uniform(0.8, 2.4);
    const auto kind = random.integer(0, 2);
    if (kind == 0) {
      for (int i = 0; i < 8; ++i)
        p.atoms.push_back({i & 1 ? size : -size, i & 2 ? size : -size, i & 4 ? size : -size, radius, 0});
    } else if (kind == 1) {
      for (int i = 0; i < 6; ++i) {
        Vec3 at{};
        at[i / 2] = i % 2 ? size : -size;
        p.atoms.push_back({at[0], at[1], at[2], radius, 0});
      }
    } else {
      p.atoms =
          atom_ring(static_cast<int>(random.integer(3, 16)), size, radius, static_cast<int>(random.integer(0, 2)));
    }
    if (random.integer(0, 2) == 0) p.atoms.push_back({0, 0, 0, radius, 0});
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("very soft atoms: decay 0.05") {
  const Seen seen = run(7000, 15, [](Random& random, Problem& p) {
    p.atoms = cloud(random, 2, 20);
    p.decay = 0.05;
    p.isovalue = random.uniform(0.3, 0.8) * static_cast<double>(p.atoms.size());
  });
  CHECK(seen.meshed > 5);
}

TEST_CASE("very hard atoms: decay 20") {
  const Seen seen = run(8000, 15, [](Random& random, Problem& p) {
    p.atoms = random_cloud(random, {8, 4.0, 0.5, 1.8, 0.1});
    p.decay = 20.0;
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("radii from 0 to 35 A in one molecule") {
  const Seen seen = run(9000, 8, [](Random& random, Problem& p) {
    p.atoms = random_cloud(random, {5, 60.0, 0.5, 10.0, 0.2});
    p.atoms.push_back({random.uniform(-5.0, 5.0), 0, 0, 35.0, 0});
    p.decay = random.uniform(0.3, 0.6);
    p.spacing = random.uniform(2.0, 4.0);
    p.other_spacing = random.uniform(3.0, 6.0);
  });
  CHECK(seen.meshed == 8);
}

TEST_CASE("far from the origin") {
  const Seen seen = run(10000, 15, [](Random& random, Problem& p) {
    p.atoms = cloud(random, 2, 10);
    const double far = random.logarithmic(1e3, 5e5);  // turning about the origin keeps it below 10^6
    for (Atom& a : p.atoms) a.x += far, a.y -= far, a.z += far;
  });
  CHECK(seen.meshed > 10);
}

TEST_CASE("necks and tunnels close to critical, by 10^-2 to 10^-7 of c") {
  Seen seen;
  for (std::uint64_t seed = 11000; seed < 11012; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Problem problem = random_problem(random);
    // Between two atoms, or in the middle of a ring, the critical value is known.
    const double radius = random.uniform(1.2, 2.0);
    double critical = 0.0;
    if (seed % 2 == 0) {
      const double distance = radius * random.uniform(2.0, 3.0);
      problem.atoms = {{0, 0, 0, radius, 0}, {distance, 0, 0, radius, 0}};
      critical = 2.0 * std::exp(-problem.decay * (0.25 * distance * distance - radius * radius));
    } else {
      const double ring = radius * random.uniform(1.1, 1.4);
      problem.atoms = atom_ring(9, ring, radius);
      critical = 9.0 * std::exp(-problem.decay * (ring * ring - radius * radius));
    }
    problem.atoms = turned(problem.atoms, random);
    const double change = std::pow(10.0, -random.uniform(2.0, 7.0));
    std::vector<Piece> pieces[2];
    for (const int side : {0, 1}) {
      problem.isovalue = critical * (side == 0 ? 1.0 - change : 1.0 + change);
      check_problem(problem, random, seen);
      pieces[side] = mesh_as_traced(problem.atoms, problem, 0.7).pieces;
    }
    CHECK((pieces[0] != pieces[1]));
  }
  CHECK(seen.splits > 0);
}
