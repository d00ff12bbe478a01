#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace lascaux {

/// Disjoint sets of 0 .. n-1. The smallest member is a set's root, so the result does not depend on
/// the order, nor on how many threads join and ask at once.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(new std::uint32_t[n]) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }

  std::uint32_t Root(std::uint32_t i) noexcept {
    for (std::uint32_t above = Parent(i); above != i; above = Parent(i)) {
      // Halves the way for those who come later; a parent is never above its child.
      const std::uint32_t next = Parent(above);
      if (next != above) SetParent(i, next);
      i = next;
    }
    return i;
  }

  bool IsRoot(std::uint32_t i) const noexcept { return Parent(i) == i; }

  void Join(std::uint32_t a, std::uint32_t b) noexcept {
    if (Parent(a) == Parent(b)) return;  // most often
    for (;;) {
      a = Root(a);
      b = Root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;  // still a root?
      if (std::atomic_ref(parent_[a]).compare_exchange_weak(expected, b, std::memory_order_relaxed))
        return;
    }
  }

 private:
  std::uint32_t Parent(std::uint32_t i) const noexcept {
    return std::atomic_ref(parent_[i]).load(std::memory_order_relaxed);
  }
  void SetParent(std::uint32_t i, std::uint32_t parent) noexcept {
    std::atomic_ref(parent_[i]).store(parent, std::memory_order_relaxed);
  }

  std::unique_ptr<std::uint32_t[]> parent_;
};

}  // namespace lascaux
