#include <2geom/elliptical-arc.h>
#include <2geom/exception.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sketch/svg/path_builder.h"

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

/// A cubic's distance from a circular arc falls with the sixth power of its angle: 4.2e-6 radii at
/// 45 degrees, well below the tolerance at which curves are flattened, where 90 degrees (2.7e-4)
/// would not be.
constexpr double kMaxPieceAngle = std::numbers::pi / 4;

/// An arc by its centre: centre + map * (cos a, sin a) for a from `begin` through `sweep` radians.
struct CentredArc {
  Vector2d centre;
  Eigen::Matrix2d map;
  double begin = 0, sweep = 0;
};

/// lib2geom finds the centre; it throws for what it takes for degenerate.
std::optional<CentredArc> FindCentre(const Vector2d& start, const EllipticArc& arc) {
  try {
    const Geom::EllipticalArc found({start.x(), start.y()}, {arc.radii.x(), arc.radii.y()},
                                    arc.rotation_degrees * std::numbers::pi / 180, arc.large,
                                    arc.sweep, {arc.end.x(), arc.end.y()});
    const Geom::Affine unit = found.unitCircleTransform();
    CentredArc result;
    result.centre = {found.center().x(), found.center().y()};
    result.map << unit[0], unit[2], unit[1], unit[3];
    result.begin = found.initialAngle();
    result.sweep = found.sweepAngle();
    return result;
  } catch (const Geom::Exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<CubicBezier> ArcPieces(const Vector2d& start, const EllipticArc& arc) {
  if (start == arc.end) return {};
  if (arc.radii.x() == 0 || arc.radii.y() == 0) return {Line(start, arc.end)};
  const std::optional<CentredArc> centred = FindCentre(start, arc);
  if (!centred || !std::isfinite(centred->sweep) || !centred->map.allFinite()) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {{{start, Vector2d(kNan, kNan), Vector2d(kNan, kNan), arc.end}}};
  }
  const int count = std::max(
      1, static_cast<int>(std::ceil(std::abs(centred->sweep) / kMaxPieceAngle * (1 - 1e-12))));
  const double step = centred->sweep / count;
  const double handle = 4.0 / 3 * std::tan(step / 4);
  std::vector<CubicBezier> pieces;
  Vector2d from = start;
  for (int i = 0; i < count; ++i) {
    const double a = centred->begin + i * step, b = a + step;
    const Vector2d unit_a(std::cos(a), std::sin(a)), unit_b(std::cos(b), std::sin(b));
    const Vector2d along_a(-unit_a.y(), unit_a.x()), along_b(-unit_b.y(), unit_b.x());
    const Vector2d to = i + 1 == count ? arc.end : centred->centre + centred->map * unit_b;
    pieces.push_back({{from, centred->centre + centred->map * (unit_a + handle * along_a),
                       centred->centre + centred->map * (unit_b - handle * along_b), to}});
    from = to;
  }
  return pieces;
}

}  // namespace lascaux::svg
