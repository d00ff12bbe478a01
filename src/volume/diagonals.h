#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lascaux {

/// Up to so many quadrilaterals around edges of a lattice, each seen along its edge: corner k
/// beside the edge and above its lower end, in units of the lattice. The corners go round.
struct SeenQuads {
  static constexpr std::size_t kMost = 64;

  struct Corners {
    alignas(64) std::array<float, kMost> x, y, height;
  };
  std::array<Corners, 4> corners;
};

/// For each of the first `count`, whether the diagonal from its first corner is the better one: the
/// shorter one that keeps the quadrilateral within the envelope of its edge by `margin`, or the
/// shorter one where none does. Others have no meaning.
std::array<std::uint8_t, SeenQuads::kMost> CutFromFirst(const SeenQuads& quads, std::size_t count,
                                                        float margin);

/// IsInEnvelope() of envelope.h in single precision, for corners in that order.
std::array<std::uint8_t, SeenQuads::kMost> AreInEnvelope(const SeenQuads& d0_d1_a_b,
                                                         std::size_t count, float margin);

}  // namespace lascaux
