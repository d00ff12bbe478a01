#include "skeleton/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "lascaux/sketch/bezier.h"
#include "skeleton/index.h"

namespace lascaux::testing {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

void AddArc(const Vector2d& center, double radius, std::array<double, 2> angles,
            std::vector<Vector2d>& points) {
  constexpr int kSteps = 48;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = angles[0] + (angles[1] - angles[0]) * i / kSteps;
    points.push_back(center + radius * Vector2d(std::cos(t), std::sin(t)));
  }
}

/// Closed chain of cubics, given by their control points without the repeated ends.
Outline Smooth(const std::vector<Vector2d>& control) {
  std::vector<Vector2d> points;
  const std::size_t n = control.size();
  for (std::size_t i = 0; i < n; i += 3) {
    const CubicBezier piece{{control[i], control[i + 1], control[i + 2], control[(i + 3) % n]}};
    for (const CurveSample& s : Flatten(piece, 1e-3)) {
      if (points.empty() || (s.point - points.back()).norm() > 1e-9) points.push_back(s.point);
    }
  }
  if ((points.front() - points.back()).norm() < 1e-9) points.pop_back();
  return Drawn(std::move(points));
}

LimbRoot RootAt(const Vector2d& left, const Vector2d& right) {
  LimbRoot root;
  root.open = {left, right};
  root.open_completion = {left, right};
  return root;
}

void Mark(Outline& outline, OutlineKind kind, bool (*where)(const Vector2d&)) {
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const Vector2d middle =
        (outline.points[i] + outline.points[(i + 1) % outline.points.size()]) / 2;
    if (where(middle)) outline.kinds[i] = kind;
  }
}

}  // namespace

Outline Drawn(std::vector<Vector2d> points) {
  Outline outline;
  if (SignedArea(points) < 0) std::reverse(points.begin(), points.end());
  outline.kinds.assign(points.size(), OutlineKind::kDrawn);
  outline.points = std::move(points);
  return outline;
}

Outline Ellipse(const Vector2d& center, double a, double b) {
  std::vector<Vector2d> points;
  constexpr int kSteps = 256;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * kPi * i / kSteps;
    points.push_back(center + Vector2d(a * std::cos(t), b * std::sin(t)));
  }
  return Drawn(std::move(points));
}

Outline Capsule(const Vector2d& from, const Vector2d& to, double radius) {
  const double angle = std::atan2(to.y() - from.y(), to.x() - from.x());
  std::vector<Vector2d> points;
  AddArc(to, radius, {angle - kPi / 2, angle + kPi / 2}, points);
  AddArc(from, radius, {angle + kPi / 2, angle + 3 * kPi / 2}, points);
  return Drawn(std::move(points));
}

Outline Crotches() {
  std::vector<Vector2d> points;
  AddArc({4, 0}, 1, {-kPi / 2, kPi / 2}, points);
  points.push_back(kCrotches[0]);
  AddArc({0, 5 - kCrotches[0].x()}, kCrotches[0].x(), {0, kPi}, points);
  points.push_back(kCrotches[1]);
  AddArc({-4, 0}, 1, {kPi / 2, 3 * kPi / 2}, points);
  return Drawn(std::move(points));
}

Outline Wedge(double opening) {
  // The arc touches both sides at distance 3 from the corner.
  const double half = opening / 2, radius = 3 * std::tan(half), middle = 3 / std::cos(half);
  std::vector<Vector2d> points{{0, 0}};
  AddArc({middle, 0}, radius, {-kPi / 2 - half, kPi / 2 + half}, points);
  return Drawn(std::move(points));
}

Outline Ear() {
  return Smooth({{0, -3},
                 {0.8, -2},
                 {1, -1.2},
                 {1, 0},
                 {1, 1.2},
                 {-1, 1.2},
                 {-1, 0},
                 {-1, -1.2},
                 {-0.8, -2}});
}

Outline Leg() {
  return Smooth({{-0.6, 0},   {-0.7, 1.5}, {-0.1, 2.5}, {-0.2, 3.5}, {-0.25, 4.2}, {-0.2, 4.8},
                 {-0.6, 5.2}, {-1.3, 5.4}, {-1.3, 6},   {-0.7, 6},   {-0.2, 6},    {0.3, 6.1},
                 {0.4, 5.6},  {0.5, 5},    {0.45, 4},   {0.5, 3.5},  {0.6, 2.5},   {0.8, 1.5},
                 {0.7, 0},    {0.6, -1},   {-0.5, -1}});
}

Outline RandomBlob(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<double, 4> cosines{}, sines{};
  for (int k = 0; k < 4; ++k) {
    cosines[Index(k)] = 0.25 * uniform(random) / (k + 1);
    sines[Index(k)] = 0.25 * uniform(random) / (k + 1);
  }
  std::vector<Vector2d> points;
  constexpr int kSteps = 300;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * kPi * i / kSteps;
    double radius = 1;
    for (int k = 0; k < 4; ++k) {
      radius += cosines[Index(k)] * std::cos((k + 1) * t) + sines[Index(k)] * std::sin((k + 1) * t);
    }
    points.push_back(radius * Vector2d(1.6 * std::cos(t), std::sin(t)));
  }
  return Drawn(std::move(points));
}

int Drawing::Add(Outline outline, PartRole role, std::optional<int> parent) {
  const int index = static_cast<int>(parts.parts.size());
  Part part;
  part.outline = std::move(outline);
  DepthNode node;
  node.role = role;
  node.parent = parent;
  node.name = "part-" + std::to_string(index);
  if (role == PartRole::kIsland) {
    part.kind = PartKind::kIsland;
    node.relation = Relation::kOverIn;
  } else if (role == PartRole::kForeground) {
    part.kind = PartKind::kLimb;
    part.over = parent;
    node.relation = Relation::kOver;
  } else if (parent) {
    node.relation = Relation::kAdjacent;
  } else {
    graph.body = index;
  }
  parts.parts.push_back(std::move(part));
  graph.nodes.push_back(std::move(node));
  graph.order.push_back(index);
  return index;
}

Drawing OnlyBody(Outline outline) {
  Drawing drawing;
  drawing.Add(std::move(outline), PartRole::kBody);
  return drawing;
}

Drawing MakeBeast() {
  Drawing beast;
  beast.Add(Ellipse({0, 0}, 4, 1.5), PartRole::kBody);
  beast.Add(Capsule({-2, 0.4}, {-2.2, 3.2}, 0.45), PartRole::kForeground, kBody);
  beast.parts.parts[kFrontLeg].root = RootAt({-2.4, 0.1}, {-1.6, 0.1});
  beast.Add(Capsule({2, 0.4}, {2.3, 3.2}, 0.5), PartRole::kForeground, kBody);
  beast.parts.parts[kHindLeg].root = RootAt({1.6, 0.1}, {2.4, 0.1});
  beast.Add(Ellipse({-3, -0.3}, 0.15, 0.15), PartRole::kIsland, kBody);
  // The tail's drawn end lies on the body's outline, which is its shared piece.
  std::vector<Vector2d> tail;
  AddArc({7, -0.8}, 0.25, {-kPi / 2, kPi / 2}, tail);
  for (int i = 0; i <= 16; ++i) {
    const double y = -0.55 - 0.5 * i / 16;
    tail.emplace_back(4 * std::sqrt(1 - y * y / 2.25), y);
  }
  Outline tail_outline = Drawn(std::move(tail));
  Mark(tail_outline, OutlineKind::kShared, [](const Vector2d& p) {
    return std::abs(p.x() * p.x() / 16 + p.y() * p.y() / 2.25 - 1) < 1e-2;
  });
  beast.Add(std::move(tail_outline), PartRole::kSagittal, kBody);
  std::vector<Vector2d> hoof{{-2.6, 3.45}, {-1.8, 3.45}, {-1.7, 4}, {-2.7, 4}};
  Outline hoof_outline = Drawn(std::move(hoof));
  beast.Add(std::move(hoof_outline), PartRole::kSagittal, kFrontLeg);
  beast.Add(Capsule({-1, 1.2}, {-1, 3}, 0.4), PartRole::kBackground, kBody);
  return beast;
}

}  // namespace lascaux::testing
