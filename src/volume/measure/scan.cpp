#include "volume/measure/scan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

/// Where an edge crosses a line.
struct Crossing {
  double at;
  int winding;
  std::uint32_t group, edge;
};

/// Pieces of a line around which one group winds; `crossings` are that group's, ascending.
void AddSpans(std::span<const Crossing> crossings, std::vector<Span>& spans) {
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const int before = winding;
    winding += crossings[i].winding;
    if (winding == 0) continue;
    const Crossing& next = crossings[i + 1];
    if (before != 0) {
      spans.back().high = next.at;
      spans.back().high_edge = next.edge;
    } else {
      spans.push_back({crossings[i].at, next.at, crossings[i].edge, next.edge});
    }
  }
}

/// Spans in order, those joined that overlap or have less than `least_gap` between them.
std::vector<Span> Merge(std::vector<Span> spans, double least_gap) {
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
    return a.low != b.low ? a.low < b.low : a.low_edge < b.low_edge;
  });
  std::vector<Span> merged;
  for (const Span& s : spans) {
    if (!(s.low < s.high)) continue;
    if (merged.empty() || s.low > merged.back().high + least_gap) {
      merged.push_back(s);
    } else if (s.high > merged.back().high) {
      merged.back().high = s.high;
      merged.back().high_edge = s.high_edge;
    }
  }
  return merged;
}

std::vector<Span> SpansOf(std::vector<Crossing>& crossings, double least_gap) {
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    if (a.group != b.group) return a.group < b.group;
    return a.at != b.at ? a.at < b.at : a.edge < b.edge;
  });
  std::vector<Span> spans;
  for (std::size_t i = 0; i < crossings.size();) {
    std::size_t end = i;
    while (end < crossings.size() && crossings[end].group == crossings[i].group) ++end;
    AddSpans({crossings.data() + i, end - i}, spans);
    i = end;
  }
  return Merge(std::move(spans), least_gap);
}

}  // namespace

ScanLines LinesThrough(const Eigen::AlignedBox2d& box, int along, double step) {
  const int across = 1 - along;
  ScanLines lines;
  lines.along = along;
  lines.step = step;
  lines.first = box.min()[across] - 0.5 * step;
  lines.count = static_cast<std::size_t>(std::ceil(box.sizes()[across] / step)) + 2;
  return lines;
}

double SpanImage::Area() const {
  double length = 0;
  for (const auto& line : spans) {
    for (const Span& s : line) length += s.high - s.low;
  }
  return length * lines.step;
}

SpanImage Scan(const Outline& outline, const ScanLines& lines) {
  const int along = lines.along, across = lines.across();
  std::vector<std::vector<Crossing>> crossings(lines.count);
  const auto line_before = [&](double place) {  // one less than the first line beyond, for safety
    const double i = std::floor((place - lines.first) / lines.step);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(lines.count)));
  };
  for (std::uint32_t e = 0; e < outline.edges.size(); ++e) {
    const OutlineEdge& edge = outline.edges[e];
    const double a = edge.a[across], b = edge.b[across];
    const std::size_t end = std::min(line_before(std::max(a, b)) + 2, lines.count);
    for (std::size_t i = line_before(std::min(a, b)); i < end; ++i) {
      const double place = lines.At(i);
      if ((a <= place) == (b <= place)) continue;  // half open: a vertex on a line counts once
      const double t = (place - a) / (b - a);
      const double at = edge.a[along] + t * (edge.b[along] - edge.a[along]);
      crossings[i].push_back({at, a < b ? edge.winding : -edge.winding, edge.group, e});
    }
  }
  SpanImage image{lines, std::vector<std::vector<Span>>(lines.count)};
  tbb::parallel_for(std::size_t{0}, lines.count, [&](std::size_t i) {
    image.spans[i] = SpansOf(crossings[i], 0.5 * lines.step);
  });
  return image;
}

Overlap Compare(const SpanImage& a, const SpanImage& b) {
  double both = 0;
  for (std::size_t i = 0; i < a.spans.size(); ++i) {
    const auto &x = a.spans[i], &y = b.spans[i];
    for (std::size_t m = 0, n = 0; m < x.size() && n < y.size();) {
      both += std::max(0.0, std::min(x[m].high, y[n].high) - std::max(x[m].low, y[n].low));
      x[m].high < y[n].high ? ++m : ++n;
    }
  }
  both *= a.lines.step;
  return {both, a.Area() + b.Area() - both};
}

}  // namespace lascaux
