#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/axis.h"
#include "keyline/surface/edit_targets.h"
#include "keyline/surface/one_matrix.h"
#include "keyline/surface/turn_over.h"

namespace keyline::surface::detail {
namespace {

using core::cross;
using core::norm;
using core::Vector3;

constexpr double kMet = 1e-9;
constexpr std::size_t kMostPoints = 121;
constexpr long kMostWays = 4;  ///< curves that are tried growing either way

bool has_ranges(const CurveCondition& c) { return c.alpha || c.s || c.branch; }

std::vector<Freedom> inside_free(const Net& net) {
  std::vector<Freedom> freedom(net.points.size(), Freedom::held);
  for (int i = 1; i + 1 < net.rows; ++i)
    for (int j = 1; j + 1 < net.columns; ++j) freedom[net.index(i, j)] = Freedom::free;
  return freedom;
}

/// What the ranges of a condition say of edges that grow from the first point on, or fall.
struct Ranges {
  core::Interval turn, growth;  ///< growth: ln s from the first point on
};
Ranges ranges_of(const CurveTask& own) {
  constexpr core::Interval kAnyGrowth{-5, 5};
  constexpr double kInner = 1e-10;  // so that what meets the equations lies within
  const CurveCondition& c = own.condition;
  Ranges r{c.alpha.value_or(core::Interval{0, own.alpha_max}), kAnyGrowth};
  if (c.s) r.growth = {std::log(c.s->low) + kInner, std::log(c.s->high) - kInner};
  const bool falls = c.branch == classa::Branch::falling;
  if (falls)
    r.growth.high = std::min(r.growth.high, 0.0);
  else if (c.s || c.branch)
    r.growth.low = std::max(r.growth.low, 0.0);
  if (own.from_end) r.growth = {-r.growth.high, -r.growth.low};
  return r;
}

/// The task of a curve, read the way its edges grow, or the other way; a branch says that itself.
CurveTask read(const EditTask& task, const NetworkCurve& c, bool other_way) {
  Sense sense = own_sense(c);
  if (other_way) sense = {!sense.rows_from_end, !sense.columns_from_end};
  return task.curve(c, sense);
}

/// `other_ways`: a bit for each curve that has ranges.
OneMatrixProblem problem_of(const EditTask& task, const Net& net, std::vector<Freedom> freedom,
                            unsigned other_ways) {
  OneMatrixProblem problem{net, std::move(freedom), {}, 0};
  const auto given = network_curves(task.net);
  for (const NetworkCurve& c : network_curves(net)) {
    const std::size_t i = task.index_of(c);
    const CurveCondition& condition = task.conditions[i];
    CurveWish wish;
    wish.loose = !has_ranges(condition);
    const Vector3 edge = given[i].control[1] - given[i].control[0];
    if (condition.tangent.value_or(false)) wish.tangent = edge / norm(edge);
    if (!wish.loose && c.control.size() > 2) {
      const Ranges ranges = ranges_of(read(task, c, other_ways & 1U));
      wish.turn_within = ranges.turn;
      wish.growth_within = ranges.growth;
      other_ways >>= 1U;
    }
    problem.wishes.push_back(wish);
  }
  return problem;
}

/// The curve between the same ends, in the plane the given one comes nearest to, whose edges turn
/// and grow as wanted: each is the one before as a complex number times one factor.
Curve curve_within(const CurveTask& own) {
  const Curve& given = own.control;
  const Ranges ranges = ranges_of(own);
  const Vector3 e0 = given[1] - given[0], e1 = given[2] - given[1];
  const double turn = core::clamp(ranges.turn, core::angle_between(e0, e1));
  const double growth = core::clamp(ranges.growth, std::log(norm(e1) / norm(e0)));
  Vector3 across;
  for (std::size_t i = 2; i < given.size(); ++i)
    across = across + cross(given[i - 1] - given[i - 2], given[i] - given[i - 1]);
  const Vector3 chord = given.back() - given.front();
  const Vector3 side = cross(across, chord);
  if (!(norm(side) > 0)) return {};
  const std::complex<double> factor = std::polar(std::exp(growth), turn);
  std::complex<double> sum = 0, power = 1;
  for (std::size_t i = 1; i < given.size(); ++i, power *= factor) sum += power;
  Curve c = given;
  std::complex<double> edge = norm(chord) / sum;
  for (std::size_t i = 1; i + 1 < c.size(); ++i, edge *= factor)
    c[i] = c[i - 1] + (edge.real() / norm(chord)) * chord + (edge.imag() / norm(side)) * side;
  return c;
}

/// The boundary curves as each alone asks for: at its minimum within its ranges, between its ends
/// and along its tangent; where it has none, within its ranges, or as it is where it has no ranges.
Net own_borders(const EditTask& task) {
  Net net = task.net;
  for (const NetworkCurve& c : network_curves(task.net)) {
    const int last = (c.is_row ? net.rows : net.columns) - 1;
    if (c.index != 0 && c.index != last) continue;
    CurveTask own = task.curve(c, own_sense(c));
    own.end_tolerance = own.condition.end_tolerance = 0;
    Curve moved = least_energy_curve(own);
    const bool may_turn = !own.condition.tangent.value_or(false) && own.control.size() > 2;
    if (moved.empty() && has_ranges(own.condition) && may_turn) moved = curve_within(own);
    for (std::size_t i = 1; i + 1 < moved.size(); ++i)
      (c.is_row ? net.at(c.index, static_cast<int>(i)) : net.at(static_cast<int>(i), c.index)) =
          moved[i];
  }
  return net;
}

bool moves_none_of(const NetworkCurve& c, const Net& net, const std::vector<Freedom>& freedom) {
  for (int k = 0; k < static_cast<int>(c.control.size()); ++k)
    if (freedom[c.is_row ? net.index(c.index, k) : net.index(k, c.index)] != Freedom::held)
      return false;
  return true;
}

MissedTarget missed(const EditTask& task, const OneMatrixNet& best,
                    const std::vector<Freedom>& freedom) {
  if (best.violation <= kMet) return {"conditions", "the patch", "its normal would turn over"};
  const NetworkCurve c = network_curves(best.net)[static_cast<std::size_t>(best.worst)];
  const std::string asked = ranges_text(task.conditions[task.index_of(c)]);
  return {"conditions", c.name,
          moves_none_of(c, best.net, freedom)
              ? "it stays where it is and does not meet " + asked
              : "no net was found in which it has one matrix with " + asked};
}

/// The net with rows, or columns, that have ranges within these, as far as they may move.
Net with_curves_within(const EditTask& task, const Net& start, bool rows, unsigned other_ways,
                       const std::vector<Freedom>& freedom) {
  Net net = start;
  for (const NetworkCurve& c : network_curves(start)) {
    if (!has_ranges(task.conditions[task.index_of(c)]) || c.control.size() < 3) continue;
    const Curve moved = c.is_row == rows ? curve_within(read(task, c, other_ways & 1U)) : Curve{};
    other_ways >>= 1U;
    for (int k = 0; k < static_cast<int>(moved.size()); ++k) {
      const std::size_t at = c.is_row ? net.index(c.index, k) : net.index(k, c.index);
      if (freedom[at] == Freedom::free) net.points[at] = moved[static_cast<std::size_t>(k)];
    }
  }
  return net;
}

/// Points that may move, within the boundary, blended from it: from its rows, from its columns, or
/// from both after Coons; from neither it is the corners. A net far from the given one, whose rows
/// and columns are like those of the boundary.
Net blended(const Net& given, double rows, double columns, const std::vector<Freedom>& freedom) {
  Net net = given;
  const int m = net.rows - 1, n = net.columns - 1;
  for (int i = 1; i < m; ++i)
    for (int j = 1; j < n; ++j) {
      if (freedom[net.index(i, j)] != Freedom::free) continue;
      const double u = static_cast<double>(i) / m, v = static_cast<double>(j) / n;
      const auto at = [&](int a, int b) { return given.at(a, b) - core::Point3{}; };
      const Vector3 along = (1 - u) * at(0, j) + u * at(m, j);
      const Vector3 across = (1 - v) * at(i, 0) + v * at(i, n);
      const Vector3 corners =
          (1 - u) * ((1 - v) * at(0, 0) + v * at(0, n)) + u * ((1 - v) * at(m, 0) + v * at(m, n));
      net.at(i, j) =
          core::Point3{} + rows * along + columns * across + (1 - rows - columns) * corners;
    }
  return net;
}

/// Where to set out from: beside the given net, or far from it.
std::vector<Net> starts_of(const EditTask& task, const Net& given,
                           const std::vector<Freedom>& freedom, unsigned other_ways, bool far) {
  if (far)
    return {blended(given, 1, 1, freedom), blended(given, 1, 0, freedom),
            blended(given, 0, 1, freedom), blended(given, 0, 0, freedom)};
  return {given, with_curves_within(task, given, true, other_ways, freedom),
          with_curves_within(task, given, false, other_ways, freedom)};
}

/// How nets are sought, one after the other until one is found. The one nearest to the given may
/// turn over where the one nearest to a start does not.
struct Search {
  bool by_shortest_steps = false;
  bool far = false;
};
constexpr Search kSearches[] = {
    {}, {.far = true}, {.by_shortest_steps = true}, {.by_shortest_steps = true, .far = true}};

/// Of the nets found the one to take or, where there is none yet, the one that meets its equations
/// best.
struct Sought {
  std::optional<OneMatrixNet> best;
  bool met = false;

  /// Returns whether the net is one to take.
  bool add(const EditTask& task, OneMatrixNet net) {
    met = net.violation <= kMet && !turns_over({task.net, {}}, {net.net, {}});
    if (met || !best || net.violation < best->violation) best = std::move(net);
    return met;
  }
};

Sought seek(const EditTask& task, const Net& given, const std::vector<Freedom>& freedom,
            unsigned all_ways) {
  Sought sought;
  for (const Search& search : kSearches)
    for (unsigned ways = 0; ways < all_ways; ++ways) {
      const OneMatrixProblem problem = problem_of(task, given, freedom, ways);
      for (const Net& start : starts_of(task, given, freedom, ways, search.far)) {
        if (task.options.progress.stop_requested()) return sought;
        if (sought.add(task, search.by_shortest_steps ? meet_by_shortest_steps(problem, start)
                                                      : solve_one_matrix(problem, start, false)))
          return sought;
      }
    }
  return sought;
}

}  // namespace

void add_conditions(const EditTask& task, TargetSet& set) {
  if (task.net.points.size() > kMostPoints) return;
  const auto asked = std::ranges::count_if(task.conditions, has_ranges);
  if (asked == 0) return;
  const Keep keep = task.options.keep;
  const bool inside = keep == Keep::joints || keep == Keep::boundary;
  const Net given = keep == Keep::joints ? own_borders(task) : task.net;
  const std::vector<Freedom> freedom = inside ? inside_free(given) : freedom_of(task);
  Sought sought = seek(task, given, freedom, 1U << std::min<long>(asked, kMostWays));
  if (sought.met)
    set.targets.push_back({"conditions", std::move(sought.best->net)});
  else if (sought.best && !task.options.progress.stop_requested())
    set.missed.push_back(missed(task, *sought.best, freedom));
}

}  // namespace keyline::surface::detail
