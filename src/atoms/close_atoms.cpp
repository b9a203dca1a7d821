#include "atoms/close_atoms.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "text/text_lines.h"

namespace gaussmesh {
namespace {

/// Edge of the cells that atoms are sorted into (A). At the density of proteins there is about one atom in each, and
/// the ball of kCloseDistance about an atom mostly stays in one.
constexpr double kCellSize = 2.0;

/// More than kCloseDistance by more than the rounding of coordinates, so that no cell is missed.
constexpr double kReach = kCloseDistance + 1e-6;

using Cell = std::array<std::int32_t, 3>;

Cell cell_of(const Atom& atom, double shift) {
  const auto index = [&](double x) { return static_cast<std::int32_t>(std::floor((x + shift) / kCellSize)); };
  return {index(atom.x), index(atom.y), index(atom.z)};
}

double distance_sq(const Atom& a, const Atom& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  const double dz = a.z - b.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Atoms by cell, as lists that begin with the latest one. Cells may share a list. Blocks of 4 x 4 x 4 cells are kept
/// together in memory: neighbours in a file are mostly neighbours in space.
class AtomLists {
 public:
  explicit AtomLists(const std::vector<Atom>& atoms)
      : atoms_(atoms),
        blocks_(std::bit_ceil(atoms.size() / kAtomsPerBlock + 1)),
        latest_(blocks_ * kCellsPerBlock, kNone),
        before_(atoms.size(), kNone) {}

  void add(std::uint32_t atom) {
    std::uint32_t& latest = latest_[list_of(cell_of(atoms_[atom], 0.0))];
    before_[atom] = latest;
    latest = atom;
  }

  /// The latest atom of any cell near to `atom` that is nearer than kCloseDistance.
  std::optional<std::uint32_t> find_close(const Atom& atom) const {
    const Cell low = cell_of(atom, -kReach);
    const Cell high = cell_of(atom, kReach);
    for (std::int32_t x = low[0]; x <= high[0]; ++x)
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
        for (std::int32_t z = low[2]; z <= high[2]; ++z)
          for (std::uint32_t other = latest_[list_of({x, y, z})]; other != kNone; other = before_[other])
            if (distance_sq(atom, atoms_[other]) < kCloseDistance * kCloseDistance) return other;
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kAtomsPerBlock = 32;
  static constexpr std::size_t kCellsPerBlock = 64;

  std::size_t list_of(const Cell& cell) const {
    std::uint64_t block = 0;
    std::size_t place = 0;
    for (const std::int32_t index : cell) {
      constexpr std::uint64_t kMixer = 0x9e3779b97f4a7c15;  // odd, bits without pattern: 2^64 over the golden ratio
      block = (std::rotl(block, 21) ^ static_cast<std::uint32_t>(index >> 2)) * kMixer;
      place = place * 4 + static_cast<std::size_t>(index & 3);
    }
    return ((block >> 32) & (blocks_ - 1)) * kCellsPerBlock + place;
  }

  const std::vector<Atom>& atoms_;
  std::size_t blocks_;  // a power of two
  std::vector<std::uint32_t> latest_;
  std::vector<std::uint32_t> before_;
};

}  // namespace

// Lists are searched from their ends: in a heap of copies, the next copy then finds its like at once.
CloseAtoms find_close_atoms(const std::vector<Atom>& atoms) {
  CloseAtoms found;
  AtomLists lists(atoms);
  for (std::uint32_t i = 0; i < atoms.size(); ++i) {
    if (const auto other = lists.find_close(atoms[i]); other && found.count++ == 0) {
      found.first = i;
      found.partner = *other;
      found.distance = std::sqrt(distance_sq(atoms[i], atoms[*other]));
    }
    lists.add(i);
  }
  return found;
}

void warn_of_close_atoms(std::string_view name, PlaceKind kind, AtomFile& file) {
  const CloseAtoms close = find_close_atoms(file.atoms);
  if (close.count == 0) return;
  const std::size_t first = file.lines[close.first];
  const std::string partner = std::to_string(file.lines[close.partner]);
  const bool is_line = kind == PlaceKind::kLine;
  char distance[32];
  std::snprintf(distance, sizeof distance, "%.2g", close.distance);
  std::string message = is_line ? to_string({name, first}) : std::string(name) + ": atom " + std::to_string(first);
  message += ": " + std::string(distance) + " A from " + (is_line ? "the atom of line " : "atom ") + partner +
             ", are both meant? Both count in the surface";
  if (close.count > 1) {
    message += " (" + std::to_string(close.count) + " atoms are nearer than 0.1 A to one before them)";
  }
  file.warnings.push_back(std::move(message));
}

}  // namespace gaussmesh
