// What is known of a mesh, as JSON and as the three lines on the terminal.

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/number_text.h"
#include "gaussmesh/mesh_surface.h"
#include "gaussmesh/version.h"

namespace gaussmesh {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const MeshReport& report) {
  const MeshOptions& o = report.options;
  return {{"decay_per_A2", o.decay},
          {"isovalue", o.isovalue},
          {"isovalue_used", report.isovalue_used},
          {"probe_radius_A", report.probe_radius},
          {"spacing_A", o.spacing},
          {"improve", o.improve},
          {"tolerance_A", o.tolerance},
          {"threads", o.threads},
          {"allow_uncertified", o.allow_uncertified},
          {"cavities", report.cavities},
          {"min_cavity_volume_A3", report.min_cavity_volume}};
}

Json input_json(const AtomSource& source) {
  const auto name = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  return {{"file", name(source.file)},
          {"radii", name(source.radii)},
          {"radii_file", name(source.radii_file)},
          {"warnings", source.warnings}};
}

Json components_json(const MeshCheck& check) {
  Json list = Json::array();
  for (const MeshComponent& c : check.components) {
    list.push_back({{"kind", c.is_cavity() ? "cavity" : "outside"},
                    {"triangles", c.triangles},
                    {"vertices", c.vertices},
                    {"chi", c.chi},
                    {"genus", c.genus},
                    {"area_A2", c.area},
                    {"volume_A3", c.volume},
                    {"parent", c.parent ? Json(*c.parent) : Json()}});
  }
  return list;
}

Json quality_of(const MeshCheck& check) {
  return {{"min_angle_deg", check.min_angle_deg},
          {"max_angle_deg", check.max_angle_deg},
          {"mean_min_angle_deg", check.mean_min_angle_deg},
          {"fraction_under_30_deg", check.fraction_under_30_deg},
          {"mean_edge_ratio", check.mean_edge_ratio},
          {"min_edge_A", check.min_edge},
          {"mean_edge_A", check.mean_edge},
          {"max_edge_A", check.max_edge},
          {"edge_ratio_histogram_by_0.05", check.ratio_histogram},
          {"angle_histogram_by_10_deg", check.angle_histogram}};
}

Json proof_json(const MeshReport& report) {
  Json boxes = Json::array();
  for (const BoxCount& b : report.boxes) boxes.push_back({{"size_A", b.size}, {"boxes", b.boxes}});
  Json critical = Json::array();
  for (const CriticalPlace& p : report.critical) {
    critical.push_back({{"point_A", p.point},
                        {"critical_value", p.value},
                        {"distance_of_isovalue", std::abs(p.value - report.options.isovalue)}});
  }
  return {{"certified", report.certified},
          {"boxes_per_level", boxes},
          {"smallest_box_A", report.smallest_box},
          {"cells", report.cells},
          {"cells_cut_by_folds", report.cells_cut_by_folds},
          {"cells_split", report.cells_split},
          {"critical_places", critical}};
}

std::size_t count_cavities(const MeshCheck& check) {
  std::size_t cavities = 0;
  for (const MeshComponent& c : check.components) cavities += c.is_cavity();
  return cavities;
}

/// A measure for people, with up to `digits` significant digits; without an exponent, however large it is.
std::string measure_text(double value, int digits = 6) {
  if (std::abs(value) < std::pow(10.0, digits) - 0.5) return number_text(value, digits);
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << value;
  return text.str();
}

/// Why edges are much shorter than was asked for.
std::string remark_on_edges(const MeshReport& report) {
  constexpr double kMuchShorter = 0.75;
  const MeshOptions& asked = report.options;
  if (!asked.improve || report.check.mean_edge > kMuchShorter * asked.spacing) return "";
  return " (" + number_text(asked.spacing, 3) + " wanted; " +
         (asked.tolerance > 0.0 ? "curvature or tolerance ask" : "curvature asks") + " for less)";
}

}  // namespace

std::string report_json(const MeshReport& report) {
  Json stages = Json::array();
  for (const StageCost& s : report.stages) {
    stages.push_back({{"stage", s.name}, {"time_s", s.time_s}, {"peak_memory_MB", s.peak_memory_MB}});
  }
  const MeshCheck& check = report.check;
  Json json = {{"program", std::string("gaussmesh ") + kVersion},
               {"input", input_json(report.source)},
               {"atoms", report.atoms},
               {"options", options_json(report)},
               {"triangles", check.triangles},
               {"vertices", check.vertices},
               {"chi", check.chi},
               {"area_A2", check.area},
               {"volume_A3", check.volume},
               {"certified", report.certified},
               {"proof", proof_json(report)},
               {"components", components_json(check)},
               {"left_out", {{"components", report.left_out.components}, {"volume_A3", report.left_out.volume}}},
               {"quality", quality_of(check)},
               {"vertex_distance_max_A", report.vertex_distance_max},
               {"stages", stages}};
  if (report.surface_distance) json["surface_distance_A"] = *report.surface_distance;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // names of files need not be UTF-8
}

std::string quality_json(const MeshCheck& check) { return quality_of(check).dump(); }

std::string report_summary(const MeshReport& report) {
  const MeshCheck& check = report.check;
  const std::size_t cavities = count_cavities(check);
  std::size_t handles = 0;
  for (const MeshComponent& c : check.components) handles += static_cast<std::size_t>(c.genus);
  double time_s = 0.0, memory_MB = 0.0;
  for (const StageCost& s : report.stages) {
    time_s += s.time_s;
    memory_MB = s.peak_memory_MB;
  }
  std::string text = counted(report.atoms, "atom", "atoms") + ": " + counted(check.triangles, "triangle", "triangles") +
                     ", " + counted(check.vertices, "vertex", "vertices") + ", area " + measure_text(check.area) +
                     " A^2, volume " + measure_text(check.volume) + " A^3, " + measure_text(time_s, 3) + " s, " +
                     measure_text(memory_MB, 3) + " MB\n";
  text += "triangles: angles of " + measure_text(check.min_angle_deg, 3) + " to " +
          measure_text(check.max_angle_deg, 4) + " degrees, smallest one " + measure_text(check.mean_min_angle_deg, 3) +
          " on average, " + measure_text(100.0 * check.fraction_under_30_deg, 2) + " % under 30; mean edge " +
          measure_text(check.mean_edge, 3) + " A" + remark_on_edges(report) + ", shortest over longest " +
          measure_text(check.mean_edge_ratio, 3);
  if (report.surface_distance) text += "; within " + measure_text(*report.surface_distance, 3) + " A of the surface";
  text += "\n";
  const std::string topology = counted(check.components.size() - cavities, "component", "components") + ", " +
                               counted(cavities, "cavity", "cavities") + ", " + counted(handles, "handle", "handles");
  const std::string but = report.left_out.components == 0
                              ? ""
                              : " but for " + counted(report.left_out.components, "component", "components") + " of " +
                                    measure_text(report.left_out.volume) + " A^3 left out on request";
  if (report.certified) {
    text += "certified: closed, embedded, every vertex on phi = c; exactly the topology of the surface" + but + ": " +
            topology;
  } else {
    text += "NOT certified: c is too near a critical value; meshed c = " + number_text(report.isovalue_used, 15) +
            " instead" + but + ": " + topology;
  }
  return text + "\n";
}

}  // namespace gaussmesh
