#include "keyline/exchange/hull_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "keyline/exchange/json_parts.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;
using detail::in;
using nlohmann::json;

constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();

const json* hull_of(const json& j) {
  const json* at = &j;
  for (const char* key : {"structure", "hull"})
    if (at->is_object() && at->contains(key)) at = &(*at)[key];
  return at->is_object() && at->contains("halfBreadths") ? at : nullptr;
}

Result<double> attribute(const json& hull, const char* name) {
  const auto attributes = detail::member(hull, "attributes", "");
  if (!attributes) return std::unexpected(attributes.error());
  const auto value = detail::number_member(**attributes, name, "attributes");
  if (value && !(*value > 0))
    return fail(ErrorCode::bad_input, "a size of the hull is not positive", "correct it",
                in("attributes", name));
  return value;
}

Result<std::vector<double>> axis(const json& table, const char* name, double unit) {
  const auto list = detail::member(table, name, "halfBreadths");
  if (!list) return std::unexpected(list.error());
  auto values = detail::numbers(**list, in("halfBreadths", name));
  if (!values) return values;
  for (double& v : *values) v *= unit;
  if (!values->empty() && !std::isfinite(values->front()))
    return fail(ErrorCode::bad_input, "this is too large", "correct it", in("halfBreadths", name));
  for (std::size_t i = 1; i < values->size(); ++i)
    if (!((*values)[i] > (*values)[i - 1]) || !std::isfinite((*values)[i]))
      return fail(ErrorCode::bad_input, "these do not grow", "put them in order",
                  in(in("halfBreadths", name), i));
  return values;
}

Result<void> add_row(HullTable& hull, const json& row, double unit, const std::string& where) {
  if (!row.is_array() || row.size() != hull.stations.size())
    return fail(ErrorCode::bad_input,
                "a row needs " + std::to_string(hull.stations.size()) + " half-breadths",
                "give one per station, null outside the hull", where);
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (row[k].is_null()) {
      hull.half_breadth.push_back(kOutside);
      continue;
    }
    const auto value = number_from_json(row[k], in(where, k));
    if (!value) return std::unexpected(value.error());
    hull.half_breadth.push_back(*value * unit);
  }
  return {};
}

/// Puts points that follow each other on the hull into curves.
class Lines {
 public:
  explicit Lines(document::Document& document) : document_(document) {}

  void add(const std::string& name, const std::string& layer, std::vector<Point3> points) {
    trim(points);
    std::reverse(points.begin(), points.end());
    trim(points);
    std::reverse(points.begin(), points.end());
    if (points.size() < 2) {
      ++short_;
      return;
    }
    document_.space_curves.push_back({{name, layer, {}}, {curve::Polyline3{std::move(points)}}});
  }

  void finish() {
    if (short_ > 0)
      document_.skipped.push_back(std::to_string(short_) + " lines of fewer than two points");
  }

 private:
  /// Of points with no breadth at the end all but the innermost go.
  static void trim(std::vector<Point3>& points) {
    while (points.size() > 1 && points.back().y == 0 && points[points.size() - 2].y == 0)
      points.pop_back();
  }

  document::Document& document_;
  int short_ = 0;
};

/// Height at which a station first reaches a half-breadth from below.
std::optional<double> height_at(const HullTable& hull, std::size_t station, double breadth) {
  const std::size_t n = hull.stations.size();
  for (std::size_t i = 1; i < hull.waterlines.size(); ++i) {
    const double a = hull.half_breadth[(i - 1) * n + station];
    const double b = hull.half_breadth[i * n + station];
    if (!(a < breadth && b >= breadth)) continue;
    const double u = (breadth - a) / (b - a);
    return hull.waterlines[i - 1] + u * (hull.waterlines[i] - hull.waterlines[i - 1]);
  }
  return std::nullopt;
}

}  // namespace

bool is_hull_json(const json& j) { return hull_of(j) != nullptr; }

Result<HullTable> hull_from_json(const json& j) {
  const json* hull = hull_of(j);
  if (!hull)
    return fail(ErrorCode::bad_input, "there is no table of offsets", "give \"halfBreadths\"");
  const auto length = attribute(*hull, "LOA");
  if (!length) return std::unexpected(length.error());
  const auto breadth = attribute(*hull, "BOA");
  if (!breadth) return std::unexpected(breadth.error());
  const auto depth = attribute(*hull, "Depth");
  if (!depth) return std::unexpected(depth.error());
  const json& table = (*hull)["halfBreadths"];
  auto waterlines = axis(table, "waterlines", *depth);
  if (!waterlines) return std::unexpected(waterlines.error());
  auto stations = axis(table, "stations", *length);
  if (!stations) return std::unexpected(stations.error());
  HullTable made{std::move(*waterlines), std::move(*stations), {}};
  const auto rows = detail::member(table, "table", "halfBreadths");
  if (!rows) return std::unexpected(rows.error());
  if (!(*rows)->is_array() || (*rows)->size() != made.waterlines.size())
    return fail(ErrorCode::bad_input, "the table needs a row for every waterline", "give them",
                "halfBreadths.table");
  for (std::size_t i = 0; i < (*rows)->size(); ++i)
    if (auto done = add_row(made, (**rows)[i], *breadth / 2, in("halfBreadths.table", i)); !done)
      return std::unexpected(done.error());
  return made;
}

document::Document hull_document(const HullTable& hull) {
  document::Document document;
  document.unit = hull.unit;
  document.skipped = hull.left_out;
  Lines lines(document);
  const std::size_t n = hull.stations.size();
  double widest = 0;
  const auto take = [&](std::vector<Point3>& points, std::size_t i, std::size_t k) {
    const double y = hull.half_breadth[i * n + k];
    if (!std::isfinite(y)) return;
    widest = std::max(widest, y);
    points.push_back({hull.stations[k], y, hull.waterlines[i]});
  };
  for (std::size_t i = 0; i < hull.waterlines.size(); ++i) {
    std::vector<Point3> points;
    for (std::size_t k = 0; k < n; ++k) take(points, i, k);
    lines.add("waterline-" + std::to_string(i + 1), "waterlines", std::move(points));
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < hull.waterlines.size(); ++i) take(points, i, k);
    lines.add("station-" + std::to_string(k + 1), "stations", std::move(points));
  }
  for (int quarter = 1; quarter <= 3; ++quarter) {
    const double y = widest * quarter / 4;
    std::vector<Point3> points;
    for (std::size_t k = 0; k < n; ++k)
      if (const auto z = height_at(hull, k, y)) points.push_back({hull.stations[k], y, *z});
    lines.add("buttock-" + std::to_string(quarter), "buttocks", std::move(points));
  }
  lines.finish();
  return document;
}

}  // namespace keyline::exchange
