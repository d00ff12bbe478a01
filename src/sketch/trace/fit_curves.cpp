#include "sketch/trace/fit_curves.h"

#include <2geom/bezier-utils.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kChunk =
    256;  // points fitted at once: the fit is quadratic in the worst case
constexpr unsigned kMostPieces = 64;       // of a chunk
constexpr std::size_t kTangentPoints = 4;  // to each side, for the tangent where chunks meet

Geom::Point ToGeom(const Vector2d& p) { return {p.x(), p.y()}; }
Vector2d FromGeom(const Geom::Point& p) { return {p.x(), p.y()}; }

bool IsFinite(const CubicBezier& curve) {
  return std::all_of(curve.p.begin(), curve.p.end(), [](const auto& p) { return p.allFinite(); });
}

/// The points without those that repeat the one before.
std::vector<Vector2d> Distinct(const std::vector<Vector2d>& points) {
  std::vector<Vector2d> result;
  for (const Vector2d& p : points)
    if (result.empty() || (p - result.back()).norm() > 1e-6) result.push_back(p);
  if (result.size() > 1 && result.back() != points.back()) result.back() = points.back();
  if (result.size() == 1 && result.front() != points.back()) result.push_back(points.back());
  return result;
}

void FitChunk(const std::vector<Geom::Point>& data, const Geom::Point& first,
              const Geom::Point& last, double tolerance, std::vector<CubicBezier>& curves) {
  std::array<Geom::Point, 4 * kMostPieces> control;
  std::array<int, kMostPieces> splits;
  const int length = static_cast<int>(data.size());
  const int count = Geom::bezier_fit_cubic_full(control.data(), splits.data(), data.data(), length,
                                                first, last, tolerance * tolerance, kMostPieces);
  std::vector<CubicBezier> found;
  for (int i = 0; i < count; ++i) {
    const Geom::Point* p = control.data() + 4 * i;
    found.push_back({{FromGeom(p[0]), FromGeom(p[1]), FromGeom(p[2]), FromGeom(p[3])}});
  }
  if (count <= 0 || !std::all_of(found.begin(), found.end(), IsFinite)) {
    found.clear();
    for (std::size_t i = 1; i < data.size(); ++i)
      found.push_back(Line(FromGeom(data[i - 1]), FromGeom(data[i])));
  }
  curves.insert(curves.end(), found.begin(), found.end());
}

}  // namespace

std::vector<CubicBezier> FitCurves(const std::vector<Vector2d>& all, double tolerance, Ends ends) {
  const std::vector<Vector2d> points = Distinct(all);
  std::vector<CubicBezier> curves;
  if (points.size() < 2) return curves;
  if (points.size() == 2) return {Line(points[0], points[1])};
  const std::size_t last = points.size() - 1;
  const Geom::Point none(0, 0);  // lib2geom then takes what fits best
  const auto tangent = [&](std::size_t i) {
    const bool ring = ends == Ends::kSmoothRing;
    const std::size_t reach = std::min(kTangentPoints, last / 2);
    const std::size_t before = i >= reach ? i - reach : ring ? i + last - reach : 0;
    const std::size_t after = i + reach <= last ? i + reach : ring ? i + reach - last : last;
    const Vector2d along = points[after] - points[before];
    return along.norm() > 1e-9 ? ToGeom(along.normalized()) : none;
  };
  const std::size_t chunks = (last + kChunk - 1) / kChunk;
  for (std::size_t k = 0; k < chunks; ++k) {
    const std::size_t from = last * k / chunks, to = last * (k + 1) / chunks;
    std::vector<Geom::Point> data;
    for (std::size_t i = from; i <= to; ++i) data.push_back(ToGeom(points[i]));
    const bool open = ends == Ends::kFree;
    FitChunk(data, from == 0 && open ? none : tangent(from),
             to == last && open ? none : -tangent(to), tolerance, curves);
  }
  for (std::size_t i = 1; i < curves.size(); ++i) curves[i].p[0] = curves[i - 1].p[3];
  return curves;
}

}  // namespace lascaux::trace
