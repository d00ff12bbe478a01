#include "lascaux/volume/fidelity.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "lascaux/base/arena.h"
#include "volume/measure/nearest_piece.h"
#include "volume/measure/outline.h"
#include "volume/measure/scan.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

constexpr double kLinesPerSide = 2000;  // error of the figures: well below 0.01 % of the diagonal
constexpr double kLeastHole = 1e-4;     // of a region's area: what remains between drawn strokes

/// A region cut in rows and in columns.
struct Cuts {
  SpanImage rows, columns;
};

Cuts Cut(const Outline& outline, const Eigen::AlignedBox2d& box, double step) {
  const auto cut = [&](int along) {
    return KeepLargestRegion(Scan(outline, LinesThrough(box, along, step)), kLeastHole);
  };
  Cuts cuts;
  tbb::parallel_invoke([&] { cuts.rows = cut(0); }, [&] { cuts.columns = cut(1); });
  return cuts;
}

/// Pieces of the outline where the lines cross edges that are rather across than along them.
void AddPieces(const Outline& outline, const SpanImage& image, std::vector<OutlinePiece>& pieces) {
  const int along = image.lines.along, across = image.lines.across();
  for (std::size_t i = 0; i < image.spans.size(); ++i) {
    const auto add = [&](double at, const OutlineEdge& edge) {
      const Vector2d tangent = (edge.b - edge.a).normalized();
      const double steep = std::abs(tangent[across]), flat = std::abs(tangent[along]);
      // At 45 degrees one of the two directions must take the edge, and only one.
      if (along == 0 ? steep < flat : steep <= flat) return;
      Vector2d middle;
      middle[along] = at;
      middle[across] = image.lines.At(i);
      pieces.push_back({middle, tangent, 0.5 * image.lines.step / steep, edge.group});
    };
    for (const Span& s : image.spans[i]) {
      add(s.low, outline.edges[s.low_edge]);
      add(s.high, outline.edges[s.high_edge]);
    }
  }
}

std::vector<OutlinePiece> PiecesOf(const Outline& outline, const Cuts& cuts) {
  std::vector<OutlinePiece> pieces;
  AddPieces(outline, cuts.rows, pieces);
  AddPieces(outline, cuts.columns, pieces);
  return pieces;
}

/// Distances from one outline to the other.
struct Deviation {
  double mean = 0, p95 = 0, worst = 0, length = 0;
  Vector2d worst_at = Vector2d::Zero();
};

std::vector<OutlinePiece> OfGroup(const std::vector<OutlinePiece>& pieces, std::size_t group) {
  std::vector<OutlinePiece> chosen;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(chosen),
               [group](const OutlinePiece& p) { return p.group == group; });
  return chosen;
}

/// `from` is not empty.
Deviation Measure(const std::vector<OutlinePiece>& from, const NearestPiece& nearest) {
  std::vector<std::pair<double, double>> found(from.size());  // distance, length
  tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t i) {
    found[i] = {nearest.Distance(from[i].middle), 2 * from[i].half_length};
  });
  Deviation deviation;
  double total = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [distance, length] = found[i];
    deviation.mean += distance * length;
    total += length;
    if (distance > deviation.worst) {
      deviation.worst = distance;
      deviation.worst_at = from[i].middle;
    }
  }
  deviation.mean /= total;
  deviation.length = total;
  std::sort(found.begin(), found.end());
  double below = 0;
  for (const auto& [distance, length] : found) {
    deviation.p95 = distance;
    below += length;
    if (below >= 0.95 * total) break;
  }
  return deviation;
}

bool IsFinite(const Outline& outline) {
  return std::all_of(outline.edges.begin(), outline.edges.end(),
                     [](const OutlineEdge& e) { return e.a.allFinite() && e.b.allFinite(); });
}

std::optional<Fidelity> Compare(const Outline& model, const Outline& drawn, std::size_t rings,
                                const Execution& execution) {
  if (!IsFinite(model) || !IsFinite(drawn)) return std::nullopt;
  const Eigen::AlignedBox2d box = model.Box().merged(drawn.Box());
  if (model.edges.empty() || drawn.edges.empty()) return std::nullopt;
  const double step = box.sizes().maxCoeff() / kLinesPerSide;
  if (!(step > 0)) return std::nullopt;
  const std::array<const Outline*, 2> outlines = {&model, &drawn};
  std::array<Cuts, 2> cuts;
  tbb::parallel_for(std::size_t{0}, std::size_t{2},
                    [&](std::size_t i) { cuts[i] = Cut(*outlines[i], box, step); });
  const std::array<std::vector<OutlinePiece>, 2> pieces = {PiecesOf(model, cuts[0]),
                                                           PiecesOf(drawn, cuts[1])};
  if (pieces[0].empty() || pieces[1].empty() || execution.IsCancelled()) return std::nullopt;

  const Overlap overlap = Compare(cuts[0].rows, cuts[1].rows);
  const double percent = 100 / drawn.Box().diagonal().norm();
  const std::array<NearestPiece, 2> nearest = {NearestPiece(pieces[0]), NearestPiece(pieces[1])};
  const std::array<Deviation, 2> both = {Measure(pieces[0], nearest[1]),
                                         Measure(pieces[1], nearest[0])};
  const Deviation& worst = both[0].worst >= both[1].worst ? both[0] : both[1];
  Fidelity fidelity;
  fidelity.iou = overlap.either > 0 ? overlap.both / overlap.either : 0;
  fidelity.contour_mean_percent = percent * std::max(both[0].mean, both[1].mean);
  fidelity.contour_p95_percent = percent * std::max(both[0].p95, both[1].p95);
  fidelity.worst_percent = percent * worst.worst;
  fidelity.worst_at = worst.worst_at;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const std::vector<OutlinePiece> shown = OfGroup(pieces[1], ring);
    fidelity.rings.emplace_back();
    if (shown.empty()) continue;
    const Deviation own = Measure(shown, nearest[0]);
    fidelity.rings.back() = {percent * own.mean, percent * own.p95, percent * own.worst,
                             own.length};
  }
  return fidelity;
}

}  // namespace

std::optional<Fidelity> MeasureFidelity(const Mesh& mesh,
                                        const std::vector<std::vector<Vector2d>>& rings,
                                        const Execution& execution) {
  for (const Eigen::Vector3f& v : mesh.vertices) {
    if (!v.allFinite()) return std::nullopt;
  }
  for (const auto& t : mesh.triangles) {
    if (*std::max_element(t.begin(), t.end()) >= mesh.vertices.size()) return std::nullopt;
  }
  std::optional<Fidelity> fidelity;
  RunInArena(execution, [&] {
    fidelity = Compare(OutlineOf(mesh), OutlineOf(rings), rings.size(), execution);
  });
  return fidelity;
}

}  // namespace lascaux
