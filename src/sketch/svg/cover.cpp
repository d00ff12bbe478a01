#include "sketch/svg/cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

/// Halvings between a visible and a hidden point of a curve.
constexpr int kHalvings = 30;

double DistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

/// A stretch of one piece of a stroke.
struct Stretch {
  std::size_t piece = 0;
  double from = 0, to = 1;
};

CubicBezier Cut(const CubicBezier& piece, double from, double to) {
  CubicBezier result = piece;
  if (to < 1) result = Split(result, to).first;
  if (from > 0) result = Split(result, from / to).second;
  return result;
}

/// Parameters along a piece at which its points are a few tolerances apart.
std::vector<double> Steps(const CubicBezier& piece, double tolerance) {
  constexpr double kSpacing = 4;
  std::vector<double> steps{0};
  const auto samples = Flatten(piece, tolerance);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double chord = (samples[i].point - samples[i - 1].point).norm();
    const int parts = 1 + static_cast<int>(std::min(chord / (kSpacing * tolerance), 1e4));
    const double from = samples[i - 1].t, step = (samples[i].t - from) / parts;
    for (int k = 1; k < parts; ++k) steps.push_back(from + k * step);
    steps.push_back(samples[i].t);
  }
  return steps;
}

/// The visible stretches of a stroke, in its direction.
template <typename IsHidden>
std::vector<Stretch> Visible(const Stroke& stroke, double tolerance, const IsHidden& is_hidden) {
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < stroke.pieces.size(); ++k) {
    const CubicBezier& piece = stroke.pieces[k];
    const std::vector<double> steps = Steps(piece, tolerance);
    double from = 0;
    bool hidden = is_hidden(piece.p[0]);
    for (std::size_t i = 1; i < steps.size(); ++i) {
      if (is_hidden(piece.At(steps[i])) == hidden) continue;
      double low = steps[i - 1], high = steps[i];
      for (int h = 0; h < kHalvings; ++h) {
        const double middle = 0.5 * (low + high);
        (is_hidden(piece.At(middle)) == hidden ? low : high) = middle;
      }
      if (!hidden && low > from) stretches.push_back({k, from, low});
      from = high;
      hidden = !hidden;
    }
    if (!hidden && from < 1) stretches.push_back({k, from, 1});
  }
  return stretches;
}

}  // namespace

Cover::Cover(const std::vector<const std::vector<CubicBezier>*>& outlines, FillRule rule, int order,
             double tolerance)
    : rule_(rule), order_(order) {
  for (const std::vector<CubicBezier>* outline : outlines) {
    if (outline->empty()) continue;
    Vector2d last = outline->front().p[0];
    const auto add = [&](const Vector2d& next) {
      if (next != last) edges_.push_back({last, next});
      last = next;
    };
    for (const CubicBezier& piece : *outline) {
      for (const CurveSample& sample : Flatten(piece, tolerance)) add(sample.point);
    }
    add(outline->front().p[0]);
  }
  for (const Edge& edge : edges_) box_.extend(edge.a);
  bands_.resize(1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(edges_.size()))));
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [low, high] = std::minmax(edges_[e].a.y(), edges_[e].b.y());
    for (std::size_t band = BandOf(low); band <= BandOf(high); ++band) bands_[band].push_back(e);
  }
}

std::size_t Cover::BandOf(double y) const {
  const double height = box_.sizes().y();
  if (!(height > 0)) return 0;
  const double last = static_cast<double>(bands_.size() - 1);
  return static_cast<std::size_t>(std::clamp((y - box_.min().y()) / height * last, 0.0, last));
}

bool Cover::Hides(const Vector2d& point, double margin) const {
  if (box_.isEmpty() || !box_.contains(point)) return false;
  int winding = 0, crossings = 0;
  for (const std::size_t e : bands_[BandOf(point.y())]) {
    const auto& [a, b] = edges_[e];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x <= point.x()) continue;
    ++crossings;
    winding += b.y() > a.y() ? 1 : -1;
  }
  if (rule_ == FillRule::kEvenOdd ? crossings % 2 == 0 : winding == 0) return false;
  for (std::size_t band = BandOf(point.y() - margin); band <= BandOf(point.y() + margin); ++band) {
    for (const std::size_t e : bands_[band]) {
      if (DistanceToSegment(point, edges_[e].a, edges_[e].b) <= margin) return false;
    }
  }
  return true;
}

std::vector<Stroke> VisibleStretches(const Stroke& stroke, int order,
                                     const std::vector<Cover>& covers, double tolerance) {
  Eigen::AlignedBox2d box;
  for (const CubicBezier& piece : stroke.pieces) box.extend(Bounds(piece));
  std::vector<const Cover*> above;
  for (const Cover& cover : covers) {
    if (cover.order() > order && cover.box().intersects(box)) above.push_back(&cover);
  }
  if (above.empty()) return {stroke};
  const double margin = std::max(0.5 * stroke.width, tolerance);
  const auto is_hidden = [&](const Vector2d& p) {
    return std::any_of(above.begin(), above.end(),
                       [&](const Cover* cover) { return cover->Hides(p, margin); });
  };
  if (stroke.is_dot) {
    return is_hidden(stroke.pieces.front().p[0]) ? std::vector<Stroke>{}
                                                 : std::vector<Stroke>{stroke};
  }
  const std::vector<Stretch> stretches = Visible(stroke, tolerance, is_hidden);
  const bool whole = stretches.size() == stroke.pieces.size() &&
                     std::all_of(stretches.begin(), stretches.end(),
                                 [](const Stretch& s) { return s.from == 0 && s.to == 1; });
  if (whole) return {stroke};
  std::vector<Stroke> visible;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& s = stretches[i];
    const bool goes_on =
        i > 0 && s.from == 0 && stretches[i - 1].to == 1 && stretches[i - 1].piece + 1 == s.piece;
    if (!goes_on) {
      visible.push_back(stroke);
      visible.back().pieces.clear();
      visible.back().closed = false;
    }
    visible.back().pieces.push_back(Cut(stroke.pieces[s.piece], s.from, s.to));
  }
  // A closed stroke that is visible where it begins is one stretch there.
  const bool seam = stroke.closed && visible.size() > 1 && stretches.front().from == 0 &&
                    stretches.front().piece == 0 && stretches.back().to == 1 &&
                    stretches.back().piece + 1 == stroke.pieces.size();
  if (seam) {
    auto& last = visible.back().pieces;
    const auto& first = visible.front().pieces;
    last.insert(last.end(), first.begin(), first.end());
    visible.front() = std::move(visible.back());
    visible.pop_back();
  }
  for (Stroke& part : visible) {
    for (std::size_t k = 1; k < part.pieces.size(); ++k)
      part.pieces[k].p[0] = part.pieces[k - 1].p[3];
  }
  return visible;
}

}  // namespace lascaux::svg
