#include "volume_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace lascaux {
namespace {

/// The first option that changes the volume; empty for none.
std::string_view OptionOf(const VolumeOptions& options) {
  if (options.preset) return "--for";
  if (options.companions.parts) return "--parts";
  if (options.companions.fog) return "--fog";
  if (options.companions.color) return "--color";
  return options.floats == VdbFloats::kHalf ? "--half" : "";
}

}  // namespace

PresetOptions OptionsOf(Preset preset) noexcept {
  PresetOptions options;
  VolumeOptions& volume = options.volume;
  volume.preset = preset;
  switch (preset) {
    case Preset::kHoudini:
      break;
    case Preset::kBlender:
      volume.up = UpAxis::kZ;
      volume.companions.fog = true;
      break;
    case Preset::kUnreal:
      options.unit = Unit::kCentimetre;
      volume.up = UpAxis::kZ;
      volume.floats = VdbFloats::kHalf;
      volume.companions.fog = true;
      break;
    case Preset::kPrint:
      options.unit = Unit::kMillimetre;
      volume.up = UpAxis::kZ;
      break;
  }
  return options;
}

bool NeedsOpenVdb(const VolumeOptions& options) noexcept {
  return options.companions != Companions{} || options.floats != VdbFloats::kFull;
}

Diagnostics CheckVolume(const VolumeOptions& options, const std::vector<OutputRequest>& outputs) {
  const std::string_view option = OptionOf(options);
  const bool volume = std::any_of(outputs.begin(), outputs.end(), [](const OutputRequest& output) {
    return output.kind == OutputKind::kVdb;
  });
  if (option.empty() || volume) return {};
  return {Error(FailureKind::kUsage, "volume-options",
                fmt::format("{} is about volumes, and none is written: add -o FILE.vdb, or leave "
                            "it out",
                            option))};
}

}  // namespace lascaux
