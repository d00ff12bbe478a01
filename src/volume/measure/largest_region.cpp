#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/union_find.h"
#include "volume/measure/scan.h"

namespace lascaux {
namespace {

/// Intervals of the lines of an image: either its spans or the gaps between them.
struct Intervals {
  std::vector<std::size_t> first;  // of each line, one more than there are lines
  std::vector<std::pair<double, double>> ends;
};

/// Sets of intervals that overlap on neighbouring lines, with the length of each at its root.
struct Regions {
  UnionFind sets;
  std::vector<double> length;
};

Regions Connect(const Intervals& intervals) {
  const auto& [first, ends] = intervals;
  Regions regions{UnionFind(ends.size()), std::vector<double>(ends.size(), 0)};
  for (std::size_t i = 0; i + 2 < first.size(); ++i) {
    for (std::size_t m = first[i], n = first[i + 1]; m < first[i + 1] && n < first[i + 2];) {
      if (std::max(ends[m].first, ends[n].first) < std::min(ends[m].second, ends[n].second)) {
        regions.sets.Join(static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(n));
      }
      ends[m].second < ends[n].second ? ++m : ++n;
    }
  }
  for (std::uint32_t k = 0; k < ends.size(); ++k) {
    regions.length[regions.sets.Root(k)] += ends[k].second - ends[k].first;
  }
  return regions;
}

Intervals SpansOf(const SpanImage& image) {
  Intervals spans{{0}, {}};
  for (const auto& line : image.spans) {
    for (const Span& s : line) spans.ends.emplace_back(s.low, s.high);
    spans.first.push_back(spans.ends.size());
  }
  return spans;
}

/// All that is not in a span, what lies to both sides of the image included.
Intervals GapsOf(const SpanImage& image) {
  constexpr double kOutside = std::numeric_limits<double>::infinity();
  Intervals gaps{{0}, {}};
  for (const auto& line : image.spans) {
    double from = -kOutside;
    for (const Span& s : line) {
      gaps.ends.emplace_back(from, s.low);
      from = s.high;
    }
    gaps.ends.emplace_back(from, kOutside);
    gaps.first.push_back(gaps.ends.size());
  }
  return gaps;
}

SpanImage KeepLargest(const SpanImage& image) {
  Regions regions = Connect(SpansOf(image));
  const auto largest = static_cast<std::uint32_t>(
      std::max_element(regions.length.begin(), regions.length.end()) - regions.length.begin());
  SpanImage kept{image.lines, std::vector<std::vector<Span>>(image.spans.size())};
  std::uint32_t k = 0;
  for (std::size_t i = 0; i < image.spans.size(); ++i) {
    for (const Span& s : image.spans[i]) {
      if (regions.sets.Root(k++) == largest) kept.spans[i].push_back(s);
    }
  }
  return kept;
}

}  // namespace

SpanImage KeepLargestRegion(const SpanImage& image, double least_hole) {
  SpanImage kept = KeepLargest(image);
  // Gaps that reach the outside have no finite length: the first and the last line are empty.
  Regions regions = Connect(GapsOf(kept));
  const double least = least_hole * kept.Area() / kept.lines.step;
  const auto first = regions.length.begin();
  std::uint32_t k = 0;
  for (std::size_t i = 0; i < kept.spans.size(); ++i) {
    std::vector<Span> filled;
    for (const Span& s : kept.spans[i]) {
      const double length = first[regions.sets.Root(k++)];
      if (!filled.empty() && length < least) {
        filled.back().high = s.high;
        filled.back().high_edge = s.high_edge;
      } else {
        filled.push_back(s);
      }
    }
    ++k;  // the gap after the last span
    kept.spans[i] = std::move(filled);
  }
  return kept;
}

}  // namespace lascaux
