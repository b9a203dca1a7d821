// Numbers for keys, in the order in which they come.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace gaussmesh {

/// Gives each key a number, counting from 0. A table of numbers with linear probing: 8 to 16 bytes a key and no
/// allocation for each. What belongs to a key is kept by its number, in an array beside this.
template <typename Key, typename Hash>
class KeyIndex {
 public:
  /// The number of `key`, and whether it is a new one.
  std::pair<std::uint32_t, bool> insert(const Key& key) {
    if (2 * (keys_.size() + 1) > slots_.size()) resize(std::max(kFewest, 2 * slots_.size()));
    std::uint32_t& slot = slots_[slot_of(key)];
    if (slot != kFree) return {slot, false};
    slot = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    return {slot, true};
  }

  /// Makes room for as many keys, beyond which it grows.
  void reserve(std::size_t keys) {
    keys_.reserve(keys);
    if (2 * keys > slots_.size()) resize(std::bit_ceil(2 * keys));
  }

  /// Forgets the keys, and keeps room for as many as there were.
  void clear() {
    const std::size_t keys = keys_.size();
    keys_.clear();
    slots_.assign(std::bit_ceil(std::max(kFewest, 2 * keys)), kFree);
  }

  std::optional<std::uint32_t> find(const Key& key) const {
    if (keys_.empty()) return std::nullopt;
    const std::uint32_t number = slots_[slot_of(key)];
    return number == kFree ? std::nullopt : std::optional(number);
  }

  bool contains(const Key& key) const { return find(key).has_value(); }
  std::size_t size() const { return keys_.size(); }
  const Key& operator[](std::size_t number) const { return keys_[number]; }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;
  static constexpr std::size_t kFewest = 16;  ///< slots, once there are any

  /// Where the key is, or the free slot where it belongs.
  std::size_t slot_of(const Key& key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = Hash{}(key)&mask;
    while (slots_[slot] != kFree && !(keys_[slots_[slot]] == key)) slot = (slot + 1) & mask;
    return slot;
  }

  void resize(std::size_t slots) {
    slots_.assign(slots, kFree);
    for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = static_cast<std::uint32_t>(i);
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;  ///< a power of two, at most half full
};

}  // namespace gaussmesh
