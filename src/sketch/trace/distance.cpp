#include "sketch/trace/distance.h"

#include <algorithm>
#include <cmath>

namespace lascaux::trace {
namespace {

using std::int32_t;
using std::int64_t;

/// Lower envelope of the parabolas (x - i)^2 + height[i]^2 over a run of ink in a row.
class Envelope {
 public:
  /// `begin` and `end` are pixels outside of the ink, on both sides of the run.
  void Fill(const int32_t* heights, int begin, int end, int32_t* squared) {
    centers_.clear();
    starts_.clear();
    for (int i = begin; i <= end; ++i) {
      while (!centers_.empty() && From(heights, centers_.back(), i) <= starts_.back())
        centers_.pop_back(), starts_.pop_back();
      starts_.push_back(centers_.empty() ? begin : From(heights, centers_.back(), i));
      centers_.push_back(i);
    }
    std::size_t k = 0;
    for (int x = begin + 1; x < end; ++x) {
      while (k + 1 < centers_.size() && starts_[k + 1] <= x) ++k;
      const int64_t dx = x - centers_[k], h = heights[centers_[k]];
      squared[x] = static_cast<int32_t>(std::min<int64_t>(dx * dx + h * h, INT32_MAX));
    }
  }

 private:
  /// The first x at which the parabola of j (> i) is not above that of i.
  static int From(const int32_t* heights, int i, int j) {
    const int64_t hi = heights[i], hj = heights[j];
    const int64_t over = int64_t{j} * j + hj * hj - int64_t{i} * i - hi * hi;
    const int64_t under = 2 * (int64_t{j} - i);
    const int64_t ceiling = over >= 0 ? (over + under - 1) / under : -(-over / under);
    return static_cast<int>(std::clamp<int64_t>(ceiling, INT32_MIN, INT32_MAX));
  }

  std::vector<int> centers_, starts_;
};

}  // namespace

Plane<int32_t> SquaredDistances(const Mask& mask) {
  // The distance along columns first.
  Plane<int32_t> heights(mask.width, mask.height);
  for (int y = 1; y < mask.height; ++y) {
    const std::uint8_t* ink = mask.Row(y);
    const int32_t* above = heights.Row(y - 1);
    int32_t* here = heights.Row(y);
    for (int x = 0; x < mask.width; ++x) here[x] = ink[x] ? above[x] + 1 : 0;
  }
  for (int y = mask.height - 2; y >= 0; --y) {
    const int32_t* below = heights.Row(y + 1);
    int32_t* here = heights.Row(y);
    for (int x = 0; x < mask.width; ++x) here[x] = std::min(here[x], below[x] + 1);
  }
  Plane<int32_t> result(mask.width, mask.height);
  Envelope envelope;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* ink = mask.Row(y);
    for (int x = 1; x < mask.width; ++x) {
      if (!ink[x]) continue;
      const int begin = x - 1;
      while (ink[x]) ++x;  // the last pixel of a row is never ink
      envelope.Fill(heights.Row(y), begin, x, result.Row(y));
    }
  }
  return result;
}

double HalfWidth(int32_t squared_distance) {
  return squared_distance == 0 ? 0 : std::sqrt(static_cast<double>(squared_distance)) - 0.5;
}

}  // namespace lascaux::trace
