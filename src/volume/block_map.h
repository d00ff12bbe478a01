#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lascaux {

inline constexpr std::int32_t kNoBlock = -1;

/// Finds blocks by their lowest voxels, multiples of 8 within a million voxels of the origin.
class BlockMap {
 public:
  explicit BlockMap(const std::vector<Eigen::Vector3i>& blocks)
      : blocks_(blocks),
        shift_(64 - std::max(3, static_cast<int>(std::bit_width(2 * blocks.size())))),
        slots_(std::size_t{1} << (64 - shift_), kNoBlock) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      std::size_t slot = Slot(blocks[b]);
      while (slots_[slot] != kNoBlock) slot = Next(slot);
      slots_[slot] = static_cast<std::int32_t>(b);
    }
  }

  /// kNoBlock when there is none.
  std::int32_t Find(const Eigen::Vector3i& block) const {
    std::size_t slot = Slot(block);
    while (slots_[slot] != kNoBlock && blocks_[static_cast<std::size_t>(slots_[slot])] != block)
      slot = Next(slot);
    return slots_[slot];
  }

 private:
  std::size_t Slot(const Eigen::Vector3i& block) const {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21 ^ static_cast<std::uint64_t>(block[axis] >> 3);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15u >> shift_);  // Fibonacci hashing
  }
  std::size_t Next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  const std::vector<Eigen::Vector3i>& blocks_;
  int shift_;
  std::vector<std::int32_t> slots_;
};

}  // namespace lascaux
