#include "lascaux/field/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flat_depth.h"
#include "psi.h"
#include "ricci.h"

namespace lascaux {
namespace {

FieldSample EvaluateChain(const FieldChain& chain, const Eigen::Vector3d& point) {
  FieldSample sum;
  const auto add = [&sum](const FieldSample& sample) {
    sum.value += sample.value;
    sum.gradient += sample.gradient;
  };
  for (const Segment& segment : chain.segments) add(Evaluate(segment, point));
  for (const PointPrimitive& primitive : chain.points) add(Evaluate(primitive, point));
  return sum;
}

}  // namespace

FieldSample BlendRicci(std::span<const FieldSample> samples, double exponent) {
  FieldSample blend;
  double largest = 0;
  for (const FieldSample& sample : samples) largest = std::max(largest, sample.value);
  if (!(largest > 0)) return blend;
  const internal::RicciExponent n(exponent);
  double sum = 0;
  for (const FieldSample& sample : samples) sum += n.Power(sample.value / largest);
  const double root = n.Root(sum);
  blend.value = largest * root;
  for (const FieldSample& sample : samples) {
    if (sample.value > 0) {
      blend.gradient += n.PowerLessOne(sample.value / blend.value) * sample.gradient;
    }
  }
  return blend;
}

FieldSample EvaluatePart(const Field& field, int part, const Eigen::Vector3d& point) {
  const FieldPart& here = field.parts[static_cast<std::size_t>(part)];
  const internal::FlatDepth depth = internal::Flatten(here, point);
  const Eigen::Vector3d flat(point.x(), point.y(), depth.z);
  FieldSample sample;
  if (here.chains.size() == 1) {
    sample = EvaluateChain(here.chains[0], flat);
  } else {
    std::vector<FieldSample> chains;
    chains.reserve(here.chains.size());
    for (const FieldChain& chain : here.chains) chains.push_back(EvaluateChain(chain, flat));
    sample = BlendRicci(chains, field.chain_exponent);
  }
  sample.gradient.head<2>() += sample.gradient.z() * depth.gradient.head<2>();
  sample.gradient.z() *= depth.gradient.z();
  return sample;
}

FieldSample Evaluate(const Field& field, const Eigen::Vector3d& point) {
  std::vector<FieldSample> parts(field.parts.size());
  FieldSample largest;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = EvaluatePart(field, static_cast<int>(i), point);
    const std::optional<int> parent = field.parts[i].parent;
    const FieldSample blend =
        parent ? BlendRicci(std::array{parts[i], parts[static_cast<std::size_t>(*parent)]},
                            field.part_exponent)
               : parts[i];
    if (blend.value > largest.value) largest = blend;
  }
  if (!field.gain) return largest;
  const LogGain gain = EvaluateLogGain(*field.gain, point.head<2>());
  largest.gradient.head<2>() += largest.value * gain.gradient;
  const double factor = std::exp(gain.value);
  return {factor * largest.value, factor * largest.gradient};
}

double SignedDistance(const FieldSample& sample) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double f = sample.value;
  if (!(f > 0)) return kInfinity;
  const double root = std::pow(f, 1.0 / 7);  // of the cylinder's profile, whose exponent is 7/2
  const double square = 1 - 0.75 * root * root;
  if (square <= 0) return -kInfinity;
  const double psi = 2 * std::sqrt(square);
  const double slope = sample.gradient.norm();
  if (psi == 1) return 0;
  if (!(slope > 0)) return psi > 1 ? kInfinity : -kInfinity;
  const double root5 = root * root * root * root * root;  // f^(5/7)
  return (psi - 1) * (7.0 / 3) * std::max(psi, internal::kLeastPsi) * root5 / slope;
}

Eigen::AlignedBox3d Bounds(const Field& field) {
  Eigen::AlignedBox3d box;
  for (const FieldPart& part : field.parts) {
    Eigen::AlignedBox3d flat;
    for (const FieldChain& chain : part.chains) {
      for (const Segment& segment : chain.segments) flat.extend(Bounds(segment));
      for (const PointPrimitive& primitive : chain.points) flat.extend(Bounds(primitive));
    }
    if (flat.isEmpty()) continue;
    const DepthRange range =
        part.depth ? RangeOf(*part.depth, {flat.min().head<2>(), flat.max().head<2>()})
                   : DepthRange{part.z0, part.z0, 1 / part.depth_scale, 1 / part.depth_scale};
    flat.min().z() = range.middle_low + (flat.min().z() - part.z0) / range.steepness_low;
    flat.max().z() = range.middle_high + (flat.max().z() - part.z0) / range.steepness_low;
    box.extend(flat);
  }
  return box;
}

}  // namespace lascaux
