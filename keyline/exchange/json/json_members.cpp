#include "keyline/exchange/json/json_members.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/core/nearest_word.h"
#include "keyline/core/text.h"
#include "keyline/exchange/json/json_hull.h"
#include "keyline/exchange/json/json_parts.h"

namespace keyline::exchange {
namespace {

using core::Result;
using detail::in;
using nlohmann::json;
using Names = std::vector<std::string_view>;

/// The fields of a kind of value, and those of each item of a list within it.
struct Kind {
  std::string_view type;
  Names fields;
  std::string_view list = {};
  Names of_items = {};
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"polyline", {"points"}},
                                     {"bezier", {"points", "weights"}},
                                     {"bspline", {"degree", "knots", "points", "weights"}},
                                     {"log-aesthetic",
                                      {"start", "direction", "closed", "pieces"},
                                      "pieces",
                                      {"alpha", "length", "curvature", "radius"}},
                                     {"log-aesthetic-space",
                                      {"start", "frame", "pieces"},
                                      "pieces",
                                      {"alpha", "beta", "length", "curvature", "torsion"}},
                                     {"path", {"curves", "closed"}},
                                     {"bezier-surface", {"points", "weights"}},
                                     {"bspline-surface", {"degree", "knots", "points", "weights"}}};
  return all;
}

const Names kLabel{"name", "layer", "color"};
const Names kOfItem{"name", "layer", "color", "stroke_width", "unit", "curve"};
const Names kOfSurface{"name", "layer", "color", "trims", "trim_loops", "unit", "surface"};
const Names kOfDocument{"unit", "curves", "surfaces", "skipped"};
const Names kOfForm{"deviation"};
/// What a value by itself carries of its place in a document or in an answer.
const Names kCarried{"name", "layer", "color",      "stroke_width",
                     "unit", "trims", "trim_loops", "deviation"};

bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string listed(const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
    text += names[i];
  }
  return text;
}

/// Gathers stray members.
class Search {
 public:
  std::vector<StrayMember> found;

  /// `carried`: what it may have beside the fields of its type.
  void in_value(const json& value, const std::string& where, const Names& carried) {
    if (!value.is_object()) return;
    const auto type = value.find("type");
    const auto kind = std::ranges::find_if(
        kinds(), [&](const Kind& one) { return type != value.end() && *type == one.type; });
    if (kind == kinds().end()) return;
    Names allowed = kind->fields;
    allowed.emplace_back("type");
    allowed.insert(allowed.end(), carried.begin(), carried.end());
    look(value, where, "a " + std::string(kind->type), allowed, kind->fields);
    if (const auto list = value.find("curves"); list != value.end() && kind->type == "path")
      for_each(*list, in(where, "curves"),
               [&](const json& member, const std::string& at) { in_value(member, at, {}); });
    if (const auto list = value.find(kind->list); list != value.end() && !kind->list.empty())
      for_each(*list, in(where, std::string(kind->list)),
               [&](const json& item, const std::string& at) {
                 look(item, at, "a piece", kind->of_items, kind->of_items);
               });
  }

  /// A curve or surface of a list: with its labels around it, or by itself.
  void in_item(const json& item, const std::string& where) {
    for (const auto& [key, fields] : {std::pair{"curve", &kOfItem}, {"surface", &kOfSurface}}) {
      if (!item.is_object() || !item.contains(key)) continue;
      look(item, where, "an entry of a " + std::string(key), *fields, *fields);
      return in_value(item[key], in(where, key), kOfForm);
    }
    in_value(item, where, kCarried);
  }

  void in_document(const json& document) {
    if (document.is_array()) return in_list(document, "");
    if (!document.is_object()) return;
    if (document.contains("type")) return in_value(document, "", kCarried);
    if (document.contains("curves") || document.contains("surfaces")) {
      look(document, "", "a document", kOfDocument, kOfDocument);
      for (const char* key : {"curves", "surfaces"})
        if (document.contains(key)) in_list(document[key], key);
      return;
    }
    in_answer(document);
  }

 private:
  template <class Visit>
  static void for_each(const json& list, const std::string& where, const Visit& visit) {
    if (!list.is_array()) return;
    for (std::size_t i = 0; i < list.size(); ++i) visit(list[i], in(where, i));
  }

  void in_list(const json& list, const std::string& where) {
    for_each(list, where, [&](const json& item, const std::string& at) { in_item(item, at); });
  }

  void in_answer(const json& answer) {
    Names fields = kCarried;
    for (const char* key : {"curve", "surface"}) {
      fields.emplace_back(key);
      if (answer.contains(key)) in_value(answer[key], key, kOfForm);
    }
    for (const auto& [name, value] : answer.items())
      if (!has(fields, name) && !core::nearest_word(name, fields).empty())
        add("", name, "a document", fields, fields);
  }

  void look(const json& object, const std::string& where, const std::string& of,
            const Names& allowed, const Names& named) {
    if (!object.is_object()) return;
    for (const auto& [name, value] : object.items()) {
      const bool says_nothing = name == "closed" && value == false;
      if (!has(allowed, name) && !says_nothing) add(where, name, of, allowed, named);
    }
  }

  /// `named`: those of the fields there are that are told where none is near.
  void add(const std::string& where, const std::string& name, const std::string& of,
           const Names& allowed, const Names& named) {
    const std::string_view meant = core::nearest_word(name, allowed);
    found.push_back({where, name, of,
                     !meant.empty()     ? "did you mean \"" + std::string(meant) + "\"?"
                     : name == "closed" ? "a path says so: {\"type\":\"path\", \"curves\":[…], "
                                          "\"closed\":true}"
                                        : "it has " + listed(named)});
  }
};

std::string no_field(const StrayMember& stray) {
  return "\"" + core::on_one_line(stray.name) + "\" is not a field of " + stray.of;
}

}  // namespace

std::vector<StrayMember> stray_members(const json& value, const std::string& where) {
  Search search;
  search.in_value(value, where, kCarried);
  return std::move(search.found);
}

std::vector<StrayMember> stray_members_of_document(const json& document) {
  Search search;
  if (!is_hull_json(document)) search.in_document(document);
  return std::move(search.found);
}

Result<void> check_members(const json& value, const std::string& where) {
  const auto strays = stray_members(value, where);
  if (strays.empty()) return {};
  const StrayMember& first = strays.front();
  return core::fail(core::ErrorCode::bad_input, no_field(first), first.hint,
                    in(first.place, first.name));
}

std::vector<std::string> in_words(const std::vector<StrayMember>& strays) {
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> times;
  for (const StrayMember& stray : strays) ++times[{stray.name, stray.of}];
  std::vector<std::string> lines;
  for (const StrayMember& stray : strays) {
    const std::size_t same = std::exchange(times[{stray.name, stray.of}], 0);
    if (same == 0) continue;
    lines.push_back((stray.place.empty() ? "" : stray.place + ": ") + no_field(stray) + "; " +
                    stray.hint + (same > 1 ? " (" + std::to_string(same) + " times)" : ""));
  }
  return lines;
}

}  // namespace keyline::exchange
