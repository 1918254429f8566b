#include "keyline/fit/canonical.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"

namespace keyline::fit::detail {
namespace {

using core::Point2;
using core::Vector2;

double quantised(double x) { return std::nearbyint(x * 0x1p34) * 0x1p-34; }

/// Whether reversal is wanted: the moment of `squares` about the middle parameter is negative.
/// Empty where it is zero to rounding.
std::optional<bool> negative_moment(const std::vector<double>& parameters,
                                    const std::vector<double>& squares) {
  double moment = 0;
  double size = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    moment += squares[i] * (parameters[i] - 0.5);
    size += squares[i];
  }
  if (std::abs(moment) <= 1e-9 * size) return std::nullopt;
  return moment < 0;
}

bool wants_reversal(std::span<const Point2> points, const std::vector<double>& parameters,
                    Point2 centre) {
  std::vector<double> squares;
  double area = 0;
  double size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2 v = points[i] - centre;
    squares.push_back(dot(v, v));
    size += squares.back();
    if (i > 0) area += cross(points[i - 1] - centre, v);
  }
  if (const auto reversed = negative_moment(parameters, squares)) return *reversed;
  return area < -1e-9 * size;
}

Vector2 axis_of(std::span<const Point2> points, Point2 first, Point2 centre, double length) {
  Vector2 axis = centre - first;
  if (norm(axis) > 1e-6 * length) return axis / norm(axis);
  for (const Point2& p : points) {
    if (norm(p - first) > norm(axis) * (1 + 1e-9)) axis = p - first;
  }
  return axis / norm(axis);
}

void reverse(SplineData& data) {
  for (double& t : data.parameters) t = 1 - t;
  std::reverse(data.parameters.begin(), data.parameters.end());
  std::reverse(data.weights.begin(), data.weights.end());
  for (auto& column : data.columns) std::reverse(column.begin(), column.end());
}

std::vector<double> quantised(std::vector<double> values) {
  for (double& v : values) v = quantised(v);
  return values;
}

}  // namespace

CanonicalData canonical_curve(std::span<const Point2> points, const std::vector<double>& parameters,
                              const std::vector<double>& weights) {
  const Point2 centre = core::centroid(points);
  double length = 0;
  for (const Point2& p : points) length = std::max(length, distance(centre, p));
  CanonicalData result;
  std::vector<Point2> scaled;
  for (const Point2& p : points) {
    const Vector2 v = (p - centre) / length;
    scaled.push_back({v.x, v.y});
  }
  result.scale = 1 / length;
  result.reversed = wants_reversal(scaled, parameters, {0, 0});
  const Point2 first = result.reversed ? scaled.back() : scaled.front();
  const Vector2 axis = axis_of(scaled, first, {0, 0}, 1);
  result.data.parameters = quantised(parameters);
  result.data.weights = weights;
  result.data.columns.resize(2);
  for (const Point2& p : scaled) {
    result.data.columns[0].push_back(quantised(dot(axis, p - first)));
    result.data.columns[1].push_back(quantised(cross(axis, p - first)));
  }
  if (result.reversed) reverse(result.data);
  return result;
}

CanonicalData canonical_function(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& weights) {
  CanonicalData result;
  std::vector<double> u;
  for (const double v : x) u.push_back((v - x.front()) / (x.back() - x.front()));
  double mean = 0;
  for (const double v : y) mean += v / static_cast<double>(y.size());
  double largest = 0;
  for (const double v : y) largest = std::max(largest, std::abs(v - mean));
  result.scale = largest > 0 ? 1 / largest : 1;
  std::vector<double> values;
  std::vector<double> squares;
  for (const double v : y) {
    values.push_back((v - mean) * result.scale);
    squares.push_back(values.back() * values.back());
  }
  const auto by_square = negative_moment(u, squares);
  result.reversed = by_square ? *by_square : negative_moment(u, values).value_or(false);
  result.data = {quantised(u), {quantised(values)}, weights};
  if (result.reversed) reverse(result.data);
  return result;
}

std::vector<double> given_direction(const CanonicalData& canonical, std::vector<double> knots) {
  if (!canonical.reversed) return knots;
  for (double& t : knots) t = 1 - t;
  std::reverse(knots.begin(), knots.end());
  return knots;
}

double decimal_rounding(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const int top = static_cast<int>(std::floor(std::log10(largest)));
  for (int exponent = top; exponent > top - 12; --exponent) {
    const double unit = std::pow(10.0, exponent);
    const bool all = std::all_of(values.begin(), values.end(), [&](double v) {
      const double multiple = v / unit;
      return std::abs(multiple - std::nearbyint(multiple)) <= 4e-16 * (largest / unit);
    });
    if (all) return unit;
  }
  return 0;
}

namespace {

/// Sum of squares of column k over [first, last) about the line of least squares through the means.
double scatter_about_line(const SplineData& data, std::size_t k, std::size_t first,
                          std::size_t last, Point2 mean) {
  double tt = 0;
  double tv = 0;
  double vv = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double weight = data.weights.empty() ? 1.0 : data.weights[i];
    const double dt = data.parameters[i] - mean.x;
    const double dv = data.columns[k][i] - mean.y;
    tt += weight * dt * dt;
    tv += weight * dt * dv;
    vv += weight * dv * dv;
  }
  return std::max(0.0, vv - (tt > 0 ? tv * tv / tt : 0));
}

}  // namespace

CondensedData condense(const SplineData& data, std::size_t bins) {
  CondensedData result;
  const std::size_t n = data.parameters.size();
  result.data.columns.resize(data.columns.size());
  const double low = data.parameters.front();
  const double width = (data.parameters.back() - low) / static_cast<double>(bins);
  const auto bin_of = [&](std::size_t i) {
    return std::min(bins - 1, static_cast<std::size_t>((data.parameters[i] - low) / width));
  };
  const auto weight = [&](std::size_t i) { return data.weights.empty() ? 1.0 : data.weights[i]; };
  for (std::size_t first = 0; first < n;) {
    std::size_t last = first;
    double sum_w = 0;
    double sum_t = 0;
    for (const std::size_t bin = bin_of(first); last < n && bin_of(last) == bin; ++last) {
      sum_w += weight(last);
      sum_t += weight(last) * data.parameters[last];
    }
    const double mean_t = sum_t / sum_w;
    result.data.parameters.push_back(
        std::clamp(mean_t, data.parameters[first], data.parameters[last - 1]));
    result.data.weights.push_back(sum_w);
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      double sum = 0;
      for (std::size_t i = first; i < last; ++i) sum += weight(i) * data.columns[k][i];
      const double mean = sum / sum_w;
      result.data.columns[k].push_back(mean);
      result.scatter += scatter_about_line(data, k, first, last, {mean_t, mean});
    }
    first = last;
  }
  return result;
}

}  // namespace keyline::fit::detail
