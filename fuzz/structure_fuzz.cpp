#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "sketch/structure_invariants.h"

/// Any strokes give a sound map, sound parts and a sound graph, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 2000) return 0;
  const std::string wrong =
      lascaux::testing::WrongWithStructureOf(lascaux::testing::SketchFrom(data, size));
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    std::abort();
  }
  return 0;
}
