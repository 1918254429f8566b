#include "keyline/surface/edit_targets.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/text.h"

namespace keyline::surface::detail {
namespace {

using core::Interval;

void put(Net& net, const NetworkCurve& curve, const Curve& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int k = static_cast<int>(i);
    (curve.is_row ? net.at(curve.index, k) : net.at(k, curve.index)) = points[i];
  }
}

/// Mean growth ln(s) of the edges of all rows, or of all columns.
double mean_growth(const Net& net, bool rows) {
  double sum = 0;
  for (const NetworkCurve& c : network_curves(net)) {
    const auto n = c.control.size();
    if (c.is_row != rows || n < 3) continue;
    sum += std::log(core::distance(c.control[n - 2], c.control[n - 1]) /
                    core::distance(c.control[0], c.control[1]));
  }
  return sum;
}

// ---- Translates ---------------------------------------------------------------------------

/// Narrows `common` to what both ask; false where nothing is left.
bool narrow(std::optional<Interval>& common, const std::optional<Interval>& other) {
  if (!other) return true;
  if (!common) common = other;
  *common = {std::max(common->low, other->low), std::min(common->high, other->high)};
  return common->low <= common->high;
}

/// What is asked of the first row (column) when all others are translates of it; empty, with the
/// reason, where that cannot be.
std::optional<CurveTask> common_task(const EditTask& task, bool rows, MissedTarget& missed) {
  std::optional<CurveTask> common;
  std::string first;
  for (const NetworkCurve& c : network_curves(task.net)) {
    if (c.is_row != rows) continue;
    CurveTask own = task.curve(c, {});
    if (!common) {
      common = own;
      first = c.name;
      continue;
    }
    CurveCondition& all = common->condition;
    const CurveCondition& more = own.condition;
    missed.curve = c.name;
    if (!narrow(all.alpha, more.alpha) || !narrow(all.s, more.s)) {
      missed.why = "as a translate of " + first + " it would need a range that both share";
      return std::nullopt;
    }
    if (more.branch && all.branch && *more.branch != *all.branch) {
      missed.why = "as a translate of " + first + " its edges cannot grow the other way";
      return std::nullopt;
    }
    if (more.branch) all.branch = more.branch;
    if (more.end_tolerance)
      all.end_tolerance = std::min(*more.end_tolerance, all.end_tolerance.value_or(HUGE_VAL));
  }
  missed.curve = first;
  return common;
}

void add_translational(const EditTask& task, TargetSet& set) {
  const Net& net = task.net;
  Curve made[2];
  for (const bool rows : {true, false}) {
    MissedTarget missed{"translational", {}, {}};
    const auto common = common_task(task, rows, missed);
    if (common) made[rows ? 0 : 1] = least_energy_curve(*common);
    if (!made[rows ? 0 : 1].empty()) continue;
    if (common) missed.why = why_no_minimum(*common);
    set.missed.push_back(std::move(missed));
    return;
  }
  const auto& [row, column] = made;
  Net moved = net;
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) moved.at(i, j) = row[j] + (column[i] - column[0]);
  set.targets.push_back({"translational", std::move(moved)});
}

// ---- One way ------------------------------------------------------------------------------

/// Which of the rows, or of the columns: those on the border, those inside, or both.
enum class Which { border, inner, all };

/// Takes rows (columns) of `moved` to their minimum between their ends, which stay; false, with the
/// reason, where one has none.
bool straighten_out(const EditTask& task, Net& moved, bool rows, Which which,
                    MissedTarget& missed) {
  const Sense common = sense_of(task.net, task.options.keep);
  for (const NetworkCurve& c : network_curves(moved)) {
    const int last = (c.is_row ? moved.rows : moved.columns) - 1;
    const bool border = c.index == 0 || c.index == last;
    if (c.is_row != rows || which == (border ? Which::inner : Which::border)) continue;
    const bool alone = border && task.options.keep == Keep::joints;
    CurveTask own = task.curve(c, alone ? own_sense(c) : common);
    own.end_tolerance = own.condition.end_tolerance = 0;  // whatever the minimum is judged by
    Curve best = least_energy_curve(own);
    if (best.empty()) {
      missed.curve = c.name;
      missed.why = why_no_minimum(own);
      return false;
    }
    best.front() = c.control.front();  // to the last digit
    best.back() = c.control.back();
    put(moved, c, best);
  }
  return true;
}

/// Rows (or columns) alone at their minimum; with `frame` the two outer columns (rows) first.
void add_one_way(const EditTask& task, bool rows, bool frame, TargetSet& set) {
  MissedTarget missed{rows ? "rows" : "columns", {}, {}};
  Net moved = task.net;
  if ((!frame || straighten_out(task, moved, !rows, Which::border, missed)) &&
      straighten_out(task, moved, rows, frame ? Which::all : Which::inner, missed))
    set.targets.push_back({missed.target, std::move(moved)});
  else
    set.missed.push_back(std::move(missed));
}

// ---- Boundaries ---------------------------------------------------------------------------

/// Shares of the length of a polygon up to each of its points.
std::vector<double> length_shares(const Curve& c) {
  std::vector<double> shares{0};
  for (std::size_t i = 1; i < c.size(); ++i)
    shares.push_back(shares.back() + core::distance(c[i - 1], c[i]));
  for (double& x : shares) x /= shares.back();
  return shares;
}

/// Inner points blended from the boundary (Coons): translates where opposite edges are.
void blend_inside(Net& net) {
  const Net given = net;
  const int n = net.rows - 1;
  const int m = net.columns - 1;
  const auto u0 = length_shares(column_of(net, 0));
  const auto u1 = length_shares(column_of(net, m));
  const auto v0 = length_shares(row_of(net, 0));
  const auto v1 = length_shares(row_of(net, n));
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < m; ++j) {
      const double u = 0.5 * (u0[i] + u1[i]);
      const double v = 0.5 * (v0[j] + v1[j]);
      const auto across = core::mix(given.at(0, j), given.at(n, j), u);
      const auto along = core::mix(given.at(i, 0), given.at(i, m), v);
      const auto corners = core::mix(core::mix(given.at(0, 0), given.at(0, m), v),
                                     core::mix(given.at(n, 0), given.at(n, m), v), u);
      net.at(i, j) = across + (along - corners);
    }
}

/// All four boundary curves at their own minimum, what lies between blended from them.
void add_blended(const EditTask& task, TargetSet& set) {
  MissedTarget missed{"boundaries", {}, {}};
  Net moved = task.net;
  EditOptions alone = task.options;  // every boundary curve for itself
  alone.keep = Keep::joints;
  const EditTask own{task.net, alone, task.conditions};
  if (!straighten_out(own, moved, true, Which::border, missed) ||
      !straighten_out(own, moved, false, Which::border, missed)) {
    set.missed.push_back(std::move(missed));
    return;
  }
  blend_inside(moved);
  std::vector<Net> starts{moved};
  for (const Target& t : set.targets)
    if (t.name == "rows" || t.name == "columns") starts.push_back(t.net);
  for (const Net& start : starts) {
    auto inside = solved_inside(task, start);
    if (!inside) continue;
    set.targets.push_back({"one matrix inside", std::move(*inside)});
    break;
  }
  set.targets.push_back({missed.target, std::move(moved)});
}

}  // namespace

Sense sense_of(const Net& net, Keep keep) {
  if (keep == Keep::start) return {};
  return {mean_growth(net, true) < 0, mean_growth(net, false) < 0};
}

Sense own_sense(const NetworkCurve& c) {
  const auto& p = c.control;
  const bool falls = core::distance(p[p.size() - 2], p.back()) < core::distance(p[0], p[1]);
  return {falls, falls};
}

CurveTask EditTask::curve(const NetworkCurve& c, const Sense& sense) const {
  const CurveCondition& condition = conditions[index_of(c)];
  const bool from_end = c.is_row ? sense.rows_from_end : sense.columns_from_end;
  return {c.control, from_end && !condition.branch, condition, options.end_tolerance,
          options.alpha_max};
}

TargetSet edit_targets(const EditTask& task) {
  TargetSet set;
  const Keep keep = task.options.keep;
  if (keep == Keep::start) add_translational(task, set);
  if (keep == Keep::start || keep == Keep::corners) add_solved(task, set);
  if (keep != Keep::start) {
    add_one_way(task, true, keep != Keep::boundary, set);
    add_one_way(task, false, keep != Keep::boundary, set);
  }
  if (keep == Keep::joints || keep == Keep::corners) add_blended(task, set);
  return set;
}

}  // namespace keyline::surface::detail
