#include "volume/color/side_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lascaux {
namespace {

using Eigen::Vector2i;
using Eigen::Vector3d;

/// Vertices in pixels, z towards the viewer in any unit.
std::vector<Vector3d> InPixels(const PageColors& page, const ColoredView& view) {
  std::vector<Vector3d> points;
  points.reserve(view.mesh.vertices.size());
  for (const Eigen::Vector3f& v : view.mesh.vertices) {
    const Eigen::Vector2d p =
        (view.frame.ToSketch(v.head<2>().cast<double>()) - page.origin) / page.pixel;
    points.emplace_back(p.x(), p.y(), v.z());
  }
  return points;
}

/// Draws triangles into a page with a buffer of depths.
class Drawing {
 public:
  explicit Drawing(const PageColors& page)
      : page_(page),
        depth_(page.colors.size(), -std::numeric_limits<double>::infinity()),
        layers_(page.colors.size(), kNoLayer) {}

  /// Those that face the viewer cover the pixels whose middles are in them.
  void Add(const Vector3d& a, const Vector3d& b, const Vector3d& c, std::uint16_t layer) {
    // Rows run down: a triangle that faces the viewer is clockwise here.
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    if (!(area < 0)) return;
    const auto [left, right] = Range(a.x(), b.x(), c.x(), page_.width);
    const auto [top, bottom] = Range(a.y(), b.y(), c.y(), page_.height);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const auto share = [&](const Vector3d& p, const Vector3d& q) {
          return ((p.x() - px) * (q.y() - py) - (q.x() - px) * (p.y() - py)) / area;
        };
        const double u = share(b, c), v = share(c, a), w = share(a, b);
        if (u < 0 || v < 0 || w < 0) continue;
        const double z = u * a.z() + v * b.z() + w * c.z();
        const std::size_t i = page_.Index(x, y);
        if (z <= depth_[i]) continue;
        depth_[i] = z;
        layers_[i] = layer;
      }
    }
  }

  std::vector<std::uint16_t> TakeLayers() { return std::move(layers_); }

 private:
  /// The first and the last pixel whose middles are between the three, on the page.
  static std::pair<int, int> Range(double a, double b, double c, int size) {
    const double low = std::clamp(std::ceil(std::min({a, b, c}) - 0.5), 0.0, size * 1.0);
    const double high = std::clamp(std::floor(std::max({a, b, c}) - 0.5), -1.0, size - 1.0);
    return {static_cast<int>(low), static_cast<int>(high)};
  }

  const PageColors& page_;
  std::vector<double> depth_;
  std::vector<std::uint16_t> layers_;
};

}  // namespace

SideView SeenFromTheSide(const PageColors& page, const ColoredView& view) {
  const std::vector<Vector3d> points = InPixels(page, view);
  SideView result;
  const auto last = std::max_element(view.layer_of_part.begin(), view.layer_of_part.end());
  result.boxes.resize(last == view.layer_of_part.end() ? 0 : *last + std::size_t{1});
  Drawing drawing(page);
  const Vector2i most(page.width - 1, page.height - 1);
  for (std::size_t t = 0; t < view.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = view.mesh.triangles[t];
    const std::uint16_t part = view.triangle_parts[t];
    const std::uint16_t layer =
        part < view.layer_of_part.size() ? view.layer_of_part[part] : kNoLayer;
    drawing.Add(points[a], points[b], points[c], layer);
    if (layer == kNoLayer) continue;
    for (const std::uint32_t corner : {a, b, c}) {
      const Vector2i pixel = points[corner].head<2>().array().floor().cast<int>();
      result.boxes[layer].extend(pixel.cwiseMax(0).cwiseMin(most));
    }
  }
  result.layers = drawing.TakeLayers();
  return result;
}

}  // namespace lascaux
