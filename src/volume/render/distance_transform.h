#pragma once

#include <array>
#include <vector>

/// @file
/// Distances to the nearest seed of a dense grid.
///
/// Source: P. Felzenszwalb, D. Huttenlocher, "Distance Transforms of Sampled Functions", Theory of
/// Computing 8, 2012.

namespace lascaux {

/// For every node the nearest seed: x runs fastest, then y, then z.
struct NearestSeeds {
  std::vector<float> squared_distance;  ///< in nodes; kNoSeed where the grid has none
  std::vector<float> value;             ///< of that seed
};

inline constexpr float kNoSeed = 1e30F;

/// Completes `seeds`, whose squared distances are 0 at seeds and kNoSeed elsewhere. Exact, in time
/// linear in the nodes.
NearestSeeds SpreadSeeds(NearestSeeds seeds, const std::array<int, 3>& size);

}  // namespace lascaux
