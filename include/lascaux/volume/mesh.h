#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "lascaux/base/unset_allocator.h"

/// @file
/// A triangle mesh, as plain values.

namespace lascaux {

/// Corners of triangles; unset by resize().
using Triangles =
    std::vector<std::array<std::uint32_t, 3>, UnsetAllocator<std::array<std::uint32_t, 3>>>;

/// Triangles, counter-clockwise seen from outside. Model frame, millimetres.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  Triangles triangles;
  /// Of the vertices, if it is known: against the gradient of the surface's field, of length 1;
  /// (0, 0, 0) where that is not known. Empty, or as many as vertices.
  std::vector<Eigen::Vector3f> outward = {};

  bool operator==(const Mesh&) const = default;
};

}  // namespace lascaux
