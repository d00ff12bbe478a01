#include <algorithm>
#include <map>

#include "lascaux/sketch/parts.h"
#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

/// Islands smaller than this share of the diagonal, squared, are specks.
constexpr double kSpeck = 4e-3;

Part WholeCycle(const PlanarMap& map, int cycle, PartKind kind) {
  const Boundary boundary = BoundaryOf(map, cycle);
  const BoundaryLine line = LineOf(map, boundary);
  const std::vector<SuggestiveCurve> none;
  Part part = CutFace({map, line, none}, cycle, {}, 0).front();
  part.kind = kind;
  return part;
}

/// True when two lengths of the walk cross: each begins in the other.
bool Cross(const BoundaryLine& line, const LimbCut& a, const LimbCut& b) {
  const double own = line.Ahead(a.from, a.to);
  const bool from = line.Ahead(a.from, b.from) < own, to = line.Ahead(a.from, b.to) < own;
  return from != to;
}

/// True when one length of the walk lies in the other and is more than half of it.
bool IsSameLimb(const BoundaryLine& line, const LimbCut& a, const LimbCut& b) {
  const double one = line.Ahead(a.from, a.to), other = line.Ahead(b.from, b.to);
  const LimbCut &outer = one > other ? a : b, &inner = one > other ? b : a;
  const double own = std::max(one, other);
  const bool inside =
      line.Ahead(outer.from, inner.from) <= own && line.Ahead(outer.from, inner.to) <= own;
  return inside && std::min(one, other) > 0.5 * own;
}

/// The face that is the torso if any is: limbs without a line of their own are looked for there
/// alone.
bool IsMainFace(const PlanarMap& map, int cycle) {
  return std::none_of(map.cycles.begin(), map.cycles.end(), [&](const MapCycle& other) {
    return other.kind == CycleKind::kBorder &&
           other.area > map.cycles[static_cast<std::size_t>(cycle)].area;
  });
}

/// The limbs of a face by the rules, which keep clear of those that were asked for.
std::vector<LimbCut> LimbsOf(const FaceView& face, const FindPartsOptions& options,
                             const std::vector<LimbCut>& asked) {
  Pairing pairing = PairCurves(face, options);
  std::vector<LimbCut> limbs = asked;
  const auto add = [&](LimbCut& limb) {
    const bool clear = std::none_of(limbs.begin(), limbs.end(), [&](const LimbCut& other) {
      const bool asked_for = other.evidence == LimbEvidence::kOverride;
      return Cross(face.line, limb, other) || (asked_for && IsSameLimb(face.line, limb, other));
    });
    if (clear) limbs.push_back(std::move(limb));
  };
  for (LimbCut& limb : pairing.limbs) add(limb);
  pairing.limbs = limbs;
  for (LimbCut& limb : OneCurveLimbs(face, pairing)) add(limb);
  return limbs;
}

/// A face of the map with everything that the rules look at.
struct Face {
  Boundary boundary;
  BoundaryLine line;
  std::vector<SuggestiveCurve> curves;

  Face(const PlanarMap& map, int cycle)
      : boundary(BoundaryOf(map, cycle)),
        line(LineOf(map, boundary)),
        curves(SuggestiveCurvesOf(map, boundary, line)) {}
};

std::vector<int> BorderCycles(const PlanarMap& map) {
  std::vector<int> borders;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    if (map.cycles[static_cast<std::size_t>(c)].kind == CycleKind::kBorder) borders.push_back(c);
  }
  return borders;
}

/// options.cuts by the cycle that each cuts: the largest that it can.
Outcome<std::map<int, std::vector<LimbCut>>> AskedLimbs(const PlanarMap& map,
                                                        const FindPartsOptions& options) {
  std::map<int, std::vector<LimbCut>> asked;
  if (options.cuts.empty()) return asked;
  std::vector<int> cycles = BorderCycles(map);
  std::stable_sort(cycles.begin(), cycles.end(), [&](int a, int b) {
    return map.cycles[static_cast<std::size_t>(a)].area >
           map.cycles[static_cast<std::size_t>(b)].area;
  });
  for (const auto& ends : options.cuts) {
    bool made = false;
    for (const int cycle : cycles) {
      const Face face(map, cycle);
      auto limb = CutAsAsked({map, face.line, face.curves}, ends);
      if (!limb) continue;
      asked[cycle].push_back(std::move(*limb));
      made = true;
      break;
    }
    if (made) continue;
    return Outcome<std::map<int, std::vector<LimbCut>>>::Failure(
        At(Error(FailureKind::kUnderstanding, "override-not-there",
                 "no part can be cut between the two points; give two places on its outline"),
           0.5 * (ends[0] + ends[1])));
  }
  return asked;
}

}  // namespace

Outcome<Parts> FindParts(const PlanarMap& map, const FindPartsOptions& options, const Execution&) {
  Diagnostics log;
  auto asked = AskedLimbs(map, options).MoveInto(log);
  if (!asked) return Outcome<Parts>::Failure(std::move(log));
  Parts result;
  for (const int c : BorderCycles(map)) {
    const Face face(map, c);
    const FaceView view{map, face.line, face.curves};
    std::vector<LimbCut> limbs = LimbsOf(view, options, (*asked)[c]);
    if (IsMainFace(map, c)) {
      for (LimbCut& limb : LimbsBesideCells(view, limbs)) limbs.push_back(std::move(limb));
      const int known = static_cast<int>(limbs.size());
      for (LimbCut& limb : NeckLimbs(view, limbs)) {
        if (limb.far_of >= 0) limb.far_of += known;
        limbs.push_back(std::move(limb));
      }
    }
    for (Part& part : CutFace(view, c, limbs, static_cast<int>(result.parts.size()))) {
      result.parts.push_back(std::move(part));
    }
  }
  const double speck = kSpeck * kSpeck * map.diagonal * map.diagonal;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    const MapCycle& cycle = map.cycles[static_cast<std::size_t>(c)];
    if (cycle.kind == CycleKind::kIsland && cycle.area >= speck) {
      result.parts.push_back(WholeCycle(map, c, PartKind::kIsland));
    } else if (cycle.kind == CycleKind::kOther) {
      result.parts.push_back(WholeCycle(map, c, PartKind::kInner));
    }
  }
  return result;
}

const char* Name(LimbEvidence evidence) noexcept {
  switch (evidence) {
    case LimbEvidence::kTwoCurves:
      return "two-curves";
    case LimbEvidence::kOneCurve:
      return "one-curve";
    case LimbEvidence::kFarSide:
      return "far-side";
    case LimbEvidence::kOverride:
      return "override";
    case LimbEvidence::kNeck:
      break;
  }
  return "neck";
}

}  // namespace lascaux
