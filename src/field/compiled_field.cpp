#include "lascaux/field/compiled_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "compiled_data.h"
#include "segment_integral.h"

namespace lascaux {
namespace {

CompiledPrimitive Compile(const Segment& piece, double segment_radius) {
  const bool from_b = piece.radius_b > piece.radius_a;
  const Eigen::Vector3d along = from_b ? piece.a - piece.b : piece.b - piece.a;
  const double small = std::min(piece.radius_a, piece.radius_b);
  const double length = along.norm();
  // A tip's y is infinite; what is beyond this is smaller than single precision resolves.
  constexpr double kLeastRadiusShare = 1e-6;
  CompiledPrimitive compiled;
  compiled.place = from_b ? piece.b : piece.a;
  compiled.radius = std::max(piece.radius_a, piece.radius_b);
  compiled.box = Bounds(piece);
  const Eigen::Vector3f direction = (along / length).cast<float>();
  compiled.ux = direction.x();
  compiled.uy = direction.y();
  compiled.uz = direction.z();
  compiled.slope = static_cast<float>((small - compiled.radius) / length);
  compiled.y_end =
      static_cast<float>(length / std::max(small, kLeastRadiusShare * compiled.radius));
  compiled.length = static_cast<float>(length / compiled.radius);
  compiled.least_radius = static_cast<float>(small);
  compiled.tip = small < kTipRadius * segment_radius;
  return compiled;
}

CompiledPrimitive Compile(const PointPrimitive& point) {
  CompiledPrimitive compiled;
  compiled.place = point.center;
  compiled.radius = point.radius;
  compiled.box = Bounds(point);
  compiled.norm = static_cast<float>(internal::kPointNorm * point.weight);
  compiled.least_radius = static_cast<float>(point.radius);
  return compiled;
}

/// Indices of the parts, each followed by its descendants.
std::vector<int> DepthFirst(const Field& field) {
  std::vector<std::vector<int>> children(field.parts.size() + 1);
  for (std::size_t i = 0; i < field.parts.size(); ++i) {
    const std::optional<int> parent = field.parts[i].parent;
    children[parent ? static_cast<std::size_t>(*parent) : field.parts.size()].push_back(
        static_cast<int>(i));
  }
  std::vector<int> order, stack(children.back().rbegin(), children.back().rend());
  while (!stack.empty()) {
    order.push_back(stack.back());
    stack.pop_back();
    const std::vector<int>& below = children[static_cast<std::size_t>(order.back())];
    stack.insert(stack.end(), below.rbegin(), below.rend());
  }
  return order;
}

}  // namespace

CompiledField::CompiledField(const Field& field, Isa isa) {
  auto data = std::make_shared<Data>();
  data->isa = isa;
  data->kernel = &internal::KernelFor(isa);
  data->bounds = Bounds(field);
  if (field.gain) data->gain.emplace(*field.gain);
  data->chain_exponent = internal::RicciExponent(field.chain_exponent);
  data->part_exponent = internal::RicciExponent(field.part_exponent);
  std::vector<int> place(field.parts.size());
  for (const int index : DepthFirst(field)) {
    const FieldPart& part = field.parts[static_cast<std::size_t>(index)];
    place[static_cast<std::size_t>(index)] = static_cast<int>(data->parts.size());
    CompiledPart compiled;
    compiled.z0 = part.z0;
    compiled.inv_depth_scale = 1 / part.depth_scale;
    compiled.map = part.depth;
    if (part.depth) compiled.table.emplace(*part.depth);
    compiled.most_steepness = part.depth
                                  ? static_cast<double>(*std::max_element(
                                        part.depth->steepness.begin(), part.depth->steepness.end()))
                                  : compiled.inv_depth_scale;
    if (part.parent) {
      compiled.parent = place[static_cast<std::size_t>(*part.parent)];
      compiled.depth = data->parts[static_cast<std::size_t>(compiled.parent)].depth + 1;
      data->depths = std::max(data->depths, compiled.depth + 1);
    }
    for (const FieldChain& chain : part.chains) {
      const auto add = [&data, &compiled](CompiledPrimitive primitive) {
        primitive.chain = static_cast<std::uint32_t>(data->chain_part.size());
        compiled.box.extend(primitive.box);
        data->primitives.push_back(primitive);
      };
      for (const Segment& segment : chain.segments) {
        const double radius = std::max(segment.radius_a, segment.radius_b);
        for (const Segment& piece : PreSplit(segment)) add(Compile(piece, radius));
      }
      for (const PointPrimitive& point : chain.points) {
        if (point.weight > 0) add(Compile(point));
      }
      data->chain_part.push_back(static_cast<std::uint32_t>(data->parts.size()));
    }
    compiled.end = static_cast<std::uint32_t>(data->primitives.size());
    data->parts.push_back(std::move(compiled));
  }
  data_ = std::move(data);
}

ActiveSet CompiledField::All() const {
  ActiveSet all;
  all.primitives.resize(data_->primitives.size());
  std::iota(all.primitives.begin(), all.primitives.end(), 0u);
  return all;
}

double CompiledField::ThinnestRadius(const ActiveSet& active) const {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t id : active.primitives) {
    const CompiledPrimitive& primitive = data_->primitives[id];
    const double depth_scale = 1 / data_->part_of(primitive).most_steepness;
    thinnest = std::min(thinnest, primitive.least_radius * std::min(1.0, depth_scale));
  }
  return thinnest;
}

const Eigen::AlignedBox3d& CompiledField::bounds() const noexcept { return data_->bounds; }

Isa CompiledField::isa() const noexcept { return data_->isa; }

}  // namespace lascaux
