#include "keyline/sketch/branch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"
#include "keyline/core/second_moments.h"
#include "keyline/numeric/solve.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::Point2;
using core::Vector2;

constexpr double kEndArm = 10;       ///< pixels of a line that tell which way its end goes, and
constexpr double kEndArmWidths = 2;  ///< so many of its widths at least

/// Half the usual width of an edge.
double half_width(const GraphEdge& e) { return core::quantile(e.radii); }

/// Direction of the line at point i, from the parabola through points i … j.
template <class PointAt>
Vector2 direction(const PointAt& point, std::size_t i, std::size_t j) {
  const Vector2 chord = point(j) - point(i);
  if (j < i + 6) return core::norm(chord) > 0 ? chord / core::norm(chord) : Vector2{1, 0};
  // least squares of p(s) = c + v s + w s² over s in [-1, 1], v and w by orthogonal polynomials
  const double n = static_cast<double>(j - i + 1);
  Vector2 linear{};
  Vector2 square{};
  double linear_norm = 0;
  double square_norm = 0;
  double mean_square = 0;
  const auto at = [&](std::size_t k) { return 2 * static_cast<double>(k - i) / (n - 1) - 1; };
  for (std::size_t k = i; k <= j; ++k) mean_square += at(k) * at(k) / n;
  for (std::size_t k = i; k <= j; ++k) {
    const double s = at(k);
    const double q = s * s - mean_square;
    linear = linear + s * (point(k) - point(i));
    square = square + q * (point(k) - point(i));
    linear_norm += s * s;
    square_norm += q * q;
  }
  const Vector2 d = linear / linear_norm - (2 / square_norm) * square;
  return core::norm(d) > 0 ? d / core::norm(d) : Vector2{1, 0};
}

/// Least sum of costs over all ways to pair, by sets of those already settled, largest set first:
/// whoever comes first of the others stays alone or goes with one of the rest.
std::vector<int> least_pairing(const std::vector<std::vector<double>>& costs, double alone) {
  const auto n = static_cast<unsigned>(costs.size());
  const std::size_t all = (std::size_t{1} << n) - 1;
  std::vector<double> rest(all + 1, 0);  // what settling the others costs
  std::vector<std::uint8_t> mate(all + 1, 0);
  for (std::size_t settled = all; settled-- > 0;) {
    const auto first = static_cast<unsigned>(std::countr_one(settled));
    const std::size_t with_first = settled | (std::size_t{1} << first);
    rest[settled] = alone + rest[with_first];
    mate[settled] = static_cast<std::uint8_t>(first);
    for (unsigned k = first + 1; k < n; ++k) {
      if ((settled >> k) & 1U || !std::isfinite(costs[first][k])) continue;
      const double cost = costs[first][k] + rest[with_first | (std::size_t{1} << k)];
      if (cost < rest[settled]) rest[settled] = cost, mate[settled] = static_cast<std::uint8_t>(k);
    }
  }
  std::vector<int> mates(n, -1);
  for (std::size_t settled = 0; settled != all;) {
    const auto first = static_cast<unsigned>(std::countr_one(settled));
    const unsigned other = mate[settled];
    settled |= (std::size_t{1} << first) | (std::size_t{1} << other);
    if (other == first) continue;
    mates[first] = static_cast<int>(other);
    mates[other] = static_cast<int>(first);
  }
  return mates;
}

}  // namespace

Branch make_branch(const StrokeGraph& graph, int edge, bool at_end, double skip) {
  const GraphEdge& line = graph.edges[static_cast<std::size_t>(edge)];
  const std::size_t n = line.points.size();
  const auto point = [&](std::size_t i) { return line.points[at_end ? n - 1 - i : i]; };
  Branch b;
  b.edge = edge;
  b.at_end = at_end;
  skip = std::min(skip, 0.4 * length_of(line));
  std::size_t i = 0;
  for (double run = 0; i + 1 < n && run < skip; ++i) run += distance(point(i), point(i + 1));
  const double reach = std::max(10.0, 7 * half_width(line));
  std::size_t j = i;
  for (double run = 0; j + 1 < n && run < reach; ++j) run += distance(point(j), point(j + 1));
  b.anchor = at_end ? n - 1 - i : i;
  b.place = point(i);
  b.outward = direction(point, i, j);
  return b;
}

LineEnd line_end(const StrokeGraph& graph, const Branch& end) {
  const GraphEdge& line = graph.edges[static_cast<std::size_t>(end.edge)];
  const Point2 last = end.at_end ? line.points.back() : line.points.front();
  const double radius = end.at_end ? line.radii.back() : line.radii.front();
  return {end.place + dot(last - end.place, end.outward) * end.outward, radius + 0.5};
}

std::vector<Point2> arm_of(const StrokeGraph& graph, const Branch& branch, double reach) {
  const GraphEdge& line = graph.edges[static_cast<std::size_t>(branch.edge)];
  const std::size_t n = line.points.size();
  std::vector<Point2> points;
  double run = 0;
  for (std::size_t i = branch.anchor; run <= reach; i += branch.at_end ? -1 : 1) {
    points.push_back(line.points[i]);
    if (i == (branch.at_end ? 0 : n - 1)) break;
    run += distance(line.points[i], line.points[branch.at_end ? i - 1 : i + 1]);
  }
  return points;
}

Way way_of(const StrokeGraph& graph, const Branch& end) {
  const double width = 2 * half_width(graph.edges[static_cast<std::size_t>(end.edge)]);
  const std::vector<Point2> arm = arm_of(graph, end, std::max(kEndArm, kEndArmWidths * width));
  Vector2 sum{};
  for (const Point2 p : arm) sum = sum + (p - arm.front());
  const Point2 middle = arm.front() + sum / static_cast<double>(arm.size());
  core::SecondMoments spread;
  for (const Point2 p : arm) spread.add(p - middle);
  const Vector2 along = spread.direction();
  return {middle, dot(along, arm.front() - arm.back()) < 0 ? -along : along};
}

Vector2 direction_of(const std::vector<Point2>& points) {
  return direction([&](std::size_t i) { return points[i]; }, 0, points.size() - 1);
}

double bend_between(const Branch& a, const Branch& b) {
  const Vector2 chord = b.place - a.place;
  if (core::norm(chord) < 1.0) return std::abs(core::angle_between(-a.outward, b.outward));
  const double first = core::angle_between(-a.outward, chord);
  const double second = core::angle_between(chord, b.outward);
  return 0.5 * std::abs(first + second) + std::abs(first - second);
}

namespace {

constexpr double kArm = 30;  ///< pixels of a line that tell how it goes on

/// Distance of (x, y) to the left of the circle through the origin that goes along x there.
double left_of_circle(double x, double y, double curvature) {
  const double q = x * x + y * y;
  const double root = std::sqrt(std::max(0.0, 1 - 2 * curvature * y + curvature * curvature * q));
  return (2 * y - curvature * q) / (1 + root);
}

}  // namespace

CommonArc common_arc(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  constexpr int kSteps = 5;  // of Gauss and Newton; the start is a few degrees off at most
  std::vector<Point2> points = a;
  points.insert(points.end(), b.begin(), b.end());
  const Vector2 chord = b.front() - a.front();
  const double length = std::max(core::norm(chord), 1e-9);
  const Vector2 along = chord / length;
  const Point2 middle = core::mix(a.front(), b.front(), 0.5);
  double far = length;
  for (const Point2 p : points) far = std::max(far, distance(p, middle));
  Eigen::Vector4d fit = Eigen::Vector4d::Zero();  // place, direction, curvature and its change
  Eigen::MatrixX4d rows(static_cast<Eigen::Index>(points.size()), 4);
  Eigen::VectorXd rest(rows.rows());
  for (int step = 0; step <= kSteps; ++step) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const Vector2 d = points[static_cast<std::size_t>(i)] - middle;
      const double across = core::cross(along, d) - fit[0] * far;
      const double x = std::cos(fit[1]) * core::dot(along, d) + std::sin(fit[1]) * across;
      const double y = std::cos(fit[1]) * across - std::sin(fit[1]) * core::dot(along, d);
      const double u = x / far;
      rest[i] = left_of_circle(x, y, fit[2] / far) / far - fit[3] * u * u * u;
      rows.row(i) << 1, u, 0.5 * u * u, u * u * u;
    }
    if (step < kSteps) fit += numeric::least_squares(rows, rest);
  }
  CommonArc arc{
      far * rest.norm() / std::sqrt(static_cast<double>(points.size())), std::abs(3 * fit[3]), {}};
  for (double x = 1 - 0.5 * length; x < 0.5 * length; ++x) {
    const double u = x / far;
    const double y =
        far * (fit[2] * u * u / (1 + std::sqrt(std::max(0.0, 1 - fit[2] * fit[2] * u * u))) +
               fit[3] * u * u * u);
    const double ahead = std::cos(fit[1]) * x - std::sin(fit[1]) * y;
    const double across = std::sin(fit[1]) * x + std::cos(fit[1]) * y + fit[0] * far;
    arc.gap.push_back(middle + ahead * along + across * core::perpendicular_left(along));
  }
  return arc;
}

double passes_beside(const StrokeGraph& g, const Branch& arm, Point2 place) {
  const double ahead = -core::dot(arm.outward, place - arm.place);
  const std::vector<Point2> points = arm_of(g, arm, std::max(kArm, 2 * ahead));
  if (ahead <= 0 || points.size() < 6 ||
      core::distance(points.front(), points.back()) < 0.5 * ahead)
    return HUGE_VAL;
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd beside(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const core::Vector2 d = points[static_cast<std::size_t>(i)] - arm.place;
    const double x = -core::dot(arm.outward, d) / ahead;
    rows.row(i) << 1, x, x * x;
    beside[i] = core::cross(arm.outward, d);
  }
  const Eigen::VectorXd parabola = numeric::least_squares(rows, beside);
  return std::abs(core::cross(arm.outward, place - arm.place) - parabola.sum());
}

std::vector<int> pair_up(const std::vector<std::vector<double>>& costs, double alone) {
  if (costs.size() <= kMostBranches) return least_pairing(costs, alone);
  std::vector<std::vector<double>> first(costs.begin(),
                                         costs.begin() + static_cast<long>(kMostBranches));
  for (std::vector<double>& row : first) row.resize(kMostBranches);
  std::vector<int> mates = least_pairing(first, alone);
  mates.resize(costs.size(), -1);
  return mates;
}

std::vector<int> pair_up(const std::vector<Branch>& branches, double turn) {
  std::vector<std::vector<double>> bends(branches.size(), std::vector<double>(branches.size()));
  for (std::size_t i = 0; i < branches.size(); ++i)
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const double bend = i == k ? HUGE_VAL : bend_between(branches[i], branches[k]);
      bends[i][k] = bend > turn ? HUGE_VAL : bend;
    }
  return pair_up(bends, 0.5 * turn);
}

}  // namespace keyline::sketch
