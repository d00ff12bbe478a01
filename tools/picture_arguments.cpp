#include "picture_arguments.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <map>
#include <string>

#include "choice.h"
#include "lascaux/base/srgb.h"

namespace lascaux {
namespace {

constexpr const char* kViewNames = "side, front, three-quarter, top";

const std::map<std::string, View>& Views() {
  static const std::map<std::string, View> kViews = {{"side", View::kSide},
                                                     {"front", View::kFront},
                                                     {"three-quarter", View::kThreeQuarter},
                                                     {"top", View::kTop}};
  return kViews;
}

float ToLinear(int level) { return static_cast<float>(DecodeSrgb(level / 255.0)); }

}  // namespace

std::optional<std::array<float, 3>> ReadColor(const std::string& text) {
  const std::size_t digits = text.size() - 1;
  if (text.empty() || text[0] != '#' || (digits != 3 && digits != 6) ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos) {
    return std::nullopt;
  }
  std::array<float, 3> color = {};
  for (std::size_t i = 0; i < color.size(); ++i) {
    std::string level = text.substr(1 + i * digits / 3, digits / 3);
    if (level.size() == 1) level += level;
    color[i] = ToLinear(std::stoi(level, nullptr, 16));
  }
  return color;
}

void AddViews(CLI::App& app, std::vector<View>& views) {
  app.add_option_function<std::vector<std::string>>(
         "--view",
         [&views](const std::vector<std::string>& names) {
           views.clear();
           for (const std::string& name : names) {
             const auto view = Views().find(name);
             if (view == Views().end()) {
               throw CLI::ValidationError("--view", "'" + name + "' is none of " + kViewNames);
             }
             views.push_back(view->second);
           }
         },
         std::string("From where: ") + kViewNames + " (default three-quarter)")
      ->delimiter(',')
      ->type_name("VIEW");
}

CLI::Option* AddPictureSize(CLI::App& app, const std::string& name, RenderOptions& render) {
  return app
      .add_option_function<int>(
          name, [&render](int size) { render.width = render.height = size; },
          "Width and height of a picture, in pixels (default 512)")
      ->check(CLI::Range(1, kLargestPicture))
      ->type_name("N");
}

void AddBackground(CLI::App& app, RenderOptions& render) {
  app.add_option_function<std::string>(
         "--background",
         [&render](const std::string& text) {
           if (text == "studio") {
             render.backdrop = Backdrop::kStudio;
           } else if (text == "transparent") {
             render.backdrop = Backdrop::kTransparent;
           } else if (const auto color = ReadColor(text)) {
             render.backdrop = Backdrop::kColor;
             render.backdrop_color = *color;
           } else {
             throw CLI::ValidationError(
                 "--background",
                 "'" + text + "' is neither studio, transparent nor a colour such as #ffeedd");
           }
         },
         "studio (default), transparent, or a colour such as #ffeedd")
      ->type_name("WHAT");
}

void AddMaterial(CLI::App& app, RenderOptions& render) {
  AddChoice<Material>(
      app, "--material", render.material,
      {{"clay", Material::kClay}, {"drawing", Material::kDrawing}, {"parts", Material::kParts}},
      "clay (default), drawing (the colours that the drawing is painted in), or parts "
      "(a colour for each part)")
      ->type_name("WHAT");
}

}  // namespace lascaux
