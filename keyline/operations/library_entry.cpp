#include "keyline/operations/library_entry.h"

#include <algorithm>

namespace keyline::operations {
namespace {

std::vector<double> numbers(const std::optional<library::TurningProfile>& turning) {
  if (!turning) return {};
  return {turning->begin(), turning->end()};
}

std::optional<library::TurningProfile> profile(const std::vector<double>& numbers) {
  if (numbers.size() != library::kTurningParts) return std::nullopt;
  library::TurningProfile turning{};
  std::ranges::transform(numbers, turning.begin(), [](double x) { return static_cast<float>(x); });
  return turning;
}

}  // namespace

LibraryEntry entry_shown(const library::Entry& e) {
  LibraryEntry shown;
  const document::Label& label = library::label(e);
  shown.kind = e.kind;
  shown.name = label.name;
  shown.layer = label.layer;
  shown.color = label.color;
  shown.unit = e.thing.unit;
  shown.source = e.source;
  if (!e.thing.paths.empty()) shown.curve = simplest(e.thing.paths.front().path);
  if (!e.thing.space_curves.empty()) shown.curve = e.thing.space_curves.front().curve;
  if (!e.thing.surfaces.empty()) shown.surface = e.thing.surfaces.front().surface;
  shown.size = e.size;
  shown.length = e.length;
  shown.volume = e.volume;
  if (e.curvature_min && e.curvature_max) shown.curvature = {{*e.curvature_min, *e.curvature_max}};
  shown.pieces = e.pieces;
  shown.cav_type = e.cav_type;
  shown.cav = e.cav;
  shown.nearest_cav = e.nearest_cav;
  shown.nearest_distance = e.nearest_distance;
  shown.sav = e.sav;
  shown.turning = numbers(e.turning);
  shown.thumbnail = e.thumbnail;
  shown.notes = e.notes;
  return shown;
}

core::Result<library::Entry> entry_of(const LibraryEntry& shown) {
  library::Entry e;
  const document::Label label{shown.name, shown.layer, shown.color};
  e.thing.unit = shown.unit;
  if (shown.surface) {
    e.thing.surfaces.push_back({label, *shown.surface, 0, {}});
  } else if (shown.curve && planar_path(*shown.curve)) {
    e.thing.paths.push_back({label, *planar_path(*shown.curve), 0});
  } else if (shown.curve && std::holds_alternative<document::SpaceCurve>(*shown.curve)) {
    e.thing.space_curves.push_back({label, std::get<document::SpaceCurve>(*shown.curve)});
  } else {
    return core::fail(core::ErrorCode::bad_input, "an entry has neither a curve nor a surface",
                      "give entries as library.measure does");
  }
  e.kind = shown.kind;
  e.source = shown.source;
  e.size = shown.size;
  e.length = shown.length;
  e.volume = shown.volume;
  if (shown.curvature) {
    e.curvature_min = (*shown.curvature)[0];
    e.curvature_max = (*shown.curvature)[1];
  }
  e.pieces = shown.pieces;
  e.cav_type = shown.cav_type;
  e.cav = shown.cav;
  e.nearest_cav = shown.nearest_cav;
  e.nearest_distance = shown.nearest_distance;
  e.sav = shown.sav;
  e.turning = profile(shown.turning);
  e.thumbnail = shown.thumbnail;
  e.notes = shown.notes;
  return e;
}

}  // namespace keyline::operations
