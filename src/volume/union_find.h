#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lascaux {

/// Disjoint sets of 0 .. n-1. The smallest member is a set's root, so the result does not depend on
/// the order.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  std::uint32_t Root(std::uint32_t i) noexcept {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void Join(std::uint32_t a, std::uint32_t b) noexcept {
    a = Root(a);
    b = Root(b);
    if (a < b) {
      parent_[b] = a;
    } else {
      parent_[a] = b;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace lascaux
