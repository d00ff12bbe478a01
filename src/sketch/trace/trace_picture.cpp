#include "lascaux/sketch/trace_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sketch/trace/filters.h"
#include "sketch/trace/find_ink.h"
#include "sketch/trace/gate.h"
#include "sketch/trace/lightness.h"
#include "sketch/trace/trace_ink.h"

namespace lascaux {
namespace {

using trace::FindInk;
using trace::Ink;
using trace::Tone;

constexpr double kFirstPixels = 1.5e6;  // at which the ink's width is first looked for
constexpr double kMostPixels = 12e6;    // that are worked on
constexpr double kWantedWidth = 6;      // pixels: wide enough for half a pixel not to matter
constexpr double kLeastWidth = 3.5;     // below it, holes between lines close
constexpr int kMostEnlargement = 3;
constexpr double kEnoughCoverage = 0.99;    // of the ink, for a trace that is right
constexpr double kHopeless = 0.8;           // coverage below which the ink is no lines
constexpr std::size_t kMostStrokes = 4000;  // a drawing of one animal has some hundred at most
constexpr double kEmpty = 0.15;             // contrast of paper and its shadows
constexpr int kLeastSide = 8;               // pixels

/// The size that a picture is worked on at: pixels of the picture to one along each side.
struct Scale {
  int reduction = 1, enlargement = 1;

  double Pixels() const { return static_cast<double>(reduction) / enlargement; }
};

Tone LightnessAt(const Bitmap& picture, const Scale& scale) {
  Tone tone = trace::Enlarged(trace::LightnessOf(picture, scale.reduction), scale.enlargement);
  if (trace::IsDarkPage(tone))
    for (float& v : tone.data) v = 1 - v;
  return tone;
}

/// The scale at which ink of this width (pixels of the picture) is as wide as is wanted.
Scale ScaleFor(double width, double pixels) {
  const int least = static_cast<int>(std::ceil(std::sqrt(pixels / kMostPixels)));
  const int wanted = static_cast<int>(std::floor(width / kWantedWidth));
  Scale scale{std::max({1, least, wanted}), 1};
  if (scale.reduction == 1 && width < kLeastWidth) {
    const int most = static_cast<int>(std::floor(std::sqrt(kMostPixels / pixels)));
    scale.enlargement = std::clamp(static_cast<int>(std::ceil(kLeastWidth / std::max(width, 1.0))),
                                   1, std::clamp(most, 1, kMostEnlargement));
  }
  return scale;
}

struct Found {
  Ink ink;
  Scale scale;
};

Diagnostic EmptyPage() {
  return Error(
      FailureKind::kInput, "empty-page",
      "there is no ink in the picture: nothing is darker than both of its sides; draw with a "
      "darker pen, or take the picture in better light");
}

Diagnostic NoDrawing(const std::string& why) {
  return Error(
      FailureKind::kInput, "no-drawing",
      fmt::format("the picture is no line drawing: {}; give a scan or photo of a drawing in "
                  "dark lines on a light page",
                  why));
}

/// Why there are no lines: nothing, or something else, is on the page.
Diagnostic NoInk(const Bitmap& picture) {
  const double pixels = static_cast<double>(picture.width) * picture.height;
  const int reduction = static_cast<int>(std::ceil(std::sqrt(pixels / kFirstPixels)));
  const double contrast = trace::ContrastOf(LightnessAt(picture, {std::max(1, reduction), 1}));
  return contrast < kEmpty ? EmptyPage() : NoDrawing("what is dark in it is no lines");
}

/// Looks for ink at a moderate size, then once more at the size that its width asks for.
std::optional<Found> FindInkAtItsScale(const Bitmap& picture) {
  const double pixels = static_cast<double>(picture.width) * picture.height;
  const Scale first{std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / kFirstPixels)))), 1};
  auto ink = FindInk(LightnessAt(picture, first), {});
  if (!ink) return std::nullopt;
  const Scale scale = ScaleFor(ink->width * first.reduction, pixels);
  const double width = ink->width * first.Pixels() / scale.Pixels();
  ink = FindInk(LightnessAt(picture, scale), {.width = width});
  if (!ink) return std::nullopt;
  return Found{std::move(*ink), scale};
}

double OnGrid(double value) {
  // Multiplied and divided by a whole number, so that the nearest double to the decimal comes out.
  constexpr double kPerPixel = 1 / kTraceGrid;
  return std::round(value * kPerPixel) / kPerPixel;
}

/// A stroke in the picture's pixels.
Stroke Scaled(Stroke stroke, double factor) {
  for (CubicBezier& piece : stroke.pieces)
    for (Eigen::Vector2d& p : piece.p) p = {OnGrid(p.x() * factor), OnGrid(p.y() * factor)};
  stroke.width = OnGrid(stroke.width * factor);
  stroke.stroke_color = Color{0, 0, 0};
  return stroke;
}

}  // namespace

Outcome<TracedPicture> TracePicture(const Bitmap& picture, const TracePictureOptions& options,
                                    const Execution& execution) {
  using Result = Outcome<TracedPicture>;
  assert(picture.rgba.size() == std::size_t{4} * static_cast<std::size_t>(picture.width) *
                                    static_cast<std::size_t>(picture.height));
  if (static_cast<std::int64_t>(picture.width) * picture.height > options.max_pixels)
    return Result::Failure(
        Error(FailureKind::kInput, "too-large",
              fmt::format("the picture has {} x {} pixels, more than {}; make it smaller",
                          picture.width, picture.height, options.max_pixels)));
  if (picture.width < kLeastSide || picture.height < kLeastSide)
    return Result::Failure(EmptyPage());
  execution.Report("tracing", 0);
  const std::optional<Found> found = FindInkAtItsScale(picture);
  if (!found) return Result::Failure(NoInk(picture));
  const std::vector<Stroke> strokes = trace::TraceInk(found->ink, options);
  if (strokes.empty()) return Result::Failure(NoInk(picture));
  if (strokes.size() > kMostStrokes)
    return Result::Failure(NoDrawing(fmt::format("it has {} lines", strokes.size())));
  const trace::GateFacts gate = trace::Compare(strokes, found->ink);
  if (gate.coverage < kHopeless)
    return Result::Failure(
        NoDrawing(fmt::format("lines cover {:.0f} % of what is dark", 100 * gate.coverage)));

  const double pixels = found->scale.Pixels();
  TracedPicture traced;
  for (const Stroke& stroke : strokes) traced.sketch.strokes.push_back(Scaled(stroke, pixels));
  traced.facts = {picture.width, picture.height,   found->ink.width * pixels, pixels,
                  gate.coverage, gate.ink_regions, gate.curve_regions};
  Diagnostics notes;
  if (gate.coverage < kEnoughCoverage || gate.ink_regions != gate.curve_regions) {
    Diagnostic warning = Warning(
        "trace-incomplete",
        fmt::format(
            "the curves cover {:.1f} % of the ink and cut the page into {} regions, the ink "
            "into {}; look at the curves (lascaux trace), and draw over lines that are missing",
            100 * gate.coverage, gate.curve_regions, gate.ink_regions));
    notes.push_back(gate.worst ? At(std::move(warning), *gate.worst * pixels) : warning);
  }
  return {std::move(traced), std::move(notes)};
}

}  // namespace lascaux
