#include "field/local_atoms.h"

#include <algorithm>

#include "catch2.h"
#include "support/random.h"

using namespace gaussmesh;
using namespace gaussmesh::testing;

TEST_CASE("lists that come from those of a larger box have the same atoms as those that come from the field") {
  const std::uint64_t seed = 41;
  CAPTURE(seed);
  Random random(seed);
  const GaussianField field(random_cloud(random, {2000, 30.0, 1.0, 2.0, 0.3}), 0.6, 1.7);
  LocalAtoms large(field), nested(field), direct(field);
  for (int i = 0; i < 20; ++i) {
    Box box, part;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = random.uniform(-13.0, 9.0);
      box.hi[k] = box.lo[k] + 4.0;
      part.lo[k] = box.lo[k] + random.uniform(0.0, 3.5);
      part.hi[k] = part.lo[k] + 0.5;
    }
    large.move_to(box);
    nested.move_to(part, &large);
    direct.move_to(part);
    std::size_t fewer = 0;
    for (const Reach reach : {Reach::kProof, Reach::kPlain, Reach::kFine}) {
      const NearAtoms &a = nested.within(reach), &b = direct.within(reach);
      CHECK(a.cut == b.cut);
      CHECK(a.size() == b.size());
      CHECK(a.size() > fewer);
      CHECK(a.size() <= large.within(reach).size());
      CHECK(std::is_permutation(a.x.begin(), a.x.begin() + static_cast<std::ptrdiff_t>(a.size()), b.x.begin()));
      fewer = a.size();
    }
  }
}
