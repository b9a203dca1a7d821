// Inputs for which the program once gave a wrong answer, or none.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "catch2.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "support/meshing.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("roots on an edge beside a larger cell come from all atoms near it, not from those of the smaller cell") {
  const std::vector<Atom> atoms = {
      {12.93807866857468, 3.8415269544943267, -13.5235476729188, 21.14704326819342, 0},
      {-15.604815241714098, -18.530928625158566, -7.6303011172487425, 21.25997991300151, 0},
      {12.52977004398884, 6.845117118174883, 26.176986333410298, 21.28563910623902, 0},
      {14.441921328526973, -26.09428556987157, 8.536997939337816, 21.089986518813866, 0},
      {1.2072430586098637, 14.183319099908525, 1.0328340640637566, 21.339577954338417, 0},
      {-13.72235022811678, 3.365135678984143, 10.500338401968923, 21.242993085036154, 0}};
  MeshOptions o = options(2.0, 1.2, 93.18025873376475);
  const MeshResult coarse = mesh_surface(atoms, o);
  CHECK(coarse.report.certified);
  o.spacing = 6.0;
  CHECK(topology(coarse) == topology(mesh_surface(atoms, o)));

  std::vector<Atom> chain;
  for (int i = 0; i < 8; ++i) {
    chain.push_back(
        {-423930.1427102475 + 6.5489713577 * i, 719510.6633774473, -210934.15759350942, 2.986246292529033, 0});
  }
  const MeshResult one = mesh_surface(chain, improved(1.0, 1.905710772017396e-07, 35.16143092961223));
  CHECK(one.report.certified);
  CHECK(topology(one) == std::vector<Piece>{{0, false}});
}

TEST_CASE("cells that are too coarse are not taken for a critical level") {
  const std::vector<Atom> atoms = {{568853.3569490163, -550030.7361057266, 275826.6545098756, 7.9396739372636205, 0},
                                   {568873.0866632913, -550035.6387718589, 275818.4842344294, 7.963040943525976, 0},
                                   {568829.3521601798, -550008.1273893256, 275814.3863717395, 8.036396610614803, 0},
                                   {568820.7560975652, -550017.6607898786, 275838.539900276, 7.938724626518845, 0},
                                   {568823.9521706692, -550024.7210474915, 275826.8257984674, 7.933948113790164, 0},
                                   {568827.713101538, -550034.9567939622, 275815.2027553085, 8.027458938210629, 0}};
  const MeshOptions o = options(156.27414323136, 8739.037766798241, 19.176228971477563);
  CHECK_THROWS_AS(mesh_surface(atoms, o), CannotMeshError);
  CHECK_THROWS_WITH(mesh_surface(atoms, o), ContainsSubstring("choose a smaller spacing"));
}

TEST_CASE("where phi hardly changes vertices are on the surface of all atoms, not of those in a list") {
  // Next to the greatest value of phi over a sheet of atoms the slope is so small that 1e-10 left out is felt: without
  // these vertices were up to 2e-6 A off.
  std::vector<Atom> sheet;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) sheet.push_back({0.7 * i, 0.7 * j, 0.027, 1.2, 0});
  }
  const MeshResult traced = mesh_surface(sheet, options(0.6, 25.3528305790182, 0.5));
  CHECK(traced.report.certified);
  CHECK(traced.report.vertex_distance_max < 1e-6);
  // Next to a saddle of a molecule.
  const std::vector<Atom> peptide = read_atoms(std::filesystem::path(GAUSSMESH_DATA) / "1a1p.pqr").atoms;
  const MeshResult mended = mesh_surface(peptide, improved(0.6, 2.1853182796052959, 0.8));
  CHECK(mended.report.certified);
  CHECK(mended.report.vertex_distance_max < 1e-6);
}

TEST_CASE("a level beside one that cannot be certified has a surface") {
  const std::vector<Atom> atoms = {{0, 0, 0, 1.5, 0}, {1.8257418583505538, 0, 0, 1.5, 0}};
  MeshOptions o = improved(0.6, 4.67929370378, 4.0);  // 1.5e-11 below the greatest value of phi
  o.allow_uncertified = true;
  const MeshResult result = mesh_surface(atoms, o);
  CHECK_FALSE(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}});
}

TEST_CASE("the neck of a level beside one that cannot be certified has triangles as small as it needs") {
  const double decay = 0.6, radius = 4.0, distance = 8.4;
  const std::vector<Atom> atoms = {{0.3, 0.2, 0.1, radius, 0}, {0.3 + distance, 0.2, 0.1, radius, 0}};
  MeshOptions o = improved(decay, 2.0 * std::exp(-decay * (0.25 * distance * distance - radius * radius)), 0.5);
  o.allow_uncertified = true;
  const MeshResult result = mesh_surface(atoms, o);
  CHECK_FALSE(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}});
  CHECK(result.report.check.fraction_under_30_deg < 0.02);
}

TEST_CASE("where the finer cells for improvement cannot be traced the others are") {
  const std::vector<Atom> atoms = {{0, 0, 0, 1.5, 0}, {1.8257418583505538, 0, 0, 1.5, 0}};
  const MeshResult result = mesh_surface(atoms, improved(0.6, 4.6792937033840518, 0.3));
  CHECK(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}});
}

TEST_CASE("an atom far from the origin that wants the smallest cells is not missed") {
  // Two spheres of a ten-thousandth of an A.
  const double decay = 0.6, isovalue = 1.7, far = 425000.0, radius = std::sqrt(1e-8 + std::log(isovalue) / decay);
  const std::vector<Atom> atoms = {{0, 0, 0, radius, 0}, {far, far, far, radius, 0}};
  const MeshResult result = mesh_surface(atoms, improved(decay, isovalue, 0.01));
  CHECK(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}, {0, false}});
}

TEST_CASE("a large crease that samples may happen to lie on does not make the mesh look too large") {
  // x, y, z, r; across the direction of one of the samples.
  const std::vector<Atom> atoms = {{0, 0, 0, 1000, 0}, {860.374350504662, -96.256007881888, 245.948689649533, 1000, 0}};
  const MeshResult result = mesh_surface(atoms, improved(0.6, 1.7, 50.0));
  CHECK(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}});
}

TEST_CASE(
    "creases between large spheres that the first trace bridges are traced anew, however many triangles they have") {
  // x, y, z, r; the last is a neck on a point of the lattice.
  const auto smallest_angle = [](const std::vector<Atom>& atoms, double decay, double isovalue, double spacing) {
    return mesh_surface(atoms, improved(decay, isovalue, spacing)).report.check.min_angle_deg;
  };
  CHECK(smallest_angle({{0, 0, 0, 40, 0}, {50, 0, 0, 40, 0}}, 0.6, 1.7, 5.0) > 30.0);
  CHECK(smallest_angle({{0, 0, 0, 30, 0}, {30, 0, 0, 30, 0}}, 0.6, 1.7, 5.0) > 30.0);
  CHECK(smallest_angle({{0.186, 0.207, 0.118, 2, 0}, {4.186, 0.207, 0.118, 2, 0}}, 10.0, 1.0, 0.5) > 30.0);
}

TEST_CASE(
    "the waist of a neck between large spheres, a sharp edge round a small hole, has triangles as small as it needs") {
  const auto smallest_angle = [](double distance, double radius, double decay, double nearness, double spacing) {
    const double half = 0.5 * distance;
    const std::array<double, 3> along = {0.48 * half, 0.6 * half, 0.64 * half};
    const std::vector<Atom> atoms = {{0.3 - along[0], 0.2 - along[1], 0.1 - along[2], radius, 0},
                                     {0.3 + along[0], 0.2 + along[1], 0.1 + along[2], radius, 0}};
    const double saddle = 2.0 * std::exp(-decay * (half * half - radius * radius));
    const MeshResult result = mesh_surface(atoms, improved(decay, (1.0 - nearness) * saddle, spacing));
    CHECK(topology(result) == std::vector<Piece>{{0, false}});
    return result.report.check.min_angle_deg;
  };
  CHECK(smallest_angle(16.32, 8.0, 0.6, 1e-5, 0.5) > 30.0);
  CHECK(smallest_angle(16.32, 8.0, 2.0, 1e-3, 1.5) > 30.0);
  CHECK(smallest_angle(6.12, 3.0, 2.0, 1e-6, 1.5) > 30.0);
}

TEST_CASE("where one vertex in twenty is at a bad triangle mending goes on until angles are good") {
  for (const double shift : {0.0, 0.3, -1.7, 2.9}) {
    CAPTURE(shift);
    const std::vector<Atom> atoms = {{2.32 + shift, 3.44 - shift, 1.88, 1.44, 0},
                                     {1.0 + shift, 0.84 - shift, 0.11, 1.92, 0},
                                     {3.44 + shift, 2.18 - shift, 1.25, 1.31, 0}};
    CHECK(mesh_surface(atoms, improved(8.0, 1.0, 1.5)).report.check.min_angle_deg > 30.0);
  }
}

TEST_CASE("near a critical level that large cells cannot certify smaller ones do, and a mesh as traced says so") {
  // Two spheres that nearly touch: between them phi is c (1 - 5e-7) at most.
  const std::vector<Atom> atoms = {{0, 0, 0, 14, 0}, {17.3, 19.1, 12.4, 14, 0}};
  const double isovalue = 0.007883665490959148;
  const MeshResult result = mesh_surface(atoms, improved(0.654, isovalue, 5.0));
  CHECK(result.report.certified);
  CHECK(topology(result) == std::vector<Piece>{{0, false}, {0, false}});
  CHECK(result.report.check.min_angle_deg > 30.0);
  CHECK_THROWS_WITH(mesh_surface(atoms, options(0.654, isovalue, 5.0)), ContainsSubstring("a smaller spacing"));
}

TEST_CASE("where small atoms make cells as large as the molecule too large for the proof, triangles stay good") {
  std::vector<Atom> atoms = {{0, 0, 0, 50.0, 0}};
  constexpr int kBumps = 60;  // low ones on its surface, by the golden angle
  constexpr double kOut = 50.625;
  for (int i = 0; i < kBumps; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kBumps, r = std::sqrt(1.0 - z * z), angle = -2.39996323 * (i + 0.5);
    atoms.push_back({kOut * r * std::cos(angle), kOut * r * std::sin(angle), kOut * z, 0.1, 0});
  }
  const MeshResult result = mesh_surface(atoms, improved(0.6, 1.7, 50.0));
  CHECK(topology(result) == std::vector<Piece>{{0, false}});
  CHECK(result.report.check.min_angle_deg > 30.0);
  CHECK(result.mesh.triangles.size() < 100);
}

TEST_CASE("a place where no box changes anything is not worked on to the end") {
  const std::vector<Atom> part_of_1ubq = {
      {28.916, 21.09, 17.156, 1.487, 0},  {31.568, 16.962, 19.825, 1.908, 0}, {30.32, 16.698, 19.051, 1.908, 0},
      {30.198, 15.657, 18.366, 1.661, 0}, {29.34, 17.594, 19.076, 1.824, 0},  {28.108, 17.439, 18.276, 1.908, 0},
      {28.375, 17.999, 16.887, 1.908, 0}, {29.326, 18.786, 16.69, 1.661, 0},  {26.926, 18.191, 18.892, 1.908, 0},
      {26.621, 17.799, 20.352, 1.908, 0}, {26.01, 16.37, 20.28, 1.908, 0},    {26.975, 15.521, 20.942, 1.824, 0},
      {27.603, 14.423, 20.655, 1.908, 0}, {27.479, 13.733, 19.537, 1.824, 0}, {29.506, 18.409, 19.699, 0.6, 0},
      {27.898, 16.47, 18.202, 1.387, 0},  {27.128, 19.164, 18.879, 1.487, 0}, {26.113, 17.998, 18.355, 1.487, 0},
      {27.444, 17.747, 20.856, 1.487, 0}, {25.95, 18.391, 20.717, 1.487, 0},  {25.177, 16.389, 20.77, 1.387, 0},
      {25.934, 16.138, 19.344, 1.387, 0}, {26.851, 14.103, 18.83, 0.6, 0},    {27.51, 17.689, 15.954, 1.824, 0},
      {27.574, 18.192, 14.563, 1.908, 0}, {26.741, 17.038, 16.266, 0.6, 0},   {25.303, 15.894, 17.152, 1.661, 0}};
  MeshOptions o = improved(4.0, 1.0, 1.5);
  double share_done = 0.0;  // but for the end, where it is 1
  o.on_improving = [&](double share) { share_done = share < 1.0 ? std::max(share_done, share) : share_done; };
  CHECK(mesh_surface(part_of_1ubq, o).report.check.min_angle_deg > 30.0);
  CHECK(share_done < 0.8);
}
