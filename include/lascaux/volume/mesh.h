#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

/// @file
/// A triangle mesh, as plain values.

namespace lascaux {

/// Triangles, counter-clockwise seen from outside. Model frame, millimetres.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool operator==(const Mesh&) const = default;
};

}  // namespace lascaux
