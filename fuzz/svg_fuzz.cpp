#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lascaux/sketch/read_svg.h"
#include "sketch/sketch_invariants.h"

/// Any bytes give a sound sketch or an error of the input, twice the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Small limits, so that what grows without bound meets them within a fuzzer's patience.
  constexpr lascaux::ReadSvgOptions kOptions{
      .max_bytes = 1u << 18, .max_pieces = 5'000, .max_depth = 40};
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto outcome = lascaux::ReadSvg(bytes, kOptions);
  const std::string wrong = lascaux::testing::WrongWith(outcome);
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    std::abort();
  }
  if (outcome.ok() && !(*lascaux::ReadSvg(bytes, kOptions) == *outcome)) std::abort();
  return 0;
}
