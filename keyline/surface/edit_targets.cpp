#include "keyline/surface/edit_targets.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/surface/one_matrix.h"

namespace keyline::surface::detail {
namespace {

using core::cross;
using core::dot;
using core::norm;
using core::Point3;
using core::Vector3;

/// Largest net the one-matrix equations are solved for: degrees (4, 4) have more freedoms than
/// equations, higher ones fewer.
constexpr std::size_t kMostSolved = 25;
constexpr double kMet = 1e-10;

using Curve = std::vector<Point3>;

/// Least-energy problem of a curve with these ends and this start tangent.
core::Result<classa::EnergyMinimum> minimum_of(const Curve& c, const EditOptions& options) {
  const Vector3 tangent = c[1] - c[0];
  const Vector3 chord = c.back() - c[0];
  const double angle = std::atan2(norm(cross(tangent, chord)), dot(tangent, chord));
  classa::EnergyConditions e;
  e.tangent = {norm(tangent), 0};
  e.chord = {norm(chord) * std::cos(angle), norm(chord) * std::sin(angle)};
  e.degree = static_cast<int>(c.size()) - 1;
  e.end_tolerance = options.end_tolerance.value_or(0.01 * norm(chord));
  e.alpha = {0, options.alpha_max};
  if (e.degree < 2) return classa::EnergyMinimum{};
  return classa::minimum_energy(e);
}

/// The curve of least energy from c[0] along its tangent to c.back(); empty where there is none.
/// `from_end`: the same seen from the other end.
Curve least_energy_curve(Curve c, bool from_end, const EditOptions& options) {
  if (from_end) std::reverse(c.begin(), c.end());
  if (c.size() > 2) {
    const auto m = minimum_of(c, options);
    if (!m) return {};
    const Vector3 tangent = c[1] - c[0];
    const Vector3 x = tangent / norm(tangent);
    const Vector3 chord = c.back() - c[0];
    const Vector3 off = chord - dot(chord, x) * x;
    const Vector3 y = norm(off) > 1e-12 * norm(chord) ? off / norm(off) : Vector3{};
    double length = m->beta * norm(tangent);
    for (std::size_t i = 1; i < c.size(); ++i, length *= m->s) {
      const double turn = (static_cast<double>(i) - 1) * m->alpha;
      c[i] = c[i - 1] + length * (std::cos(turn) * x + std::sin(turn) * y);
    }
  }
  if (from_end) std::reverse(c.begin(), c.end());
  return c;
}

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

/// Which way edges are to grow: away from b00 where the start is kept, else as they do.
struct Sense {
  bool rows_from_end = false;
  bool columns_from_end = false;
};
Sense sense_of(const Net& net, Keep keep) {
  if (keep == Keep::start) return {};
  return {mean_growth(net, true) < 0, mean_growth(net, false) < 0};
}

std::vector<Growth> wanted_growth(const Net& net, const Sense& sense, const EditOptions& options,
                                  const std::vector<Growth>& before) {
  std::vector<Growth> growth;
  for (const NetworkCurve& c : network_curves(net)) {
    const bool from_end = c.is_row ? sense.rows_from_end : sense.columns_from_end;
    Curve points = c.control;
    if (from_end) std::reverse(points.begin(), points.end());
    const auto m =
        points.size() > 2 ? minimum_of(points, options) : core::Result<classa::EnergyMinimum>{};
    if (points.size() <= 2)
      growth.push_back(std::nullopt);
    else if (m)
      growth.push_back((from_end ? -1 : 1) * std::log(m->s));
    else
      growth.push_back(before.empty() ? Growth{(from_end ? -1 : 1) * 0.39} : before[growth.size()]);
  }
  return growth;
}

bool same(const std::vector<Growth>& a, const std::vector<Growth>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i] && std::abs(*a[i] - *b[i]) > 1e-8) return false;
  return true;
}

std::vector<Freedom> freedom_of(const Net& net, Keep keep) {
  std::vector<Freedom> freedom(net.points.size(), Freedom::free);
  freedom[0] = Freedom::held;
  if (keep == Keep::start) {
    freedom[net.index(0, 1)] = Freedom::along;
    freedom[net.index(1, 0)] = Freedom::along;
    return freedom;
  }
  for (const std::size_t corner : {net.index(0, net.columns - 1), net.index(net.rows - 1, 0),
                                   net.index(net.rows - 1, net.columns - 1)})
    freedom[corner] = Freedom::held;
  return freedom;
}

void add_solved(std::vector<Target>& targets, const Net& net, const EditOptions& options) {
  OneMatrixProblem problem;
  problem.net = net;
  problem.freedom = freedom_of(net, options.keep);
  problem.growth.assign(static_cast<std::size_t>(net.rows) + static_cast<std::size_t>(net.columns),
                        std::nullopt);
  OneMatrixNet found = solve_one_matrix(problem, net, false);
  if (!(found.violation <= kMet)) return;
  targets.push_back({"one matrix", found.net});
  const Sense sense = sense_of(found.net, options.keep);
  for (const double weight : {0.02, 0.1, 0.5, 3.0}) {
    if (options.progress.stop_requested()) return;
    problem.growth = wanted_growth(found.net, sense, options, problem.growth);
    problem.growth_weight = weight;
    const OneMatrixNet next = solve_one_matrix(problem, found.net, false);
    if (!(next.violation <= kMet)) return;
    found = next;
    targets.push_back({"towards least energy", found.net});
  }
  bool met = false;
  for (int round = 0; round < 8; ++round) {
    const auto wanted = wanted_growth(found.net, sense, options, problem.growth);
    if (met && same(wanted, problem.growth)) break;
    problem.growth = wanted;
    problem.growth_weight = 2;
    const OneMatrixNet next = solve_one_matrix(problem, found.net, true);
    if (!(next.violation <= kMet && next.growth_error <= 1e-9)) break;
    met = true;
    found = next;
  }
  if (met) targets.push_back({"least energy", found.net});
}

void add_translational(std::vector<Target>& targets, const Net& net, const EditOptions& options) {
  const Curve row = least_energy_curve(row_of(net, 0), false, options);
  const Curve column = least_energy_curve(column_of(net, 0), false, options);
  if (row.empty() || column.empty()) return;
  Net moved = net;
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) moved.at(i, j) = row[j] + (column[i] - column[0]);
  targets.push_back({"translational", std::move(moved)});
}

/// Rows (or columns) alone at their minimum; with `frame` the two outer columns (rows) first.
void add_one_way(std::vector<Target>& targets, const Net& net, bool rows, bool frame,
                 const EditOptions& options) {
  const Sense sense = sense_of(net, options.keep);
  Net moved = net;
  const auto change = [&](bool row_curves, bool outer, bool inner) {
    for (const NetworkCurve& c : network_curves(moved)) {
      const int last = (c.is_row ? net.rows : net.columns) - 1;
      const bool border = c.index == 0 || c.index == last;
      if (c.is_row != row_curves || (border ? !outer : !inner)) continue;
      const bool from_end = c.is_row ? sense.rows_from_end : sense.columns_from_end;
      const Curve best = least_energy_curve(c.control, from_end, options);
      if (best.empty()) return false;
      put(moved, c, best);
    }
    return true;
  };
  if (frame && !change(!rows, true, false)) return;
  if (!change(rows, frame, true)) return;
  targets.push_back({rows ? "rows" : "columns", std::move(moved)});
}

}  // namespace

std::vector<Target> edit_targets(const Net& net, const EditOptions& options) {
  std::vector<Target> targets;
  if (options.keep == Keep::start) add_translational(targets, net, options);
  if (options.keep != Keep::boundary && net.points.size() <= kMostSolved)
    add_solved(targets, net, options);
  if (options.keep != Keep::start) {
    // these ends have to stay, whatever tolerance the minimum is judged by
    EditOptions held = options;
    held.end_tolerance = 0;
    const bool frame = options.keep == Keep::corners;
    add_one_way(targets, net, true, frame, held);
    add_one_way(targets, net, false, frame, held);
  }
  return targets;
}

}  // namespace keyline::surface::detail
