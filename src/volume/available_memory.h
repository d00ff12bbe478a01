#pragma once

#include <cstddef>

namespace lascaux {

/// Bytes that this process may still use without swapping: the least of what the machine has
/// available, what its control group leaves and what its limit on address space (RLIMIT_AS) leaves.
///
/// The largest number there is where nothing of that can be read.
std::size_t AvailableMemory();

}  // namespace lascaux
