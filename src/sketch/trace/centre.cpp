#include "sketch/trace/centre.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kStep = 0.5;  // pixels between samples across a line

/// Moving averages, over `reach` points to each side, fewer near the ends of an open line, which
/// stay where they are.
Points Smoothed(const Points& points, int reach, bool closed) {
  const int n = static_cast<int>(points.size()), period = n - 1;
  Points result(points);
  for (int i = 0; i < n; ++i) {
    const int side = closed ? std::min(reach, period / 4) : std::min({reach, i, n - 1 - i});
    Vector2d sum = Vector2d::Zero();
    for (int k = -side; k <= side; ++k) {
      const int j = closed ? (i + k + period) % period : i + k;
      sum += points[static_cast<std::size_t>(j)];
    }
    result[static_cast<std::size_t>(i)] = sum / (2 * side + 1);
  }
  return result;
}

/// How far the ink reaches from a point in a direction: to where it covers half, linearly
/// interpolated. Nothing when it goes on beyond `limit`.
std::optional<double> Reach(const Tone& coverage, const Vector2d& from, const Vector2d& direction,
                            double limit) {
  double before = CoverageAt(coverage, from);
  if (before < 0.5) return 0;
  for (double s = kStep; s <= limit; s += kStep) {
    const double here = CoverageAt(coverage, from + s * direction);
    if (here < 0.5) return s - kStep * (0.5 - here) / (before - here);
    before = here;
  }
  return std::nullopt;
}

void CentreBranch(Branch& branch, const Tone& coverage) {
  const int n = static_cast<int>(branch.points.size());
  branch.measured.assign(branch.points.size(), false);
  if (n < 3) return;
  const bool closed = branch.nodes[0] < 0;
  const double typical = branch.half_widths[static_cast<std::size_t>(n / 2)];
  const int reach = std::max(2, static_cast<int>(std::lround(typical)));
  const Points smooth = Smoothed(branch.points, reach, closed);
  Points moved = smooth;
  for (int i = 0; i < n; ++i) {
    const auto at = [&](int j) {
      const int k = closed ? (j + n - 1) % (n - 1) : std::clamp(j, 0, n - 1);
      return smooth[static_cast<std::size_t>(k)];
    };
    const Vector2d along = at(i + reach) - at(i - reach);
    if (along.norm() < 1e-9) continue;
    const Vector2d normal = Vector2d(-along.y(), along.x()).normalized();
    const auto u = static_cast<std::size_t>(i);
    const double limit = 2 * branch.half_widths[u] + 2;
    const auto left = Reach(coverage, smooth[u], normal, limit);
    const auto right = Reach(coverage, smooth[u], -normal, limit);
    if (!left || !right || *left + *right <= 0) continue;
    // A line that is met halfway: the ink is wider to one side than the line is.
    if (std::abs(*left - *right) > 1 + 0.5 * branch.half_widths[u]) continue;
    moved[u] = smooth[u] + 0.5 * (*left - *right) * normal;
    branch.half_widths[u] = 0.5 * (*left + *right);
    branch.measured[u] = true;
  }
  branch.points = Smoothed(moved, 1, closed);
}

/// Ends a branch where the middle of a round pen was when it stopped: half a width before the ink's
/// end, as seen from a width before it.
void EndAtTip(Branch& branch, int end, const Tone& coverage) {
  if (end == 0) std::reverse(branch.points.begin(), branch.points.end());
  if (end == 0) std::reverse(branch.half_widths.begin(), branch.half_widths.end());
  Points& points = branch.points;
  const std::size_t n = points.size();
  const auto back = [&](double distance) {  // index of the point so far before the end
    return n - 1 - std::min(n - 1, static_cast<std::size_t>(std::ceil(distance)));
  };
  const double half_width = branch.half_widths[back(2 * branch.half_widths[n / 2])];
  const Vector2d from = points[back(2 * half_width)];
  const Vector2d along = from - points[back(4 * half_width + 2)];
  if (along.norm() > 1e-9) {
    const Vector2d direction = along.normalized();
    const auto tip = Reach(coverage, from, direction, 6 * half_width + 2);
    const double wanted = tip ? *tip - half_width : -1;
    const auto at = [&](const Vector2d& p) { return (p - from).dot(direction); };
    if (wanted > 0) {
      while (points.size() > 2 && at(points.back()) > wanted - kStep)
        points.pop_back(), branch.half_widths.pop_back();
      points.push_back(points.back() + (wanted - at(points.back())) * direction);
      branch.half_widths.push_back(half_width);
      branch.measured.assign(points.size(), true);
    }
  }
  if (end == 0) std::reverse(branch.points.begin(), branch.points.end());
  if (end == 0) std::reverse(branch.half_widths.begin(), branch.half_widths.end());
}

}  // namespace

double CoverageAt(const Tone& coverage, const Vector2d& point) {
  const double x = point.x() - 0.5, y = point.y() - 0.5;
  if (!(x >= 0 && y >= 0 && x < coverage.width - 1 && y < coverage.height - 1)) return 0;
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const double fx = x - ix, fy = y - iy;
  const float *above = coverage.Row(iy) + ix, *below = coverage.Row(iy + 1) + ix;
  return (1 - fy) * ((1 - fx) * above[0] + fx * above[1]) +
         fy * ((1 - fx) * below[0] + fx * below[1]);
}

double BlotWidthAt(const Tone& coverage, const Vector2d& at, double half_width) {
  constexpr int kDirections = 16;
  double sum = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const double limit = 2 * half_width + 2;
    sum += Reach(coverage, at, {std::cos(angle), std::sin(angle)}, limit).value_or(limit);
  }
  return 2 * sum / kDirections;
}

void Centre(InkGraph& graph, const Ink& ink) {
  for (Branch& branch : graph.branches) {
    if (branch.removed) continue;
    CentreBranch(branch, ink.coverage);
    if (branch.nodes[0] < 0) continue;
    for (int end = 0; end < 2; ++end) {
      InkNode& node =
          graph.nodes[static_cast<std::size_t>(branch.nodes[static_cast<std::size_t>(end)])];
      if (node.ends.size() > 1) continue;
      EndAtTip(branch, end, ink.coverage);
      node.at = end == 0 ? branch.points.front() : branch.points.back();
    }
  }
}

}  // namespace lascaux::trace
