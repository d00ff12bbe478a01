#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "lascaux/sketch/trace_picture.h"
#include "sketch/sketch_invariants.h"

/// @file
/// Any bytes as a picture, and what every outcome of TracePicture() must be; for tests and the
/// fuzzer.

namespace lascaux::testing {

/// The first byte is the width (8 to 135), the second says whether there is colour and alpha, the
/// rest are the pixels.
inline Bitmap PictureOf(std::string_view bytes) {
  Bitmap picture;
  if (bytes.size() < 2) return picture;
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  picture.width = 8 + at(0) % 128;
  const std::size_t channels = at(1) % 2 == 0 ? 1 : 4;
  const std::size_t pixels = (bytes.size() - 2) / channels;
  picture.height = static_cast<int>(pixels / static_cast<std::size_t>(picture.width));
  const std::size_t used =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  for (std::size_t i = 0; i < used; ++i)
    for (std::size_t c = 0; c < 4; ++c)
      picture.rgba.push_back(channels == 4 ? at(2 + 4 * i + c) : c == 3 ? 255 : at(2 + i));
  return picture;
}

/// What is wrong with the curves of a picture; empty when nothing is.
inline std::string WrongWithTraceOf(std::string_view bytes) {
  constexpr std::array<std::string_view, 4> kCodes = {"empty-page", "no-drawing", "too-large",
                                                      "trace-incomplete"};
  const Bitmap picture = PictureOf(bytes);
  const auto outcome = TracePicture(picture);
  for (const Diagnostic& d : outcome.diagnostics()) {
    if (std::find(kCodes.begin(), kCodes.end(), d.code) == kCodes.end())
      return "an unknown code " + d.code;
    if (d.severity == Severity::kError && d.failure != FailureKind::kInput)
      return "an error that is not the input's";
  }
  if (!outcome.ok()) return HasError(outcome.diagnostics()) ? "" : "no result and no error";
  if (outcome->sketch.strokes.empty()) return "a sketch without strokes";
  for (const Stroke& stroke : outcome->sketch.strokes)
    if (std::string wrong = WrongWith(stroke); !wrong.empty()) return wrong;
  const double reach = picture.width + picture.height;
  const Eigen::AlignedBox2d box = Bounds(outcome->sketch);
  if (box.min().minCoeff() < -reach || box.max().maxCoeff() > 2 * reach)
    return "curves off the page";
  if (!(*TracePicture(picture) == *outcome)) return "not the same twice";
  return {};
}

}  // namespace lascaux::testing
