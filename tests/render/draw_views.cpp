#include <openvdb/io/File.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>

#include "lascaux/io/write_png.h"
#include "lascaux/volume/render_grids.h"
#include "render/animal.h"

/// Draws the four views of a level set for people to look at: draw_views FOLDER [MODEL.vdb [WIDTH
/// HEIGHT]].
int main(int argc, char** argv) {
  using namespace lascaux;  // NOLINT(google-build-using-namespace)
  if (argc < 2) return 2;
  openvdb::FloatGrid::Ptr grid;
  if (argc > 2) {
    openvdb::initialize();
    openvdb::io::File file(argv[2]);
    file.open(/*delayLoad=*/false);
    grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
  } else {
    grid = Animal(256);
  }
  RenderOptions options;
  if (argc > 4) options.width = std::stoi(argv[3]), options.height = std::stoi(argv[4]);
  for (const auto& [view, name] :
       {std::pair{View::kThreeQuarter, "three-quarter"}, std::pair{View::kSide, "side"},
        std::pair{View::kFront, "front"}, std::pair{View::kTop, "top"}}) {
    options.view = view;
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu_begin = std::clock();
    const auto image = Render({grid}, options);
    const double cpu = 1e3 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - begin;
    std::printf("%s: %.1f ms, %.1f ms of processors\n", name, wall.count(), cpu);
    if (!image) return 1;
    const auto path = std::filesystem::path(argv[1]) / (std::string(name) + ".png");
    if (!WritePng(path, ToImage(*image)).empty()) return 1;
  }
  return 0;
}
