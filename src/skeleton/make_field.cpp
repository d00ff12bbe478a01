#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "lascaux/skeleton/creature.h"
#include "skeleton/built_parts.h"
#include "skeleton/field_part.h"
#include "skeleton/index.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Between the chains of one part: each reproduces its own discs, and 4 converges fastest in the
/// fit.
constexpr double kChainExponent = 4;

}  // namespace

ModelFrame FrameOf(const Parts& parts, const DepthGraph& graph, double size) {
  const std::vector<char> built = BuiltParts(graph);
  Eigen::AlignedBox2d box;
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    if (!built[p]) continue;
    for (const Vector2d& point : parts.parts[p].outline.points) box.extend(point);
  }
  if (box.isEmpty() || !(box.sizes().maxCoeff() > 0)) return {};
  ModelFrame frame;
  frame.scale = size / box.sizes().maxCoeff();
  frame.shift = {-frame.scale * box.center().x(), frame.scale * box.max().y()};
  return frame;
}

Field MakeField(const Creature& creature, const ModelFrame& frame, double blend_exponent) {
  Field field;
  field.chain_exponent = kChainExponent;
  field.part_exponent = blend_exponent;
  std::vector<std::pair<int, int>>
      images;  // of each part: the drawn side's index and the mirrored one's
  for (const CreaturePart& part : creature.parts) {
    const auto add = [&](double side) {
      FieldPart image = side > 0 ? MakeFieldPart(part, frame) : MirrorImage(field.parts.back());
      if (part.parent)
        image.parent =
            side > 0 ? images[Index(*part.parent)].first : images[Index(*part.parent)].second;
      field.parts.push_back(std::move(image));
      return static_cast<int>(field.parts.size()) - 1;
    };
    const int near = add(1);
    images.emplace_back(near, part.mirrored ? add(-1) : near);
  }
  return field;
}

}  // namespace lascaux
