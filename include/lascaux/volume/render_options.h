#pragma once

#include <array>
#include <cstdint>

/// @file
/// What a picture shows, apart from how it is made: without OpenVDB, which takes seconds to
/// compile.

namespace lascaux {

/// The drawn side, the face, between the two, from above.
enum class View : std::uint8_t { kSide, kFront, kThreeQuarter, kTop };

/// Where the model's head is along x: kFront and kThreeQuarter show it. kHigher is a guess for when
/// nothing is known: at the end that reaches higher, which is wrong for whales.
enum class Head : std::uint8_t { kHigher, kRight, kLeft };

/// What is behind the model. kStudio: a pale floor that runs into the backdrop, opaque. kColor: one
/// colour, opaque. kTransparent: nothing; the shadow is black of some alpha, to lie on any page.
enum class Backdrop : std::uint8_t { kStudio, kTransparent, kColor };

/// What the model is made of. kClay: clay. kDrawing: painted in the drawing's colours (a grid of
/// colours). kParts: clay of another colour for each part (a grid of parts).
enum class Material : std::uint8_t { kClay, kDrawing, kParts };

/// How the camera stands. kView: centred on what this view shows, which fills the frame.
/// kTurntable: so that the model stays in the frame however it is turned, at one scale.
enum class Framing : std::uint8_t { kView, kTurntable };

/// kColor leaves depth, normals and parts out of the picture.
enum class Layers : std::uint8_t { kColor, kAll };

struct RenderOptions {
  int width = 512, height = 512;  ///< pixels, at least 1
  View view = View::kThreeQuarter;
  double turn =
      0;  ///< degrees about the vertical, added to the view's: the camera goes to the right
  Head head = Head::kHigher;
  Framing framing = Framing::kView;
  Material material = Material::kClay;
  Backdrop backdrop = Backdrop::kStudio;
  std::array<float, 3> backdrop_color = {1, 1, 1};  ///< for kColor: linear, sRGB primaries
  Layers layers = Layers::kColor;

  bool operator==(const RenderOptions&) const = default;
};

}  // namespace lascaux
