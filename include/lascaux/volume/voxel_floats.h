#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace lascaux {

/// Leaves numbers as memory comes where no value is given.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

/// A number for each voxel, unset by resize(): the first to touch a page waits for the system, so
/// threads fill the blocks that they work on.
using VoxelFloats = std::vector<float, UnsetAllocator<float>>;

}  // namespace lascaux
