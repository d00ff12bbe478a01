#include "sketch/trace/pen.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lascaux::testing {
namespace {

using Eigen::Vector2d;

double DistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d step = b - a;
  const double length2 = step.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(step) / length2, 0.0, 1.0) : 0;
  return (a + t * step - p).norm();
}

std::vector<Vector2d> PointsOf(const Stroke& stroke, double tolerance) {
  std::vector<Vector2d> points;
  for (const CubicBezier& piece : stroke.pieces)
    for (const CurveSample& sample : Flatten(piece, tolerance)) points.push_back(sample.point);
  return points;
}

template <typename Change>
Bitmap Changed(Bitmap picture, Change change) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        auto& v =
            picture
                .rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x)) +
                      c];
        v = static_cast<std::uint8_t>(
            std::clamp(std::lround(change(x, y, c, static_cast<double>(v))), 0L, 255L));
      }
  return picture;
}

}  // namespace

Page::Page(int w, int h)
    : width(w),
      height(h),
      ink(static_cast<std::size_t>(w * h)),
      colors(static_cast<std::size_t>(w * h), {0.98, 0.97, 0.96}) {}

void Page::Draw(const Stroke& stroke) {
  const double radius = stroke.width / 2;
  const std::vector<Vector2d> points = PointsOf(stroke, 0.02);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector2d low = points[i - 1].cwiseMin(points[i]),
                   high = points[i - 1].cwiseMax(points[i]);
    const int x0 = std::max(0, static_cast<int>(low.x() - radius - 1));
    const int x1 = std::min(width - 1, static_cast<int>(high.x() + radius + 1));
    const int y0 = std::max(0, static_cast<int>(low.y() - radius - 1));
    const int y1 = std::min(height - 1, static_cast<int>(high.y() + radius + 1));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double d = DistanceToSegment({x + 0.5, y + 0.5}, points[i - 1], points[i]);
        double& here = ink[static_cast<std::size_t>(y * width + x)];
        here = std::max(here, std::clamp(radius - d + 0.5, 0.0, 1.0));
      }
  }
}

void Page::Draw(const Sketch& sketch) {
  for (const Stroke& stroke : sketch.strokes) Draw(stroke);
}

void Page::Paint(const Vector2d& center, double radius, const std::array<double, 3>& color) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if ((Vector2d(x + 0.5, y + 0.5) - center).norm() < radius)
        colors[static_cast<std::size_t>(y * width + x)] = color;
}

void Page::Blot(const Vector2d& center, double radius) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double& here = ink[static_cast<std::size_t>(y * width + x)];
      here = std::max(
          here, std::clamp(radius - (Vector2d(x + 0.5, y + 0.5) - center).norm() + 0.5, 0.0, 1.0));
    }
}

Bitmap Page::Seen(double darkness) const {
  Bitmap picture{width, height, {}};
  for (std::size_t i = 0; i < ink.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgba.push_back(static_cast<std::uint8_t>(std::lround(
          255 * ((1 - ink[i]) * colors[i][c] + ink[i] * std::min(darkness, colors[i][c])))));
    picture.rgba.push_back(255);
  }
  return picture;
}

Bitmap Unevenly(Bitmap picture) {
  const double w = picture.width, h = picture.height;
  return Changed(std::move(picture), [&](int x, int y, std::size_t, double v) {
    const double fall = 0.45 + 0.55 * (1 - 0.5 * (x / w + y / h));
    const double shadow = 1 - 0.35 / (1 + std::exp((x + 0.3 * y - 0.6 * w) / (0.03 * w)));
    return v * fall * shadow;
  });
}

Bitmap Grainy(Bitmap picture, double deviation, Random& random) {
  return Changed(std::move(picture), [&](int, int, std::size_t, double v) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += random.Uniform(-1, 1);
    return v + deviation * sum * std::sqrt(0.75);
  });
}

Bitmap Blurry(Bitmap picture, int radius) {
  const Bitmap sharp = picture;
  return Changed(std::move(picture), [&](int x, int y, std::size_t c, double) {
    double sum = 0;
    int count = 0;
    for (int v = std::max(0, y - radius); v <= std::min(sharp.height - 1, y + radius); ++v)
      for (int u = std::max(0, x - radius); u <= std::min(sharp.width - 1, x + radius);
           ++u, ++count)
        sum += sharp.rgba[4 * static_cast<std::size_t>(v * sharp.width + u) + c];
    return sum / count;
  });
}

Bitmap Blocky(Bitmap picture, double step) {
  const Bitmap sharp = picture;
  return Changed(std::move(picture), [&](int x, int y, std::size_t c, double v) {
    const int x0 = x / 8 * 8, y0 = y / 8 * 8;
    double sum = 0;
    int count = 0;
    for (int b = y0; b < std::min(y0 + 8, sharp.height); ++b)
      for (int a = x0; a < std::min(x0 + 8, sharp.width); ++a, ++count)
        sum += sharp.rgba[4 * static_cast<std::size_t>(b * sharp.width + a) + c];
    const double mean = sum / count;
    return mean + step * std::round((v - mean) / step);
  });
}

Sketch Placed(Sketch sketch, const Vector2d& page, double width) {
  const Eigen::AlignedBox2d box = Bounds(sketch);
  const double margin = 4 * width;
  const double scale = ((page.array() - 2 * margin) / box.sizes().array()).minCoeff();
  for (Stroke& stroke : sketch.strokes) {
    for (CubicBezier& piece : stroke.pieces)
      for (Vector2d& p : piece.p) p = (p - box.min()) * scale + Vector2d::Constant(margin);
    stroke.width = width;
  }
  return sketch;
}

double Farthest(const Sketch& a, const Sketch& b) {
  std::vector<std::vector<Vector2d>> lines;
  for (const Stroke& stroke : b.strokes) lines.push_back(PointsOf(stroke, 0.05));
  double farthest = 0;
  for (const Stroke& stroke : a.strokes) {
    const std::vector<Vector2d> points = PointsOf(stroke, 0.05);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& line : lines)
        for (std::size_t k = 1; k < line.size(); ++k)
          nearest = std::min(nearest, DistanceToSegment(points[i], line[k - 1], line[k]));
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

}  // namespace lascaux::testing
