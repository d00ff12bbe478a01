#pragma once

namespace lascaux {

/// Gives freed memory back to the system, where the program's allocator keeps it (allocator.cpp).
/// What is asked for afterwards comes as new pages.
void GiveBackMemory() noexcept;

}  // namespace lascaux
