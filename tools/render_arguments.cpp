#include "render_arguments.h"

#include <CLI/CLI.hpp>

#include "picture_arguments.h"

namespace lascaux {

void AddRender(CLI::App& app, RenderCommandOptions& options, int& threads) {
  constexpr int kMostPictures = 9999;
  app.add_option("MODEL", options.models, "Level sets (.vdb); - reads from standard input")
      ->required();
  app.add_option(
         "-o,--output", options.outputs,
         "A file to write, again for each more: .png .exr; {} stands for the model's name, #### "
         "for the number of a picture")
      ->type_name("FILE")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--as", options.format, "png or exr, whatever the endings of the outputs")
      ->check(CLI::IsMember({"png", "exr"}))
      ->type_name("FORMAT");
  AddViews(app, options.views);
  app.add_option("--turntable", options.turntable, "Turns the model around once in N pictures")
      ->check(CLI::Range(1, kMostPictures))
      ->type_name("N");
  app.add_flag("--contact-sheet", options.contact_sheet,
               "All four views, or those of --view, on one sheet; several models share it when the "
               "output's name is without {}");
  app.add_option("--columns", options.columns, "Pictures in a row of a sheet")
      ->check(CLI::Range(1, kMostPictures))
      ->type_name("N");
  const auto side = CLI::Range(1, kLargestPicture);
  app.add_option("--width", options.render.width, "Of a picture, in pixels")
      ->check(side)
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--height", options.render.height, "Of a picture, in pixels")
      ->check(side)
      ->capture_default_str()
      ->type_name("N");
  AddPictureSize(app, "--size", options.render)->excludes("--width")->excludes("--height");
  AddBackground(app, options.render);
  AddMaterial(app, options.render);
  app.add_option("--grid", options.grid, "Name of the level set (default surface, or the first)")
      ->type_name("NAME");
  app.add_option("--threads", threads, "Worker threads (default: all)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.add_flag_callback(
      "--quiet,-q", [&options] { options.verbosity = Verbosity::kQuiet; },
      "No progress and no notes; warnings and errors stay");
  app.allow_extras(false);
}

}  // namespace lascaux
