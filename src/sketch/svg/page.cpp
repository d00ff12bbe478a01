#include "sketch/svg/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "sketch/svg/cover.h"
#include "sketch/svg/duplicates.h"
#include "sketch/svg/ink_outlines.h"

namespace lascaux::svg {
namespace {

using Eigen::Vector2d;

constexpr const char* kZeroLength = "zero-length-piece";
constexpr const char* kDuplicate = "duplicate-stroke";
constexpr const char* kHidden = "hidden-line";

/// An area lighter than this in all its components looks like the page: it erases.
constexpr double kWhite = 0.95;
/// Lines that reach over less than this share of the drawing's width or height are details in a
/// drawing of areas.
constexpr double kLinesShare = 0.7;
/// A filled area is a blob of ink, an eye or a nostril, if it is darker than this and smaller than
/// this share of the diagonal, but no speck or hair.
constexpr double kDark = 0.5;
constexpr double kMostBlob = 0.08, kLeastBlob = 4e-3, kMostElongation = 3;
/// Covers are followed to this share of the diagonal, and hide nothing nearer to their outline.
constexpr double kTolerance = 1e-3;

/// An area's outline is closed, whether its path says so or not: that is how it is filled.
Stroke Closed(Stroke area) {
  const Vector2d begin = area.pieces.front().p[0], end = area.pieces.back().p[3];
  if (begin != end) area.pieces.push_back(Line(end, begin));
  area.closed = true;
  return area;
}

Diagnostic NoStrokes(const std::string& root) {
  return Error(FailureKind::kInput, "no-strokes",
               fmt::format("nothing in {} draws a line: each element is hidden, empty, or has "
                           "neither a stroke nor a fill; draw the outline with a stroke, and "
                           "convert text and pictures to paths",
                           root));
}

Diagnostic ZeroLength(const std::string& name, int pieces) {
  return Note(kZeroLength, fmt::format("{}: {} of no length left out; remove repeated points", name,
                                       pieces > 1 ? fmt::format("{} pieces", pieces) : "a piece"));
}

/// One note for all copies of a curve: the first of them, and how many there are.
Diagnostic Duplicate(const std::string& name, int copies, const std::string& first) {
  const std::string what = copies == 1 ? "runs along the same curve as {1} and was left out"
                                       : "and {2} more run along the same curve as {1} and were "
                                         "left out";
  return Note(kDuplicate, fmt::format(fmt::runtime("{0} " + what), name, first, copies - 1));
}

bool IsWhite(const PaintedSubpath& subpath) {
  const auto& color = subpath.stroke.fill_color;
  return color && *std::min_element(color->begin(), color->end()) >= kWhite;
}

bool IsSameColor(const PaintedSubpath& a, const PaintedSubpath& b) {
  return a.stroke.fill_color && a.stroke.fill_color == b.stroke.fill_color;
}

/// What hides what, on one page.
class Page {
 public:
  explicit Page(const std::vector<PaintedSubpath>& painted) {
    Eigen::AlignedBox2d lines, areas;
    for (const PaintedSubpath& p : painted) {
      for (const CubicBezier& piece : p.stroke.pieces) {
        const Eigen::AlignedBox2d box = Bounds(piece);
        bounds_.extend(box);
        if (p.is_line) lines.extend(box);
        if (p.covers && !IsWhite(p)) areas.extend(box);
        has_lines_ = has_lines_ || p.is_line;
      }
    }
    tolerance_ = kTolerance * bounds_.diagonal().norm();
    areas_are_drawn_ = !has_lines_ || (!areas.isEmpty() &&
                                       lines.volume() < kLinesShare * lines.merged(areas).volume());
    MakeCovers(painted);
  }

  bool has_lines() const { return has_lines_; }

  /// Whether a subpath's curve is a stroke, as far as it can be seen.
  bool IsDrawn(const PaintedSubpath& subpath) const {
    if (subpath.is_line) return true;
    if (subpath.is_ink) return false;
    if (IsBlob(subpath)) return true;
    return areas_are_drawn_ && (!IsWhite(subpath) || !any_color_ || LiesOnColor(subpath));
  }

  std::vector<Stroke> Visible(const PaintedSubpath& subpath, Stroke stroke) const {
    if (covers_.empty() || (subpath.is_line && covers_.back().order() <= subpath.order))
      return {std::move(stroke)};
    std::vector<Stroke> visible = VisibleStretches(stroke, subpath.order, covers_, tolerance_);
    if (subpath.is_line || IsWhite(subpath)) return visible;
    // Inside of an area of its own color an area has no edge.
    std::vector<Cover> alike;
    for (std::size_t i = 0; i < covers_.size(); ++i) {
      if (covers_[i].order() < subpath.order && IsSameColor(*first_of_[i], subpath))
        alike.push_back(covers_[i]);
    }
    if (alike.empty()) return visible;
    std::vector<Stroke> edges;
    for (const Stroke& part : visible) {
      for (Stroke& edge : VisibleStretches(part, -1, alike, tolerance_))
        edges.push_back(std::move(edge));
    }
    return edges;
  }

 private:
  void MakeCovers(const std::vector<PaintedSubpath>& painted) {
    for (std::size_t i = 0; i < painted.size();) {
      std::vector<const std::vector<CubicBezier>*> outlines;
      std::size_t end = i;
      for (; end < painted.size() && painted[end].order == painted[i].order; ++end)
        outlines.push_back(&painted[end].stroke.pieces);
      if (painted[i].covers && tolerance_ > 0) {
        covers_.emplace_back(outlines, painted[i].fill_rule, painted[i].order, tolerance_);
        first_of_.push_back(&painted[i]);
        any_color_ = any_color_ || !IsWhite(painted[i]);
      }
      i = end;
    }
  }

  bool IsBlob(const PaintedSubpath& subpath) const {
    const auto& color = subpath.stroke.fill_color;
    if (!color || !subpath.covers || *std::max_element(color->begin(), color->end()) > kDark)
      return false;
    Eigen::AlignedBox2d box;
    for (const CubicBezier& piece : subpath.stroke.pieces) box.extend(Bounds(piece));
    const double diagonal = bounds_.diagonal().norm();
    const double small = box.sizes().minCoeff(), large = box.sizes().maxCoeff();
    return large <= kMostBlob * diagonal && small >= kLeastBlob * diagonal &&
           large <= kMostElongation * small;
  }

  /// True when an area was drawn onto a colored one: a white eye in a black head.
  bool LiesOnColor(const PaintedSubpath& subpath) const {
    for (std::size_t i = 0; i < covers_.size(); ++i) {
      if (covers_[i].order() < subpath.order && !IsWhite(*first_of_[i]) &&
          covers_[i].Hides(subpath.start, 0))
        return true;
    }
    return false;
  }

  Eigen::AlignedBox2d bounds_;
  double tolerance_ = 0;
  bool has_lines_ = false, areas_are_drawn_ = false, any_color_ = false;
  std::vector<Cover> covers_;  ///< in the order of drawing
  std::vector<const PaintedSubpath*> first_of_;
};

/// The areas that are painted with a colour, in their order.
std::vector<FilledArea> AreasOf(const std::vector<PaintedSubpath>& painted) {
  std::vector<FilledArea> areas;
  int last = -1;  // element
  for (const PaintedSubpath& p : painted) {
    if (!p.covers || p.is_ink || !p.stroke.fill_color || p.stroke.pieces.empty()) continue;
    if (p.order != last) areas.push_back({{}, p.fill_rule, *p.stroke.fill_color});
    areas.back().outlines.push_back(p.stroke.pieces);
    last = p.order;
  }
  return areas;
}

/// What is put into the sketch, piece by piece.
class SketchBuilder {
 public:
  SketchBuilder(const Page& page, Reading& reading) : page_(page), reading_(reading) {}

  /// Adds what is seen of a subpath; the index of its first stroke, -1 if there is none.
  int Add(const PaintedSubpath& subpath) {
    const int index = static_cast<int>(sketch_.strokes.size());
    Stroke stroke = subpath.is_line ? subpath.stroke : Closed(subpath.stroke);
    const std::size_t pieces = stroke.pieces.size();
    std::vector<Stroke> visible = page_.Visible(subpath, std::move(stroke));
    const bool is_whole = visible.size() == 1 && visible.front().pieces.size() == pieces &&
                          visible.front().closed == (!subpath.is_line || subpath.stroke.closed);
    if (!is_whole && ++hidden_ == 1) first_hidden_ = subpath.element;
    for (Stroke& part : visible) sketch_.strokes.push_back(std::move(part));
    return visible.empty() ? -1 : index;
  }

  Sketch Finish() && {
    if (hidden_ > 0) {
      reading_.findings().Add(kHidden, [&] {
        return Note(kHidden,
                    fmt::format("of {} line{} only what later areas leave to be seen was taken "
                                "(the first is {})",
                                hidden_, hidden_ == 1 ? "" : "s", reading_.Name(first_hidden_)));
      });
    }
    return std::move(sketch_);
  }

 private:
  const Page& page_;
  Reading& reading_;
  Sketch sketch_;
  int hidden_ = 0;
  pugi::xml_node first_hidden_;
};

}  // namespace

Diagnostic OutOfRange(const std::string& name) {
  return Error(FailureKind::kInput, "not-finite",
               fmt::format("{}: coordinates, matrices and pen widths must be numbers of at most "
                           "{:g}, and the whole drawing not smaller than {:g}; correct the number "
                           "or scale the drawing",
                           name, kMaxCoordinate, 1 / kMaxCoordinate));
}

Outcome<Sketch> DrawPage(std::vector<PaintedSubpath> painted, Reading& reading) {
  Findings& findings = reading.findings();
  TakeInkOutlines(painted, reading);
  const Page page(painted);
  // Lines first: an area that is the same curve as a line is that line's filling, whichever is
  // drawn first.
  std::vector<PaintedSubpath*> order;
  for (PaintedSubpath& p : painted) order.push_back(&p);
  std::stable_partition(order.begin(), order.end(),
                        [](const PaintedSubpath* p) { return p->is_line; });
  std::vector<PaintedSubpath*> drawn;
  std::vector<const Stroke*> curves;
  for (PaintedSubpath* p : order) {
    if (!p->stroke.pieces.empty()) {
      drawn.push_back(p);
      curves.push_back(&p->stroke);
    } else if (p->is_line || !page.has_lines()) {
      findings.Add(kZeroLength,
                   [&] { return ZeroLength(reading.Name(p->element), p->dropped_pieces); });
    }
  }
  if (drawn.empty()) return reading.Failed(NoStrokes(reading.RootName()));
  std::vector<FilledArea> areas = AreasOf(painted);

  const std::vector<std::size_t> first = FirstOfEach(curves);
  std::vector<int> copies(drawn.size(), 0);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (first[i] != i) ++copies[first[i]];
    auto& color = drawn[first[i]]->stroke.fill_color;
    if (!color) color = drawn[i]->stroke.fill_color;
  }
  SketchBuilder builder(page, reading);
  std::vector<int> index(drawn.size(), -1);  // in the sketch
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    PaintedSubpath& p = *drawn[i];
    const int kept = index[first[i]];
    if (first[i] != i) {
      const int count = std::exchange(copies[first[i]], 0);
      if (kept < 0 || count == 0) continue;
      findings.Add(kDuplicate, [&] {
        const std::string name = reading.Name(p.element);
        const std::string before = reading.Name(drawn[first[i]]->element);
        return At(OnStroke(Duplicate(name, count, before), kept), p.start);
      });
    } else if (page.IsDrawn(p)) {
      index[i] = builder.Add(p);
      if (p.dropped_pieces > 0 && index[i] >= 0) {
        findings.Add(kZeroLength, [&] {
          const Diagnostic note = ZeroLength(reading.Name(p.element), p.dropped_pieces);
          return At(OnStroke(note, index[i]), p.start);
        });
      }
    }
  }
  Sketch sketch = std::move(builder).Finish();
  sketch.areas = std::move(areas);
  if (sketch.strokes.empty()) return reading.Failed(NoStrokes(reading.RootName()));
  const double diagonal = Bounds(sketch).diagonal().norm();
  if (diagonal > 0 && diagonal < 1 / kMaxCoordinate) {
    return reading.Failed(OutOfRange(reading.Name(drawn.front()->element)));
  }
  return {std::move(sketch), std::move(findings).Take()};
}

}  // namespace lascaux::svg
