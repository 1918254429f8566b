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
  shown.measures = e;
  shown.turning = numbers(e.turning);
  shown.thumbnail = e.thumbnail;
  shown.notes = e.notes;
  return shown;
}

core::Result<library::Entry> entry_of(const LibraryEntry& shown) {
  library::Entry e{shown.measures,         shown.kind,      {},         shown.source,
                   profile(shown.turning), shown.thumbnail, shown.notes};
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
  return e;
}

}  // namespace keyline::operations
