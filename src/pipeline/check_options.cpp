#include "pipeline/check_options.h"

#include <cmath>

#include "core/number_text.h"
#include "gaussmesh/error.h"
#include "gaussmesh/read_atoms.h"
#include "improve/improve_surface.h"

namespace gaussmesh {
namespace {

void check_range(const char* name, double value, double lo, double hi, const char* unit) {
  if (value >= lo && value <= hi) return;
  throw OptionError(std::string(name) + ": expected a number from " + number_text(lo) + " to " + number_text(hi) +
                    unit + ", got '" + number_text(value) + "'");
}

void check_spacing(const MeshOptions& options) {
  if (options.improve && options.spacing > kLargestSpacing) {
    throw OptionError("spacing: expected at most " + number_text(kLargestSpacing) +
                      " A unless the mesh is to stay as traced, got '" + number_text(options.spacing) + "'");
  }
  check_range("spacing", options.spacing, 0.01, options.improve ? kLargestSpacing : 1000.0, " (A)");
}

void check_tolerance(const MeshOptions& options) {
  if (options.tolerance == 0.0) return;
  if (!options.improve) {
    throw OptionError("tolerance: expected 0 where the mesh is to stay as traced, got '" +
                      number_text(options.tolerance) + "'");
  }
  check_range("tolerance", options.tolerance, kVertexTolerance, 1000.0,
              " (A), or 0, since vertices may be that far from the surface");
}

}  // namespace

void check_options(const std::vector<Atom>& atoms, const MeshOptions& options) {
  check_range("decay", options.decay, 1e-3, 1e3, " (1/A^2)");
  check_range("isovalue", options.isovalue, 1e-9, 1e9, "");
  check_spacing(options);
  check_tolerance(options);
  check_range("threads", options.threads, 0, 4096, "");
  if (atoms.empty()) throw InputError("no atoms: expected at least one");
  for (const Atom& a : atoms) {
    bool is_good = a.radius >= 0.0 && a.radius <= kLargestRadius;
    for (const double x : {a.x, a.y, a.z}) is_good = is_good && std::abs(x) <= kLargestCoordinate;
    if (!is_good) {
      throw InputError("an atom: expected coordinates within 1e6 A and a radius from 0 to 1e5 A, got (" +
                       number_text(a.x) + ", " + number_text(a.y) + ", " + number_text(a.z) + "), " +
                       number_text(a.radius));
    }
  }
}

}  // namespace gaussmesh
