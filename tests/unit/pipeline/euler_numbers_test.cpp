// Euler numbers tell meshes of different topology apart, component by component.
#include "pipeline/euler_numbers.h"

#include "catch2.h"
#include "unit/verify/shapes.h"

using namespace gaussmesh;
using namespace gaussmesh::shapes;

namespace {

using Numbers = std::vector<std::int64_t>;

/// Those of the mesh, after a look that the judge finds the same.
Numbers numbers_of(const TriangleMesh& mesh) {
  const Numbers numbers = euler_numbers(mesh);
  CHECK(euler_numbers(check_mesh(mesh).components) == numbers);
  return numbers;
}

const TriangleMesh kTorus = torus(12, 8, 3.0, 1.0);

}  // namespace

TEST_CASE("a sphere has 2, a torus 0, however many triangles they have") {
  CHECK(numbers_of(tetrahedron()) == Numbers{2});
  CHECK(numbers_of(icosphere(3, 2.0)) == Numbers{2});
  CHECK(numbers_of(kTorus) == Numbers{0});
  CHECK(numbers_of(torus(5, 3, 3.0, 1.0)) == Numbers{0});
  CHECK(numbers_of({}).empty());
}

TEST_CASE("components count one by one, in rising order, cavities as they are") {
  const TriangleMesh spheres = together(icosphere(1, 5.0), turned(icosphere(2, 2.0)));
  CHECK(numbers_of(spheres) == Numbers{2, 2});
  CHECK(numbers_of(together(moved(cube(1.0), {9, 0, 0}), kTorus)) == Numbers{0, 2});
  CHECK(numbers_of(together(kTorus, moved(cube(1.0), {9, 0, 0}))) == Numbers{0, 2});
}

TEST_CASE("a handle that is closed and a sphere that is lost do not make up for each other") {
  // chi is 2 in all of both: V - E + F of the whole does not tell them apart.
  const TriangleMesh one = icosphere(1, 2.0), two = together(moved(icosphere(1, 2.0), {9, 0, 0}), kTorus);
  CHECK(numbers_of(one) != numbers_of(two));
}
