#include "volume/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace lascaux {
namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// The number at the beginning of a file; empty for "max" and for files that are not there.
std::optional<std::size_t> NumberIn(const std::string& path) {
  std::ifstream file(path);
  std::size_t number = 0;
  if (!(file >> number)) return std::nullopt;
  return number;
}

std::size_t FreeOnMachine() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::size_t kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return kUnlimited;
}

std::size_t Left(std::optional<std::size_t> limit, std::optional<std::size_t> used) {
  if (!limit) return kUnlimited;
  return *limit - std::min(*limit, used.value_or(0));
}

std::size_t FreeInControlGroup() {
  // Inside a container the process's own group is mounted at the root of the hierarchy.
  const std::string root = "/sys/fs/cgroup/";
  return std::min(Left(NumberIn(root + "memory.max"), NumberIn(root + "memory.current")),
                  Left(NumberIn(root + "memory/memory.limit_in_bytes"),
                       NumberIn(root + "memory/memory.usage_in_bytes")));
}

std::size_t FreeAddressSpace() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const std::optional<std::size_t> pages = NumberIn("/proc/self/statm");
  const long page = sysconf(_SC_PAGESIZE);
  return Left(limit.rlim_cur, pages.value_or(0) * static_cast<std::size_t>(std::max(page, 0L)));
}

}  // namespace

std::size_t AvailableMemory() {
  return std::min({FreeOnMachine(), FreeInControlGroup(), FreeAddressSpace()});
}

}  // namespace lascaux
