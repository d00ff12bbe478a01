#pragma once

#include <memory>
#include <new>
#include <utility>

namespace lascaux {

/// Leaves what a container holds as memory comes where no value is given: the first to touch a page
/// waits for the system, so threads fill what they work on.
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

}  // namespace lascaux
