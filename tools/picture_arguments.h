#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/volume/render_options.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// @file
/// Options of pictures on the command line.

namespace lascaux {

inline constexpr int kLargestPicture = 16384;  ///< pixels: the most that viewers take

/// Adds --view, which takes one view or several with commas.
void AddViews(CLI::App& app, std::vector<View>& views);

/// Adds an option of this name for width and height at once.
CLI::Option* AddPictureSize(CLI::App& app, const std::string& name, RenderOptions& render);

/// Adds --background.
void AddBackground(CLI::App& app, RenderOptions& render);

/// Adds --material.
void AddMaterial(CLI::App& app, RenderOptions& render);

/// Linear light of a colour as written in HTML, "#rgb" or "#rrggbb" in sRGB; nothing for other
/// texts.
std::optional<std::array<float, 3>> ReadColor(const std::string& text);

}  // namespace lascaux
