#include "lascaux/io/read_vdb.h"

#include <fmt/format.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "io/vdb_archive.h"

namespace lascaux {
namespace {

constexpr std::string_view kPreferred = "surface", kColorGrid = "Cd", kPartGrid = "part";
/// Scales along the axes may differ by this much, relative to themselves: float32 metadata.
constexpr double kSameScale = 1e-5;
/// Along a side; four times what a build makes at most. Far more is damage, not a model.
constexpr int kMostVoxels = 1 << 15;

using Result = Outcome<VdbModel>;

/// Damaged files bring bytes of any kind into names and into what OpenVDB says: what is not ASCII
/// becomes '?'.
Result Fail(std::string code, std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](char c) { return static_cast<signed char>(c) < ' '; },
      '?');
  return Result::Failure(Error(FailureKind::kInput, std::move(code), std::move(message)));
}

std::string ListOf(const VdbContents& contents) {
  if (contents.entries.empty()) return "the file holds no grid";
  std::string list = "the file holds";
  const char* separator = " ";
  for (const VdbEntry& entry : contents.entries) {
    list += fmt::format("{}'{}'", separator, entry.name);
    if (entry.grid) {
      list +=
          fmt::format(" ({})", openvdb::GridBase::gridClassToString(entry.grid->getGridClass()));
    } else {
      list += fmt::format(" ({})", entry.type);
    }
    separator = ", ";
  }
  return list;
}

bool IsLevelSet(const VdbEntry& entry) {
  return entry.grid && entry.grid->getGridClass() == openvdb::GRID_LEVEL_SET;
}

/// The level set that is asked for; nullptr when there is none.
openvdb::FloatGrid::Ptr Choose(const VdbContents& contents, const std::string& name) {
  openvdb::FloatGrid::Ptr first;
  for (const VdbEntry& entry : contents.entries) {
    if (!IsLevelSet(entry)) continue;
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(entry.grid);
    if (entry.name == (name.empty() ? kPreferred : std::string_view(name))) return grid;
    if (!first) first = grid;
  }
  return name.empty() ? first : nullptr;
}

Result NoLevelSet(const VdbContents& contents, const std::string& name) {
  const std::string remedy =
      "give a level set of floats: Lascaux, Houdini's VDB from Polygons and vdb_tool -mesh2ls make "
      "them, vdb_tool -iso2ls turns a fog volume into one";
  if (!name.empty()) {
    return Fail("not-level-set", fmt::format("no level set '{}': {}; name one of them, or {}", name,
                                             ListOf(contents), remedy));
  }
  return Fail("not-level-set", fmt::format("no level set: {}; {}", ListOf(contents), remedy));
}

bool HasOneScale(const openvdb::math::Transform& transform) {
  if (!transform.isLinear()) return false;
  const auto affine = transform.baseMap()->getAffineMap();
  const openvdb::Mat4d m = affine->getMat4();
  const double scale = m(0, 0);
  if (!(scale > 0) || !std::isfinite(scale)) return false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double expected = row == column ? scale : 0;
      if (!(std::abs(m(row, column) - expected) <= kSameScale * scale)) return false;
    }
  }
  return true;
}

/// All values are distances: finite, and within the background.
bool HoldsDistances(const openvdb::FloatGrid& grid) {
  const float background = grid.background();
  if (!(background > 0) || !std::isfinite(background)) return false;
  const float most = 1.01F * background;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* const values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < openvdb::FloatTree::LeafNodeType::SIZE; ++i) {
      if (!(std::abs(values[i]) <= most)) return false;
    }
  }
  return true;
}

/// The same active voxels with z, which was up, on y: (x, y, z) becomes (x, z, -y).
template <typename Grid>
typename Grid::Ptr WithYUp(const Grid& grid) {
  const auto turned = Grid::create(grid.background());
  auto accessor = turned->getAccessor();
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    const openvdb::Coord c = value.getCoord();
    accessor.setValue({c.x(), c.z(), -c.y()}, *value);
  }
  const openvdb::Vec3d origin = grid.indexToWorld(openvdb::Vec3d(0));
  turned->setTransform(openvdb::math::Transform::createLinearTransform(grid.voxelSize().x()));
  turned->transform().postTranslate({origin.x(), origin.z(), -origin.y()});
  turned->setName(grid.getName());
  turned->setGridClass(grid.getGridClass());
  return turned;
}

bool IsColor(const VdbEntry& entry) {
  return entry.name == kColorGrid && entry.grid->isType<openvdb::Vec3SGrid>();
}
bool IsPart(const VdbEntry& entry) {
  return entry.name == kPartGrid && entry.grid->isType<openvdb::FloatGrid>();
}

/// The first grid of this name and type that was read; nullptr if there is none, or none with one
/// scale.
template <typename Grid>
typename Grid::Ptr GridNamed(const VdbContents& contents, std::string_view name) {
  for (const VdbEntry& entry : contents.entries) {
    if (entry.name != name || !entry.grid || !entry.grid->isType<Grid>()) continue;
    return HasOneScale(entry.grid->transform()) ? openvdb::gridPtrCast<Grid>(entry.grid) : nullptr;
  }
  return nullptr;
}

bool IsZUp(const openvdb::MetaMap& metadata) {
  const auto axis = metadata.getMetadata<openvdb::StringMetadata>("up_axis");
  return axis && axis->value() == "Z";
}

Result Read(std::string_view bytes, const ReadVdbOptions& options) {
  VdbContents contents = ReadVdbContents(bytes, [&](const VdbEntry& entry) {
    if (options.colors && (IsColor(entry) || IsPart(entry))) return true;
    return entry.grid->isType<openvdb::FloatGrid>() &&
           (options.grid.empty() || entry.name == options.grid);
  });
  openvdb::FloatGrid::Ptr grid = Choose(contents, options.grid);
  if (!grid) return NoLevelSet(contents, options.grid);
  const std::string name = grid->getName();
  if (!HasOneScale(grid->transform())) {
    return Fail("bad-transform",
                fmt::format("'{}' is turned, or its voxels are no cubes; resample it to a uniform "
                            "scale first, such as by vdb_tool -resample",
                            name));
  }
  if (grid->activeVoxelCount() == 0) {
    return Fail("empty-grid", fmt::format("'{}' has no active voxel: there is nothing to show; "
                                          "build it with a higher --resolution",
                                          name));
  }
  if (!HoldsDistances(*grid)) {
    return Fail("bad-level-set",
                fmt::format("'{}' says that it is a level set, but its values are no distances "
                            "within its band of {}; make it again, such as by vdb_tool -iso2ls",
                            name, grid->background()));
  }
  const openvdb::Coord extent = grid->evalActiveVoxelBoundingBox().dim();
  if (std::max({extent.x(), extent.y(), extent.z()}) > kMostVoxels) {
    return Fail("too-large", fmt::format("'{}' has {} x {} x {} voxels, more than {} along a side; "
                                         "resample it to fewer",
                                         name, extent.x(), extent.y(), extent.z(), kMostVoxels));
  }
  VdbModel model{std::move(grid), GridNamed<openvdb::Vec3SGrid>(contents, kColorGrid),
                 GridNamed<openvdb::FloatGrid>(contents, kPartGrid), std::move(contents.metadata)};
  if (IsZUp(model.metadata)) {
    model.surface = WithYUp(*model.surface);
    openvdb::tools::signedFloodFill(model.surface->tree());
    if (model.color) model.color = WithYUp(*model.color);
    if (model.part) model.part = WithYUp(*model.part);
  }
  return model;
}

}  // namespace

Outcome<VdbModel> ReadVdb(std::string_view bytes, const ReadVdbOptions& options) {
  std::string reason;
  try {
    return Read(bytes, options);
  } catch (const std::bad_alloc&) {
    reason = "it asks for more memory than there is";
  } catch (const std::ios_base::failure&) {
    reason = "it ends too early";
  } catch (const std::exception& error) {
    reason = error.what();
  }
  return Fail("not-vdb",
              fmt::format("not an OpenVDB file, or a damaged one: {}; write it again", reason));
}

}  // namespace lascaux
