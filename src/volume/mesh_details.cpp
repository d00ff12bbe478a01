#include "lascaux/volume/mesh_details.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lascaux/base/srgb.h"

namespace lascaux {
namespace {

constexpr double kLightness = 0.76, kChroma = 0.095;       // inside the sRGB gamut at every hue
constexpr double kFirstHue = 65 * std::numbers::pi / 180;  // clay

}  // namespace

std::uint8_t SrgbFromLinear(double value) noexcept {
  return static_cast<std::uint8_t>(std::lround(255 * EncodeSrgb(std::clamp(value, 0.0, 1.0))));
}

float LinearFromSrgb(std::uint8_t value) noexcept {
  return static_cast<float>(DecodeSrgb(value / 255.0));
}

std::vector<std::uint16_t> PartsOfTriangles(std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const std::vector<std::uint16_t>& vertex_parts) {
  std::vector<std::uint16_t> result(triangles.size());
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
    const auto& [a, b, c] = triangles[t];
    const bool others = vertex_parts[b] == vertex_parts[c];
    result[t] = vertex_parts[others ? b : a];
  });
  return result;
}

Srgb8 PartColor(int index) noexcept {
  constexpr double kGoldenAngle = 2 * std::numbers::pi / (1 + std::numbers::phi);
  const double hue = kFirstHue + index * kGoldenAngle;
  const double a = kChroma * std::cos(hue), b = kChroma * std::sin(hue);
  // B. Ottosson, "A perceptual color space for image processing", 2020: OKLab to linear sRGB.
  const Eigen::Array3d lms = Eigen::Array3d(kLightness + 0.3963377774 * a + 0.2158037573 * b,
                                            kLightness - 0.1055613458 * a - 0.0638541728 * b,
                                            kLightness - 0.0894841775 * a - 1.2914855480 * b)
                                 .cube();
  return {
      SrgbFromLinear(4.0767416621 * lms[0] - 3.3077115913 * lms[1] + 0.2309699292 * lms[2]),
      SrgbFromLinear(-1.2684380046 * lms[0] + 2.6097574011 * lms[1] - 0.3413193965 * lms[2]),
      SrgbFromLinear(-0.0041960863 * lms[0] - 0.7034186147 * lms[1] + 1.7076147010 * lms[2]),
  };
}

}  // namespace lascaux
