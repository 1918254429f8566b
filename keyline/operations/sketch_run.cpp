#include "keyline/operations/sketch_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/acquire/acquire.h"
#include "keyline/core/polygon.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/operations/fields.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

/// The value a word stands for, else bad_input that lists the words.
template <class T, std::size_t N>
Result<T> one_of(const json& request, const char* name,
                 const std::array<std::pair<const char*, T>, N>& words) {
  const std::string given = string_or(request, name, words[0].first);
  std::string list;
  for (const auto& [word, value] : words) {
    if (given == word) return value;
    list += std::string(list.empty() ? "" : ", ") + word;
  }
  return core::fail(ErrorCode::bad_input, "\"" + given + "\" is unknown", "give one of " + list,
                    name);
}

Result<std::vector<std::optional<double>>> region_thresholds(const json& request) {
  std::vector<std::optional<double>> regions;
  if (!request.contains("thresholds")) return regions;
  const json& list = request["thresholds"];
  const auto bad = [] {
    return core::fail(ErrorCode::bad_input, "are not 64 numbers from 0 to 1 or nulls",
                      "give them row by row from the top left region", "thresholds");
  };
  if (!list.is_array() || list.size() != sketch::kRegionCount) return bad();
  for (const json& item : list) {
    if (item.is_null()) {
      regions.emplace_back();
    } else if (item.is_number() && item.get<double>() >= 0 && item.get<double>() <= 1) {
      regions.emplace_back(item.get<double>());
    } else {
      return bad();
    }
  }
  return regions;
}

json points_json(const std::vector<core::Point2>& points, double scale) {
  json list = json::array();
  for (const core::Point2 p : points) list.push_back({scale * p.x, scale * p.y});
  return list;
}

document::Path path_of(const sketch::Stroke& stroke, const core::Similarity2& map) {
  document::Path path;
  path.closed = stroke.closed;
  for (const curve::Bezier2& piece : stroke.curve)
    path.curves.push_back({curve::transform(piece, map)});
  return path;
}

}  // namespace

Result<sketch::TraceOptions> trace_options(const json& request) {
  sketch::TraceOptions options;
  options.binarize.threshold = optional_number(request, "threshold");
  if (const auto t = options.binarize.threshold; t && !(*t >= 0 && *t <= 1))
    return core::fail(ErrorCode::bad_input, "is not from 0 to 1",
                      "levels run from black 0 to white 1", "threshold");
  auto regions = region_thresholds(request);
  if (!regions) return std::unexpected(regions.error());
  options.binarize.regions = std::move(*regions);
  const auto gain = positive_number(request, "log_gain");
  if (!gain) return std::unexpected(gain.error());
  options.tone.gain = *gain;
  using sketch::CurvatureAim, sketch::Edge, sketch::Flatten, sketch::Polarity;
  const auto flatten = one_of<Flatten, 3>(
      request, "flatten",
      {{{"auto", Flatten::automatic}, {"on", Flatten::on}, {"off", Flatten::off}}});
  const auto polarity = one_of<Polarity, 3>(request, "polarity",
                                            {{{"auto", Polarity::automatic},
                                              {"dark", Polarity::dark_on_light},
                                              {"light", Polarity::light_on_dark}}});
  const auto edge =
      one_of<Edge, 2>(request, "edge", {{{"center", Edge::center}, {"outer", Edge::outer}}});
  const auto aim = one_of<CurvatureAim, 3>(request, "curvature",
                                           {{{"none", CurvatureAim::none},
                                             {"smooth", CurvatureAim::smooth},
                                             {"rhythm", CurvatureAim::rhythm}}});
  if (!flatten) return std::unexpected(flatten.error());
  if (!polarity) return std::unexpected(polarity.error());
  if (!edge) return std::unexpected(edge.error());
  if (!aim) return std::unexpected(aim.error());
  options.tone.flatten = *flatten;
  options.tone.polarity = *polarity;
  options.edge = *edge;
  options.curve.aim = *aim;
  options.consolidate = boolean_or(request, "consolidate", false);
  options.curve.tolerance = number_or(request, "tolerance", options.curve.tolerance);
  options.gap = optional_number(request, "gap");
  if (!(options.curve.tolerance >= 0) || !(options.gap.value_or(0) >= 0))
    return core::fail(ErrorCode::bad_input, "is less than 0", "give 0 or more",
                      options.curve.tolerance >= 0 ? "gap" : "tolerance");
  if (request.contains("specks")) {
    const auto specks = integer_between(request, "specks", 0, 0, 1 << 20);
    if (!specks) return std::unexpected(specks.error());
    options.specks = *specks;
  }
  return options;
}

Result<sketch::TraceResult> trace_picture([[maybe_unused]] sketch::Image image,
                                          [[maybe_unused]] const sketch::TraceOptions& options) {
#ifdef KEYLINE_HAS_SKETCH
  return sketch::trace(std::move(image), options);
#else
  return core::fail(ErrorCode::unsupported, "this Keyline was built without room sketch",
                    "build it with -DKEYLINE_SKETCH=ON");
#endif
}

Result<sketch::TraceResult> trace_drawn(
    [[maybe_unused]] const std::vector<sketch::DrawnStroke>& strokes, [[maybe_unused]] double width,
    [[maybe_unused]] const sketch::TraceOptions& options) {
#ifdef KEYLINE_HAS_SKETCH
  return sketch::trace_strokes(strokes, width, options);
#else
  return core::fail(ErrorCode::unsupported, "this Keyline was built without room sketch",
                    "build it with -DKEYLINE_SKETCH=ON");
#endif
}

json sketch_json(const sketch::TraceResult& trace, double scale) {
  json strokes = json::array();
  for (const sketch::Stroke& stroke : trace.strokes) {
    strokes.push_back({{"points", points_json(stroke.points, scale)},
                       {"segments", points_json(stroke.segments, scale)},
                       {"curve", exchange::to_json(path_of(stroke, {scale, 0, {}}))},
                       {"corners", stroke.corners},
                       {"closed", stroke.closed},
                       {"width", scale * stroke.width}});
    if (!stroke.members.empty()) strokes.back()["members"] = stroke.members;
    if (stroke.driven)
      strokes.back()["curvature_error"] = {{"before", stroke.driven->before / scale},
                                           {"after", stroke.driven->after / scale}};
  }
  return {{"strokes", std::move(strokes)},
          {"size", {scale * trace.width, scale * trace.height}},
          {"explained", trace.explained},
          {"left_over", trace.left_over},
          {"report", trace.notes}};
}

document::Document sketch_document(const sketch::TraceResult& trace, double scale, double lift) {
  document::Document document;
  const core::Similarity2 map{scale, 0, {0, lift}};
  for (std::size_t i = 0; i < trace.strokes.size(); ++i)
    document.paths.push_back({{"stroke" + std::to_string(i + 1), {}, {}},
                              path_of(trace.strokes[i], map),
                              scale * trace.strokes[i].width});
  return document;
}

Result<std::vector<acquire::KeyLine>> key_lines_of(const sketch::TraceResult& trace,
                                                   std::size_t& skipped) {
  constexpr double kPositionError = 0.2;  ///< pixels, of a hand-drawn line's centre
  std::vector<acquire::KeyLine> lines;
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    const sketch::Stroke& stroke = trace.strokes[i];
    if (core::polygon_length(stroke.points, stroke.closed) < std::max(24.0, 8 * stroke.width)) {
      ++skipped;
      continue;
    }
    acquire::RawCurve raw;
    raw.id = "stroke" + std::to_string(i + 1);
    // every other point: neighbours a pixel apart say the same
    for (std::size_t k = 0; k < stroke.points.size(); k += 2)
      raw.points.push_back({stroke.points[k].x, stroke.points[k].y, 0});
    acquire::AcquireOptions options;
    options.closed = stroke.closed;
    options.ordered = true;
    options.remove_outliers = false;
    options.noise = kPositionError;
    auto line = acquire::acquire_key_line(raw, options);
    if (!line) return std::unexpected(line.error());
    line->id = raw.id;
    lines.push_back(std::move(*line));
  }
  return lines;
}

}  // namespace keyline::operations
