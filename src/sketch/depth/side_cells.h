#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lascaux/sketch/depth_graph.h"
#include "sketch/depth/adjacency.h"

/// @file
/// Closed cells beside the body that come in pairs: legs and ears drawn without a suggestive curve.

namespace lascaux {

/// Looks at cells one by one, as the depth stage hangs them on parts that are already placed.
class SideCells {
 public:
  /// `graph` has the body and the limbs with their far sides.
  SideCells(const PlanarMap& map, const Parts& parts, const Adjacency& adjacency,
            const DepthGraph& graph);

  /// Does a cell that hangs on `parent`, a part in the plane, leave it sideways, one of a pair?
  /// `more` are the cells that hang on the cell alone (a hoof), which count as its own.
  ///
  /// A leg is longer than wide, leaves its parent's underside and comes down to the ground. An ear
  /// or a horn leaves the upper side of the head upwards, longer than its joint. The head is where
  /// the eyes are; without any, the end of the body that reaches farther beyond the legs. An animal
  /// without a single leg has fins, not ears.
  /// The score of the better role of both (Evidence): it is one from 0 on.
  double OneOfAPair(int cell, int parent, const std::vector<int>& more) const;

  struct Unlike {
    double cost = 0;   ///< small: much alike
    double score = 0;  ///< Evidence
  };
  /// Is this leg's far or near side beside it? How unlike they are, or none.
  std::optional<Unlike> Unlikeness(int one, int other, int parent) const;

  /// How far down a cell reaches, in sketch units.
  double Lowest(int cell) const;

 private:
  struct Shape;
  Shape ShapeOf(int cell, int parent, const std::vector<int>& more) const;
  double LegScore(const Shape& shape, int parent) const;
  double EarScore(const Shape& shape, int cell, int parent) const;
  bool IsInATangle(int cell, int parent) const;
  double HeadScore(const Eigen::Vector2d& joint) const;

  const PlanarMap& map_;
  const Parts& parts_;
  const Adjacency& adjacency_;
  std::vector<Eigen::Vector2d> eyes_, roots_;
  double top_ = 0, bottom_ = 0, left_ = 0, right_ = 0;  ///< bounds: of the drawing, of the body
};

}  // namespace lascaux
