#include "volume_arguments.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "choice.h"

namespace lascaux {
namespace {

const std::map<std::string, Preset>& Presets() {
  static const std::map<std::string, Preset> kPresets = {{"houdini", Preset::kHoudini},
                                                         {"blender", Preset::kBlender},
                                                         {"unreal", Preset::kUnreal},
                                                         {"print", Preset::kPrint}};
  return kPresets;
}

}  // namespace

void AddVolume(CLI::App& app, WriteOptions& options) {
  // The parser takes options in this order, whatever the order on the command line.
  app.add_option_function<std::string>(
         "--for",
         [&options](const std::string& program) {
           const PresetOptions preset = OptionsOf(Presets().at(program));
           options.unit = preset.unit;
           options.volume = preset.volume;
         },
         "Makes the .vdb, and --units, as a program takes them: houdini (m, y up), blender (m, z "
         "up, fog), unreal (cm, z up, fog, half), print (mm, z up)")
      ->check(CLI::IsMember(Presets()))
      ->type_name("PROGRAM");
  AddChoice<Unit>(app, "--units", options.unit,
                  {{"mm", Unit::kMillimetre}, {"cm", Unit::kCentimetre}, {"m", Unit::kMetre}},
                  "Unit of .vdb, .obj, .ply and .usda: mm, cm or m (default m)")
      ->type_name("UNIT");
  Companions& companions = options.volume.companions;
  app.add_flag_callback(
      "--parts", [&companions] { companions.parts = true; },
      "A level set in the .vdb for each part, too: part_body, part_limb_1, ...");
  app.add_flag_callback(
      "--fog", [&companions] { companions.fog = true; }, "A fog volume in the .vdb, too: density");
  app.add_flag_callback(
      "--color", [&companions] { companions.color = true; },
      "Colours, the drawing's or the parts', and numbers of parts in the .vdb, too: Cd, part");
  app.add_flag_callback(
      "--half", [&options] { options.volume.floats = VdbFloats::kHalf; },
      "Floats of 16 bits in the .vdb: smaller, distances within 1/2048 of themselves");
}

}  // namespace lascaux
