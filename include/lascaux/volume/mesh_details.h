#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// @file
/// What scene formats hold beside a mesh's triangles, as plain values.

namespace lascaux {

/// 8-bit sRGB.
using Srgb8 = std::array<std::uint8_t, 3>;

/// The linear value, 0 to 1, of an 8-bit sRGB value.
float LinearFromSrgb(std::uint8_t value) noexcept;

/// The nearest 8-bit sRGB value of a linear one.
std::uint8_t SrgbFromLinear(double value) noexcept;

/// A part of the model as people see it.
struct MeshPart {
  std::string name;  ///< unique
  Srgb8 color{};

  bool operator==(const MeshPart&) const = default;
};

/// Normals and parts of a mesh. Either list may be empty: no normals, no parts.
struct MeshDetails {
  std::vector<Eigen::Vector3f> normals;  ///< of each vertex, of length 1, outward
  std::vector<MeshPart> parts;
  /// Index in `parts` of each vertex and of each triangle; empty where there are no parts.
  std::vector<std::uint16_t> vertex_parts, triangle_parts;
  /// Of each vertex, where the drawing has colours; empty where parts have one each.
  std::vector<Srgb8> vertex_colors = {};

  /// Precondition: there are parts.
  const Srgb8& ColorOf(std::size_t vertex) const noexcept {
    return vertex_colors.empty() ? parts[vertex_parts[vertex]].color : vertex_colors[vertex];
  }

  bool operator==(const MeshDetails&) const = default;
};

/// The part of each triangle: that of two of its corners at least, else the first corner's.
std::vector<std::uint16_t> PartsOfTriangles(std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const std::vector<std::uint16_t>& vertex_parts);

/// Colours that tell parts apart: the first is clay (the body's), each next one turns the hue by
/// the golden angle, so that any number of them stays as far apart as can be.
///
/// All have one lightness and one chroma in OKLCH (Ottosson 2020), so none looks nearer or more
/// important than another.
Srgb8 PartColor(int index) noexcept;

}  // namespace lascaux
