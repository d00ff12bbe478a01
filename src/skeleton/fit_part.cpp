#include "skeleton/fit_part.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lascaux/field/field.h"
#include "skeleton/index.h"
#include "skeleton/normal_equations.h"
#include "skeleton/planar_field.h"
#include "skeleton/ring.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// Levenberg's damping and how it follows success and failure.
constexpr double kFirstDamping = 1e-3, kLessDamping = 0.3, kMoreDamping = 6, kMostDamping = 1e6;
/// No unknown moves by more in a step: 30 % of a radius.
constexpr double kLongestStep = 0.3;
/// Discs are held to where they were firmly at first, when distances are large and their estimates
/// poor, then less with each step that succeeds: a hold kept to the end would leave a bias of 0.1 %
/// of the diagonal.
constexpr double kLoosen = 0.3, kLeastHold = 4e-4;
/// Distances are trusted up to this share of the radius nearby: beyond it the field saturates or
/// vanishes.
constexpr double kTrusted = 0.5;
/// Small and round outlines are sampled by their length.
constexpr double kLeastSamples = 128;
/// The result is checked at so many times as many samples as were fitted.
constexpr int kCheck = 2;
/// A step that lowers the cost by less than this share is the last one.
constexpr double kStalled = 1e-4;

struct Target {
  Vector2d point;
  double weight;
  double limit;  ///< largest distance that counts
};

double WeightOf(OutlineKind kind, double completion_weight) {
  if (kind == OutlineKind::kDrawn) return 1;
  return kind == OutlineKind::kCompletion ? completion_weight : 0;
}

/// Radius of the disc whose circle is nearest.
double RadiusNear(const std::vector<Chain>& chains, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity(), radius = 0;
  for (const Chain& chain : chains) {
    for (const SkeletonVertex& v : chain.vertices) {
      const double distance = std::abs((point - v.position).norm() - v.radius);
      if (distance < least) least = distance, radius = v.radius;
    }
  }
  return radius;
}

std::vector<Target> TargetsOn(const Outline& outline, const std::vector<Chain>& chains,
                              double spacing, double completion_weight) {
  std::vector<Target> targets;
  for (const OutlineSample& sample : SampleOutline(outline, spacing)) {
    const double weight = WeightOf(sample.kind, completion_weight);
    if (weight <= 0) continue;
    targets.push_back({sample.point, weight, kTrusted * RadiusNear(chains, sample.point)});
  }
  return targets;
}

/// Signed distance of a target from the silhouette, within its limit.
double Residual(const PlanarSample& sample, const Target& target) {
  const FieldSample field{sample.value, {sample.gradient.x(), sample.gradient.y(), 0}};
  return std::clamp(SignedDistance(field), -target.limit, target.limit);
}

/// Unknowns: for each vertex the change of its log radius and, in its first radii, of its position.
class Model {
 public:
  explicit Model(const std::vector<Chain>& start) : start_(start) {
    for (const Chain& chain : start) {
      for (const SkeletonVertex& v : chain.vertices) radii_.push_back(v.radius);
    }
  }
  int unknowns() const { return 3 * static_cast<int>(radii_.size()); }
  /// What an unknown is multiplied by to be the field's.
  double Scale(int index) const { return index % 3 == 0 ? 1.0 : radii_[Index(index / 3)]; }

  std::vector<Chain> At(const VectorXd& x) const {
    std::vector<Chain> chains = start_;
    Eigen::Index i = 0;
    for (Chain& chain : chains) {
      for (SkeletonVertex& v : chain.vertices) {
        v.position += v.radius * Vector2d(x[i + 1], x[i + 2]);
        v.radius *= std::exp(x[i]);
        i += 3;
      }
    }
    return chains;
  }

  double MedianRadius() const {
    std::vector<double> radii = radii_;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
  }

 private:
  const std::vector<Chain>& start_;
  std::vector<double> radii_;
};

/// The linearised problem at a point: cost, largest drawn distance, and the normal equations.
struct Linearised {
  double cost = 0, worst = 0;
  NormalEquations sums;
};

/// Matrices that were used before: their pages are there already.
class Spares {
 public:
  explicit Spares(int unknowns) : unknowns_(unknowns) {}

  NormalEquations Take() {
    if (spares_.empty()) return NormalEquations(unknowns_);
    NormalEquations taken = std::move(spares_.back());
    spares_.pop_back();
    return taken;
  }
  void GiveBack(NormalEquations used) {
    used.Clear();
    spares_.push_back(std::move(used));
  }

 private:
  int unknowns_;
  std::vector<NormalEquations> spares_;
};

/// Where the problem is linearised, and the cost beyond which nobody wants to know more.
struct Trial {
  std::vector<Chain> chains;
  double most_cost;
};

void LineariseSome(const Model& model, std::span<const Target> targets, const Trial& trial,
                   Linearised& at) {
  PlanarField field(trial.chains);
  PlanarSample sample;
  for (const Target& target : targets) {
    field.Evaluate(target.point, sample);
    const double d = Residual(sample, target);
    at.cost += target.weight * d * d;
    if (at.cost > trial.most_cost) break;
    if (target.weight == 1) at.worst = std::max(at.worst, std::abs(d));
    const double steepness = sample.gradient.norm();
    if (!(steepness > 0)) continue;
    // d = (psi - 1) / |grad psi|, and near the surface its change is that of psi alone.
    auto derivative = sample.derivatives.begin();
    for (const PlanarSample::Run& run : sample.runs) {
      for (int i = 0; i < run.count; ++i) *derivative++ *= -model.Scale(run.first + i) / steepness;
      derivative += run.FilledUp() - run.count;
    }
    AddRow({sample.runs, sample.derivatives, target.weight, d}, at.sums);
  }
}

/// In halves, side by side, for the torso's fit is longer than those of all other parts together;
/// unless there are more unknowns than targets, and a second matrix costs more than it saves. What
/// costs more than `most_cost` is left unfinished.
Linearised Linearise(const Model& model, std::span<const Target> targets, const Trial& trial,
                     Spares& spares) {
  Linearised at{0, 0, spares.Take()};
  if (targets.size() < Index(model.unknowns())) {
    LineariseSome(model, targets, trial, at);
    return at;
  }
  Linearised rest{0, 0, spares.Take()};
  const std::size_t half = targets.size() / 2;
  tbb::parallel_invoke([&] { LineariseSome(model, targets.first(half), trial, at); },
                       [&] { LineariseSome(model, targets.subspan(half), trial, rest); });
  at.cost += rest.cost;
  at.worst = std::max(at.worst, rest.worst);
  at.sums.Add(rest.sums);
  spares.GiveBack(std::move(rest.sums));
  return at;
}

/// The damped Gauss-Newton step. Discs far from each other share no sample, so the matrix is nearly
/// banded.
VectorXd Solve(const Linearised& at, double damping, double hold, const VectorXd& x) {
  const Eigen::Index n = x.size();
  Eigen::SparseMatrix<double> matrix(n, n);
  // In order: whatever is put between what is there moves all that follows.
  for (Eigen::Index j = 0; j < n; ++j) {
    matrix.startVec(j);
    const int column = static_cast<int>(j);
    matrix.insertBack(j, j) = at.sums.Diagonal(column) * (1 + damping) + hold;
    at.sums.ForBelow(column, [&](int i, double value) { matrix.insertBack(i, j) = value; });
  }
  matrix.finalize();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(matrix);
  return factors.solve(-(at.sums.slope + hold * x));
}

/// Largest distance of a target from the chains' silhouette.
double WorstOf(const std::vector<Chain>& chains, const std::vector<Target>& targets) {
  double worst = 0;
  PlanarField field(chains);
  PlanarSample sample;
  for (const Target& target : targets) {
    field.Evaluate(target.point, sample);
    worst = std::max(worst, std::abs(Residual(sample, target)));
  }
  return worst;
}

}  // namespace

std::vector<Chain> FitChains(const std::vector<Chain>& chains, const Outline& outline,
                             const FitOptions& options) {
  const double diagonal = Diagonal(outline.points);
  if (!(diagonal > 0)) return chains;  // nothing is drawn
  const double spacing =
      std::min(options.sample_spacing * diagonal, Perimeter(outline.points) / kLeastSamples);
  const std::vector<Target> targets =
      TargetsOn(outline, chains, spacing, options.completion_weight);
  const Model model(chains);
  const int n = model.unknowns();
  double weights = 0;
  for (const Target& t : targets) weights += t.weight;
  double hold = std::pow(options.regularization * model.MedianRadius(), 2) * weights / n;

  const double least_hold = kLeastHold * hold;
  VectorXd x = VectorXd::Zero(n), best = x;
  Spares spares(n);
  const auto linearise = [&](const VectorXd& place, double most_cost) {
    return Linearise(model, targets, {model.At(place), most_cost}, spares);
  };
  Linearised at = linearise(x, std::numeric_limits<double>::infinity());
  const double first_worst = at.worst;
  double best_worst = at.worst, damping = kFirstDamping;
  for (int step = 0; step < options.max_steps && best_worst > options.target * diagonal; ++step) {
    const VectorXd move = Solve(at, damping, hold, x);
    if (!move.allFinite()) break;
    const VectorXd next = x + move.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    const double before = at.cost + hold * x.squaredNorm(), held = hold * next.squaredNorm();
    Linearised there = linearise(next, before - held);
    const double after = there.cost + held;
    if (!(after < before)) {
      spares.GiveBack(std::move(there.sums));
      damping *= kMoreDamping;
      if (damping > kMostDamping) break;
      continue;
    }
    damping *= kLessDamping;
    hold = std::max(kLoosen * hold, least_hold);
    x = next;
    spares.GiveBack(std::exchange(at, std::move(there)).sums);
    if (at.worst < best_worst) best_worst = at.worst, best = x;
    if (before - after < kStalled * before) break;
  }
  std::vector<Chain> fitted = model.At(best);
  const std::vector<Target> check = TargetsOn(outline, chains, spacing / kCheck, 0);
  const double worst = WorstOf(fitted, check);
  // Among the samples that are checked are those that were fitted.
  const bool no_worse = worst <= first_worst || worst <= WorstOf(chains, check);
  return no_worse ? fitted : chains;
}

FitError MeasureChains(const std::vector<Chain>& chains, const Outline& outline, double spacing) {
  const double diagonal = Diagonal(outline.points);
  FitError error;
  if (!(diagonal > 0)) return error;
  double count = 0;
  PlanarField field(chains);
  PlanarSample sample;
  for (const Target& target : TargetsOn(outline, chains, spacing * diagonal, 0)) {
    field.Evaluate(target.point, sample);
    const double d = std::abs(Residual(sample, target)) / diagonal;
    error.mean += d;
    error.max = std::max(error.max, d);
    ++count;
  }
  if (count > 0) error.mean /= count;
  return error;
}

}  // namespace lascaux
