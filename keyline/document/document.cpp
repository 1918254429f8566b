#include "keyline/document/document.h"

#include <algorithm>
#include <array>
#include <utility>

#include "keyline/core/leading_number.h"
#include "keyline/document/select.h"

namespace keyline::document {
namespace {

/// "hood" is the name of "hood", of its parts "hood/face-3" and of its later runs "hood#2".
bool within(const std::string& name, const std::string& wanted) {
  if (!name.starts_with(wanted)) return false;
  const std::size_t end = wanted.size();
  return name.size() == end || name[end] == '/' || name[end] == '#';
}

std::string known_names(const std::vector<std::string>& all) {
  constexpr std::size_t kMost = 8;
  std::string list;
  std::size_t count = 0;
  for (const std::string& name : all) {
    if (name.empty()) continue;
    if (++count > kMost) return list + " and others";
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

template <class T>
void keep_only(std::vector<T>& things, const std::vector<bool>& keep, std::size_t& at) {
  std::vector<T> kept;
  for (T& thing : things)
    if (keep[at++]) kept.push_back(std::move(thing));
  things = std::move(kept);
}

}  // namespace

std::vector<bool> chosen(const std::vector<Label>& all, const std::string& wanted) {
  std::vector<bool> keep(all.size(), wanted.empty());
  if (wanted.empty()) return keep;
  const auto any_where = [&](auto&& meant) {
    for (std::size_t i = 0; i < all.size(); ++i) keep[i] = meant(all[i]);
    return std::find(keep.begin(), keep.end(), true) != keep.end();
  };
  if (any_where([&](const Label& label) { return label.name == wanted; }) ||
      any_where([&](const Label& label) { return label.layer == wanted; }) ||
      any_where([&](const Label& label) { return within(label.name, wanted); }))
    return keep;
  const auto index = core::parse_whole<std::size_t>(wanted);
  if (!index || *index < 1 || *index > all.size()) return {};
  keep[*index - 1] = true;
  return keep;
}

std::size_t size(const Document& document) {
  return document.paths.size() + document.space_curves.size() + document.surfaces.size();
}

std::vector<Label> labels(const Document& document) {
  std::vector<Label> all;
  for (const auto& thing : document.paths) all.push_back(thing.label);
  for (const auto& thing : document.space_curves) all.push_back(thing.label);
  for (const auto& thing : document.surfaces) all.push_back(thing.label);
  return all;
}

core::Failure nothing_named(const std::string& wanted, const std::vector<std::string>& names) {
  const std::string known = known_names(names);
  const std::string numbers = "give a number from 1 to " + std::to_string(names.size());
  return {core::ErrorCode::bad_input,
          "nothing and no layer is named \"" + wanted + "\" and none has that number",
          known.empty() ? numbers : "there are " + known + "; or " + numbers, "--select"};
}

core::Result<void> select(Document& document, const std::string& wanted) {
  if (wanted.empty()) return {};
  const std::vector<Label> all = labels(document);
  const std::vector<bool> keep = chosen(all, wanted);
  if (keep.empty()) {
    std::vector<std::string> names;
    for (const Label& label : all) names.push_back(label.name);
    return std::unexpected(nothing_named(wanted, names));
  }
  std::size_t at = 0;
  keep_only(document.paths, keep, at);
  keep_only(document.space_curves, keep, at);
  keep_only(document.surfaces, keep, at);
  return {};
}

void add_trim_curves(Document& document) {
  for (const NamedSurface& named : document.surfaces) {
    int number = 0;
    for (const auto& loop : named.trim_loops)
      for (const SpaceCurve& curve : loop) {
        Label label = named.label;
        label.name += "/trim-" + std::to_string(++number);
        document.space_curves.push_back({std::move(label), curve});
      }
  }
}

double millimetres(const std::string& unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 8> kUnits = {
      {{"mm", 1},
       {"cm", 10},
       {"m", 1000},
       {"km", 1e6},
       {"in", 25.4},
       {"ft", 304.8},
       {"pt", 25.4 / 72},
       {"px", 25.4 / 96}}};
  for (const auto& [name, length] : kUnits)
    if (unit == name) return length;
  return 0;
}

}  // namespace keyline::document
