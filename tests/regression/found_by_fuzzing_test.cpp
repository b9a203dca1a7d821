// Inputs for which the program once gave a wrong answer, or none.
#include "catch2.h"
#include "gaussmesh/error.h"
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
