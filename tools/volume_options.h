#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/io/units.h"
#include "lascaux/io/write_vdb_options.h"
#include "lascaux/volume/model_volume.h"
#include "output_plan.h"

namespace lascaux {

/// Programs with habits of their own.
enum class Preset : std::uint8_t { kHoudini, kBlender, kUnreal, kPrint };

/// What a .vdb holds beside the surface, and how.
struct VolumeOptions {
  std::optional<Preset> preset;  ///< what was asked for; the rest has it already
  UpAxis up = UpAxis::kY;
  VdbFloats floats = VdbFloats::kFull;
  Companions companions;

  bool operator==(const VolumeOptions&) const = default;
};

/// True for what is more than the surface in floats of 32 bits: that is written without OpenVDB.
bool NeedsOpenVdb(const VolumeOptions& options) noexcept;

/// The unit of the scene formats and the volume that a program takes best.
struct PresetOptions {
  Unit unit = Unit::kMetre;
  VolumeOptions volume;
};

/// - Houdini works in metres, y up, with level sets called "surface": the model's own conventions.
/// - Blender imports volumes as they are, z up, in metres, and looks for a fog volume "density".
/// - Unreal has z up and centimetres; its sparse volume textures take fog volumes and keep 16 bits.
/// - Programs for printing take millimetres, z up, as .stl and .3mf have them: the level set lies
///   where the mesh lies.
PresetOptions OptionsOf(Preset preset) noexcept;

/// An error "volume-options" when something is asked of the volume and no .vdb is written.
Diagnostics CheckVolume(const VolumeOptions& options, const std::vector<OutputRequest>& outputs);

}  // namespace lascaux
