#include "gaussmesh/nearest_name.h"

#include <string>
#include <vector>

#include "catch2.h"

using namespace gaussmesh;

TEST_CASE("letters are inserted, taken out, replaced and swapped") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("vwd", "vdw") == 1);
  CHECK(edit_distance("dorp", "drop") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ca", "abc") == 3);  // no place is changed twice
}

TEST_CASE("a name is meant that is near, in any case, or begins so") {
  const std::vector<std::string> presets = {"ses-volume", "ses-area", "vdw", "sas"};
  CHECK(did_you_mean("SAS", presets) == "; did you mean 'sas'?");
  CHECK(did_you_mean("vwd", presets) == "; did you mean 'vdw'?");
  CHECK(did_you_mean("ses", presets) == "; did you mean 'ses-volume'?");
  CHECK(did_you_mean("SES-ar", presets) == "; did you mean 'ses-area'?");
  CHECK(did_you_mean("xyz", presets).empty());
  CHECK(did_you_mean("", presets).empty());
}
