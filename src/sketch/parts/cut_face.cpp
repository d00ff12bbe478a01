#include <algorithm>
#include <set>

#include "sketch/parts/completion.h"
#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A ring under construction; consecutive equal points are left out.
class RingBuilder {
 public:
  explicit RingBuilder(const PlanarMap& map) : map_(map) {}

  void Add(const Polyline& line, OutlineKind kind) {
    for (const Vector2d& p : line) AddPoint(p, kind);
  }

  void Add(const BoundaryStretch& stretch) {
    AddPoint(stretch.points.front(), OutlineKind::kDrawn);
    std::vector<int>& walked = stretches_.emplace_back();
    for (std::size_t i = 0; i < stretch.half_edges.size(); ++i) {
      const int h = stretch.half_edges[i];
      if (walked.empty() || walked.back() != h) walked.push_back(h);
      AddPoint(stretch.points[i + 1], KindOf(h));
    }
  }

  void NoteStrokes(const std::vector<int>& edges) {
    for (const int e : edges) strokes_.insert(map_.edges[static_cast<std::size_t>(e)].stroke);
  }

  Part Finish() {
    Part part;
    part.outline = std::move(outline_);
    if (part.outline.points.size() > 1 &&
        part.outline.points.front() == part.outline.points.back()) {
      part.outline.points.pop_back();
      part.outline.kinds.front() = part.outline.kinds.back();
      part.outline.kinds.pop_back();
    }
    // Kinds were noted with the point that a piece ends at; they belong to the one that it begins
    // at.
    if (!part.outline.kinds.empty()) {
      std::rotate(part.outline.kinds.begin(), part.outline.kinds.begin() + 1,
                  part.outline.kinds.end());
    }
    for (const std::vector<int>& stretch : stretches_) {
      for (const int h : stretch)
        strokes_.insert(map_.edges[static_cast<std::size_t>(h / 2)].stroke);
    }
    strokes_.erase(-1);
    part.stretches = std::move(stretches_);
    part.strokes.assign(strokes_.begin(), strokes_.end());
    return part;
  }

 private:
  void AddPoint(const Vector2d& p, OutlineKind kind) {
    if (!outline_.points.empty() && outline_.points.back() == p) return;
    outline_.points.push_back(p);
    outline_.kinds.push_back(kind);
  }

  /// A line with another bounded face behind it is shared.
  OutlineKind KindOf(int h) const {
    const int behind = map_.cycle[static_cast<std::size_t>(PlanarMap::Twin(h))];
    return map_.cycles[static_cast<std::size_t>(behind)].area > 0 ? OutlineKind::kShared
                                                                  : OutlineKind::kDrawn;
  }

  const PlanarMap& map_;
  Outline outline_;
  std::vector<std::vector<int>> stretches_;
  std::set<int> strokes_;
};

bool Owns(const BoundaryLine& line, const LimbCut& outer, const LimbCut& inner) {
  const double own = line.Ahead(outer.from, outer.to);
  const double from = line.Ahead(outer.from, inner.from), to = line.Ahead(outer.from, inner.to);
  return from <= own && to <= own && from <= to && line.Ahead(inner.from, inner.to) < own;
}

/// For each limb the innermost other one whose stretch holds its own; -1 for limbs of the face.
std::vector<int> Owners(const BoundaryLine& line, const std::vector<LimbCut>& limbs) {
  std::vector<int> owners(limbs.size(), -1);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    for (std::size_t k = 0; k < limbs.size(); ++k) {
      if (k == i || !Owns(line, limbs[k], limbs[i])) continue;
      const int best = owners[i];
      if (best < 0 || Owns(line, limbs[static_cast<std::size_t>(best)], limbs[k]))
        owners[i] = static_cast<int>(k);
    }
  }
  return owners;
}

Polyline ClosedCompletion(const FaceView& face, const LimbCut& limb) {
  const double reach = TangentReach(face.map);
  return CompleteInside({face.line.At(limb.from), face.line.DirectionBefore(limb.from, reach)},
                        {face.line.At(limb.to), -face.line.DirectionAfter(limb.to, reach)},
                        face.line.points);
}

Polyline OpenCompletion(const FaceView& face, const LimbCut& limb) {
  const double reach = TangentReach(face.map);
  return CompleteInside({limb.to_curve.back(), ArrivalDirection(limb.to_curve, reach)},
                        {limb.from_curve.back(), ArrivalDirection(limb.from_curve, reach)},
                        face.line.points);
}

/// The walk from one place to another, each child limb on it replaced by the completion of its
/// closed ends.
void AddWalk(const FaceView& face, RingBuilder& ring, double from, double to,
             std::vector<const LimbCut*> children) {
  std::sort(children.begin(), children.end(), [&](const LimbCut* a, const LimbCut* b) {
    return face.line.Ahead(from, a->from) < face.line.Ahead(from, b->from);
  });
  double at = from;
  for (const LimbCut* child : children) {
    if (face.line.Ahead(at, child->from) > 0) ring.Add(Stretch(face.line, at, child->from));
    ring.Add(ClosedCompletion(face, *child), OutlineKind::kCompletion);
    at = child->to;
  }
  if (face.line.Ahead(at, to) > 0) ring.Add(Stretch(face.line, at, to));
}

std::vector<const LimbCut*> ChildrenOf(const std::vector<LimbCut>& limbs,
                                       const std::vector<int>& owners, int owner) {
  std::vector<const LimbCut*> children;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (owners[i] == owner) children.push_back(&limbs[i]);
  }
  return children;
}

Part BasePart(const FaceView& face, const std::vector<const LimbCut*>& children) {
  RingBuilder ring(face.map);
  if (children.empty()) {
    BoundaryStretch all{face.line.points, face.line.half_edges};
    all.points.push_back(all.points.front());
    ring.Add(all);
  } else {
    // Once around from a limb's end back to it, that limb's completion first.
    const double start = children.front()->from;
    AddWalk(face, ring, start, start, children);
  }
  return ring.Finish();
}

Part LimbPart(const FaceView& face, const LimbCut& limb,
              const std::vector<const LimbCut*>& children) {
  RingBuilder ring(face.map);
  ring.Add(Reversed(limb.from_curve), limb.from_kind);
  AddWalk(face, ring, limb.from, limb.to, children);
  ring.Add(limb.to_curve, limb.to_kind);
  const Polyline open = OpenCompletion(face, limb);
  ring.Add(open, OutlineKind::kCompletion);
  for (const SuggestiveCurve& curve : face.curves) {
    if (curve.points == limb.from_curve || curve.points == limb.to_curve)
      ring.NoteStrokes(curve.edges);
  }
  Part part = ring.Finish();
  part.kind = PartKind::kLimb;
  LimbRoot root;
  root.closed = {limb.from_curve.front(), limb.to_curve.front()};
  root.open = {limb.from_curve.back(), limb.to_curve.back()};
  root.closed_completion = ClosedCompletion(face, limb);
  root.open_completion = Reversed(open);
  root.evidence = limb.evidence;
  root.energy = limb.energy;
  part.root = std::move(root);
  return part;
}

}  // namespace

std::vector<Part> CutFace(const FaceView& face, int cycle, const std::vector<LimbCut>& limbs,
                          int first_id) {
  const std::vector<int> owners = Owners(face.line, limbs);
  std::vector<Part> parts{BasePart(face, ChildrenOf(limbs, owners, -1))};
  std::vector<int> id_of(limbs.size(), -1);
  // Owners have longer stretches than what they own.
  std::vector<std::size_t> order(limbs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return face.line.Ahead(limbs[a].from, limbs[a].to) >
           face.line.Ahead(limbs[b].from, limbs[b].to);
  });
  for (const std::size_t i : order) {
    Part part = LimbPart(face, limbs[i], ChildrenOf(limbs, owners, static_cast<int>(i)));
    part.over = owners[i] < 0 ? first_id : id_of[static_cast<std::size_t>(owners[i])];
    part.score = limbs[i].score;
    id_of[i] = first_id + static_cast<int>(parts.size());
    parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs[i].far_of < 0) continue;
    Part& far = parts[static_cast<std::size_t>(id_of[i] - first_id)];
    far.kind = PartKind::kBorder;
    far.over.reset();
    far.root.reset();
    far.far_side_of = id_of[static_cast<std::size_t>(limbs[i].far_of)];
  }
  for (Part& part : parts) part.cycles = {cycle};
  return parts;
}

}  // namespace lascaux
