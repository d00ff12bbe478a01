#include "lascaux/volume/volume_grids.h"

#include <fmt/format.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/volume/level_set.h"
#include "lascaux/volume/part_of_points.h"

namespace lascaux {
namespace {

using openvdb::Vec3SGrid;
using Grids = std::vector<openvdb::GridBase::ConstPtr>;

openvdb::FloatGrid::Ptr LevelSetOf(const NarrowBand& band, UpAxis up, const Execution& execution) {
  return ToLevelSet(up == UpAxis::kY ? band : TurnedZUp(band), execution);
}

openvdb::FloatGrid::Ptr FogOf(const openvdb::FloatGrid& surface) {
  const openvdb::FloatGrid::Ptr fog = surface.deepCopy();
  openvdb::tools::sdfToFogVolume(*fog);
  fog->setName("density");
  return fog;
}

/// A grid with the places of the other one and a background.
template <typename Grid>
typename Grid::Ptr Beside(const openvdb::BoolGrid& places,
                          const typename Grid::ValueType& background) {
  const auto tree =
      std::make_shared<typename Grid::TreeType>(places.tree(), background, openvdb::TopologyCopy());
  const typename Grid::Ptr grid = Grid::create(tree);
  grid->setTransform(places.transform().copy());
  return grid;
}

/// Calls `use(value iterator, index)` for each active value, tiles and voxels, always in one order.
template <typename Grid, typename Use>
void ForEachValue(Grid& grid, Use&& use) {
  std::size_t i = 0;
  for (auto value = grid.beginValueOn(); value; ++value) use(value, i++);
}

using Places = std::vector<Eigen::Vector3f>;

/// Where the active values of `places` are, in the model's axes.
Places PlacesOf(openvdb::BoolGrid& places, const ModelVolume& model) {
  Places points;
  ForEachValue(places, [&](const auto& value, std::size_t) {
    const openvdb::Vec3d p = places.indexToWorld(value.getBoundingBox().getCenter());
    points.push_back(ToModelAxes({p.x(), p.y(), p.z()}, model.up).template cast<float>());
  });
  return points;
}

std::vector<std::uint16_t> PartsAt(const Places& places, const ModelVolume& model,
                                   const Execution& execution) {
  std::vector<std::uint16_t> parts =
      PartOfPoints(model.field, places, {0, -model.lift, 0}, execution);
  std::replace(parts.begin(), parts.end(), kNoPart, std::uint16_t{0});
  return parts;
}

/// The colours and parts of the active values of `places`.
ColorGrids ColorsAt(openvdb::BoolGrid& places, const ModelVolume& model,
                    const Execution& execution) {
  const Places at = PlacesOf(places, model);
  const std::vector<std::uint16_t> parts = PartsAt(at, model, execution);
  const auto color = Beside<Vec3SGrid>(places, openvdb::Vec3f(0));
  ForEachValue(*color, [&](const auto& value, std::size_t i) {
    if (model.colors != nullptr) {
      const Eigen::Array3f c = model.colors->At(parts[i], at[i].x(), at[i].y());
      value.setValue({c[0], c[1], c[2]});
    } else {
      const Srgb8& srgb = model.parts[parts[i]].color;
      value.setValue({LinearFromSrgb(srgb[0]), LinearFromSrgb(srgb[1]), LinearFromSrgb(srgb[2])});
    }
  });
  color->setName("Cd");
  color->setVectorType(openvdb::VEC_INVARIANT);
  const auto index = Beside<openvdb::FloatGrid>(places, -1);
  ForEachValue(*index, [&](const auto& value, std::size_t i) {
    value.setValue(static_cast<float>(parts[i]));
  });
  index->setName("part");
  return {color, index};
}

void AddColors(const openvdb::FloatGrid& surface, const ModelVolume& model,
               const Execution& execution, Grids& grids) {
  const openvdb::BoolGrid::Ptr places = openvdb::tools::sdfInteriorMask(surface);
  places->tree().topologyUnion(surface.tree());
  places->setTransform(surface.transform().copy());
  const ColorGrids found = ColorsAt(*places, model, execution);
  grids.push_back(found.color);
  grids.push_back(found.part);
}

std::string GridName(std::string_view part, std::set<std::string>& used) {
  std::string name = "part_";
  for (const char c : part) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    name += plain ? c : '_';
  }
  while (!used.insert(name).second) name += '_';
  return name;
}

/// The level set of one part by itself, lifted as the surface is; empty when it is thinner than the
/// voxels.
Outcome<openvdb::FloatGrid::Ptr> PartLevelSet(const ModelVolume& model, std::size_t part,
                                              const Execution& execution) {
  using Result = Outcome<openvdb::FloatGrid::Ptr>;
  Field alone = model.field;
  alone.parts = {model.field.parts[part]};
  alone.parts[0].parent.reset();
  Diagnostics found;
  auto band =
      RasteriseBand(alone, {.voxel_size = model.surface.voxel_size}, execution).MoveInto(found);
  if (band) {
    band->origin.y() += model.lift;
    return LevelSetOf(*band, model.up, execution);
  }
  const bool thin = found.size() == 1 && found[0].code == "empty-field";
  if (!thin) return Result::Failure(std::move(found));
  return {openvdb::FloatGrid::Ptr(),
          {Note("part-not-in-volume",
                fmt::format("{} is thinner than the voxels and has no grid; raise --resolution",
                            model.parts[part].name))}};
}

}  // namespace

ColorGrids ColorsBesideSurface(const openvdb::FloatGrid& surface, const ModelVolume& model,
                               const Execution& execution) {
  // All corners of a cell that the surface runs through are within its diagonal.
  const auto near = static_cast<float>(1.75 * surface.voxelSize().x());
  const auto places = openvdb::BoolGrid::create(false);
  places->setTransform(surface.transform().copy());
  ColorGrids grids;
  RunInArena(execution, [&] {
    places->tree().topologyUnion(surface.tree());
    openvdb::tree::LeafManager<openvdb::BoolTree> leaves(places->tree());
    leaves.foreach ([&](openvdb::BoolTree::LeafNodeType& leaf, std::size_t) {
      const auto* const distances = surface.tree().probeConstLeaf(leaf.origin());
      for (auto on = leaf.beginValueOn(); on; ++on) {
        if (distances == nullptr || std::abs(distances->getValue(on.pos())) > near)
          leaf.setValueOff(on.pos());
      }
    });
    grids = ColorsAt(*places, model, execution);
  });
  return grids;
}

Outcome<Grids> VolumeGrids(const ModelVolume& model, const Execution& execution) {
  assert(model.parts.size() == model.field.parts.size());
  openvdb::initialize();
  Diagnostics log;
  const auto surface = LevelSetOf(model.surface, model.up, execution);
  Grids grids = {surface};
  RunInArena(execution, [&] {
    if (model.companions.fog) grids.push_back(FogOf(*surface));
    if (model.companions.color) AddColors(*surface, model, execution, grids);
  });
  if (!model.companions.parts) return grids;
  std::set<std::string> used;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const auto level_set = PartLevelSet(model, p, execution).MoveInto(log);
    if (!level_set) return Outcome<Grids>::Failure(std::move(log));
    const std::string name = GridName(model.parts[p].name, used);
    if (!*level_set) continue;
    (*level_set)->setName(name);
    grids.push_back(*level_set);
  }
  return {std::move(grids), std::move(log)};
}

}  // namespace lascaux
