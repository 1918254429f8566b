#include "keyline/exchange/json/json_document.h"

#include "keyline/core/text.h"
#include "keyline/document/color.h"
#include "keyline/exchange/json/json_hull.h"
#include "keyline/exchange/json/json_lists.h"
#include "keyline/exchange/json/json_members.h"
#include "keyline/exchange/json/json_parts.h"
#include "keyline/exchange/json/json_surface.h"
#include "keyline/exchange/json/json_text.h"
#include "keyline/exchange/text/header_unit.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using detail::in;
using document::Document;
using document::Label;
using nlohmann::json;

/// Long lists are left to `lists` where there are some to be filled.
template <class Curve>
json curve_json(const Curve& curve, detail::PointLists* lists) {
  using Line = std::conditional_t<std::is_same_v<Curve, document::PlanarCurve>, curve::Polyline2,
                                  curve::Polyline3>;
  const auto* line = lists ? std::get_if<Line>(&curve.value) : nullptr;
  if (!line || line->points.empty()) return to_json(curve);
  lists->push_back(&line->points);
  return {{"type", "polyline"}, {"points", json::array()}};
}

json path_json(const document::Path& path, detail::PointLists* lists) {
  const bool chain =
      path.curves.size() == 1 && std::holds_alternative<lac::Chain>(path.curves[0].value);
  // A closed path of one curve other than a chain says so only as a path.
  const bool plain = path.curves.size() == 1 && (chain || !path.closed);
  if (plain) return curve_json(path.curves.front(), lists);
  json whole = to_json(document::Path{{}, path.closed});
  for (const document::PlanarCurve& c : path.curves)
    whole["curves"].push_back(curve_json(c, lists));
  return whole;
}

void add_label(json& j, const Label& label) {
  if (!label.name.empty()) j["name"] = label.name;
  if (!label.layer.empty()) j["layer"] = label.layer;
  if (!label.color.empty()) j["color"] = label.color;
}

json item_json(const Label& label, const char* kind, json value) {
  json item{{kind, std::move(value)}};
  add_label(item, label);
  return item;
}

/// j[key]; empty where it is absent or null.
Result<std::string> text_of(const json& j, const char* key, const std::string& where) {
  if (!j.is_object()) return std::string();
  const auto it = j.find(key);
  if (it == j.end() || it->is_null()) return std::string();
  if (it->is_string()) return it->get<std::string>();
  return fail(ErrorCode::bad_input, "a text is wanted here", "put it in quotes", in(where, key));
}

/// "unit", also in words ("inches", "MM"); as it is where it is unknown.
Result<std::string> unit_of(const json& j, const std::string& where) {
  auto given = text_of(j, "unit", where);
  if (!given) return given;
  std::string unit = detail::unit_in_words(*given);
  return unit.empty() ? std::move(*given) : std::move(unit);
}

Result<Label> label_of(const json& j, const std::string& where) {
  Label label;
  for (const auto& [key, text] : {std::pair{"name", &label.name}, std::pair{"layer", &label.layer},
                                  std::pair{"color", &label.color}}) {
    auto given = text_of(j, key, where);
    if (!given) return std::unexpected(given.error());
    *text = std::move(*given);
  }
  if (!label.color.empty() && document::color_value(label.color) < 0)
    return fail(ErrorCode::bad_input, "\"" + label.color + "\" is no colour", "give #rrggbb",
                in(where, "color"));
  return label;
}

/// Of a closed path whose ends lie apart: the line that closes it stands nowhere in its text.
void tell_closing_line(Document& document, const json& value, const document::Path& path,
                       const std::string& where) {
  const auto members = value.find("curves");
  if (members == value.end() || path.curves.size() == members->size()) return;
  const document::PlanarCurve& line = path.curves.back();
  const double length = distance(evaluate(line, 0), evaluate(line, 1));
  document.skipped.push_back((where.empty() ? "" : where + ": ") +
                             "nothing, but a straight line of length " +
                             core::number_text(length, 3) + " closes this path");
}

Result<void> add_value(Document& document, const json& value, const std::string& where, Label label,
                       double stroke_width) {
  if (is_surface_json(value)) {
    auto read = surface_from_json(value, where);
    if (!read) return std::unexpected(read.error());
    document.surfaces.push_back({std::move(label), std::move(*read), 0});
    return {};
  }
  if (is_space_curve(value)) {
    auto curve = space_curve_from_json(value, where);
    if (!curve) return std::unexpected(curve.error());
    document.space_curves.push_back({std::move(label), std::move(*curve)});
    return {};
  }
  if (is_space_path(value)) {
    auto members = space_path_from_json(value, where);
    if (!members) return std::unexpected(members.error());
    for (document::SpaceCurve& member : *members)
      document.space_curves.push_back({label, std::move(member)});
    return {};
  }
  auto path = path_from_json(value, where);
  if (!path) return std::unexpected(path.error());
  tell_closing_line(document, value, *path, where);
  document.paths.push_back({std::move(label), std::move(*path), stroke_width});
  return {};
}

Result<void> add_trim_loops(document::NamedSurface& named, const json& item,
                            const std::string& where) {
  const auto loops = item.find("trim_loops");
  if (loops == item.end()) return {};
  const std::string at = in(where, "trim_loops");
  const auto wanted = [](const std::string& path) {
    return fail(ErrorCode::bad_input, "a list is wanted here", "give [[curve, …], …]", path);
  };
  if (!loops->is_array()) return wanted(at);
  for (std::size_t i = 0; i < loops->size(); ++i) {
    const json& list = (*loops)[i];
    if (!list.is_array()) return wanted(in(at, i));
    auto& loop = named.trim_loops.emplace_back();
    for (std::size_t k = 0; k < list.size(); ++k) {
      auto curve = space_curve_from_json(list[k], in(in(at, i), k));
      if (!curve) return std::unexpected(curve.error());
      loop.push_back(std::move(*curve));
    }
  }
  return {};
}

Result<void> add_surface(Document& document, const json& item, const std::string& where) {
  const bool wrapped = item.is_object() && item.contains("surface");
  if (!wrapped && !is_surface_json(item))
    return fail(ErrorCode::bad_input, "a surface is wanted here",
                "give {\"surface\":{…}}, or the surface itself", where);
  auto read = wrapped ? surface_from_json(item["surface"], in(where, "surface"))
                      : surface_from_json(item, where);
  if (!read) return std::unexpected(read.error());
  auto label = label_of(item, where);
  if (!label) return std::unexpected(label.error());
  const auto trims = item.find("trims");
  const bool counted = trims != item.end();
  if (counted && !(trims->is_number_integer() && *trims >= 0 && *trims < 1'000'000))
    return fail(ErrorCode::bad_input, "a number of trims is wanted here", "give 0 or more",
                in(where, "trims"));
  document.surfaces.push_back(
      {std::move(*label), std::move(*read), counted ? trims->get<int>() : 0});
  return add_trim_loops(document.surfaces.back(), item, where);
}

Result<void> add_item(Document& document, const json& item, const std::string& where) {
  if (item.is_object() && (item.contains("surface") || is_surface_json(item)))
    return add_surface(document, item, where);
  auto label = label_of(item, where);
  if (!label) return std::unexpected(label.error());
  double width = 0;
  if (item.is_object() && item.contains("stroke_width")) {
    const auto number = number_from_json(item["stroke_width"], in(where, "stroke_width"));
    if (!number) return std::unexpected(number.error());
    if (*number < 0)
      return fail(ErrorCode::bad_input, "the stroke width is negative", "give 0 or more",
                  in(where, "stroke_width"));
    width = *number;
  }
  const bool wrapped = item.is_object() && item.contains("curve");
  return add_value(document, wrapped ? item["curve"] : item, wrapped ? in(where, "curve") : where,
                   std::move(*label), width);
}

/// The unit of a document and of each thing in it, where it names one: all the same.
Result<void> take_unit(Document& document, const json& j, const std::string& where) {
  auto unit = unit_of(j, where);
  if (!unit) return std::unexpected(unit.error());
  if (unit->empty() || *unit == document.unit) return {};
  if (!document.unit.empty())
    return fail(ErrorCode::bad_input, "two units, " + document.unit + " and " + *unit,
                "give all in one", in(where, "unit"));
  document.unit = std::move(*unit);
  return {};
}

using AddItem = Result<void> (*)(Document&, const json&, const std::string&);

Result<void> add_all(Document& document, const json& list, const std::string& key, AddItem add) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = in(key, i);
    if (auto done = take_unit(document, list[i], where); !done) return done;
    if (auto done = add(document, list[i], where); !done) return done;
  }
  return {};
}

/// Curves and surfaces one after the other, as they stand in either list.
Result<Document> document_of_array(const json& j) {
  Document document;
  if (auto done = add_all(document, j, "", add_item); !done) return std::unexpected(done.error());
  return document;
}

Result<Document> document_of_list(const json& j) {
  Document document;
  if (auto done = take_unit(document, j, ""); !done) return std::unexpected(done.error());
  for (const auto& [key, add] :
       {std::pair<const char*, AddItem>{"curves", add_item}, {"surfaces", add_surface}}) {
    const auto list = j.find(key);
    if (list == j.end()) continue;
    if (!list->is_array())
      return fail(ErrorCode::bad_input, "a list is wanted here", "give [{…}, …]", key);
    if (auto done = add_all(document, *list, key, add); !done) return std::unexpected(done.error());
  }
  if (const auto skipped = j.find("skipped"); skipped != j.end() && skipped->is_array())
    for (const json& line : *skipped)
      if (line.is_string()) document.skipped.push_back(line.get<std::string>());
  return document;
}

/// A value by itself, or the answer of an operation.
Result<Document> document_of_one(const json& j) {
  Document document;
  if (auto done = take_unit(document, j, ""); !done) return std::unexpected(done.error());
  if (auto done = add_item(document, j, ""); !done) return std::unexpected(done.error());
  return document;
}

json surfaces_json(const Document& document) {
  json list = json::array();
  for (const auto& named : document.surfaces) {
    list.push_back(item_json(named.label, "surface", to_json(named.surface)));
    if (named.trims > 0) list.back()["trims"] = named.trims;
    if (named.trim_loops.empty()) continue;
    json& loops = list.back()["trim_loops"] = json::array();
    for (const auto& loop : named.trim_loops) {
      json curves = json::array();
      for (const document::SpaceCurve& curve : loop) curves.push_back(to_json(curve));
      loops.push_back(std::move(curves));
    }
  }
  return list;
}

/// A single unlabelled thing is written as the value it is.
bool is_one_path(const Document& document) {
  return document.paths.size() == 1 && size(document) == 1 && document.skipped.empty() &&
         document.paths[0].label.layer.empty() && document.paths[0].stroke_width == 0;
}

bool is_one_surface(const Document& document) {
  return document.surfaces.size() == 1 && size(document) == 1 && document.skipped.empty() &&
         document.surfaces[0].label.layer.empty() && document.surfaces[0].trims == 0;
}

bool is_one_space_curve(const Document& document) {
  return document.space_curves.size() == 1 && size(document) == 1 && document.skipped.empty() &&
         document.space_curves[0].label.layer.empty();
}

json value_of(const Document& document, detail::PointLists* lists) {
  if (!document.paths.empty()) return path_json(document.paths[0].path, lists);
  if (!document.space_curves.empty()) return curve_json(document.space_curves[0].curve, lists);
  return to_json(document.surfaces[0].surface);
}

json tree_of(const Document& document, detail::PointLists* lists) {
  if (is_one_path(document) || is_one_surface(document) || is_one_space_curve(document)) {
    json one = value_of(document, lists);
    add_label(one, labels(document).front());
    if (!document.unit.empty()) one["unit"] = document.unit;
    return one;
  }
  json list = json::array();
  for (const auto& named : document.paths) {
    list.push_back(item_json(named.label, "curve", path_json(named.path, lists)));
    if (named.stroke_width > 0) list.back()["stroke_width"] = named.stroke_width;
  }
  for (const auto& named : document.space_curves)
    list.push_back(item_json(named.label, "curve", curve_json(named.curve, lists)));
  json j{{"curves", std::move(list)}};
  if (!document.surfaces.empty()) j["surfaces"] = surfaces_json(document);
  if (!document.unit.empty()) j["unit"] = document.unit;
  if (!document.skipped.empty()) j["skipped"] = document.skipped;
  return j;
}

}  // namespace

json to_json(const Document& document) { return tree_of(document, nullptr); }

std::string json_text(const Document& document, int indent, const json& further) {
  detail::PointLists lists;
  json tree = tree_of(document, &lists);
  tree.update(further);
  return detail::filled(tree.dump(indent, ' ', false, json::error_handler_t::replace), lists,
                        indent);
}

std::string json_text(const Document& document, int indent) {
  return json_text(document, indent, json::object());
}

Result<Document> document_from_json(const json& j) {
  auto document = [&]() -> Result<Document> {
    if (is_hull_json(j)) {
      const auto hull = hull_from_json(j);
      if (!hull) return std::unexpected(hull.error());
      return hull_document(*hull);
    }
    if (j.is_array() && !j.empty() && j.front().is_object()) return document_of_array(j);
    const bool typed = j.is_object() && j.contains("type");
    if (j.is_object() && !typed && (j.contains("curves") || j.contains("surfaces")))
      return document_of_list(j);
    return document_of_one(j);
  }();
  if (!document) return document;
  for (std::string& line : in_words(stray_members_of_document(j)))
    document->skipped.push_back(std::move(line));
  return document;
}

Result<Document> read_json(std::string_view text) {
  const auto j = parse_json(text);
  if (!j) return std::unexpected(j.error());
  return document_from_json(*j);
}

}  // namespace keyline::exchange
