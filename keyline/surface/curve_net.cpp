#include "keyline/surface/curve_net.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace keyline::surface::detail {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using Crossings = std::vector<std::vector<Crossing>>;

constexpr int kLooks = 128;        ///< places of a curve that are looked at first
constexpr double kFinest = 1e-13;  ///< share of the length that a crossing is found to
constexpr double kLength = 1e-10;  ///< relative, of arc lengths

/// From the place to those looked at beside it.
double spacing(const std::vector<Point3>& places, std::size_t i) {
  double most = 0;
  if (i > 0) most = core::distance(places[i - 1], places[i]);
  if (i + 1 < places.size()) most = std::max(most, core::distance(places[i], places[i + 1]));
  return most;
}

/// Steps of the longer curve over those of the other, a power of two: where they were as large a
/// share of it, those of the other could not be seen until they were as small in length.
double share_ratio(double longer, double other) {
  const double ratio = longer / other;
  return ratio > 1 && std::isfinite(ratio) ? std::exp2(-std::round(std::log2(ratio))) : 1;
}

/// The nearest of places beside each other, closer and closer.
Crossing crossing(const Thread& u, const Thread& v, const std::vector<Point3>& on_u,
                  const std::vector<Point3>& on_v) {
  std::size_t best_i = 0;
  std::size_t best_j = 0;
  double least = INFINITY;
  for (std::size_t i = 0; i < on_u.size(); ++i)
    for (std::size_t j = 0; j < on_v.size(); ++j)
      if (const double d = core::distance(on_u[i], on_v[j]); d < least)
        least = d, best_i = i, best_j = j;
  double s = static_cast<double>(best_i) / kLooks;
  double t = static_cast<double>(best_j) / kLooks;
  const double space_u = spacing(on_u, best_i), space_v = spacing(on_v, best_j);
  const double of_u = share_ratio(space_u, space_v), of_v = share_ratio(space_v, space_u);
  for (double step = 1 / (kLooks * of_u * of_v); step > kFinest;) {
    double next_s = s;
    double next_t = t;
    const double step_s = std::min(1.0 / kLooks, step * of_u);
    const double step_t = std::min(1.0 / kLooks, step * of_v);
    for (const double ds : {-step_s, 0.0, step_s})
      for (const double dt : {-step_t, 0.0, step_t}) {
        const double a = std::clamp(s + ds, 0.0, 1.0);
        const double b = std::clamp(t + dt, 0.0, 1.0);
        if (const double d = core::distance(u.at(a), v.at(b)); d < least)
          least = d, next_s = a, next_t = b;
      }
    if (next_s == s && next_t == t) step /= 2;
    s = next_s;
    t = next_t;
  }
  return {s, t, least, core::mix(u.at(s), v.at(t), 0.5)};
}

std::vector<Point3> looked_at(const Thread& thread) {
  std::vector<Point3> places;
  for (int i = 0; i <= kLooks; ++i) places.push_back(thread.at(static_cast<double>(i) / kLooks));
  return places;
}

Crossings all_crossings(const std::vector<Thread>& u, const std::vector<Thread>& v) {
  std::vector<std::vector<Point3>> on_v;
  for (const Thread& thread : v) on_v.push_back(looked_at(thread));
  Crossings all;
  for (const Thread& thread : u) {
    const auto on_u = looked_at(thread);
    all.emplace_back();
    for (std::size_t j = 0; j < v.size(); ++j)
      all.back().push_back(crossing(thread, v[j], on_u, on_v[j]));
  }
  return all;
}

/// Exchanges the part of u and v.
Crossings transposed(const Crossings& given) {
  Crossings all(given.front().size());
  for (const auto& row : given)
    for (std::size_t j = 0; j < row.size(); ++j)
      all[j].push_back({row[j].along_v, row[j].along_u, row[j].gap, row[j].place});
  return all;
}

/// Columns in the order in which the first row meets them; rows that meet them the other way are
/// turned round.
void put_in_order(std::vector<Thread>& rows, std::vector<Thread>& columns, Crossings& crossings) {
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t j) { return crossings[0][j].along_u; });
  std::vector<Thread> sorted;
  for (const std::size_t j : order) sorted.push_back(std::move(columns[j]));
  columns = std::move(sorted);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Crossing> row;
    for (const std::size_t j : order) row.push_back(crossings[i][j]);
    crossings[i] = std::move(row);
    if (crossings[i].front().along_u <= crossings[i].back().along_u) continue;
    rows[i].turn_round();
    for (Crossing& c : crossings[i]) c.along_u = 1 - c.along_u;
  }
}

/// What lies between the outermost columns.
Thread inner_part(Thread row, const std::vector<Crossing>& crossings) {
  const auto [first, last] = std::ranges::minmax(crossings, {}, &Crossing::along_u);
  if (first.along_u < last.along_u) row.cut(first.along_u, last.along_u);
  return row;
}

/// Fails where rows meet each other: what is between them is no patch.
Result<void> keep_apart(const std::vector<Thread>& rows, const Crossings& crossings, double gap,
                        const std::string& name) {
  std::vector<Thread> inner;
  std::vector<std::vector<Point3>> places;
  const auto called = [&](std::size_t i) { return name + "[" + std::to_string(i) + "]"; };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    inner.push_back(inner_part(rows[i], crossings[i]));
    places.push_back(looked_at(inner[i]));
    for (std::size_t k = 0; k < i; ++k)
      if (crossing(inner[k], inner[i], places[k], places[i]).gap <= gap)
        return core::fail(ErrorCode::bad_input,
                          "the curve meets " + called(k) + ", of its own direction",
                          "leave one of the two out; the borders of a network are four", called(i));
  }
  return {};
}

/// Cuts rows at their first and last column; shares are those of what is left.
bool cut_rows(std::vector<Thread>& rows, Crossings& crossings) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double from = crossings[i].front().along_u;
    const double to = crossings[i].back().along_u;
    for (std::size_t j = 1; j < crossings[i].size(); ++j)
      if (!(crossings[i][j].along_u > crossings[i][j - 1].along_u)) return false;
    rows[i].cut(from, to);
    for (Crossing& c : crossings[i]) c.along_u = (c.along_u - from) / (to - from);
  }
  return true;
}

/// Of the columns, the mean over the rows of where they are met.
std::vector<double> places_of(const Crossings& crossings) {
  std::vector<double> places(crossings.front().size(), 0);
  for (const auto& row : crossings)
    for (std::size_t j = 0; j < row.size(); ++j)
      places[j] += row[j].along_u / static_cast<double>(crossings.size());
  places.front() = 0;
  places.back() = 1;
  return places;
}

}  // namespace

Thread::Thread(curve::BSpline3 curve, Measure measure)
    : curve_(std::move(curve)), measure_(measure) {
  if (measure_ == Measure::length) map_ = curve::arc_length_map(curve_, kLength);
}

double Thread::parameter(double share) const {
  if (measure_ == Measure::parameter) return share;
  return curve::parameter_at_length(curve_, map_, share * total_length(map_));
}

Point3 Thread::at(double share) const { return evaluate(curve_, parameter(share)); }

void Thread::turn_round() { *this = Thread(curve::reverse(curve_), measure_); }

void Thread::cut(double from, double to) {
  if (from > 0 || to < 1)
    *this = Thread(curve::subcurve(curve_, parameter(from), to < 1 ? parameter(to) : 1), measure_);
}

Result<CurveNet> net_of_curves(const std::vector<curve::BSpline3>& along_u,
                               const std::vector<curve::BSpline3>& along_v, Measure measure,
                               double gap) {
  CurveNet net;
  for (const curve::BSpline3& c : along_u) net.u.emplace_back(c, measure);
  for (const curve::BSpline3& c : along_v) net.v.emplace_back(c, measure);
  net.crossings = all_crossings(net.u, net.v);
  for (std::size_t i = 0; i < net.u.size(); ++i)
    for (std::size_t j = 0; j < net.v.size(); ++j) {
      net.gap = std::max(net.gap, net.crossings[i][j].gap);
      if (!(net.crossings[i][j].gap <= gap))
        return core::fail(ErrorCode::bad_input,
                          "the curve misses along_v[" + std::to_string(j) + "] by " +
                              std::to_string(net.crossings[i][j].gap),
                          "let every curve along u meet every curve along v, or give a larger gap",
                          "along_u[" + std::to_string(i) + "]");
    }
  Crossings other = transposed(net.crossings);
  if (auto sound = keep_apart(net.u, net.crossings, gap, "along_u"); !sound)
    return std::unexpected(sound.error());
  if (auto sound = keep_apart(net.v, other, gap, "along_v"); !sound)
    return std::unexpected(sound.error());
  put_in_order(net.u, net.v, net.crossings);
  other = transposed(net.crossings);
  put_in_order(net.v, net.u, other);
  net.crossings = transposed(other);
  const bool u_sound = cut_rows(net.u, net.crossings);
  other = transposed(net.crossings);
  if (!u_sound || !cut_rows(net.v, other))
    return core::fail(ErrorCode::bad_input, "the curves cross in different orders",
                      "leave out those that cross others of their own direction", "along_u");
  net.crossings = transposed(other);
  net.u_places = places_of(net.crossings);
  net.v_places = places_of(other);
  return net;
}

}  // namespace keyline::surface::detail
