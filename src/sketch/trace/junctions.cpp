#include "sketch/trace/junctions.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sketch/trace/centre.h"
#include "sketch/trace/clusters.h"
#include "sketch/trace/stubs.h"

namespace lascaux::trace {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kTangentWidths = 2;     // stretch of a branch that gives its tangent, in widths
constexpr double kMostCut = 0.4;         // of a branch's length at each of its ends
constexpr double kMostUnmeasured = 1;    // widths more that are cut where ink has no two sides
constexpr double kLongestExtension = 5;  // in widths: lines at 10 degrees part after that
constexpr double kBend = 0.25;           // radians that cost as much as being twice as far away
constexpr double kMeet = 1;              // pixels: bars that are nearer cross or touch
constexpr double kLongestTip = 3;        // in widths: of a corner of 20 degrees

/// What becomes of an end of a branch.
struct Joint {
  int partner = -1;  ///< the end that the line goes on with
  Points onward;     ///< from the cut to the partner's, or to where it ends; the cuts left out
  int bar = -1;      ///< an end of the line that it ends on
};

class Solver {
 public:
  Solver(const InkGraph& graph, const Tone& coverage, const TracePictureOptions& options)
      : graph_(graph),
        coverage_(coverage),
        options_(options),
        clusters_(ClustersOf(graph, options.junction)),
        stubs_(2 * graph.branches.size()),
        joints_(2 * graph.branches.size()),
        dropped_(clusters_.inside) {
    for (const std::vector<int>& nodes : clusters_.nodes) Solve(nodes);
  }

  std::vector<Line> Lines() {
    line_of_.assign(graph_.branches.size(), -1);
    for (int pass = 0; pass < 2; ++pass)  // from the ends first, then what goes round
      for (std::size_t i = 0; i < graph_.branches.size(); ++i) {
        const Branch& branch = graph_.branches[i];
        if (branch.removed || dropped_[i] || line_of_[i] >= 0) continue;
        const int b = static_cast<int>(i);
        if (branch.nodes[0] < 0) {
          AddLoop(branch, b);
        } else if (joints_[2 * i].partner < 0) {
          Follow(2 * b);
        } else if (joints_[2 * i + 1].partner < 0) {
          Follow(2 * b + 1);
        } else if (pass == 1) {
          Follow(2 * b);
        }
      }
    for (const Link& link : links_) {
      const int id = static_cast<int>(lines_.size());
      Line line{
          .points = Straight(link.a, link.b), .width = link.width, .closed = false, .ends = {}};
      line.points.insert(line.points.begin(), link.a);
      lines_.push_back(std::move(line));
      pending_.push_back({id, 0, link.on_a});
      pending_.push_back({id, 1, link.on_b});
    }
    for (auto& [line, end, bar] : pending_)
      lines_[static_cast<std::size_t>(line)].ends[end].on_line =
          line_of_[static_cast<std::size_t>(bar / 2)];
    return std::move(lines_);
  }

 private:
  const Branch& Of(int end) const { return graph_.branches[static_cast<std::size_t>(end / 2)]; }
  Stub& StubOf(int end) { return stubs_[static_cast<std::size_t>(end)]; }
  Joint& JointOf(int end) { return joints_[static_cast<std::size_t>(end)]; }
  FromEnd PointsFrom(int end) const { return {Of(end).points, end % 2}; }

  void Solve(const std::vector<int>& nodes) {
    std::vector<int> ends;
    Vector2d center = Vector2d::Zero();
    for (const int n : nodes) {
      const InkNode& node = graph_.nodes[static_cast<std::size_t>(n)];
      center += node.at / static_cast<double>(nodes.size());
      for (const BranchEnd& e : node.ends)
        if (!clusters_.inside[static_cast<std::size_t>(e.branch)])
          ends.push_back(2 * e.branch + e.end);
    }
    if (ends.size() < 2) return;
    double radius = 0, half_width = 0;
    for (const int n : nodes) {
      const InkNode& node = graph_.nodes[static_cast<std::size_t>(n)];
      radius = std::max(radius, (node.at - center).norm() + node.half_width);
      half_width = std::max(half_width, node.half_width);
    }
    for (const int e : ends) Cut(e, center, radius, 2 * half_width);
    if (ends.size() == 3 && SharpCorner(ends, 2 * half_width)) return;
    const std::vector<int> stems = PairUp(ends);
    if (stems.size() == ends.size()) return MeetInOnePoint(stems, center, radius);
    EndOnBars(stems, ends, 2 * half_width);
    LinkBars(ends, 2 * half_width);
  }

  /// Lines whose inks touch, and which both go on without meeting, are linked where they are
  /// nearest: what they enclose together stays enclosed.
  void LinkBars(const std::vector<int>& ends, double width) {
    std::vector<int> linked;
    for (const int e : ends) {
      if (JointOf(e).partner < e) continue;  // each bar once
      Link best;
      double nearest = std::numeric_limits<double>::infinity();
      for (const int other : linked) {
        const Points line = Around(other);
        for (const Vector2d& p : Around(e)) {
          const Vector2d foot = NearestOn(line, p);
          if ((foot - p).norm() >= nearest) continue;
          nearest = (foot - p).norm();
          best = {p, foot, e, other, width};
        }
      }
      if (!linked.empty() && nearest > kMeet && IsInk(best.a, best.b)) links_.push_back(best);
      linked.push_back(e);
    }
  }

  void Cut(int end, const Vector2d& center, double radius, double width) {
    const FromEnd points = PointsFrom(end);
    const double most = kMostCut * LengthOf(Of(end).points);
    double s = 0;
    std::size_t i = 0;
    const auto is_measured = [&](std::size_t k) {
      const std::vector<bool>& measured = Of(end).measured;
      return bool{measured[end % 2 == 0 ? k : measured.size() - 1 - k]};
    };
    while (i + 2 < points.size()) {
      const double away = (points[i] - center).norm();
      if (away > radius && (is_measured(i) || away > radius + kMostUnmeasured * width)) break;
      const double step = (points[i + 1] - points[i]).norm();
      if (s + step > most) break;
      s += step;
      ++i;
    }
    Stub& stub = StubOf(end);
    stub = {i, points[i], TangentToward(points, i, kTangentWidths * width)};
    if (stub.toward.isZero(0)) stub.toward = (center - stub.at).stableNormalized();
  }

  /// Degrees that a line turns by if it goes on from one stub into the other.
  double Turn(const Stub& a, const Stub& b) const {
    const Vector2d chord = b.at - a.at;
    if (chord.norm() < 1e-9) return Angle(a.toward, -b.toward) * 180 / std::numbers::pi;
    return (Angle(a.toward, chord) + Angle(chord, -b.toward)) * 180 / std::numbers::pi;
  }

  void Join(int a, int b, Points onward) {
    JointOf(a).partner = b;
    JointOf(b).partner = a;
    JointOf(b).onward.assign(onward.rbegin(), onward.rend());
    JointOf(a).onward = std::move(onward);
  }

  /// Joins the ends that agree, best first; what is left over has no partner.
  std::vector<int> PairUp(const std::vector<int>& ends) {
    struct Pair {
      double turn;
      int a, b;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = i + 1; j < ends.size(); ++j) {
        const double turn = Turn(StubOf(ends[i]), StubOf(ends[j]));
        if (turn <= options_.corner) pairs.push_back({turn, ends[i], ends[j]});
      }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.turn < b.turn; });
    for (const Pair& pair : pairs)
      if (JointOf(pair.a).partner < 0 && JointOf(pair.b).partner < 0)
        Join(pair.a, pair.b, Bridge(StubOf(pair.a), StubOf(pair.b)));
    std::vector<int> stems;
    for (const int e : ends)
      if (JointOf(e).partner < 0) stems.push_back(e);
    return stems;
  }

  /// Two lines that meet at a sharp angle leave a spur to the tip of their corner: it goes, and
  /// they meet where their tangents do.
  bool SharpCorner(const std::vector<int>& ends, double width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Branch& spur = Of(ends[k]);
      const int far = spur.nodes[static_cast<std::size_t>(1 - ends[k] % 2)];
      if (graph_.nodes[static_cast<std::size_t>(far)].ends.size() != 1) continue;
      const double length = LengthOf(spur.points);
      if (length > kLongestTip * width) continue;
      const int a = ends[(k + 1) % 3], b = ends[(k + 2) % 3];
      const Stub &sa = StubOf(a), &sb = StubOf(b);
      // Both sides go the way that the spur goes, so neither goes on into the other.
      const Vector2d tip = graph_.nodes[static_cast<std::size_t>(far)].at;
      if (sa.toward.dot(tip - sa.at) <= 0 || sb.toward.dot(tip - sb.at) <= 0) continue;
      if (Angle(sa.toward, sb.toward) > std::numbers::pi / 2) continue;
      const double across = Cross(sa.toward, sb.toward);
      if (std::abs(across) < 1e-3) continue;
      const double t = Cross(sb.at - sa.at, sb.toward) / across;
      const Vector2d apex = sa.at + t * sa.toward;
      if (t <= 0 || (apex - tip).norm() > width) continue;
      Points onward = Straight(sa.at, apex);
      const Points second = Straight(apex, sb.at);
      onward.insert(onward.end(), second.begin(), second.end() - 1);
      Join(a, b, std::move(onward));
      dropped_[static_cast<std::size_t>(ends[k] / 2)] = true;
      return true;
    }
    return false;
  }

  /// The point nearest to all tangents.
  void MeetInOnePoint(const std::vector<int>& stems, const Vector2d& center, double radius) {
    Eigen::Matrix2d normal =
        1e-2 * Eigen::Matrix2d::Identity();  // parallel ones meet in the middle
    Vector2d right = 1e-2 * center;
    for (const int e : stems) {
      const Vector2d& d = StubOf(e).toward;
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - d * d.transpose();
      normal += across;
      right += across * StubOf(e).at;
    }
    Vector2d point = normal.inverse() * right;
    if (!((point - center).norm() <= radius)) point = center;
    for (const int e : stems) JointOf(e).onward = Straight(StubOf(e).at, point);
  }

  /// Stems end on bars, or on stems that end already, the nearest first; where another one ends
  /// within a width, it is there.
  void EndOnBars(std::vector<int> stems, const std::vector<int>& ends, double width) {
    std::vector<int> targets;
    for (const int e : ends)
      if (JointOf(e).partner > e) targets.push_back(e);  // each bar once
    std::vector<Landing> landings;
    while (!stems.empty()) {
      Landing best;
      std::size_t which = 0;
      for (std::size_t i = 0; i < stems.size(); ++i) {
        const Landing landing = LandingOf(stems[i], targets, kLongestExtension * width);
        if (landing.cost < best.cost) best = landing, which = i;
      }
      if (best.on < 0) best = NearestLanding(stems[which], targets);
      for (const Landing& other : landings)
        if ((other.at - best.at).norm() < width) best = other;
      const int stem = stems[which];
      JointOf(stem).bar = best.on;
      JointOf(stem).onward = Straight(StubOf(stem).at, best.at);
      landings.push_back(best);
      targets.push_back(stem);
      stems.erase(stems.begin() + static_cast<std::ptrdiff_t>(which));
    }
  }

  /// Where a stem meets another line, and an end that belongs to that line.
  struct Landing {
    double cost = std::numeric_limits<double>::infinity();
    Vector2d at = Vector2d::Zero();
    int on = -1;
  };

  /// The place of a line that a stem reaches soonest through ink while it bends least: on its
  /// tangent if that hits the line at all, else where it merges with it.
  Landing LandingOf(int stem, const std::vector<int>& targets, double longest) {
    const Stub& stub = StubOf(stem);
    Landing best;
    for (const int e : targets) {
      const Points line = Around(e);
      for (const Vector2d& at : line) {
        const double distance = (at - stub.at).norm();
        if (distance > longest) continue;
        const double bend = distance > 1e-9 ? Angle(stub.toward, at - stub.at) / kBend : 0;
        const double cost = distance * (1 + bend * bend);
        if (cost < best.cost && IsInk(stub.at, at)) best = {cost, at, e};
      }
    }
    return best;
  }

  Landing NearestLanding(int stem, const std::vector<int>& targets) {
    const Vector2d& from = StubOf(stem).at;
    Landing best;
    for (const int e : targets) {
      const Vector2d foot = NearestOn(Around(e), from);
      if ((foot - from).norm() < best.cost) best = {(foot - from).norm(), foot, e};
    }
    return best;
  }

  bool IsInk(const Vector2d& a, const Vector2d& b) const {
    const int steps = static_cast<int>(std::ceil((b - a).norm()));
    for (int i = 1; i < steps; ++i)
      if (CoverageAt(coverage_, a + (b - a) * (static_cast<double>(i) / steps)) < 0.5) return false;
    return true;
  }

  /// The line that goes through a junction or ends there, with as much of its branches as a stem
  /// may hit.
  Points Around(int end) {
    const Joint& joint = JointOf(end);
    Points points = Stretch(end);
    std::reverse(points.begin(), points.end());
    points.insert(points.end(), joint.onward.begin(), joint.onward.end());
    if (joint.partner < 0) return points;
    const Points beyond = Stretch(joint.partner);
    points.insert(points.end(), beyond.begin(), beyond.end());
    return points;
  }

  Points Stretch(int end) {
    constexpr std::size_t kPoints = 40;  // about three widths
    const FromEnd from = PointsFrom(end);
    Points points;
    for (std::size_t i = StubOf(end).cut; i < from.size() && points.size() < kPoints; ++i)
      points.push_back(from[i]);
    return points;
  }

  void AddLoop(const Branch& branch, int id) {
    Line line;
    line.points = branch.points;
    line.closed = true;
    line.width = 2 * Median(branch.half_widths);
    line_of_[static_cast<std::size_t>(id)] = static_cast<int>(lines_.size());
    lines_.push_back(std::move(line));
  }

  static double Median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  /// The line that begins with this end of a branch.
  void Follow(int start) {
    Line line;
    const int id = static_cast<int>(lines_.size());
    std::vector<double> half_widths;
    const auto end_with = [&](int end, int which) {
      if (JointOf(end).bar >= 0) pending_.push_back({id, which, JointOf(end).bar});
    };
    const Joint& first = JointOf(start);
    if (first.partner < 0) {
      line.points.assign(first.onward.rbegin(), first.onward.rend());
      end_with(start, 0);
    }
    int end = start;
    for (;;) {
      line_of_[static_cast<std::size_t>(end / 2)] = id;
      const int far = end ^ 1;
      const FromEnd points = PointsFrom(end);
      const Branch& branch = Of(end);
      const std::size_t stop = points.size() - StubOf(far).cut;
      for (std::size_t i = StubOf(end).cut; i < stop; ++i) {
        line.points.push_back(points[i]);
        half_widths.push_back(
            branch.half_widths[end % 2 == 0 ? i : branch.half_widths.size() - 1 - i]);
      }
      const Joint& joint = JointOf(far);
      line.points.insert(line.points.end(), joint.onward.begin(), joint.onward.end());
      if (joint.partner < 0) {
        end_with(far, 1);
        break;
      }
      end = joint.partner;
      if (end == start) {
        line.closed = true;
        line.points.push_back(line.points.front());
        break;
      }
    }
    line.width = half_widths.empty() ? 1 : 2 * Median(std::move(half_widths));
    lines_.push_back(std::move(line));
  }

  struct Pending {
    int line, end, bar;
  };
  /// A short line between two bars, each known by one of its ends.
  struct Link {
    Vector2d a = Vector2d::Zero(), b = Vector2d::Zero();
    int on_a = -1, on_b = -1;
    double width = 0;
  };

  const InkGraph& graph_;
  const Tone& coverage_;
  const TracePictureOptions& options_;
  Clusters clusters_;
  std::vector<Stub> stubs_;
  std::vector<Joint> joints_;
  std::vector<bool> dropped_;  ///< branches that are part of no line
  std::vector<int> line_of_;
  std::vector<Line> lines_;
  std::vector<Pending> pending_;
  std::vector<Link> links_;
};

}  // namespace

std::vector<Line> LinesOf(const InkGraph& graph, const Tone& coverage,
                          const TracePictureOptions& options) {
  return Solver(graph, coverage, options).Lines();
}

}  // namespace lascaux::trace
