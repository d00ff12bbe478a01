#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/skeleton/normalise_outline.h"
#include "run_pipeline.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"
#include "skeleton/union_outline.h"

/// How the parts of all examples meet: where blends end, and what they do to the outline.

namespace lascaux {
namespace {

using Eigen::Vector2d;

struct Example {
  std::string name;
  Model model;  ///< up to the creature
  ModelFrame frame;
  Field field;
  double diagonal = 0;  ///< of the drawing, in model units
};

std::vector<Example> Examples() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(LASCAUX_EXAMPLES)) {
    if (entry.path().extension() == ".svg") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Example> examples;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    PipelineOptions options;
    options.last = LastStage::kCreature;
    Example& example = examples.emplace_back();
    example.name = path.stem().string();
    example.model = RunPipeline(bytes, options);
    const Parts& parts = *example.model.parts;
    const DepthGraph& graph = *example.model.graph;
    example.frame = FrameOf(parts, graph, options.size);
    example.field = NormaliseOutline(MakeField(*example.model.creature, example.frame),
                                     {parts, graph, example.frame});
    example.diagonal = example.frame.scale * BuiltBox(parts, graph).diagonal().norm();
  }
  return examples;
}

/// The place at distance `length` along a polyline from its first point; none when it is shorter
/// than twice that.
std::optional<Vector2d> Along(const std::vector<Vector2d>& line, double length) {
  std::optional<Vector2d> place;
  double way = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    way += (line[i] - line[i - 1]).norm();
    if (!place && way >= length) place = line[i];
  }
  return way >= 2 * length ? place : std::nullopt;
}

/// Distance of a place of the drawing from the model's silhouette, in shares of the diagonal;
/// negative where the model is larger.
double FromSilhouette(const Example& example, const Vector2d& place) {
  const Vector2d at = example.frame.ToModel(place);
  double deepest = Bounds(example.field).max().z(), best = 0;
  const auto value = [&](double z) { return Evaluate(example.field, {at.x(), at.y(), z}).value; };
  constexpr int kSteps = 48;
  for (int k = 1; k <= kSteps; ++k) {
    const double z = deepest * k / kSteps;
    if (value(z) > value(best)) best = z;
  }
  for (double step = deepest / kSteps / 2; step > 1e-4; step /= 2) {
    for (const double z : {std::abs(best - step), best + step}) {
      if (value(z) > value(best)) best = z;
    }
  }
  return SignedDistance(Evaluate(example.field, {at.x(), at.y(), best})) / example.diagonal;
}

TEST(ExampleJoints, CrotchesOfTheOutlineAreMet) {
  // Shares of the diagonal. A fillet is no larger than a blend makes it, and over so far from the
  // crotch.
  constexpr double kSpacing = 2.5e-3, kFillet = 0.011, kMeanFillet = 2e-3, kOver = 0.03;
  constexpr double kShort = 3e-3, kGrown = 2e-3;
  int crotches = 0;
  double sum = 0;
  for (const Example& example : Examples()) {
    const double diagonal = example.diagonal / example.frame.scale;
    double worst = 0;
    for (auto run : UnionOutline(*example.model.parts, *example.model.graph, kSpacing * diagonal)) {
      if ((run.front() - run.back()).norm() < kSpacing * diagonal) continue;  // closed
      for (int side = 0; side < 2; ++side) {
        std::reverse(run.begin(), run.end());
        const double off = FromSilhouette(example, run.front());
        EXPECT_LT(off, kShort) << example.name << " at " << run.front().transpose();
        EXPECT_GT(off, -kFillet) << example.name << " at " << run.front().transpose();
        worst = std::max(worst, std::abs(off));
        sum += std::abs(off);
        ++crotches;
        if (const auto away = Along(run, kOver * diagonal)) {
          EXPECT_GT(FromSilhouette(example, *away), -kGrown)
              << example.name << " grows past its outline at " << away->transpose();
        }
      }
    }
    std::printf("%-12s worst crotch %.2f %%\n", example.name.c_str(), 100 * worst);
  }
  std::printf("%d crotches, mean %.3f %%\n", crotches, 100 * sum / crotches);
  EXPECT_GT(crotches, 200);
  EXPECT_LT(sum / crotches, kMeanFillet);
}

/// A limb whose joint is drawn by two curves, and its parent, alone.
struct Joint {
  const Example& example;
  const Part& part;
  Field limb_and_parent, parent;
  double radius = 0;  ///< the limb's largest, in sketch units

  /// How far the limb with its parent stands out of the parent alone over a place of the drawing,
  /// in radii; nothing beside the parent.
  std::optional<double> Relief(const Vector2d& place) const {
    const std::optional<double> front = Front(parent, place), both = Front(limb_and_parent, place);
    if (!front || !both) return std::nullopt;
    return (*both - *front) / (example.frame.scale * radius);
  }

  std::optional<double> Front(const Field& field, const Vector2d& place) const {
    const Vector2d at = example.frame.ToModel(place);
    const auto inside = [&](double z) { return Evaluate(field, {at.x(), at.y(), z}).value >= 1; };
    const double deepest = Bounds(field).max().z();
    constexpr int kSteps = 64;
    int k = kSteps;
    while (k >= 0 && !inside(deepest * k / kSteps)) --k;
    if (k < 0) return std::nullopt;
    double low = deepest * k / kSteps, high = low + deepest / kSteps;
    for (int i = 0; i < 20; ++i) {
      const double middle = (low + high) / 2;
      (inside(middle) ? low : high) = middle;
    }
    return low;
  }

  /// Index of the outline's point at one end of a drawn curve.
  int PointAt(const Vector2d& end) const {
    const Ring& ring = part.outline.points;
    return static_cast<int>(std::min_element(ring.begin(), ring.end(),
                                             [&](const Vector2d& a, const Vector2d& b) {
                                               return (a - end).norm() < (b - end).norm();
                                             }) -
                            ring.begin());
  }

  const Vector2d& Point(int i) const {
    const int n = static_cast<int>(part.outline.points.size());
    return part.outline.points[Index((i % n + n) % n)];
  }

  Vector2d Outward(int i) const {
    const Vector2d along = Point(i + 2) - Point(i - 2);
    return Vector2d(along.y(), -along.x()).normalized();
  }

  /// Relief a little inside of a point of the outline.
  std::optional<double> ReliefWithin(int i) const {
    constexpr double kWithin = 0.15;
    return Relief(Point(i) - kWithin * radius * Outward(i));
  }

  /// Indices of the outline's points along a drawn curve, from its closed end to its open one.
  std::vector<int> Curve(std::size_t side) const {
    const int n = static_cast<int>(part.outline.points.size());
    const int closed = PointAt(part.root->closed[side]), open = PointAt(part.root->open[side]);
    const int other = PointAt(part.root->open[1 - side]);
    const int forward = (open - closed + n) % n;
    const int step = (other - closed + n) % n < forward ? -1 : 1;
    std::vector<int> indices{closed};
    while (indices.back() != open) indices.push_back((indices.back() + step + n) % n);
    return indices;
  }

  /// How far beyond the outline the blend with the parent ends, in radii.
  std::optional<double> BlendBeyond(int i) const {
    constexpr double kStep = 0.02, kFar = 1, kNothing = 0.02;
    for (double beyond = 0; beyond < kFar; beyond += kStep) {
      const std::optional<double> relief = Relief(Point(i) + beyond * radius * Outward(i));
      if (!relief) return std::nullopt;
      if (*relief < kNothing) return beyond;
    }
    return kFar;
  }
};

std::vector<Joint> JointsOf(const Example& example) {
  std::vector<Joint> joints;
  const Creature& creature = *example.model.creature;
  std::vector<int> field_part;
  for (const CreaturePart& part : creature.parts) {
    field_part.push_back(field_part.empty() ? 0 : field_part.back() + 1);
    if (field_part.size() > 1 && creature.parts[field_part.size() - 2].mirrored) {
      ++field_part.back();
    }
    const Part& drawn = example.model.parts->parts[Index(part.part)];
    if (!part.parent || !part.mirrored || !drawn.root ||
        drawn.root->evidence != LimbEvidence::kTwoCurves)
      continue;
    Joint& joint = joints.emplace_back(Joint{example, drawn, {}, {}, 0});
    joint.parent.part_exponent = example.field.part_exponent;
    joint.parent.gain = example.field.gain;
    joint.parent.parts.push_back(example.field.parts[Index(field_part[Index(*part.parent)])]);
    joint.parent.parts[0].parent.reset();
    joint.limb_and_parent = joint.parent;
    joint.limb_and_parent.parts.push_back(example.field.parts[Index(field_part.back())]);
    joint.limb_and_parent.parts[1].parent = 0;
    for (const Chain& chain : part.axis) {
      for (const SkeletonVertex& v : chain.vertices)
        joint.radius = std::max(joint.radius, v.radius);
    }
  }
  return joints;
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

TEST(ExampleJoints, BlendsEndWhereTheDrawnCurvesEnd) {
  // In radii of the limb. Where the curves are drawn, it stands out of its parent; where they end,
  // the blend is over; between their ends, it has gone into its parent.
  constexpr double kBeyond = 0.6, kMeanBeyond = 0.25, kSeen = 0.03, kMeanAtTop = 0.16;
  constexpr double kShareSeen = 0.9;
  std::vector<double> beyond, tops, seen;
  for (const Example& example : Examples()) {
    for (const Joint& joint : JointsOf(example)) {
      const LimbRoot& root = *joint.part.root;
      for (const std::size_t side : {0, 1}) {
        const std::vector<int> curve = joint.Curve(side);
        if (const auto here = joint.BlendBeyond(curve.back())) {
          EXPECT_LT(*here, kBeyond) << example.name << " at " << root.open[side].transpose();
          beyond.push_back(*here);
        }
        for (const double share : {0.3, 0.5, 0.7, 0.9}) {
          const auto k = static_cast<std::size_t>(share * static_cast<double>(curve.size() - 1));
          if (const auto relief = joint.ReliefWithin(curve[k]))
            seen.push_back(*relief > kSeen ? 1 : 0);
        }
      }
      const int top = joint.PointAt(root.open_completion[root.open_completion.size() / 2]);
      if (const auto relief = joint.ReliefWithin(top)) tops.push_back(*relief);
    }
  }
  std::printf(
      "%zu ends of drawn curves: blends end %.2f radii beyond them; limbs stand out along %.0f %% "
      "of the curves, by %.2f radii between their ends\n",
      beyond.size(), MeanOf(beyond), 100 * MeanOf(seen), MeanOf(tops));
  EXPECT_GT(beyond.size(), 80u);
  EXPECT_LT(MeanOf(beyond), kMeanBeyond);
  EXPECT_GT(MeanOf(seen), kShareSeen);
  EXPECT_LT(MeanOf(tops), kMeanAtTop);
}

}  // namespace
}  // namespace lascaux
