#include "volume/render/distance_transform.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace lascaux {
namespace {

/// The parabolas of one line's lower envelope, and copies of what they replace.
class LineTransform {
 public:
  explicit LineTransform(int length)
      : distance_(static_cast<std::size_t>(length)),
        value_(distance_.size()),
        apex_(distance_.size()),
        begin_(distance_.size() + 1) {}

  /// Replaces the entries `first + i * stride`.
  void Run(NearestSeeds& seeds, std::size_t first, std::size_t stride) {
    const std::size_t length = distance_.size();
    float* const distance = seeds.squared_distance.data() + first;
    float* const value = seeds.value.data() + first;
    for (std::size_t i = 0; i < length; ++i) {
      distance_[i] = distance[i * stride];
      value_[i] = value[i * stride];
    }
    const std::size_t count = FindEnvelope();
    if (count == 0) return;
    for (std::size_t i = 0, k = 0; i < length; ++i) {
      const auto x = static_cast<float>(i);
      while (k + 1 < count && begin_[k + 1] < x) ++k;
      const std::size_t apex = apex_[k];
      const float offset = x - static_cast<float>(apex);
      distance[i * stride] = offset * offset + distance_[apex];
      value[i * stride] = value_[apex];
    }
  }

 private:
  /// Number of parabolas in the envelope; parabola k is the lowest from begin_[k] on.
  std::size_t FindEnvelope() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < distance_.size(); ++i) {
      if (distance_[i] >= kNoSeed) continue;
      float from = -kNoSeed;
      while (count > 0 && (from = Crossing(apex_[count - 1], i)) <= begin_[count - 1]) --count;
      apex_[count] = i;
      begin_[count] = count == 0 ? -kNoSeed : from;
      ++count;
    }
    return count;
  }

  /// Where the parabola of `right` falls below that of `left`.
  float Crossing(std::size_t left, std::size_t right) const {
    const auto a = static_cast<float>(left), b = static_cast<float>(right);
    return ((distance_[right] + b * b) - (distance_[left] + a * a)) / (2 * (b - a));
  }

  std::vector<float> distance_, value_;
  std::vector<std::size_t> apex_;
  std::vector<float> begin_;
};

/// Transforms `count` lines that start at `first(i)`.
template <typename First>
void TransformLines(NearestSeeds& seeds, int length, std::size_t stride, int count, First first) {
  tbb::parallel_for(tbb::blocked_range<int>(0, count, 64), [&](const auto& range) {
    LineTransform line(length);
    for (int i = range.begin(); i < range.end(); ++i) {
      line.Run(seeds, first(static_cast<std::size_t>(i)), stride);
    }
  });
}

}  // namespace

NearestSeeds SpreadSeeds(NearestSeeds seeds, const std::array<int, 3>& size) {
  const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
  TransformLines(seeds, size[0], 1, size[1] * size[2], [=](std::size_t i) { return i * nx; });
  TransformLines(seeds, size[1], nx, size[0] * size[2],
                 [=](std::size_t i) { return i % nx + i / nx * nx * ny; });
  TransformLines(seeds, size[2], nx * ny, size[0] * size[1], [](std::size_t i) { return i; });
  return seeds;
}

}  // namespace lascaux
