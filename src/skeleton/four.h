#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

/// @file
/// Four doubles as a vector, in the notation that g++ and clang share: one register with AVX2, two
/// without. All of it is inlined, so that sources may compile it for several instruction sets;
/// nothing is fused, so the bits agree.

namespace lascaux {

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;

[[gnu::always_inline]] inline Four LoadFour(const double* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

[[gnu::always_inline]] inline void StoreFour(const Four& four, double* to) {
  std::memcpy(to, &four, sizeof four);
}

[[gnu::always_inline]] inline Four Root(Four a) {
  for (std::size_t k = 0; k < 4; ++k) a[k] = std::sqrt(a[k]);
  return a;
}

}  // namespace lascaux
