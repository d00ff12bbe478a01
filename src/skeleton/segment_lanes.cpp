#include "skeleton/segment_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lascaux/field/compiled_field.h"
#include "skeleton/four.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

constexpr double kCurveNorm = 1.4968340312374837;  // 1 / (2 (3/4)^(7/2) 32/35)
/// Pieces with |kappa| up to this have radii in a ratio of at most 3.
constexpr double kGentle = 0.5;
constexpr int kMaxPieces = 16;

/// Nodes and weights of Gauss-Legendre on [0, 1].
struct Node {
  double at, weight;
};
constexpr std::array<Node, 8> kNodes = [] {
  constexpr std::array<Node, 4> kUpper = {{{0.1834346424956498, 0.3626837833783620},
                                           {0.5255324099163290, 0.3137066458778873},
                                           {0.7966664774136267, 0.2223810344533745},
                                           {0.9602898564975363, 0.1012285362903763}}};
  std::array<Node, 8> nodes{};
  for (std::size_t k = 0; k < 4; ++k) {
    nodes[3 - k] = {(1 - kUpper[k].at) / 2, kUpper[k].weight / 2};
    nodes[4 + k] = {(1 + kUpper[k].at) / 2, kUpper[k].weight / 2};
  }
  return nodes;
}();

/// A number of each of four segments.
struct Lanes {
  Four x, y, by_radius, ux, uy, slope, end, by_length;

  explicit Lanes(std::span<const LaneSegment* const> segments) {
    static const LaneSegment kNone;
    for (std::size_t k = 0; k < 4; ++k) {
      const LaneSegment& s = k < segments.size() ? *segments[k] : kNone;
      x[k] = s.x, y[k] = s.y, by_radius[k] = s.by_radius;
      ux[k] = s.ux, uy[k] = s.uy, slope[k] = s.slope, end[k] = s.end, by_length[k] = s.by_length;
    }
  }
};

[[gnu::always_inline]] inline Four Least(const Four& a, const Four& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Four Greatest(const Four& a, const Four& b) { return a < b ? b : a; }

/// Equal pieces of the interval on which the kernel is not 0.
struct Pieces {
  std::array<int, 4> count;
  Four step;
  int most;

  [[gnu::always_inline]] Pieces(const Four& first, const Four& last, const Four& slope) {
    const Four length = Greatest(last - first, Four{});
    const Four kappa = -slope * length / 2 / (1 - slope * (first + last) / 2);
    most = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      // The first of n equal pieces is the steepest: its kappa is at most K / (n (1 - K) + K) for K
      // of the whole.
      const double needed = kappa[k] > kGentle ? kappa[k] / (1 - kappa[k]) * (1 / kGentle - 1) : 1;
      count[k] = length[k] > 0 ? std::clamp(static_cast<int>(std::ceil(needed)), 1, kMaxPieces) : 0;
      step[k] = length[k] / std::max(count[k], 1);
      most = std::max(most, count[k]);
    }
  }

  /// Lengths of one of them: 0 for those that have no more.
  [[gnu::always_inline]] Four Length(int piece) const {
    Four length{};
    for (std::size_t k = 0; k < 4; ++k) length[k] = piece < count[k] ? step[k] : 0;
    return length;
  }
};

/// In the homothetic parameter y = s / radius(s), s measured from `a`: radius = radius_a / (1 -
/// slope y) and the kernel is (top - curve (y - middle)^2)^3, on one interval for every slope <= 0.
[[gnu::always_inline]] inline void Integrate(const Lanes& at, const Vector2d& point,
                                             LaneSamples& samples) {
  const Four wx = (point.x() - at.x) * at.by_radius, wy = (point.y() - at.y) * at.by_radius;
  const Four x = wx * at.ux + wy * at.uy;
  const Four across_x = wx - x * at.ux, across_y = wy - x * at.uy;
  const Four h2 = across_x * across_x + across_y * across_y;
  const Four e = 1 + at.slope * x;
  const Four big = Greatest(e * e + at.slope * at.slope * h2, Four{} + 1e-30);
  const Four room = Greatest(4 * big - h2, Four{}), by_big = 1 / big;
  const Four half = Root(room) * by_big, middle = (x * e + at.slope * h2) * by_big;
  const Four top = room * by_big / 4, curve = big / 4;
  const Four first = Greatest(middle - half, Four{}), last = Least(middle + half, at.end);

  const Pieces pieces(first, last, at.slope);
  Four value{}, radius_both{}, radius_b{};
  // Of what pulls the ends: what is along w, and along u.
  Four w_both{}, w_b{}, u_both{}, u_b{};
  for (int piece = 0; piece < pieces.most; ++piece) {
    const Four step = pieces.Length(piece), start = first + piece * pieces.step;
    for (const Node& node : kNodes) {
      const Four y = start + node.at * step;
      const Four narrow = 1 - at.slope * y;  // radius_a over the radius here
      const Four wide = 1 / narrow;
      const Four s = y * wide;  // arc length in radius_a
      const Four way = y - middle;
      const Four p = top - curve * way * way;
      const Four p2 = p * p, p3 = p2 * p;
      const Four share = node.weight * step;
      value += share * wide * p3;
      const Four by_radius = share * (6 * p2 - 7 * p3);
      radius_both += by_radius;
      radius_b += s * by_radius;
      const Four toward = share * narrow * p2, toward_s = s * toward;
      w_both += toward;
      w_b += toward_s;
      u_both += toward_s;
      u_b += s * toward_s;
    }
  }
  // Shares of the way from `a` to the other end, and in units of lengths.
  const Four to_b = at.by_length / at.by_radius;
  const Four norm = kCurveNorm * at.by_radius, pull = 1.5 * norm;
  value *= kCurveNorm;
  radius_b *= to_b, w_b *= to_b, u_b *= to_b;
  const Four w_a = w_both - w_b, u_a = u_both - u_b, along = value * at.by_length;
  StoreFour(value, samples.value.data());
  StoreFour(norm * (radius_both - radius_b), samples.by_radius_a.data());
  StoreFour(norm * radius_b, samples.by_radius_b.data());
  StoreFour(pull * (w_a * wx - u_a * at.ux) - along * at.ux, samples.by_ax.data());
  StoreFour(pull * (w_a * wy - u_a * at.uy) - along * at.uy, samples.by_ay.data());
  StoreFour(pull * (w_b * wx - u_b * at.ux) + along * at.ux, samples.by_bx.data());
  StoreFour(pull * (w_b * wy - u_b * at.uy) + along * at.uy, samples.by_by.data());
}

using Flags [[gnu::vector_size(4 * sizeof(double))]] = std::int64_t;

[[gnu::always_inline]] inline void AddContaining(const LaneBoxes& boxes, const Vector2d& point,
                                                 std::vector<int>& found) {
  for (std::size_t i = 0; i < boxes.count; i += 4) {
    const Flags in =
        (LoadFour(&boxes.low_x[i]) <= point.x()) & (LoadFour(&boxes.high_x[i]) >= point.x()) &
        (LoadFour(&boxes.low_y[i]) <= point.y()) & (LoadFour(&boxes.high_y[i]) >= point.y());
    if ((in[0] | in[1] | in[2] | in[3]) == 0) continue;
    for (std::size_t k = 0; k < 4; ++k)
      if (in[k] != 0) found.push_back(static_cast<int>(i + k));
  }
}

// The same code twice. Without fused multiplications, which AVX2 by itself has not, the bits agree.
void RunBaseline(const Lanes& at, const Vector2d& point, LaneSamples& samples) {
  Integrate(at, point, samples);
}
void FindBaseline(const LaneBoxes& boxes, const Vector2d& point, std::vector<int>& found) {
  AddContaining(boxes, point, found);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void FindAvx2(const LaneBoxes& boxes, const Vector2d& point,
                                      std::vector<int>& found) {
  AddContaining(boxes, point, found);
}
[[gnu::target("avx2")]] void RunAvx2(const Lanes& at, const Vector2d& point, LaneSamples& samples) {
  Integrate(at, point, samples);
}
#else
constexpr auto RunAvx2 = RunBaseline;
constexpr auto FindAvx2 = FindBaseline;
#endif

}  // namespace

LaneSegment::LaneSegment(const SkeletonVertex& from, const SkeletonVertex& to) {
  const Vector2d axis = to.position - from.position;
  const double length = axis.norm();
  if (!(length > 0)) return;
  x = from.position.x(), y = from.position.y();
  by_radius = 1 / from.radius;
  ux = axis.x() / length, uy = axis.y() / length;
  slope = (to.radius - from.radius) / length;
  end = length / to.radius;
  by_length = 1 / length;
}

LaneSamples SampleSegments(std::span<const LaneSegment* const> segments, const Vector2d& point) {
  static const auto run = BestIsa() == Isa::kBaseline ? RunBaseline : RunAvx2;
  LaneSamples samples;
  run(Lanes(segments), point, samples);
  return samples;
}

void LaneBoxes::Add(const Eigen::AlignedBox2d& box) {
  if (count % 4 == 0) {
    // What fills up the last four contains nothing.
    for (std::vector<double>* low : {&low_x, &low_y}) low->resize(count + 4, 1);
    for (std::vector<double>* high : {&high_x, &high_y}) high->resize(count + 4, -1);
  }
  low_x[count] = box.min().x(), low_y[count] = box.min().y();
  high_x[count] = box.max().x(), high_y[count] = box.max().y();
  ++count;
}

void FindContaining(const LaneBoxes& boxes, const Vector2d& point, std::vector<int>& found) {
  static const auto find = BestIsa() == Isa::kBaseline ? FindBaseline : FindAvx2;
  find(boxes, point, found);
}

}  // namespace lascaux
