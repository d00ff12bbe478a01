#include "record_print.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "lascaux/volume/part_of_points.h"
#include "mesh_details_of.h"

namespace lascaux {
namespace {

constexpr std::size_t kNamedParts = 3;  // in a message
constexpr Srgb8 kPlateColor = {128, 128, 128};

std::string PlaceText(const Eigen::Vector3d& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", p.x(), p.y(), p.z());
}

Diagnostic ThickenedNote(const PrintRecord& record, double wall) {
  std::string parts;
  const std::size_t named = std::min(record.thickened.size(), kNamedParts);
  for (std::size_t i = 0; i < named; ++i) {
    const ThickenedPart& part = record.thickened[i];
    parts += fmt::format("{}{} ({:.2f} mm at {})", i > 0 ? ", " : "", part.part,
                         part.thinnest.thickness, PlaceText(part.thinnest.middle));
  }
  if (record.thickened.size() > named)
    parts += fmt::format(" and {} more parts", record.thickened.size() - named);
  return Note("wall-thickened",
              fmt::format("made {:.3g} mm thick where it was thinner: {}; sides "
                          "moved by up to {:.2f} mm",
                          wall, parts, (wall - record.thickened[0].thinnest.thickness) / 2));
}

Diagnostic StillThinWarning(const std::vector<Wall>& walls, double wanted) {
  const Wall& thinnest = *std::min_element(
      walls.begin(), walls.end(), [](auto& a, auto& b) { return a.thickness < b.thickness; });
  return Warning("wall-still-thin",
                 fmt::format("only {:.2f} mm thick at {}, not {:.3g}: the voxels are too coarse "
                             "there; take a higher --resolution",
                             thinnest.thickness, PlaceText(thinnest.middle), wanted));
}

Diagnostic PlateNote(const Plate& plate) {
  return Note("base-added", fmt::format("it would not stand: a plate {:.1f} mm thick is under its "
                                        "feet, reaching {:.1f} mm beyond them",
                                        plate.top - plate.bottom, plate.margin));
}

Diagnostic CavityDiagnostic(const std::optional<Cavity>& cavity, double wall) {
  if (!cavity)
    return Warning("not-hollowed",
                   fmt::format("walls of {:.3g} mm leave no room for a cavity that can be drained: "
                               "ask for thinner walls, or a larger --size",
                               wall));
  return Note("hollowed",
              fmt::format("walls of {:.3g} mm save {:.0f} % of the volume; a drain {:.1f} mm wide "
                          "opens downwards at {}",
                          wall, 100 * cavity->saved, cavity->drain, PlaceText(cavity->opening)));
}

}  // namespace

PrintRecord RecordOf(PrintChanges changes, const Model& model, const Execution& execution) {
  PrintRecord record;
  std::vector<Eigen::Vector3f> places;
  for (const Wall& wall : changes.thickened) places.push_back(wall.middle.cast<float>());
  const std::vector<std::uint16_t> parts =
      PartOfPoints(*model.field, places, {0, -model.lift, 0}, execution);
  const std::vector<MeshPart> names = FieldPartsOf(model);
  std::map<std::uint16_t, Wall> thinnest;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::uint16_t part = parts[i] == kNoPart ? 0 : parts[i];
    const auto [entry, is_new] = thinnest.try_emplace(part, changes.thickened[i]);
    if (!is_new && changes.thickened[i].thickness < entry->second.thickness)
      entry->second = changes.thickened[i];
  }
  for (const auto& [part, wall] : thinnest) record.thickened.push_back({names[part].name, wall});
  std::stable_sort(record.thickened.begin(), record.thickened.end(),
                   [](auto& a, auto& b) { return a.thinnest.thickness < b.thinnest.thickness; });
  record.changes = std::move(changes);
  return record;
}

void Lift(PrintRecord& record, double by) {
  for (Wall& wall : record.changes.thickened) wall.middle.y() += by;
  for (Wall& wall : record.changes.still_thin) wall.middle.y() += by;
  for (ThickenedPart& part : record.thickened) part.thinnest.middle.y() += by;
  if (auto& plate = record.changes.plate) plate->bottom += by, plate->top += by;
  if (auto& cavity = record.changes.cavity) cavity->opening.y() += by;
}

Diagnostics DescribeChanges(const PrintRecord& record, const PrintOptions& options) {
  Diagnostics log;
  if (options.min_wall && !record.thickened.empty())
    log.push_back(ThickenedNote(record, *options.min_wall));
  if (options.min_wall && !record.changes.still_thin.empty())
    log.push_back(StillThinWarning(record.changes.still_thin, *options.min_wall));
  if (record.changes.plate) {
    log.push_back(PlateNote(*record.changes.plate));
  } else if (options.base != Base::kNone) {
    log.push_back(Note("stands-alone", "it stands safely on its feet: no base is added"));
  }
  if (options.hollow) log.push_back(CavityDiagnostic(record.changes.cavity, *options.hollow));
  return log;
}

void MarkPlate(const PrintRecord& record, const Mesh& mesh, MeshDetails& details) {
  const auto& plate = record.changes.plate;
  if (!plate) return;
  const double skin = 0.1 * (plate->top - plate->bottom);  // more than the mesh is off the plate
  const auto index = static_cast<std::uint16_t>(details.parts.size());
  details.parts.push_back({"base", kPlateColor});
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (plate->Distance(mesh.vertices[v].cast<double>()) <= skin) details.vertex_parts[v] = index;
}

Json PrintRecordJson(const std::optional<PrintRecord>& record) {
  if (!record) return nullptr;
  Json json = {{"thickened", Json::array()}, {"base", nullptr}, {"cavity", nullptr}};
  for (const ThickenedPart& part : record->thickened)
    json["thickened"].push_back({{"part", part.part},
                                 {"was", part.thinnest.thickness},
                                 {"at", PlaceJson(part.thinnest.middle)}});
  if (const auto& plate = record->changes.plate)
    json["base"] = {{"thickness", plate->top - plate->bottom}, {"margin", plate->margin}};
  if (const auto& cavity = record->changes.cavity)
    json["cavity"] = {{"saved_percent", 100 * cavity->saved},
                      {"drain", cavity->drain},
                      {"opening", PlaceJson(cavity->opening)}};
  return json;
}

}  // namespace lascaux
