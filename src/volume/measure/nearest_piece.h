#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lascaux {

/// A short straight piece of an outline.
struct OutlinePiece {
  Eigen::Vector2d middle;
  Eigen::Vector2d tangent;  ///< unit vector
  double half_length = 0;
  std::uint32_t group = 0;  ///< of the edge that it is cut from

  double DistanceTo(const Eigen::Vector2d& p) const;
};

/// Finds the nearest of many pieces: a tree of their middles that halves the wider side at the
/// median.
class NearestPiece {
 public:
  explicit NearestPiece(std::vector<OutlinePiece> pieces);

  /// Distance from `p` to the nearest piece; +infinity without pieces.
  double Distance(const Eigen::Vector2d& p) const;

 private:
  void Split(std::size_t begin, std::size_t end);
  void Search(std::size_t begin, std::size_t end, const Eigen::Vector2d& p, double& best) const;

  std::vector<OutlinePiece> pieces_;  // each range's median in its middle
  std::vector<std::uint8_t> axis_;    // that the range around each median is split at
  double longest_half_ = 0;
};

}  // namespace lascaux
