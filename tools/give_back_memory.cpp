#include "give_back_memory.h"

#include <cstddef>

extern "C" {
/// Of jemalloc, which the program is linked with; tests and sanitizers are not.
[[gnu::weak]] int mallctl(const char* name, void* old, std::size_t* old_size, void* value,
                          std::size_t value_size);
}

namespace lascaux {

void GiveBackMemory() noexcept {
  constexpr const char* kPurgeAllArenas = "arena.4096.purge";
  if (mallctl != nullptr) mallctl(kPurgeAllArenas, nullptr, nullptr, nullptr, 0);
}

}  // namespace lascaux
