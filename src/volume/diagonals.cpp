#include "volume/diagonals.h"

#include <cstring>

namespace lascaux {
namespace {

/// Four quadrilaterals at a time, in the notation that g++ and clang share.
constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;
using Bits [[gnu::vector_size(4 * kLanes)]] = std::int32_t;

#define LASCAUX_INLINE [[gnu::always_inline]] inline

struct Corner {
  Lanes x, y, height;
};

LASCAUX_INLINE Lanes Load(const std::array<float, SeenQuads::kMost>& from, std::size_t at) {
  Lanes lanes;
  std::memcpy(&lanes, from.data() + at, sizeof lanes);
  return lanes;
}

/// Four quadrilaterals from the one at `at` on.
LASCAUX_INLINE std::array<Corner, 4> LoadFour(const SeenQuads& quads, std::size_t at) {
  std::array<Corner, 4> q;
  for (std::size_t k = 0; k < 4; ++k) {
    const SeenQuads::Corners& from = quads.corners[k];
    q[k] = {Load(from.x, at), Load(from.y, at), Load(from.height, at)};
  }
  return q;
}

LASCAUX_INLINE Lanes Size(Lanes a) { return a < 0 ? -a : a; }

LASCAUX_INLINE Lanes Cross(const Corner& p, const Corner& q) { return p.x * q.y - p.y * q.x; }

LASCAUX_INLINE Lanes Area(const Corner& p, const Corner& q, const Corner& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// IsInEnvelope() of envelope.h, all ones where it is.
LASCAUX_INLINE Bits AreInEnvelope(const Corner& d0, const Corner& d1, const Corner& a,
                                  const Corner& b, float margin) {
  const Lanes edge = Cross(d0, d1);
  const Bits takes_b = edge * Area(d0, d1, a) > 0;
  const Corner beyond = {takes_b ? b.x : a.x, takes_b ? b.y : a.y, takes_b ? b.height : a.height};
  const Lanes area = Area(d0, d1, beyond);
  const Lanes crossing =
      Cross(d1, beyond) * d0.height + Cross(beyond, d0) * d1.height + edge * beyond.height;
  const Lanes above = area > 0 ? crossing : -crossing;
  return (Size(edge) > margin) & (Size(area) > margin) & (area * edge <= 0) & (above > margin) &
         (above < Size(area) - margin);
}

LASCAUX_INLINE Lanes SquaredLength(const Corner& a, const Corner& b) {
  const Lanes x = a.x - b.x, y = a.y - b.y, height = a.height - b.height;
  return x * x + y * y + height * height;
}

}  // namespace

std::array<std::uint8_t, SeenQuads::kMost> CutFromFirst(const SeenQuads& quads, std::size_t count,
                                                        float margin) {
  std::array<std::uint8_t, SeenQuads::kMost> cuts;
  for (std::size_t at = 0; at < count; at += kLanes) {
    const std::array<Corner, 4> q = LoadFour(quads, at);
    const Bits first_is_shorter = SquaredLength(q[0], q[2]) <= SquaredLength(q[1], q[3]);
    const Bits first_is_good = AreInEnvelope(q[0], q[2], q[1], q[3], margin);
    const Bits second_is_good = AreInEnvelope(q[1], q[3], q[2], q[0], margin);
    const Bits from_first = (first_is_shorter & (first_is_good | ~second_is_good)) |
                            (~first_is_shorter & first_is_good & ~second_is_good);
    for (std::size_t i = 0; i < kLanes; ++i) cuts[at + i] = from_first[i] != 0 ? 1 : 0;
  }
  return cuts;
}

std::array<std::uint8_t, SeenQuads::kMost> AreInEnvelope(const SeenQuads& d0_d1_a_b,
                                                         std::size_t count, float margin) {
  std::array<std::uint8_t, SeenQuads::kMost> are;
  for (std::size_t at = 0; at < count; at += kLanes) {
    const auto [d0, d1, a, b] = LoadFour(d0_d1_a_b, at);
    const Bits lanes = AreInEnvelope(d0, d1, a, b, margin);
    for (std::size_t i = 0; i < kLanes; ++i) are[at + i] = lanes[i] != 0 ? 1 : 0;
  }
  return are;
}

}  // namespace lascaux
