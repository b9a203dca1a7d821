// What a user of the installed library writes: public headers, one target, no knowledge of the source tree.
#include <gaussmesh/check_mesh.h>
#include <gaussmesh/version.h>

#include <cstdio>

int main() {
  const gaussmesh::TriangleMesh tetrahedron = {
      {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
  };
  const gaussmesh::MeshCheck check = gaussmesh::check_mesh(tetrahedron);
  std::printf("gaussmesh %s: a tetrahedron has chi %lld\n", gaussmesh::kVersion, static_cast<long long>(check.chi));
  return check.fit_for_solver() && check.chi == 2 ? 0 : 1;
}
