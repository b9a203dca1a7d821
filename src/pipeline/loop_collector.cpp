#include "pipeline/loop_collector.h"

#include <algorithm>

#include "core/lattice_degenerate.h"

namespace gaussmesh {

std::span<const Loop> LoopCollector::collect(const CellKey& key, std::uint32_t hint, unsigned empty_faces) {
  links_.clear();
  for (int face = 0; face < 6; ++face) {
    if (empty_faces >> face & 1) continue;
    const int axis = face / 2;
    const bool is_high = face % 2 == 1;
    const FineIndex lo = is_high ? moved(key.lo, axis, fine_size(key.level)) : key.lo;
    collect_links(axis, lo, key.level, hint, is_high);
  }
  build_loops(lattice_.point(key.lo), lattice_.point(cell_hi(key)));
  return {loops_.data(), loop_count_};
}

// The surface of a cell is on the left of a link in its low faces, on the right of one in its high faces.
void LoopCollector::collect_links(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side) {
  std::span<const Link> links;
  if (level == 0) {
    const auto place = store_.find(lo, hint);
    if (!place) return;
    if (store_.cell(*place).face[axis].is_divided) return collect_parts(axis, lo, level, hint, high_side);
    links = store_.face_links(*place, axis);
  } else {
    const CellKey beyond{high_side ? lo : moved(lo, axis, -fine_size(level)), level};
    if (split_.is_split(beyond)) return collect_parts(axis, lo, level, hint, high_side);
    links = split_.face_links(axis, lo, level);
  }
  for (const Link& link : links) links_.push_back(high_side ? Link{link.to, link.from} : link);
}

void LoopCollector::collect_parts(int axis, const FineIndex& lo, int level, std::uint32_t hint, bool high_side) {
  const std::int64_t half = fine_size(level + 1);
  for (int part = 0; part < 4; ++part) {
    const FineIndex corner =
        moved(moved(lo, first_axis(axis), (part & 1) * half), second_axis(axis), (part >> 1) * half);
    collect_links(axis, corner, level + 1, hint, high_side);
  }
}

Loop& LoopCollector::add_loop() {
  if (loop_count_ == loops_.size()) loops_.emplace_back();
  Loop& loop = loops_[loop_count_++];
  loop.clear();
  return loop;
}

void LoopCollector::build_loops(const CoordPoint& lo, const CoordPoint& hi) {
  loop_count_ = 0;
  used_.assign(links_.size(), false);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (used_[i]) continue;
    Loop& loop = add_loop();
    std::size_t at = i;
    while (!used_[at]) {
      used_[at] = true;
      const SurfacePoint& point = vertices_[links_[at].from];
      loop.push_back({links_[at].from, point, faces_of(point.position, lo, hi)});
      const auto next =
          std::find_if(links_.begin(), links_.end(), [&](const Link& link) { return link.from == links_[at].to; });
      if (next == links_.end()) throw LatticeDegenerate(to_angstrom(point.position));
      at = static_cast<std::size_t>(next - links_.begin());
    }
    if (at != i) throw LatticeDegenerate(to_angstrom(vertices_[links_[at].from].position));
  }
}

}  // namespace gaussmesh
