#pragma once

/// @file
/// Constants of the map from the field to a distance, for both precisions.

namespace lascaux::internal {

/// psi is taken for at least this where it scales the gradient: beside an axis both go to 0, and
/// where fields overlap psi alone does, which would make deep places look shallow.
inline constexpr double kLeastPsi = 0.25;

}  // namespace lascaux::internal
