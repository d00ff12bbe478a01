#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sketch/parts/completion.h"
#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Suggestive curves shorter than this share of the diagonal are hooks of the pen.
constexpr double kShortest = 0.008;
/// A curve that neither side runs on into within this angle stands on the outline: it is a detail
/// if the outline passes it straight.
constexpr double kDetailTurn = std::numbers::pi / 4;
/// Cost of a turn between a limb's contour and its suggestive curve, per radian squared.
constexpr double kTurnCost = 2;
/// The closed ends of a limb are at most this share of the diagonal apart ...
constexpr double kWidest = 0.4;
/// ... and it sticks out: its own contour is at least so many times as long as the chord between
/// them.
constexpr double kLeastProtrusion = 1.25;
/// Or contour and curves close by themselves, being so many times as long as the way between the
/// open ends. That is so where a limb behind meets it near its tip, and then the closed ends, which
/// lie on two limbs, say nothing of the parent's line.
constexpr double kLeastEnclosure = 10;
/// The larger half of a face is no limb of it, however well two curves meet there.
constexpr double kMostShare = 0.5;
/// Least value of the paper's p: even the best angles leave some of the completions' energy.
constexpr double kLeastP = 0.05;
/// Share of the chord between closed ends that has to run through the face.
constexpr double kChordInside = 0.85;

/// How a limb between curve i and curve j would be connected; the limb owns the walk from i to j.
struct Candidate {
  int i = 0, j = 0;
  double energy = std::numeric_limits<double>::infinity();
};

/// A mouth, a gill, a wrinkle: the outline passes its end more smoothly than it would turn into it.
bool IsDetail(const SuggestiveCurve& curve) {
  const double turn = std::min(curve.turn_before, curve.turn_after);
  return turn > kDetailTurn && curve.turn_through < 0.5 * turn;
}

double PValue(const Vector2d& arrival, const Vector2d& chord, const Vector2d& curve) {
  const double alpha = AngleBetween(arrival, chord), beta = AngleBetween(arrival, curve);
  return std::clamp(beta > 0 ? alpha / beta : 1.0, kLeastP, 1.0);
}

bool ChordIsInside(const Polyline& ring, const Vector2d& a, const Vector2d& b) {
  constexpr int kSamples = 20;
  int inside = 0;
  for (int i = 1; i <= kSamples; ++i) {
    inside += Contains(ring, a + (i / (kSamples + 1.0)) * (b - a)) ? 1 : 0;
  }
  return inside >= kChordInside * kSamples;
}

/// Energy of the limb that owns the walk from curve i to curve j; infinite for one that does not
/// stick out.
///
/// To the paper's energy comes what it costs when the limb's own contour does not run on into its
/// suggestive curves: the square of both turns.
double PairEnergy(const FaceView& face, int i, int j, double limit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const SuggestiveCurve& a = face.curves[static_cast<std::size_t>(i)];
  const SuggestiveCurve& b = face.curves[static_cast<std::size_t>(j)];
  const double turns = kTurnCost * (a.turn_after * a.turn_after + b.turn_before * b.turn_before);
  const Vector2d chord = b.points.front() - a.points.front();
  const double walk = face.line.Ahead(a.arc, b.arc);
  const double opening = (b.points.back() - a.points.back()).norm();
  const bool encloses = walk + a.length + b.length >= kLeastEnclosure * opening;
  if (turns >= limit || (walk < kLeastProtrusion * chord.norm() && !encloses)) return kNever;
  const double reach = TangentReach(face.map);
  const Vector2d arrival_a = face.line.DirectionBefore(a.arc, reach);
  const Vector2d arrival_b = -face.line.DirectionAfter(b.arc, reach);
  const double p = PValue(arrival_a, chord, a.departure) * PValue(arrival_b, -chord, b.departure);
  const double closed =
      Complete({a.points.front(), arrival_a}, {b.points.front(), arrival_b}).energy;
  const double open = Complete({a.points.back(), a.tip}, {b.points.back(), b.tip}).energy;
  return p * (encloses ? open : open + closed) + turns;
}

/// True when the limb that owns the walk from curve i to curve j would be most of its face.
bool IsMostOf(const FaceView& face, int i, int j) {
  const Polyline own = Stretch(face.line, face.curves[static_cast<std::size_t>(i)].arc,
                               face.curves[static_cast<std::size_t>(j)].arc)
                           .points;
  return std::abs(SignedArea(own)) > kMostShare * std::abs(SignedArea(face.line.points));
}

/// Interval dynamic programme over the curves in walk order: the non-crossing assignment of least
/// total cost.
class Assignment {
 public:
  Assignment(std::vector<double> single, std::vector<std::vector<Candidate>> pairs)
      : n_(single.size()), single_(std::move(single)), pairs_(std::move(pairs)) {
    cost_.assign(n_ + 1, std::vector<double>(n_ + 1, 0));
    choice_.assign(n_ + 1, std::vector<int>(n_ + 1, -1));
    for (std::size_t length = 1; length <= n_; ++length) {
      for (std::size_t i = 0; i + length <= n_; ++i) Solve(i, i + length);
    }
  }

  std::vector<Candidate> Chosen() const {
    std::vector<Candidate> chosen;
    Collect(0, n_, chosen);
    return chosen;
  }

 private:
  void Solve(std::size_t i, std::size_t end) {
    double best = single_[i] + cost_[i + 1][end];
    int choice = -1;
    for (std::size_t k = i + 1; k < end; ++k) {
      const double cost = pairs_[i][k].energy + cost_[i + 1][k] + cost_[k + 1][end];
      if (cost < best) {
        best = cost;
        choice = static_cast<int>(k);
      }
    }
    cost_[i][end] = best;
    choice_[i][end] = choice;
  }

  void Collect(std::size_t i, std::size_t end, std::vector<Candidate>& chosen) const {
    while (i < end) {
      const int k = choice_[i][end];
      if (k < 0) {
        ++i;
        continue;
      }
      chosen.push_back(pairs_[i][static_cast<std::size_t>(k)]);
      Collect(i + 1, static_cast<std::size_t>(k), chosen);
      i = static_cast<std::size_t>(k) + 1;
    }
  }

  std::size_t n_;
  std::vector<double> single_;
  std::vector<std::vector<Candidate>> pairs_;
  std::vector<std::vector<double>> cost_;
  std::vector<std::vector<int>> choice_;
};

/// The better of both ways to connect two curves, if it costs less than `limit` and the chord runs
/// through the face.
Candidate BestWay(const FaceView& face, int i, int j, double limit) {
  const Vector2d& a = face.curves[static_cast<std::size_t>(i)].points.front();
  const Vector2d& b = face.curves[static_cast<std::size_t>(j)].points.front();
  const double chord = (a - b).norm() / face.map.diagonal;
  if (chord < kShortest || chord > kWidest) return {};
  Candidate ways[] = {{i, j, PairEnergy(face, i, j, limit)}, {j, i, PairEnergy(face, j, i, limit)}};
  for (Candidate& way : ways) {
    if (way.energy < limit && IsMostOf(face, way.i, way.j)) way = {};
  }
  const Candidate& best = ways[0].energy <= ways[1].energy ? ways[0] : ways[1];
  return best.energy < limit && ChordIsInside(face.line.points, a, b) ? best : Candidate{};
}

}  // namespace

Pairing PairCurves(const FaceView& face, const FindPartsOptions& options) {
  std::vector<int> usable;
  for (std::size_t i = 0; i < face.curves.size(); ++i) {
    const SuggestiveCurve& curve = face.curves[i];
    if (curve.length >= kShortest * face.map.diagonal && !IsDetail(curve))
      usable.push_back(static_cast<int>(i));
  }
  const std::size_t n = usable.size();
  const std::vector<double> single(n, options.single_cost);
  std::vector<std::vector<Candidate>> pairs(n, std::vector<Candidate>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      pairs[i][j] = BestWay(face, usable[i], usable[j], 2 * options.single_cost);
    }
  }
  Pairing pairing;
  std::vector<bool> taken(face.curves.size(), false);
  for (const Candidate& c : Assignment(single, pairs).Chosen()) {
    const SuggestiveCurve& a = face.curves[static_cast<std::size_t>(c.i)];
    const SuggestiveCurve& b = face.curves[static_cast<std::size_t>(c.j)];
    taken[static_cast<std::size_t>(c.i)] = taken[static_cast<std::size_t>(c.j)] = true;
    pairing.limbs.push_back({a.arc, b.arc, a.points, b.points, OutlineKind::kDrawn,
                             OutlineKind::kDrawn, LimbEvidence::kTwoCurves, c.energy,
                             std::max(0.0, 1 - c.energy / (2 * options.single_cost))});
  }
  for (const int i : usable) {
    if (!taken[static_cast<std::size_t>(i)]) pairing.single.push_back(i);
  }
  return pairing;
}

}  // namespace lascaux
