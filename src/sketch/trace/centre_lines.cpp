#include "sketch/trace/centre_lines.h"

#include <algorithm>
#include <cmath>

#include "sketch/trace/find_ink.h"
#include "sketch/trace/gate.h"
#include "sketch/trace/trace_ink.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

constexpr double kPixelsToWidth = 8;
constexpr double kMostPixels = 4e6;
constexpr double kMargin = 2;  // pixels around the shape

Eigen::AlignedBox2d BoundsOf(const Contours& contours) {
  Eigen::AlignedBox2d box;
  for (const auto& contour : contours)
    for (const CubicBezier& curve : contour) box.extend(Bounds(curve));
  return box;
}

double LengthOf(const Contours& contours, double tolerance) {
  double length = 0;
  for (const auto& contour : contours) {
    for (const CubicBezier& curve : contour) {
      const auto samples = Flatten(curve, tolerance);
      for (std::size_t i = 1; i < samples.size(); ++i)
        length += (samples[i].point - samples[i - 1].point).norm();
    }
    if (!contour.empty()) length += (contour.back().p[3] - contour.front().p[0]).norm();
  }
  return length;
}

RasterFrame FrameFor(const Eigen::AlignedBox2d& box, double scale) {
  // The margin keeps the ink off the edge, and bounds the pixels of a shape of no height.
  const Vector2d pixels = box.sizes() / scale;
  return {box.min() - Vector2d::Constant(kMargin * scale), scale,
          static_cast<int>(std::ceil(pixels.x() + 2 * kMargin)),
          static_cast<int>(std::ceil(pixels.y() + 2 * kMargin))};
}

/// Pixels so large that the box has at most `most` of them.
double CoarsestFor(const Eigen::AlignedBox2d& box, double most) {
  const Vector2d size = box.sizes();
  return std::max(std::sqrt(size.prod() / most), size.maxCoeff() / most);
}

Stroke InShapesUnits(Stroke stroke, const RasterFrame& frame) {
  for (CubicBezier& piece : stroke.pieces)
    for (Vector2d& p : piece.p) p = frame.origin + frame.scale * p;
  stroke.width *= frame.scale;
  return stroke;
}

}  // namespace

double InkWidthOf(const Contours& contours, FillRule rule) {
  // The area as pixels have it, since contours may overlap; a thousandth of the size is enough.
  const Eigen::AlignedBox2d box = BoundsOf(contours);
  if (box.isEmpty() || !(box.sizes().maxCoeff() > 0)) return 0;
  constexpr double kSamples = 1e6;
  const RasterFrame frame = FrameFor(box, CoarsestFor(box, kSamples));
  double area = 0;
  for (const float v : Rasterised(contours, rule, frame).data) area += static_cast<double>(v);
  const double perimeter = LengthOf(contours, 0.1 * frame.scale);
  return perimeter > 0 ? 2 * area * frame.scale * frame.scale / perimeter : 0;
}

std::optional<CentreLines> CentreLinesOf(const Contours& contours, FillRule rule,
                                         const TracePictureOptions& options) {
  const double width = InkWidthOf(contours, rule);
  if (!(width > 0)) return std::nullopt;
  const Eigen::AlignedBox2d box = BoundsOf(contours);
  const RasterFrame frame =
      FrameFor(box, std::max(width / kPixelsToWidth, CoarsestFor(box, kMostPixels)));
  Tone coverage = Rasterised(contours, rule, frame);
  Mask mask(frame.width, frame.height);
  for (std::size_t i = 0; i < mask.data.size(); ++i)
    mask.data[i] = coverage.data[i] >= 0.5f ? 1 : 0;
  const Ink ink = InkOfMask(std::move(mask), std::move(coverage));
  if (!(ink.width > 0)) return std::nullopt;
  const std::vector<Stroke> strokes = TraceInk(ink, options);
  if (strokes.empty()) return std::nullopt;
  CentreLines lines;
  lines.gate = Compare(strokes, ink);
  for (const Stroke& stroke : strokes) lines.strokes.push_back(InShapesUnits(stroke, frame));
  return lines;
}

}  // namespace lascaux::trace
