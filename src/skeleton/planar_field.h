#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "lascaux/skeleton/creature.h"
#include "skeleton/segment_lanes.h"

/// @file
/// A part's field in its own plane, with derivatives with respect to its discs.
///
/// The same function as MakeField() gives, caps included; derivatives of the integrals in SCALIS'
/// homothetic form.

namespace lascaux {

/// Value and gradient at a point, and the derivatives by discs: index 3 v + (0: log radius, 1: x,
/// 2: y), where v counts the vertices of all chains in order. Those outside of the runs are 0; runs
/// ascend and don't touch each other's chains.
struct PlanarSample {
  /// Consecutive indices.
  struct Run {
    int first, count;

    int FilledUp() const { return (count + 3) / 4 * 4; }
  };
  double value = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  std::vector<double> derivatives;  ///< run after run, each filled up with 0 to a multiple of four
  std::vector<Run> runs;
};

/// Ricci's blend of chains in their plane.
class PlanarField {
 public:
  explicit PlanarField(const std::vector<Chain>& chains);

  /// Overwrites `sample`, whose memory is used again. Integrals by 8-node Gauss-Legendre on pieces
  /// whose radii have a ratio of at most 3: within 1e-5 of the exact value.
  void Evaluate(const Eigen::Vector2d& point, PlanarSample& sample);

 private:
  /// How an end's vertex and its neighbour move the point where the cap sits.
  struct End {
    int vertex = 0, neighbour = 0;
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
    Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
  };
  struct Polyline {
    int first = 0;                           ///< number of its first vertex
    std::vector<Eigen::Vector2d> positions;  ///< with the ends moved out
    std::vector<double> radii;
    std::vector<LaneSegment> segments;
    LaneBoxes boxes;  ///< outside of them, the segments' fields are 0
    std::vector<End> ends;
    Eigen::Vector2d center = Eigen::Vector2d::Zero();
    double reach = 0;  ///< its field is 0 further than this from the center
  };
  /// Derivatives by one vertex' position (moved out, at ends) and radius.
  struct Pull {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double radius = 0;
  };

  void AddSegments(const Polyline& line, const Eigen::Vector2d& point, double& value);
  double AddPolyline(const Polyline& line, const Eigen::Vector2d& point, PlanarSample& sample);

  std::vector<Polyline> lines_;
  std::vector<Pull> pulls_;  ///< scratch: all 0
  std::vector<double> values_;
  std::vector<Eigen::Vector2d> gradients_;
  std::vector<int> near_;
};

}  // namespace lascaux
