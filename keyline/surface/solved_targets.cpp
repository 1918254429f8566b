#include <algorithm>
#include <cmath>

#include "keyline/core/axis.h"
#include "keyline/surface/edit_targets.h"
#include "keyline/surface/one_matrix.h"

namespace keyline::surface::detail {
namespace {

using core::cross;
using core::dot;
using core::norm;
using core::Vector3;

/// Largest net the one-matrix equations are solved for: degrees (4, 4) have more freedoms than
/// equations, higher ones fewer.
constexpr std::size_t kMostSolved = 25;
constexpr double kMet = 1e-10;
constexpr double kUsualGrowth = 0.39;  ///< of cubics at their minimum

Freedom start_freedom(const CurveCondition& condition) {
  return condition.tangent.value_or(true) ? Freedom::along : Freedom::free;
}

/// A wish with nothing but the tangent that is to be kept; A1 and the first column slide along
/// theirs where the start is kept.
CurveWish bare_wish(const EditTask& task, const NetworkCurve& c) {
  CurveWish wish;
  const bool slides = task.options.keep == Keep::start && c.index == 0;
  if (!task.conditions[task.index_of(c)].tangent.value_or(false) || slides) return wish;
  const auto given = network_curves(task.net)[task.index_of(c)].control;
  const Vector3 edge = given[1] - given[0];
  wish.tangent = edge / norm(edge);
  return wish;
}

/// What brings a curve to its minimum. Where its ends and tangent leave none within its ranges, the
/// place within them nearest to the one there is, turn and all.
CurveWish wish_of(const EditTask& task, const NetworkCurve& c, const Sense& sense,
                  const CurveWish& before) {
  CurveWish wish = bare_wish(task, c);
  const CurveTask own = task.curve(c, sense);
  if (own.control.size() < 3) return wish;
  const double sign = own.from_end ? -1 : 1;
  if (const auto m = minimum_of(own)) {
    wish.growth = sign * std::log(m->s);
    return wish;
  }
  const auto nearest = nearest_minimum(own);
  const CurveCondition& asked = own.condition;
  if (!nearest || (!asked.alpha && !asked.s)) {
    wish.growth = before.growth ? before.growth : std::optional(sign * kUsualGrowth);
    return wish;
  }
  wish.growth = sign * std::log(asked.s ? core::clamp(*asked.s, nearest->s) : nearest->s);
  if (asked.alpha) wish.turn = core::clamp(*asked.alpha, nearest->alpha);
  return wish;
}

std::vector<CurveWish> wishes_of(const EditTask& task, const Net& net, const Sense& sense,
                                 const std::vector<CurveWish>& before) {
  std::vector<CurveWish> wishes;
  for (const NetworkCurve& c : network_curves(net))
    wishes.push_back(wish_of(task, c, sense, before[wishes.size()]));
  return wishes;
}

bool same(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || std::abs(*a - *b) <= 1e-8);
}

bool same(const std::vector<CurveWish>& a, const std::vector<CurveWish>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i].growth, b[i].growth) || !same(a[i].turn, b[i].turn)) return false;
  return true;
}

/// Binds curves that left their ranges to the ends of these. Returns whether there was one.
bool bind(const EditTask& task, const Net& net, const Sense& sense, OneMatrixProblem& problem) {
  constexpr double kOut = 1e-9;
  bool bound = false;
  for (const NetworkCurve& c : network_curves(net)) {
    const CurveTask own = task.curve(c, sense);
    if (own.control.size() < 3) continue;
    CurveWish& wish = problem.wishes[task.index_of(c)];
    const Vector3 e0 = c.control[1] - c.control[0];
    const Vector3 e1 = c.control[2] - c.control[1];
    const double turn = core::angle_between(e0, e1);
    const double sign = own.from_end ? -1 : 1;
    const double s = std::pow(norm(e1) / norm(e0), sign);
    const auto& [alpha_range, s_range] = std::pair(own.condition.alpha, own.condition.s);
    if (s_range && std::abs(s - core::clamp(*s_range, s)) > kOut) {
      wish.growth = sign * std::log(core::clamp(*s_range, s));
      wish.firm = bound = true;
    }
    if (alpha_range && std::abs(turn - core::clamp(*alpha_range, turn)) > kOut) {
      wish.turn = core::clamp(*alpha_range, turn);
      bound = true;
    }
  }
  return bound;
}

/// solve_one_matrix, ranges of the conditions held.
OneMatrixNet solve_within(const EditTask& task, const Sense& sense, OneMatrixProblem& problem,
                          const Net& start, bool exact_growth) {
  OneMatrixNet found = solve_one_matrix(problem, start, exact_growth);
  for (int round = 0; round < 4 && bind(task, found.net, sense, problem); ++round)
    found = solve_one_matrix(problem, found.net, exact_growth);
  return found;
}

void miss(const EditTask& task, const std::string& target, const OneMatrixNet& best,
          TargetSet& set) {
  const NetworkCurve c = network_curves(best.net)[static_cast<std::size_t>(best.worst)];
  const std::string asked = ranges_text(task.conditions[task.index_of(c)]);
  set.missed.push_back({target, c.name,
                        best.violation <= kMet
                            ? "no net was found in which all curves stand at their minimum"
                            : "no net was found in which it has one matrix" +
                                  (asked.empty() ? std::string() : " with " + asked) +
                                  " and the others have theirs"});
}

/// Rounds of exact growth until it is what the minima ask for.
void add_least_energy(const EditTask& task, const Sense& sense, OneMatrixProblem& problem,
                      OneMatrixNet found, TargetSet& set) {
  bool met = false;
  problem.growth_weight = 2;
  for (int round = 0; round < 8; ++round) {
    const auto wanted = wishes_of(task, found.net, sense, problem.wishes);
    if (met && same(wanted, problem.wishes)) break;
    problem.wishes = wanted;
    found = round == 0 ? solve_one_matrix(problem, found.net, true)
                       : meet_by_shortest_steps(problem, found.net);
    met = found.violation <= kMet && found.growth_error <= 1e-9;
  }
  if (!met) return miss(task, "least energy", found, set);
  set.targets.push_back({"least energy", found.net});
}

}  // namespace

std::vector<Freedom> freedom_of(const EditTask& task) {
  const Net& net = task.net;
  std::vector<Freedom> freedom(net.points.size(), Freedom::free);
  freedom[0] = Freedom::held;
  if (task.options.keep == Keep::start) {
    freedom[net.index(0, 1)] = start_freedom(task.conditions[0]);
    freedom[net.index(1, 0)] = start_freedom(task.conditions[static_cast<std::size_t>(net.rows)]);
    return freedom;
  }
  for (const std::size_t corner : {net.index(0, net.columns - 1), net.index(net.rows - 1, 0),
                                   net.index(net.rows - 1, net.columns - 1)})
    freedom[corner] = Freedom::held;
  return freedom;
}

bool solvable(const Net& net) { return net.points.size() <= kMostSolved; }

void add_solved(const EditTask& task, TargetSet& set) {
  const Net& net = task.net;
  if (!solvable(net)) return;
  OneMatrixProblem problem;
  problem.net = net;
  problem.freedom = freedom_of(task);
  for (const NetworkCurve& c : network_curves(net)) problem.wishes.push_back(bare_wish(task, c));
  OneMatrixNet found = solve_within(task, sense_of(net, task.options.keep), problem, net, false);
  if (!(found.violation <= kMet)) return miss(task, "one matrix", found, set);
  set.targets.push_back({"one matrix", found.net});
  const Sense sense = sense_of(found.net, task.options.keep);
  for (const double weight : {0.02, 0.1, 0.5, 3.0}) {
    if (task.options.progress.stop_requested()) return;
    problem.wishes = wishes_of(task, found.net, sense, problem.wishes);
    problem.growth_weight = weight;
    const OneMatrixNet next = solve_within(task, sense, problem, found.net, false);
    if (!(next.violation <= kMet)) return miss(task, "towards least energy", next, set);
    found = next;
    set.targets.push_back({"towards least energy", found.net});
  }
  add_least_energy(task, sense, problem, std::move(found), set);
}

std::optional<Net> solved_inside(const EditTask& task, const Net& net) {
  if (!solvable(net)) return std::nullopt;
  OneMatrixProblem problem;
  problem.net = net;
  problem.freedom.assign(net.points.size(), Freedom::held);
  for (int i = 1; i + 1 < net.rows; ++i)
    for (int j = 1; j + 1 < net.columns; ++j) problem.freedom[net.index(i, j)] = Freedom::free;
  problem.wishes.resize(task.conditions.size());
  // As many equations as freedoms, and dependent near translates: the last digits may stay out.
  constexpr double kInsideMet = 1e-8;
  OneMatrixNet found = solve_one_matrix(problem, net, false);
  if (!(found.violation <= kInsideMet)) return std::nullopt;
  return std::move(found.net);
}

}  // namespace keyline::surface::detail
