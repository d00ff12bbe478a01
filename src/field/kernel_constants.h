#pragma once

/// @file
/// Numbers of the vector code, in single precision.

namespace lascaux::internal {

inline constexpr float kNorm = 1.4968340312323631f;  ///< N of primitives.h

/// N INT xi^j over [-1, 1] for j = 0, 2, 4.
inline constexpr float kEven0 = 2 * kNorm;
inline constexpr float kEven2 = 2 * kNorm / 3;
inline constexpr float kEven4 = 2 * kNorm / 5;

/// N INT xi^6 / (1 - kappa xi) over [-1, 1] as a polynomial in kappa^2, interpolated at the
/// Chebyshev nodes of [0, 1/4]: the pieces that PreSplit makes have |kappa| <= 1/2. Relative
/// error 1.6e-6.
inline constexpr float kTail[5] = {0.28571470124260745f * kNorm, 0.22213949098293828f * kNorm,
                                   0.18440301882624793f * kNorm, 0.12638956453778222f * kNorm,
                                   0.2447734917299931f * kNorm};

/// Below this a curvature is that of a point at the apex of a cone, where the field has no limit.
inline constexpr float kLeastCurvature = 1e-30f;

/// Values below this count as 0 where they would be divided by.
inline constexpr float kLeastValue = 1e-30f;

/// Gradients below this, in 1 / length, mean that the distance is beyond every limit.
inline constexpr float kLeastSlope = 1e-30f;

/// kLeastPsi of psi.h.
inline constexpr float kLeastPsiFloat = 0.25f;

/// Where the bounds on a ball are sharpest, in local radii beyond the nearest place of the segment;
/// and the least distance for it, in radii of the ball, which must be above 1. Chosen for the
/// tightest bounds on random blocks.
inline constexpr float kTypicalOffset = 0.1f;
inline constexpr float kLeastTouch = 1.05f;

/// How far a kernel reaches, in radii, and a little for rounding.
inline constexpr float kSupport = 2.001f;

/// The dominating quadratic is used while its curvature is at least this share of its terms.
inline constexpr float kLeastShape = 0.02f;

/// Of the guess for a seventh root: (6/7) of the bits of 1, less what makes the largest error
/// smallest.
inline constexpr float kRootBias = (6.f / 7) * (0x3f800000 - 0x00060000);

}  // namespace lascaux::internal
