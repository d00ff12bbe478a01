#include "sketch/svg/ink_outlines.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "sketch/trace/centre_lines.h"
#include "sketch/trace/find_ink.h"
#include "sketch/trace/regions.h"

namespace lascaux::svg {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using trace::Mask;
using trace::RasterFrame;
using trace::Tone;

/// Ink has no component above this; an area with all components above kWhite is as the page.
constexpr double kInkColor = 0.3, kWhite = 0.95;
/// A pen that is thinner than this share of the diagonal is not seen around a filled area.
constexpr double kHair = 3e-4;
/// Lines that reach over this share of everything are the drawing, not its dark areas.
constexpr double kLinesShare = 0.7;
/// The widest pen, as a share of the diagonal: an icon's, 2 of 24 units.
constexpr double kWidest = 0.06;
/// How much of the drawing's outer edge is ink at least.
constexpr double kInkedEdge = 0.8;
/// How much of the ink its middle lines must cover, drawn again.
constexpr double kLeastCoverage = 0.9;
/// The page is looked at in this many pixels, and traced in at most so many.
constexpr double kPixelsToLook = 5e5, kPixelsToTrace = 4e6;
/// Areas that together are this many times as large as the page are not looked at: no drawing of
/// one animal has them, and they would take seconds.
constexpr double kMostLayers = 40;
constexpr double kPixelsToWidth = 8;

struct Element {
  std::size_t begin = 0, end = 0;  ///< its subpaths
  bool is_ink = false, covers = false, is_white = false;
};

bool IsInk(const PaintedSubpath& p) {
  const auto& color = p.stroke.fill_color;
  return p.covers && color && *std::max_element(color->begin(), color->end()) <= kInkColor;
}

bool IsWhite(const PaintedSubpath& p) {
  const auto& color = p.stroke.fill_color;
  return color && *std::min_element(color->begin(), color->end()) >= kWhite;
}

AlignedBox2d BoxOf(const PaintedSubpath& p) {
  AlignedBox2d box;
  for (const CubicBezier& piece : p.stroke.pieces) box.extend(Bounds(piece));
  return box;
}

std::vector<Element> ElementsOf(const std::vector<PaintedSubpath>& painted) {
  std::vector<Element> elements;
  for (std::size_t i = 0; i < painted.size();) {
    Element element{i, i, IsInk(painted[i]), painted[i].covers, IsWhite(painted[i])};
    while (element.end < painted.size() && painted[element.end].order == painted[i].order)
      ++element.end;
    i = element.end;
    elements.push_back(element);
  }
  return elements;
}

/// How much of each pixel is ink, and how much is painted with a colour, as it is seen.
struct Seen {
  Tone ink, color;
};

/// A page in pixels: each area in its order over what was there.
class InkPage {
 public:
  explicit InkPage(const std::vector<PaintedSubpath>& painted)
      : painted_(painted), elements_(ElementsOf(painted)) {
    AlignedBox2d all, lines;
    for (const PaintedSubpath& p : painted) all.extend(BoxOf(p));
    hair_ = kHair * all.diagonal().norm();
    for (const PaintedSubpath& p : painted) {
      if (p.is_line && !IsTaken(p)) lines.extend(BoxOf(p));
      if (p.covers && !IsWhite(p)) areas_.extend(BoxOf(p));
    }
    lines_are_drawn_ =
        !lines.isEmpty() && lines.volume() >= kLinesShare * lines.merged(areas_).volume();
  }

  /// Whether its areas may be lines' ink: there is no other drawing, and not too much of it.
  bool MayBeInk() const {
    if (lines_are_drawn_ || !(areas_.sizes().minCoeff() > 0)) return false;
    double painted = 0;
    for (const Element& element : elements_) {
      if (element.covers) painted += BoundsOf(element).volume();
    }
    return painted <= kMostLayers * areas_.volume();
  }
  const AlignedBox2d& areas() const { return areas_; }

  /// Whether the line of a subpath is no line of its own: it is the edge of ink, or not seen.
  bool IsTaken(const PaintedSubpath& p) const {
    return IsInk(p) || (p.covers && p.stroke.width <= hair_);
  }

  Seen SeenAt(const RasterFrame& frame) const {
    Seen seen{Tone(frame.width, frame.height), Tone(frame.width, frame.height)};
    for (const Element& element : elements_) {
      if (element.covers) Paint(element, frame, seen);
    }
    return seen;
  }

 private:
  /// The box around what is on the page of an element's area; one of no size for none.
  AlignedBox2d BoundsOf(const Element& element) const {
    AlignedBox2d box;
    for (std::size_t i = element.begin; i < element.end; ++i) box.extend(BoxOf(painted_[i]));
    box = box.intersection(areas_);
    return box.isEmpty() ? AlignedBox2d(areas_.min(), areas_.min()) : box;
  }

  void Paint(const Element& element, const RasterFrame& frame, Seen& seen) const {
    trace::Contours contours;
    for (std::size_t i = element.begin; i < element.end; ++i)
      contours.push_back(painted_[i].stroke.pieces);
    // Its own pixels alone.
    const AlignedBox2d box = BoundsOf(element);
    const Vector2d low = (box.min() - frame.origin) / frame.scale;
    const Vector2d high = (box.max() - frame.origin) / frame.scale;
    const int x0 = static_cast<int>(low.x()), y0 = static_cast<int>(low.y());
    const RasterFrame own{frame.origin + frame.scale * Vector2d(x0, y0), frame.scale,
                          std::min(frame.width, static_cast<int>(high.x()) + 1) - x0,
                          std::min(frame.height, static_cast<int>(high.y()) + 1) - y0};
    const Tone area = trace::Rasterised(contours, painted_[element.begin].fill_rule, own);
    const float ink = element.is_ink ? 1 : 0, color = element.is_ink || element.is_white ? 0 : 1;
    for (int y = 0; y < own.height; ++y) {
      for (int x = 0; x < own.width; ++x) {
        const float share = area(x, y);
        const std::size_t i = seen.ink.Index(x0 + x, y0 + y);
        seen.ink.data[i] += share * (ink - seen.ink.data[i]);
        seen.color.data[i] += share * (color - seen.color.data[i]);
      }
    }
  }

  const std::vector<PaintedSubpath>& painted_;
  std::vector<Element> elements_;
  AlignedBox2d areas_;
  double hair_ = 0;
  bool lines_are_drawn_ = false;
};

/// The width of the ink in pixels if it is that of lines, else nothing.
std::optional<double> LineWidthOf(const Seen& seen) {
  const int w = seen.ink.width, h = seen.ink.height;
  Mask ink(w, h), drawn(w, h);
  for (std::size_t i = 0; i < ink.data.size(); ++i) {
    ink.data[i] = seen.ink.data[i] >= 0.5f ? 1 : 0;
    drawn.data[i] = seen.ink.data[i] + seen.color.data[i] >= 0.5f ? 1 : 0;
  }
  // The frame has a margin: the first region of the page is what is outside.
  const auto regions = trace::RegionsOf(drawn, 0, trace::Neighbours::kEdges);
  Mask outside(w, h);
  for (const std::int32_t i : regions.front()) outside.data[static_cast<std::size_t>(i)] = 1;
  std::size_t inked = 0, enclosed = 0, edge = 0, inked_edge = 0;
  for (int y = 1; y + 1 < h; ++y) {
    for (int x = 1; x + 1 < w; ++x) {
      if (outside(x, y)) continue;
      ++(ink(x, y) ? inked : enclosed);
      if (!outside(x - 1, y) && !outside(x + 1, y) && !outside(x, y - 1) && !outside(x, y + 1))
        continue;
      ++edge;
      inked_edge += ink(x, y);
    }
  }
  const bool is_thin_inside = inked > 0 && enclosed >= inked;
  if (!is_thin_inside || static_cast<double>(inked_edge) < kInkedEdge * static_cast<double>(edge))
    return std::nullopt;
  const double width = trace::InkOfMask(std::move(ink), {}).width;
  if (!(width > 0) || width > kWidest * std::hypot(w, h)) return std::nullopt;
  return width;
}

}  // namespace

void TakeInkOutlines(std::vector<PaintedSubpath>& painted, Reading& reading) {
  const auto first = std::find_if(painted.begin(), painted.end(), IsInk);
  if (first == painted.end()) return;
  const InkPage page(painted);
  if (!page.MayBeInk()) return;
  const RasterFrame look = trace::FrameAround(page.areas(), 0, kPixelsToLook);
  const std::optional<double> width = LineWidthOf(page.SeenAt(look));
  if (!width) return;
  const RasterFrame frame =
      trace::FrameAround(page.areas(), *width * look.scale / kPixelsToWidth, kPixelsToTrace);
  const auto lines = trace::CentreLinesOf(page.SeenAt(frame).ink, frame);
  if (!lines || lines->gate.coverage < kLeastCoverage) return;
  reading.findings().Add("ink-outlines", [&] {
    return Note("ink-outlines",
                fmt::format("dark areas are the ink of lines, whose middle was taken: {} lines, "
                            "{:.3g} wide, cover {:.1f} % of it (the first is {})",
                            lines->strokes.size(), lines->width, 100 * lines->gate.coverage,
                            reading.Name(first->element)));
  });
  PaintedSubpath line;
  line.element = first->element;
  line.is_line = true;
  line.order = painted.back().order + 1;
  for (PaintedSubpath& p : painted) {
    p.is_ink = IsInk(p);
    if (page.IsTaken(p)) p.is_line = false;
  }
  for (const Stroke& stroke : lines->strokes) {
    line.stroke = stroke;
    line.stroke.stroke_color = Color{0, 0, 0};
    line.start = stroke.pieces.front().p[0];
    painted.push_back(line);
  }
}

}  // namespace lascaux::svg
