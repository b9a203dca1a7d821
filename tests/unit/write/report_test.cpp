#include <nlohmann/json.hpp>

#include "catch2.h"
#include "gaussmesh/mesh_surface.h"

using namespace gaussmesh;

namespace {

MeshReport sample_report() {
  MeshReport report;
  report.atoms = 906;
  report.options.decay = 0.6;
  report.options.isovalue = 1.7;
  report.options.spacing = 0.5;
  report.isovalue_used = 1.7;
  report.boxes = {{2.0, 100}, {1.0, 700}, {0.5, 5000}};
  report.smallest_box = 0.25;
  report.cells = 20000;
  report.cells_cut_by_folds = 7;
  report.cells_split = 3;
  report.certified = true;
  report.vertex_distance_max = 1.5e-9;
  report.check.vertices = 1002;
  report.check.triangles = 2000;
  report.check.chi = 2;
  report.check.area = 3500.25;
  report.check.volume = 7400.5;
  MeshComponent outside;
  outside.chi = 0;
  outside.genus = 1;
  outside.area = 3400.0;
  outside.volume = 7500.5;
  outside.closed = true;
  MeshComponent cavity;
  cavity.chi = 2;
  cavity.area = 100.25;
  cavity.volume = -100.0;
  cavity.closed = true;
  cavity.depth = 1;
  report.check.components = {outside, cavity};
  report.stages = {{"field", 0.25, 30.0}, {"boxes and roots", 1.5, 80.0}};
  return report;
}

}  // namespace

TEST_CASE("the report is JSON that has all that was done and proved") {
  const auto json = nlohmann::json::parse(report_json(sample_report()));
  CHECK(json.at("atoms") == 906);
  CHECK(json.at("options").at("decay_per_A2") == 0.6);
  CHECK(json.at("options").at("isovalue") == 1.7);
  CHECK(json.at("options").at("spacing_A") == 0.5);
  CHECK(json.at("triangles") == 2000);
  CHECK(json.at("vertices") == 1002);
  CHECK(json.at("chi") == 2);
  CHECK(json.at("area_A2") == 3500.25);
  CHECK(json.at("volume_A3") == 7400.5);
  CHECK(json.at("certified") == true);
  CHECK(json.at("proof").at("cells_cut_by_folds") == 7);
  CHECK(json.at("proof").at("cells_split") == 3);
  CHECK(json.at("proof").at("smallest_box_A") == 0.25);
  CHECK(json.at("proof").at("boxes_per_level").size() == 3);
  CHECK(json.at("components").size() == 2);
  CHECK(json.at("components").at(0).at("genus") == 1);
  CHECK(json.at("components").at(1).at("kind") == "cavity");
  CHECK(json.at("components").at(1).at("volume_A3") == -100.0);
  CHECK(json.at("stages").size() == 2);
}

TEST_CASE("what the caller knows of the atoms is in the report, in UTF-8 whatever the name") {
  MeshReport report = sample_report();
  auto json = nlohmann::json::parse(report_json(report));
  CHECK(json.at("input").at("file").is_null());
  CHECK(json.at("input").at("radii").is_null());
  CHECK(json.at("input").at("warnings").empty());
  CHECK(json.at("options").at("cavities") == "keep");
  report.source = {"\xff.pdb", "bondi", {"left out 3 atoms of water"}};
  report.cavities = "drop";
  report.min_cavity_volume = 11.4;
  json = nlohmann::json::parse(report_json(report));
  CHECK_THAT(json.at("input").at("file").get<std::string>(), Catch::Matchers::ContainsSubstring(".pdb"));
  CHECK(json.at("input").at("radii") == "bondi");
  CHECK(json.at("input").at("radii_file").is_null());
  CHECK(json.at("input").at("warnings").at(0) == "left out 3 atoms of water");
  CHECK(json.at("options").at("cavities") == "drop");
  CHECK(json.at("options").at("min_cavity_volume_A3") == 11.4);
}

TEST_CASE("critical places are in the report with the distance of c from their value") {
  MeshReport report = sample_report();
  report.certified = false;
  report.isovalue_used = 1.71;
  report.critical = {{{1.0, 2.0, 3.0}, 1.75}};
  const auto json = nlohmann::json::parse(report_json(report));
  const auto& place = json.at("proof").at("critical_places").at(0);
  CHECK(place.at("critical_value") == 1.75);
  CHECK(place.at("distance_of_isovalue").get<double>() == Approx(0.05));
  CHECK(place.at("point_A").at(2) == 3.0);
  CHECK(json.at("certified") == false);
}

TEST_CASE("the summary counts components, cavities and handles, and says whether that is proved") {
  const std::string good = report_summary(sample_report());
  CHECK_THAT(good, Catch::Matchers::ContainsSubstring("2000 triangles"));
  CHECK_THAT(good, Catch::Matchers::ContainsSubstring("certified"));
  CHECK_THAT(good, Catch::Matchers::ContainsSubstring("1 component, 1 cavity, 1 handle"));
  MeshReport report = sample_report();
  report.certified = false;
  report.isovalue_used = 1.70000001;
  const std::string uncertain = report_summary(report);
  CHECK_THAT(uncertain, Catch::Matchers::ContainsSubstring("NOT certified"));
  CHECK_THAT(uncertain, Catch::Matchers::ContainsSubstring("1.70000001"));
}

TEST_CASE("the summary has no exponents where numbers are large") {
  MeshReport report = sample_report();
  report.check.area = 1.2e7;
  report.check.volume = 999999.6;
  report.check.fraction_under_30_deg = 1.0;
  report.check.mean_edge = 1000.0;
  report.stages = {{"field", 12345.0, 2530.0}};
  const std::string said = report_summary(report);
  CHECK_THAT(said, Catch::Matchers::ContainsSubstring("area 12000000 A^2, volume 1000000 A^3, 12345 s, 2530 MB\n"));
  CHECK_THAT(said, Catch::Matchers::ContainsSubstring(", 100 % under 30; mean edge 1000 A"));
  report.stages = {{"field", 206.4, 999.5}};
  CHECK_THAT(report_summary(report), Catch::Matchers::ContainsSubstring(", 206 s, 1000 MB\n"));
}

TEST_CASE("the summary says why edges are much shorter than the spacing") {
  MeshReport report = sample_report();
  report.check.mean_edge = 0.45;
  CHECK_THAT(report_summary(report), Catch::Matchers::ContainsSubstring("mean edge 0.45 A, shortest"));
  report.options.spacing = 2.5;
  CHECK_THAT(report_summary(report),
             Catch::Matchers::ContainsSubstring("mean edge 0.45 A (2.5 wanted; curvature asks for less), shortest"));
  report.options.tolerance = 0.01;
  CHECK_THAT(report_summary(report),
             Catch::Matchers::ContainsSubstring("(2.5 wanted; curvature or tolerance ask for less)"));
  report.options.improve = false;
  CHECK_THAT(report_summary(report), !Catch::Matchers::ContainsSubstring("wanted"));
}
