#include "improve/sheet_tree.h"

#include <limits>

namespace gaussmesh {

SheetTree::Cell::Cell() {
  constexpr float kFar = std::numeric_limits<float>::max();
  for (int k = 0; k < 3; ++k) {
    lo[k].fill(kFar);
    hi[k].fill(-kFar);
    normal_lo[k].fill(kFar);
    normal_hi[k].fill(-kFar);
  }
  eighth.fill(-1);
}

void SheetTree::Cell::add(std::size_t e, const Item& item) {
  for (int k = 0; k < 3; ++k) {
    lo[k][e] = std::min(lo[k][e], item.box.lo[k]);
    hi[k][e] = std::max(hi[k][e], item.box.hi[k]);
    normal_lo[k][e] = std::min(normal_lo[k][e], item.normal[k]);
    normal_hi[k][e] = std::max(normal_hi[k][e], item.normal[k]);
  }
}

std::uint32_t SheetTree::add(const Item& item) {
  const auto number = static_cast<std::int32_t>(entries_.size());
  entries_.push_back({item});
  link(number, find_cell(item));
  return static_cast<std::uint32_t>(number);
}

void SheetTree::change(std::uint32_t number, const Item& item) {
  Entry& entry = entries_[number];
  entry.item = item;
  const std::int32_t cell = find_cell(item);
  if (cell == entry.cell) return;
  unlink(static_cast<std::int32_t>(number));
  link(static_cast<std::int32_t>(number), cell);
}

std::int32_t SheetTree::find_cell(const Item& item) {
  float extent = 0.0f;
  std::array<float, 3> middle;
  for (int k = 0; k < 3; ++k) {
    extent = std::max(extent, item.box.hi[k] - item.box.lo[k]);
    middle[k] = 0.5f * (item.box.lo[k] + item.box.hi[k]);
  }
  std::int32_t at = 0;
  float half = 0.5f * width_;
  std::array<float, 3> centre{half, half, half};
  for (int level = 1; level < kMostLevels && extent <= half; ++level) {
    std::size_t e = 0;
    half *= 0.5f;
    for (int k = 0; k < 3; ++k) {
      const bool is_upper = middle[k] >= centre[k];
      e |= static_cast<std::size_t>(is_upper) << k;
      centre[k] += is_upper ? half : -half;
    }
    cells_[static_cast<std::size_t>(at)].add(e, item);
    if (cells_[static_cast<std::size_t>(at)].eighth[e] < 0) {
      cells_[static_cast<std::size_t>(at)].eighth[e] = static_cast<std::int32_t>(cells_.size());
      cells_.emplace_back();
    }
    at = cells_[static_cast<std::size_t>(at)].eighth[e];
  }
  return at;
}

void SheetTree::link(std::int32_t number, std::int32_t cell) {
  Entry& entry = entries_[static_cast<std::size_t>(number)];
  std::int32_t& first = cells_[static_cast<std::size_t>(cell)].first;
  entry.cell = cell;
  entry.previous = -1;
  entry.next = first;
  if (first >= 0) entries_[static_cast<std::size_t>(first)].previous = number;
  first = number;
}

void SheetTree::unlink(std::int32_t number) {
  const Entry& entry = entries_[static_cast<std::size_t>(number)];
  if (entry.next >= 0) entries_[static_cast<std::size_t>(entry.next)].previous = entry.previous;
  if (entry.previous >= 0) {
    entries_[static_cast<std::size_t>(entry.previous)].next = entry.next;
  } else {
    cells_[static_cast<std::size_t>(entry.cell)].first = entry.next;
  }
}

}  // namespace gaussmesh
