#include <cstddef>
#include <cstdlib>

/// @file
/// How jemalloc treats the program's memory; it reads this symbol when the program starts.
///
/// Pages that are touched for the first time are the slowest memory there is: 3 GB/s in pages of 4
/// kB. In pages of 2 MB they are an eighth of that work, and what a stage gives back is kept for
/// the next. One arena, for there are as few threads as cores, and each has a cache of its own.

extern "C" {
extern const char* const malloc_conf;
const char* const malloc_conf =
    "thp:always,metadata_thp:always,narenas:1,oversize_threshold:0,"
    "dirty_decay_ms:1000,muzzy_decay_ms:0";
}

namespace {

/// jemalloc asks the system for little at first, which is in no page of 2 MB. One large piece,
/// whose pages nobody has touched, is what it cuts all others from.
const bool kReserved = [] {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  void* volatile piece = std::malloc(kBytes);
  std::free(piece);
  return true;
}();

}  // namespace
