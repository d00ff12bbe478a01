#include <algorithm>

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

/// The face that is the torso if any is: limbs without a line of their own are looked for there
/// alone.
bool IsMainFace(const PlanarMap& map, int cycle) {
  return std::none_of(map.cycles.begin(), map.cycles.end(), [&](const MapCycle& other) {
    return other.kind == CycleKind::kBorder &&
           other.area > map.cycles[static_cast<std::size_t>(cycle)].area;
  });
}

std::vector<Part> PartsOf(const PlanarMap& map, int cycle, int first_id,
                          const FindPartsOptions& options) {
  const Boundary boundary = BoundaryOf(map, cycle);
  const BoundaryLine line = LineOf(map, boundary);
  const std::vector<SuggestiveCurve> curves = SuggestiveCurvesOf(map, boundary, line);
  const FaceView face{map, line, curves};
  Pairing pairing = PairCurves(face, options);
  std::vector<LimbCut> limbs = pairing.limbs;
  for (LimbCut& limb : OneCurveLimbs(face, pairing)) {
    const bool crossing = std::any_of(
        limbs.begin(), limbs.end(), [&](const LimbCut& other) { return Cross(line, limb, other); });
    if (!crossing) limbs.push_back(std::move(limb));
  }
  for (LimbCut& limb : LimbsBesideCells(face, limbs)) limbs.push_back(std::move(limb));
  if (IsMainFace(map, cycle)) {
    const int known = static_cast<int>(limbs.size());
    for (LimbCut& limb : NeckLimbs(face, limbs)) {
      if (limb.far_of >= 0) limb.far_of += known;
      limbs.push_back(std::move(limb));
    }
  }
  return CutFace(face, cycle, limbs, first_id);
}

}  // namespace

Outcome<Parts> FindParts(const PlanarMap& map, const FindPartsOptions& options, const Execution&) {
  Parts result;
  for (int c = 0; c < static_cast<int>(map.cycles.size()); ++c) {
    if (map.cycles[static_cast<std::size_t>(c)].kind != CycleKind::kBorder) continue;
    for (Part& part : PartsOf(map, c, static_cast<int>(result.parts.size()), options)) {
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

}  // namespace lascaux
