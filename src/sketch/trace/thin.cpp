#include "sketch/trace/thin.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lascaux::trace {
namespace {

/// Whether a pixel may go, by which of its 8 neighbours are ink: it joins one 8-connected piece of
/// them and touches one 4-connected piece of the page (Yokoi's number is 1), and is no line's end.
constexpr std::array<bool, 256> MayGoTable() {
  std::array<bool, 256> table{};
  for (unsigned n = 0; n < 256; ++n) {
    const auto page = [n](unsigned k) { return ((n >> (k % 8)) & 1u) == 0; };
    int number = 0;
    for (unsigned k = 0; k < 8; k += 2) number += page(k) && !(page(k + 1) && page(k + 2)) ? 1 : 0;
    table[n] = number == 1 && std::popcount(n) > 1;
  }
  return table;
}
constexpr std::array<bool, 256> kMayGo = MayGoTable();

class Thinning {
 public:
  explicit Thinning(const Mask& mask) : ink_(mask), waiting_(mask.width, mask.height) {
    for (int k = 0; k < 8; ++k) offset_[static_cast<std::size_t>(k)] = kDy[k] * mask.width + kDx[k];
  }

  /// Removes what may go of one layer. From four sides in turn, so that a line of even width loses
  /// as much on both sides and is not eaten up from its end.
  void Layer(std::vector<std::int32_t>& layer) {
    bool changed = true;
    while (changed) {
      changed = false;
      for (const int side : {6, 2, 0, 4}) {
        border_.clear();
        for (const std::int32_t i : layer)
          if (ink_.data[At(i)] && !ink_.data[At(i + offset_[static_cast<std::size_t>(side)])])
            border_.push_back(i);
        for (const std::int32_t i : border_) changed |= Remove(i);
      }
      // Those of earlier layers that stayed only for what has gone now.
      std::swap(layer, reopened_);
      reopened_.clear();
      for (const std::int32_t i : layer) waiting_.data[At(i)] = 0;
      std::sort(layer.begin(), layer.end());
      changed = changed && !layer.empty();
    }
  }

  void Passed(const std::vector<std::int32_t>& layer) {
    for (const std::int32_t i : layer) passed_.data[At(i)] = 1;
  }
  Mask Take() && { return std::move(ink_); }

  void Start() { passed_ = Mask(ink_.width, ink_.height); }

 private:
  static std::size_t At(std::int32_t i) { return static_cast<std::size_t>(i); }

  bool Remove(std::int32_t i) {
    unsigned neighbours = 0;
    for (std::size_t k = 0; k < 8; ++k)
      neighbours |= static_cast<unsigned>(ink_.data[At(i + offset_[k])]) << k;
    if (!kMayGo[neighbours]) return false;
    ink_.data[At(i)] = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::int32_t j = i + offset_[k];
      if (!ink_.data[At(j)] || !passed_.data[At(j)] || waiting_.data[At(j)]) continue;
      waiting_.data[At(j)] = 1;
      reopened_.push_back(j);
    }
    return true;
  }

  Mask ink_, waiting_, passed_;
  std::array<std::int32_t, 8> offset_{};
  std::vector<std::int32_t> border_, reopened_;
};

}  // namespace

Mask Thinned(const Mask& mask, const Plane<std::int32_t>& squared_distances) {
  std::vector<std::int32_t> pixels;
  for (std::size_t i = 0; i < mask.data.size(); ++i)
    if (mask.data[i]) pixels.push_back(static_cast<std::int32_t>(i));
  const auto distance = [&](std::int32_t i) {
    return squared_distances.data[static_cast<std::size_t>(i)];
  };
  std::stable_sort(pixels.begin(), pixels.end(),
                   [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
  Thinning thinning(mask);
  thinning.Start();
  std::vector<std::int32_t> layer;
  for (std::size_t i = 0; i < pixels.size();) {
    layer.clear();
    const std::int32_t here = distance(pixels[i]);
    for (; i < pixels.size() && distance(pixels[i]) == here; ++i) layer.push_back(pixels[i]);
    thinning.Passed(layer);
    thinning.Layer(layer);
  }
  return std::move(thinning).Take();
}

}  // namespace lascaux::trace
