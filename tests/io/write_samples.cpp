#include <cstdio>
#include <filesystem>

#include "io/samples.h"
#include "lascaux/io/write_3mf.h"
#include "lascaux/io/write_exr.h"
#include "lascaux/io/write_glb.h"
#include "lascaux/io/write_obj.h"
#include "lascaux/io/write_ply.h"
#include "lascaux/io/write_png.h"
#include "lascaux/io/write_stl.h"
#include "lascaux/io/write_usda.h"
#include "lascaux/io/write_vdb.h"

/// Writes one file of each format into a folder, for readers that are not ours (check_formats.py).
int main(int argc, char** argv) {
  using namespace lascaux;  // NOLINT(google-build-using-namespace)
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  Diagnostics diagnostics;
  const auto log = [&](const Diagnostics& found) {
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
  };
  const Mesh mesh = SampleSphere(5);
  log(WriteStl(folder / "sphere.stl", mesh));
  log(WritePly(folder / "sphere.ply", mesh, {}, {.unit = Unit::kMillimetre}));
  const MeshDetails details = SampleDetails(mesh);
  const MeshFileOptions options{Unit::kMetre, "sphere", {{"creator", "lascaux test"}}};
  log(WritePly(folder / "parts.ply", mesh, details, options));
  log(WriteObj(folder / "sphere.obj", mesh, details, options));
  log(WriteGlb(folder / "sphere.glb", mesh, details, options));
  log(WriteUsda(folder / "sphere.usda", mesh, details, {options, "sphere.vdb"}));
  log(Write3mf(folder / "sphere.3mf", mesh, details, {options, SamplePicture(32, 32)}));
  const auto grid = SampleLevelSet(0.4);
  log(WriteVdb(folder / "sphere.vdb", *grid, {.metadata = {{"creator", "lascaux test"}}}));
  log(WriteVdb(folder / "sphere_mm.vdb", *grid, {.unit = Unit::kMillimetre}));
  log(WritePng(folder / "picture.png", SamplePicture(40, 30)));
  log(WriteExr(folder / "layers.exr", SampleLayers(40, 30)));
  for (const Diagnostic& diagnostic : diagnostics) std::puts(diagnostic.message.c_str());
  return diagnostics.empty() ? 0 : 1;
}
