#include "picture_style.h"

#include <algorithm>
#include <array>

namespace lascaux {
namespace {

constexpr const char* kBodyColor = "#e8cf9f";
constexpr const char* kIgnoredColor = "#c9c9c9";
constexpr const char* kIslandColor = "#5b6c8f";
// Light enough for dark lines on top; neighbours in the list are far apart in hue.
constexpr std::array kColors = {"#7fb7be", "#e58f65", "#9ac26b", "#c78bc0", "#e6b93f",
                                "#7d9fdd", "#e07a8b", "#6fc0a0", "#b39ddb", "#c2a878"};

std::vector<std::string> ColorsOf(const DepthGraph& graph) {
  std::vector<std::string> colors(graph.nodes.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const DepthNode& node = graph.nodes[i];
    if (node.role == PartRole::kBackground) continue;  // takes its partner's below
    if (node.role == PartRole::kBody)
      colors[i] = kBodyColor;
    else if (node.role == PartRole::kIgnored)
      colors[i] = kIgnoredColor;
    else if (node.role == PartRole::kIsland)
      colors[i] = kIslandColor;
    else
      colors[i] = kColors[next++ % kColors.size()];
  }
  for (std::size_t i = 0; i < colors.size(); ++i)
    if (colors[i].empty())
      colors[i] = graph.nodes[i].pair ? colors[static_cast<std::size_t>(*graph.nodes[i].pair)]
                                      : kColors[next++ % kColors.size()];
  return colors;
}

/// The widest stretch inside the ring along the line where coordinate `1 - axis` is `level`.
std::array<double, 2> WidestChord(const std::vector<Eigen::Vector2d>& ring, int axis,
                                  double level) {
  std::vector<double> crossings;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a[1 - axis] > level) == (b[1 - axis] > level)) continue;
    const double t = (level - a[1 - axis]) / (b[1 - axis] - a[1 - axis]);
    crossings.push_back(a[axis] + t * (b[axis] - a[axis]));
  }
  std::sort(crossings.begin(), crossings.end());
  std::array<double, 2> widest{0, 0};
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    if (crossings[i + 1] - crossings[i] > widest[1] - widest[0])
      widest = {crossings[i], crossings[i + 1]};
  return widest;
}

}  // namespace

PictureStyle StyleFor(const Model& model) {
  PictureStyle style;
  if (model.sketch) style.box = Bounds(*model.sketch);
  if (style.box.isEmpty()) style.box = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};
  const double diagonal = style.box.diagonal().norm();
  style.unit = diagonal > 0 ? diagonal / 100 : 1;
  style.numbers = SvgNumbers(style.unit * 100);
  if (model.graph) style.colors = ColorsOf(*model.graph);
  return style;
}

LabelPlace InnerPlace(const std::vector<Eigen::Vector2d>& ring) {
  constexpr int kLevels = 15;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& point : ring) box.extend(point);
  if (box.isEmpty()) return {Eigen::Vector2d::Zero(), 0};
  LabelPlace best{box.center(), 0};
  for (int i = 1; i <= kLevels; ++i) {
    const double y = box.min().y() + box.sizes().y() * i / (kLevels + 1);
    const auto [left, right] = WidestChord(ring, 0, y);
    const double x = (left + right) / 2;
    const auto [top, bottom] = WidestChord(ring, 1, x);
    const double room = std::min({(right - left) / 2, y - top, bottom - y});
    if (room > best.room) best = {{x, y}, room};
  }
  return best;
}

LabelPlace LabelPlaceOf(const Model& model, int part) {
  const SkeletonVertex* largest = nullptr;
  if (model.skeletons)
    for (const Skeleton& skeleton : *model.skeletons)
      if (skeleton.part == part)
        for (const SkeletonVertex& vertex : skeleton.vertices)
          if (largest == nullptr || vertex.radius > largest->radius) largest = &vertex;
  if (largest != nullptr) return {largest->position, largest->radius};
  return InnerPlace(model.parts->parts[static_cast<std::size_t>(part)].outline.points);
}

}  // namespace lascaux
