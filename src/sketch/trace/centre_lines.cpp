#include "sketch/trace/centre_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sketch/trace/fills.h"
#include "sketch/trace/find_ink.h"
#include "sketch/trace/trace_ink.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 2;  // pixels around the box

Mask MaskOf(const Tone& coverage) {
  Mask mask(coverage.width, coverage.height);
  for (std::size_t i = 0; i < mask.data.size(); ++i)
    mask.data[i] = coverage.data[i] >= 0.5f ? 1 : 0;
  return mask;
}

/// Lines only: of areas filled with ink what a pen would have drawn around them.
Ink WithoutFills(Ink ink) {
  const Fills fills = FillsOf(ink.mask, ink.width);
  if (!(fills.share > 0)) return ink;
  for (std::size_t i = 0; i < ink.mask.data.size(); ++i) {
    if (fills.interior.data[i]) ink.mask.data[i] = 0, ink.coverage.data[i] = 0;
  }
  return InkOfMask(std::move(ink.mask), std::move(ink.coverage));
}

Stroke InUnitsOf(const RasterFrame& frame, Stroke stroke) {
  for (CubicBezier& piece : stroke.pieces)
    for (Vector2d& p : piece.p) p = frame.origin + frame.scale * p;
  stroke.width *= frame.scale;
  return stroke;
}

}  // namespace

RasterFrame FrameAround(const Eigen::AlignedBox2d& box, double scale, double most_pixels) {
  const Vector2d size = box.sizes();
  // The second bound is for boxes of no height.
  scale =
      std::max({scale, std::sqrt(size.prod() / most_pixels), 4 * size.maxCoeff() / most_pixels});
  const Vector2d pixels = size / scale;
  return {box.min() - Vector2d::Constant(kMargin * scale), scale,
          static_cast<int>(std::ceil(pixels.x() + 2 * kMargin)),
          static_cast<int>(std::ceil(pixels.y() + 2 * kMargin))};
}

std::optional<CentreLines> CentreLinesOf(Tone ink, const RasterFrame& frame,
                                         const TracePictureOptions& options) {
  Mask mask = MaskOf(ink);
  const Ink lines_only = WithoutFills(InkOfMask(std::move(mask), std::move(ink)));
  if (!(lines_only.width > 0)) return std::nullopt;
  const std::vector<Stroke> strokes = TraceInk(lines_only, options);
  if (strokes.empty()) return std::nullopt;
  CentreLines lines;
  lines.gate = Compare(strokes, lines_only);
  lines.width = lines_only.width * frame.scale;
  for (const Stroke& stroke : strokes) lines.strokes.push_back(InUnitsOf(frame, stroke));
  return lines;
}

}  // namespace lascaux::trace
