#include "keyline/surface/net.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/core/extent.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Point3;

namespace {

std::string place(const char* list, const Net& net, std::size_t i) {
  const auto columns = static_cast<std::size_t>(net.columns);
  return std::string(list) + "[" + std::to_string(i / columns) + "][" +
         std::to_string(i % columns) + "]";
}

}  // namespace

std::vector<Point3> row_of(const Net& net, int row) {
  std::vector<Point3> points;
  for (int j = 0; j < net.columns; ++j) points.push_back(net.at(row, j));
  return points;
}

std::vector<Point3> column_of(const Net& net, int column) {
  std::vector<Point3> points;
  for (int i = 0; i < net.rows; ++i) points.push_back(net.at(i, column));
  return points;
}

Net transposed(const Net& net) {
  Net turned{net.columns, net.rows, {}};
  turned.points.reserve(net.points.size());
  for (int j = 0; j < net.columns; ++j)
    for (int i = 0; i < net.rows; ++i) turned.points.push_back(net.at(i, j));
  return turned;
}

core::Result<void> validate(const Net& net, const std::vector<double>& weights) {
  if (net.rows < 2 || net.columns < 2)
    return fail(ErrorCode::bad_input, "a surface has at least two rows of two points",
                "give a net of control points", "points");
  if (net.points.size() !=
      static_cast<std::size_t>(net.rows) * static_cast<std::size_t>(net.columns))
    return fail(ErrorCode::bad_input, "the number of points is not rows times columns",
                "give rows of equal length", "points");
  if (!weights.empty() && weights.size() != net.points.size())
    return fail(ErrorCode::bad_input, "there must be one weight per control point, or none",
                "give as many weights as points", "weights");
  for (std::size_t i = 0; i < net.points.size(); ++i)
    if (!core::is_finite(net.points[i]))
      return fail(ErrorCode::bad_input, "coordinate is not a finite number", "give finite numbers",
                  place("points", net, i));
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!(std::isfinite(weights[i]) && weights[i] > 0))
      return fail(ErrorCode::bad_input, "weight is not a positive finite number",
                  "give positive weights", place("weights", net, i));
  return {};
}

double extent(const Net& net) { return diagonal(core::box_of(net.points)); }

}  // namespace keyline::surface
