#include "sketch/svg/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lascaux::svg {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr std::size_t kMaxArguments = 6;

struct Arguments {
  std::array<double, kMaxArguments> values{};
  std::size_t count = 0;
};

double Radians(double degrees) { return degrees * std::numbers::pi / 180; }

Affine2d FromColumns(const std::array<double, 6>& m) {
  Affine2d result;
  result.matrix() << m[0], m[2], m[4], m[1], m[3], m[5], 0, 0, 1;
  return result;
}

/// The quarter turns exactly: sin(pi) is not 0 in floating point, and drawings are turned by right
/// angles.
Affine2d Rotation(double degrees) {
  const double quarters = degrees / 90;
  if (std::abs(quarters) < 1e6 && quarters == std::floor(quarters)) {
    constexpr std::array<double, 4> kSines{0, 1, 0, -1};
    const auto quarter = static_cast<std::size_t>(static_cast<long>(quarters) & 3);
    const double s = kSines[quarter], c = kSines[(quarter + 1) & 3];
    return FromColumns({c, s, -s, c, 0, 0});
  }
  const double s = std::sin(Radians(degrees)), c = std::cos(Radians(degrees));
  return FromColumns({c, s, -s, c, 0, 0});
}

/// One function of the list; nothing when the name or the number of arguments is wrong.
std::optional<Affine2d> Function(std::string_view name, const Arguments& arguments) {
  const auto& v = arguments.values;
  const std::size_t n = arguments.count;
  if (name == "matrix" && n == 6) return FromColumns(v);
  if (name == "translate" && (n == 1 || n == 2)) return FromColumns({1, 0, 0, 1, v[0], v[1]});
  if (name == "scale" && n == 1) return FromColumns({v[0], 0, 0, v[0], 0, 0});
  if (name == "scale" && n == 2) return FromColumns({v[0], 0, 0, v[1], 0, 0});
  if (name == "rotate" && n == 1) return Rotation(v[0]);
  if (name == "rotate" && n == 3) {
    return FromColumns({1, 0, 0, 1, v[1], v[2]}) * Rotation(v[0]) *
           FromColumns({1, 0, 0, 1, -v[1], -v[2]});
  }
  if (name == "skewx" && n == 1) return FromColumns({1, 0, std::tan(Radians(v[0])), 1, 0, 0});
  if (name == "skewy" && n == 1) return FromColumns({1, std::tan(Radians(v[0])), 0, 1, 0, 0});
  return std::nullopt;
}

/// What stands in the parentheses; on return without a fault the closing one has been read.
std::optional<Arguments> ReadArguments(Cursor& cursor) {
  Arguments arguments;
  cursor.SkipSpace();
  if (!cursor.Take('(')) return std::nullopt;
  cursor.SkipSpace();
  while (!cursor.Take(')')) {
    const std::optional<double> number = cursor.Number();
    if (!number || arguments.count == kMaxArguments) return std::nullopt;
    const std::string_view unit = cursor.TakeWord();
    if (!unit.empty() && unit != "px" && unit != "deg") return std::nullopt;
    arguments.values[arguments.count++] = *number;
    cursor.SkipSeparator();
  }
  return arguments;
}

/// Where in the room that is left over the box goes: 0, 1/2 or 1 for Min, Mid or Max.
double Alignment(std::string_view align, char axis) {
  for (std::size_t i = 0; i + 4 <= align.size(); ++i) {
    if (ToLower(align[i]) != axis) continue;
    const std::string_view word = align.substr(i + 1, 3);
    if (word == "Min") return 0;
    if (word == "Max") return 1;
  }
  return 0.5;
}

}  // namespace

Transform ParseTransform(std::string_view text) {
  Transform result;
  Cursor cursor(text);
  cursor.SkipSpace();
  if (Trimmed(text) == "none") return result;
  while (!cursor.AtEnd()) {
    std::array<char, 9> name{};
    const std::string_view word = cursor.TakeWord();
    const bool known_length = word.size() <= name.size();
    if (known_length) std::transform(word.begin(), word.end(), name.begin(), ToLower);
    const std::optional<Arguments> arguments = ReadArguments(cursor);
    const std::optional<Affine2d> factor =
        arguments && known_length ? Function(std::string_view(name.data(), word.size()), *arguments)
                                  : std::nullopt;
    if (!factor) {
      const bool not_finite = cursor.fault() == Fault::kNotFinite;
      return {Affine2d::Identity(), not_finite ? Fault::kNotFinite : Fault::kSyntax,
              cursor.position()};
    }
    result.value = result.value * *factor;
    cursor.SkipSeparator();
  }
  if (!result.value.matrix().allFinite()) result.fault = Fault::kNotFinite;
  return result;
}

std::optional<Box> ParseViewBox(std::string_view text) {
  Cursor cursor(text);
  std::array<double, 4> values{};
  cursor.SkipSpace();
  for (double& value : values) {
    const std::optional<double> number = cursor.Number();
    if (!number) return std::nullopt;
    value = *number;
    cursor.SkipSeparator();
  }
  if (!cursor.AtEnd() || !(values[2] > 0) || !(values[3] > 0)) return std::nullopt;
  return Box{values[0], values[1], values[2], values[3]};
}

Affine2d FitViewBox(const Box& view_box, const Box& viewport,
                    std::string_view preserve_aspect_ratio) {
  std::string_view preserve = Trimmed(preserve_aspect_ratio);
  if (preserve.starts_with("defer")) preserve = Trimmed(preserve.substr(5));
  double scale_x = viewport.width / view_box.width, scale_y = viewport.height / view_box.height;
  double x = viewport.x, y = viewport.y;
  if (!preserve.starts_with("none")) {
    const bool slice = preserve.ends_with("slice");
    const double scale = slice ? std::max(scale_x, scale_y) : std::min(scale_x, scale_y);
    x += Alignment(preserve, 'x') * (viewport.width - scale * view_box.width);
    y += Alignment(preserve, 'y') * (viewport.height - scale * view_box.height);
    scale_x = scale_y = scale;
  }
  return FromColumns({scale_x, 0, 0, scale_y, x - scale_x * view_box.x, y - scale_y * view_box.y});
}

}  // namespace lascaux::svg
