#pragma once

#include <atomic>

namespace lascaux {

/// Makes SIGINT and SIGTERM raise a flag instead of ending the process in the middle of a file, and
/// SIGPIPE and SIGXFSZ an error of the write that met them. Returns the flag; it lives as long as
/// the program.
const std::atomic<bool>& WatchForInterrupts();

}  // namespace lascaux
