// Measures of a mesh by the atoms of its molecule: what of it belongs to which, how far from their spheres it is,
// and which charges it leaves out.

#include "gaussmesh/measure_mesh.h"

#include <algorithm>
#include <cmath>

#include "gaussmesh/error.h"
#include "verify/atom_tree.h"
#include "verify/component_geometry.h"
#include "verify/exact_orientation.h"
#include "verify/parallel.h"
#include "verify/triangle_tree.h"
#include "verify/vector3.h"

namespace gaussmesh {

using namespace verify;

namespace {

/// What is asked of the atoms at a vertex.
struct AtomsAtVertex {
  std::uint32_t nearest = 0;
  double relative_distance = 0.0;
};

std::vector<AtomsAtVertex> ask_atoms(const TriangleMesh& mesh, const std::vector<Atom>& atoms) {
  const AtomTree tree(atoms);
  std::vector<AtomsAtVertex> answers(mesh.vertices.size());
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t v = 0; v < answers.size(); ++v)
    answers[v] = {tree.nearest(mesh.vertices[v]), tree.least_relative_distance(mesh.vertices[v])};
  return answers;
}

double area_of(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Point& corner = mesh.vertices[a];
  return length(cross(difference(mesh.vertices[b], corner), difference(mesh.vertices[c], corner))) / 2;
}

/// The triangles that were judged, and their components.
struct JudgedTriangles {
  TriangleMesh mesh;
  std::vector<std::uint32_t> component_of;
};

JudgedTriangles find_judged(const TriangleMesh& mesh, const MeshCheck& check) {
  JudgedTriangles judged;
  judged.mesh.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (check.component_of[t] == kNoComponent) continue;
    judged.mesh.triangles.push_back(mesh.triangles[t]);
    judged.component_of.push_back(check.component_of[t]);
  }
  return judged;
}

/// The centre; a coordinate too small for exact signs is 0, 1e-60 A away at most.
Point exact_centre(const Atom& atom) {
  Point centre{atom.x, atom.y, atom.z};
  for (double& x : centre)
    if (std::abs(x) < kSmallestExact) x = 0.0;
  return centre;
}

}  // namespace

AtomMeasures measure_by_atoms(const TriangleMesh& mesh, const std::vector<Atom>& atoms) {
  if (atoms.empty()) throw OptionError("atoms: expected at least one, got 'none'");
  const std::vector<AtomsAtVertex> answers = ask_atoms(mesh, atoms);
  AtomMeasures measures;
  measures.areas.resize(atoms.size());
  for (const Triangle& triangle : mesh.triangles) {
    const double third = area_of(mesh, triangle) / 3;
    for (const std::uint32_t vertex : triangle) measures.areas[answers[vertex].nearest] += third;
  }
  const bool has_radius = std::any_of(atoms.begin(), atoms.end(), [](const Atom& a) { return a.radius > 0.0; });
  if (answers.empty() || !has_radius) return measures;
  double sum = 0.0;
  for (const AtomsAtVertex& answer : answers) sum += answer.relative_distance - 1;
  measures.vdw_distance = sum / static_cast<double>(answers.size());
  return measures;
}

std::vector<std::uint32_t> find_charges_outside(const TriangleMesh& mesh, const MeshCheck& check,
                                                const std::vector<Atom>& atoms) {
  const JudgedTriangles judged = find_judged(mesh, check);
  std::vector<bool> is_closed;
  for (const MeshComponent& component : check.components) is_closed.push_back(component.closed);
  const TriangleTree tree(judged.mesh);
  std::vector<std::uint8_t> is_outside(atoms.size());
  parallel_for(atoms.size(), [&](std::size_t i) {
    if (atoms[i].charge == 0.0) return;
    const auto around =
        find_components_around(exact_centre(atoms[i]), judged.mesh, judged.component_of, is_closed, tree);
    is_outside[i] = around.size() % 2 == 0;
  });
  std::vector<std::uint32_t> outside;
  for (std::size_t i = 0; i < atoms.size(); ++i)
    if (is_outside[i] != 0) outside.push_back(static_cast<std::uint32_t>(i));
  return outside;
}

}  // namespace gaussmesh
