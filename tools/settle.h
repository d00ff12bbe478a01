#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model.h"

/// @file
/// What happens between the mesh and its measurements: the model is put on the ground and compared
/// with the drawing.

namespace lascaux {

/// Moves the model so that the mesh's lowest vertex is at y = 0: mesh, grid, frame and what was
/// changed for printing, by the same amount.
///
/// Precondition: mesh, grid and frame are there. The lowest vertex is exactly 0 afterwards.
void StandOnGround(Model& model);

/// Outlines of the parts that are built (neither background nor ignored), in the model's x and y;
/// rings without points for the others. The plate under the feet, when there is one, comes last.
///
/// Precondition: parts, graph and frame are there.
std::vector<std::vector<Eigen::Vector2d>> BuiltOutlines(const Model& model);

/// Where the head is, so that the preview can show the face: the end at which the eyes are.
enum class HeadEnd : std::uint8_t { kUnknown, kRight, kLeft };

/// kUnknown without eyes, and when they are in the middle tenth of the animal.
///
/// Precondition: parts and graph are there.
HeadEnd FindHead(const Model& model);

}  // namespace lascaux
