#include "sketch/trace/corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sketch/trace/centre.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kRounded = 0.8;  // widths to each side of a corner where the thinned line is off
constexpr double kSide = 2.3;     // widths to each side up to which it gives the side's direction
constexpr double kMostSharpened = 3;  // widths that a corner may lie beyond the thinned line

constexpr double kPenRim = 0.35;  // widths from a corner that are ink

double Turn(const Vector2d& a, const Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// A line by its arc length; a closed one repeats.
class ByLength {
 public:
  ByLength(const Points& points, bool closed) : points_(points), closed_(closed) {
    lengths_.push_back(0);
    for (std::size_t i = 1; i < points.size(); ++i)
      lengths_.push_back(lengths_.back() + (points[i] - points[i - 1]).norm());
  }

  double total() const { return lengths_.back(); }
  double At(std::size_t i) const { return lengths_[i]; }

  Vector2d PointAt(double s) const {
    s = Wrapped(s);
    const auto above = std::upper_bound(lengths_.begin(), lengths_.end(), s);
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        above - lengths_.begin(), 1, static_cast<std::ptrdiff_t>(lengths_.size()) - 1));
    const double step = lengths_[i] - lengths_[i - 1];
    const double t = step > 0 ? (s - lengths_[i - 1]) / step : 0;
    return points_[i - 1] + std::clamp(t, 0.0, 1.0) * (points_[i] - points_[i - 1]);
  }

 private:
  double Wrapped(double s) const {
    if (!closed_ || total() <= 0) return std::clamp(s, 0.0, total());
    s = std::fmod(s, total());
    return s < 0 ? s + total() : s;
  }

  const Points& points_;
  bool closed_;
  std::vector<double> lengths_;
};

/// How sharply a line turns at a place: by how much within a width to each side, 0 where the turn
/// goes on beyond, as it does on a small circle.
double TurnAt(const ByLength& path, double s, double width) {
  constexpr double kConcentrated =
      0.55;  // of the turn over three widths: on a circle it is a third
  const auto direction = [&](double from, double to) -> Vector2d {
    return path.PointAt(s + to * width) - path.PointAt(s + from * width);
  };
  const double near = Turn(direction(-1, 0), direction(0, 1));
  const double far = Turn(direction(-2, -1), direction(1, 2));
  return near >= kConcentrated * far ? near : 0;
}

/// Arc lengths of the corners, ascending: where the chords of one width before and after turn the
/// most, and by more than a corner.
std::vector<double> CornersOf(const Line& line, const ByLength& path,
                              const CornerOptions& options) {
  const double w = options.width, least = options.degrees * std::numbers::pi / 180;
  struct Found {
    double s, turn;
  };
  std::vector<Found> found;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const double s = path.At(i);
    if (!line.closed && (s < 0.5 * w || s > path.total() - 0.5 * w)) continue;
    const double turn = TurnAt(path, s, w);
    if (turn >= least) found.push_back({s, turn});
  }
  // The sharpest first; what is nearer than a width to one is the same.
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.turn > b.turn; });
  std::vector<double> corners;
  const auto apart = [&](double a, double b) {
    const double d = std::abs(a - b);
    return line.closed ? std::min(d, path.total() - d) : d;
  };
  for (const Found& f : found)
    if (std::none_of(corners.begin(), corners.end(), [&](double s) { return apart(s, f.s) < w; }))
      corners.push_back(f.s);
  std::sort(corners.begin(), corners.end());
  return corners;
}

struct Ray {
  Vector2d from, toward;
};

/// The straight line through the path from `s` over `length` (negative: backward), toward `s`.
std::optional<Ray> Side(const ByLength& path, double s, double length) {
  constexpr int kSamples = 8;
  Vector2d mean = Vector2d::Zero(), slope = Vector2d::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 0.5) / kSamples - 0.5;
    const Vector2d point = path.PointAt(s + (t + 0.5) * length);
    mean += point / kSamples;
    slope += t * point;
  }
  if (slope.norm() < 1e-9) return std::nullopt;
  return Ray{mean, -slope.normalized()};
}

/// Where the two sides of a corner meet.
std::optional<Vector2d> Apex(const Ray& a, const Ray& b) {
  const double across = a.toward.x() * b.toward.y() - a.toward.y() * b.toward.x();
  if (std::abs(across) < 0.1) return std::nullopt;
  const Vector2d between = b.from - a.from;
  const double t = (between.x() * b.toward.y() - between.y() * b.toward.x()) / across;
  const double u = (between.x() * a.toward.y() - between.y() * a.toward.x()) / across;
  if (t <= 0 || u <= 0) return std::nullopt;
  return a.from + t * a.toward;
}

/// How far the line may be replaced around a corner: to half the way to what comes next.
struct Room {
  double before, after;
};

struct Corner {
  double s;  ///< where it is on the thinned line
  Vector2d at;
  double before, after;  ///< arc lengths to its sides that it replaces
};

Corner Sharpened(const ByLength& path, double s, const Room& room, const Tone& coverage, double w) {
  const Corner blunt{s, path.PointAt(s), 0, 0};
  const double before = std::min(kRounded * w, 0.5 * room.before);
  const double after = std::min(kRounded * w, 0.5 * room.after);
  const double far_before = std::min(kSide * w, room.before);
  const double far_after = std::min(kSide * w, room.after);
  const auto a = Side(path, s - before, before - far_before);
  const auto b = Side(path, s + after, far_after - after);
  if (!a || !b) return blunt;
  const auto apex = Apex(*a, *b);
  if (!apex || (*apex - blunt.at).norm() > kMostSharpened * w) return blunt;
  // The pen's disc was there, so most of the way to its rim is ink; a side that bends leads too
  // far.
  const Vector2d outward = (*apex - blunt.at).stableNormalized();
  double back = 0;
  const double beyond = (*apex - blunt.at).norm();
  while (back < beyond && CoverageAt(coverage, *apex + (kPenRim * w - back) * outward) < 0.5)
    back += 0.25;
  return {s, *apex - std::min(back, beyond) * outward, before, after};
}

}  // namespace

std::vector<Points> PiecesBetweenCorners(const Line& line, const Tone& coverage,
                                         const CornerOptions& options) {
  const ByLength path(line.points, line.closed);
  const std::vector<double> places = CornersOf(line, path, options);
  if (places.empty()) return {line.points};
  const double total = path.total();
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double last = i > 0 ? places[i - 1] : line.closed ? places.back() - total : 0;
    const double next = i + 1 < places.size() ? places[i + 1]
                        : line.closed         ? places.front() + total
                                              : total;
    const auto room = [&](double distance, bool to_corner) {
      return to_corner ? 0.5 * distance : distance;
    };
    corners.push_back(Sharpened(path, places[i],
                                {room(places[i] - last, i > 0 || line.closed),
                                 room(next - places[i], i + 1 < places.size() || line.closed)},
                                coverage, options.width));
  }
  // The stretch of points whose arc length lies in (from, to), between two given ends.
  const auto stretch = [&](const Vector2d& first, double from, double to, const Vector2d& last) {
    Points points{first};
    for (int turn = 0; turn < 2; ++turn)
      for (std::size_t i = 0;
           i + 1 < line.points.size() || (!line.closed && i < line.points.size()); ++i) {
        const double s = path.At(i) + turn * total;
        if (s > from && s < to) points.push_back(line.points[i]);
      }
    points.push_back(last);
    return points;
  };
  std::vector<Points> pieces;
  if (!line.closed)
    pieces.push_back(stretch(line.points.front(), 0, corners.front().s - corners.front().before,
                             corners.front().at));
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    pieces.push_back(stretch(corners[i].at, corners[i].s + corners[i].after,
                             corners[i + 1].s - corners[i + 1].before, corners[i + 1].at));
  const Corner &first = corners.front(), &last = corners.back();
  pieces.push_back(
      line.closed ? stretch(last.at, last.s + last.after, first.s + total - first.before, first.at)
                  : stretch(last.at, last.s + last.after, total, line.points.back()));
  return pieces;
}

}  // namespace lascaux::trace
