#include "keyline/classa/minimum_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlopt.h>

#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/numeric/roots.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Interval;
using core::kPi;
using core::Vector2;

namespace {

constexpr int kCells = 48;       // of alpha, to find where an end angle can be reached
constexpr int kAlphaStarts = 9;  // per feasible range
constexpr int kRimStarts = 8;    // points around the allowed end

/// The conditions in the frame of the first edge, turning left, chord of length 1.
struct Frame {
  int degree = 3;
  double angle = 0;  // of the chord from the tangent, in [0, 2 pi)
  double slack = 0;  // end_tolerance over the chord
  Interval alpha;
  Interval s;
  bool growing = true;

  double lowest_s(double a) const { return growing ? std::max(s.low, 1 / std::cos(a)) : s.low; }
  double highest_s(double a) const { return growing ? s.high : std::min(s.high, std::cos(a)); }
  double lowest_angle(double a) const { return end_angle({a, lowest_s(a)}, degree); }
  double highest_angle(double a) const { return end_angle({a, highest_s(a)}, degree); }
};

/// Where on the rim of the allowed disc the end lies, and how often the curve winds before.
struct Rim {
  double direction = 0;
  int winding = 0;
};

struct Target {
  double angle = 0;   // end_angle to be reached
  double length = 1;  // of the chord
};

Target target_at(const Frame& f, const Rim& rim) {
  const double x = 1 + f.slack * std::cos(rim.direction);
  const double y = f.slack * std::sin(rim.direction);
  return {f.angle + std::atan2(y, x) + 2 * kPi * rim.winding, std::hypot(x, y)};
}

struct Candidate {
  double alpha = 0;
  double s = 1;
  Rim rim;
  double energy = HUGE_VAL;  // with a chord of length 1
};

Candidate candidate_at(const Frame& f, const Rim& rim, double alpha) {
  const Target target = target_at(f, rim);
  Candidate c{alpha, 1, rim, HUGE_VAL};
  c.s = scale_at_end_angle(alpha, target.angle, f.degree, {f.lowest_s(alpha), f.highest_s(alpha)});
  const double reach = norm(end_in_frame({c.alpha, c.s}, f.degree));
  c.energy = matrix_energy({c.alpha, c.s}, f.degree).value * reach / target.length;
  return c;
}

// ---- Which alpha can reach a target -------------------------------------------------------

/// End angles at the two ends of the range of s, over alpha; where the upper one has a top between
/// two cells, that alpha is among the nodes.
struct ReachTable {
  std::vector<double> alpha, lowest, highest;
};

/// Where angle_of is largest between a and b, if it has one top there (golden section).
template <class AngleOf>
double top_between(const AngleOf& angle_of, double a, double b) {
  constexpr double kShare = 0.6180339887498949;
  while (b - a > 1e-9) {
    const double left = b - kShare * (b - a);
    const double right = a + kShare * (b - a);
    (angle_of(left) < angle_of(right) ? a : b) = angle_of(left) < angle_of(right) ? left : right;
  }
  return 0.5 * (a + b);
}

ReachTable tabulate(const Frame& f) {
  std::vector<double> nodes;
  for (int i = 0; i <= kCells; ++i) nodes.push_back(at(f.alpha, i / static_cast<double>(kCells)));
  const auto angle_of = [&f](double a) { return f.highest_angle(a); };
  if (!f.growing && f.alpha.low < f.alpha.high) {  // the only side that comes back
    const auto top = std::max_element(
        nodes.begin(), nodes.end(), [&](double a, double b) { return angle_of(a) < angle_of(b); });
    if (top != nodes.begin() && top + 1 != nodes.end())
      nodes.insert(top, top_between(angle_of, *(top - 1), *(top + 1)));
    std::sort(nodes.begin(), nodes.end());
  }
  ReachTable table;
  for (const double a : nodes) {
    table.alpha.push_back(a);
    table.lowest.push_back(f.lowest_angle(a));
    table.highest.push_back(f.highest_angle(a));
  }
  return table;
}

/// Alpha between a and b at which `angle_of` passes the target.
template <class AngleOf>
void add_crossing(std::vector<double>& nodes, const AngleOf& angle_of, double a, double b,
                  double target) {
  const auto root =
      numeric::bracketed_root([&](double x) { return angle_of(x) - target; }, a, b, 1e-15);
  if (root) nodes.push_back(*root);
}

/// Ranges of alpha in which some s of the range reaches the target angle.
std::vector<Interval> feasible_alpha(const Frame& f, const ReachTable& table, double target) {
  std::vector<Interval> ranges;
  for (std::size_t i = 0; i + 1 < table.alpha.size(); ++i) {
    const double a = table.alpha[i];
    const double b = table.alpha[i + 1];
    std::vector<double> nodes = {a, b};
    const bool over[] = {table.lowest[i] > target, table.lowest[i + 1] > target};
    const bool under[] = {table.highest[i] < target, table.highest[i + 1] < target};
    if ((over[0] && over[1]) || (under[0] && under[1])) continue;
    if (over[0] != over[1])
      add_crossing(nodes, [&](double x) { return f.lowest_angle(x); }, a, b, target);
    if (under[0] != under[1])
      add_crossing(nodes, [&](double x) { return f.highest_angle(x); }, a, b, target);
    std::sort(nodes.begin(), nodes.end());
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const double middle = 0.5 * (nodes[k] + nodes[k + 1]);
      if (f.lowest_angle(middle) > target || f.highest_angle(middle) < target) continue;
      if (!ranges.empty() && ranges.back().high == nodes[k])
        ranges.back().high = nodes[k + 1];
      else
        ranges.push_back({nodes[k], nodes[k + 1]});
    }
  }
  if (ranges.empty() && f.alpha.low == f.alpha.high && table.lowest[0] <= target + 1e-12 &&
      table.highest[0] >= target - 1e-12)
    ranges.push_back(f.alpha);
  return ranges;
}

// ---- Starts -------------------------------------------------------------------------------

/// The least of the samples of one winding on each range of alpha, and its local minima there.
std::vector<Candidate> starts_of(const Frame& f, const ReachTable& table, int winding) {
  std::vector<Candidate> starts;
  const int rims = f.slack > 0 ? kRimStarts : 1;
  for (int r = 0; r < rims; ++r) {
    const Rim rim{2 * kPi * r / rims, winding};
    for (const Interval& range : feasible_alpha(f, table, target_at(f, rim).angle)) {
      std::array<Candidate, kAlphaStarts + 1> line;
      for (int i = 0; i <= kAlphaStarts; ++i) {
        const double u = i / static_cast<double>(kAlphaStarts);
        line[i] = candidate_at(f, rim, at(range, u * u * (3 - 2 * u)));
      }
      for (int i = 0; i <= kAlphaStarts; ++i) {
        const bool below = i == 0 || line[i].energy <= line[i - 1].energy;
        const bool above = i == kAlphaStarts || line[i].energy <= line[i + 1].energy;
        if (below && above && std::isfinite(line[i].energy)) starts.push_back(line[i]);
      }
    }
  }
  return starts;
}

/// Keeps the few best starts that are not neighbours of a better one.
std::vector<Candidate> choose(std::vector<Candidate> starts) {
  constexpr std::size_t kMost = 4;
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
  std::vector<Candidate> chosen;
  for (const Candidate& c : starts) {
    if (chosen.size() == kMost) break;
    const auto near = [&](const Candidate& other) {
      return other.rim.winding == c.rim.winding && std::abs(other.alpha - c.alpha) < 0.15;
    };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(c);
  }
  return chosen;
}

// ---- Refinement: x = (alpha, ln s, direction on the rim) ----------------------------------

struct Search {
  const Frame* frame;
  int winding;
};

/// ln(energy) and the end angle with their rates by alpha and ln s.
struct Local {
  double log_energy, energy_by_alpha, energy_by_log_s;
  double angle_by_alpha, angle_by_log_s;
};

Local local_at(double alpha, double s, int degree) {
  // z G'/G of G = 1 + z + … + z^(n-1): by ln z, the rates of ln|G| and of its direction.
  const std::complex<double> z = std::polar(s, alpha);
  std::complex<double> sum = 0;
  std::complex<double> slope = 0;
  for (int i = 0; i < degree; ++i) {
    slope = slope * z + sum;
    sum = sum * z + 1.0;
  }
  const std::complex<double> rate = z * slope / sum;
  const MatrixEnergy energy = matrix_energy({alpha, s}, degree);
  return {std::log(energy.value * std::abs(sum)), energy.log_by_alpha - rate.imag(),
          energy.log_by_s * s + rate.real(), rate.real(), rate.imag()};
}

/// Rates of the target's angle and of ln(length) by the direction on the rim, over the slack.
struct RimRates {
  double angle, log_length;
};
RimRates rim_rates(const Frame& f, double rim) {
  const double squared = 1 + f.slack * (2 * std::cos(rim) + f.slack);
  return {(f.slack + std::cos(rim)) / squared, -std::sin(rim) / squared};
}

double log_energy(unsigned n, const double* x, double* gradient, void* data) {
  const auto& search = *static_cast<const Search*>(data);
  const Frame& f = *search.frame;
  const Local local = local_at(x[0], std::exp(x[1]), f.degree);
  const double rim = n > 2 ? x[2] : 0;
  if (gradient) {
    gradient[0] = local.energy_by_alpha;
    gradient[1] = local.energy_by_log_s;
    if (n > 2) gradient[2] = -f.slack * rim_rates(f, rim).log_length;
  }
  return local.log_energy - std::log(target_at(f, {rim, search.winding}).length);
}

double end_misfit(unsigned n, const double* x, double* gradient, void* data) {
  const auto& search = *static_cast<const Search*>(data);
  const Frame& f = *search.frame;
  const double rim = n > 2 ? x[2] : 0;
  const double s = std::exp(x[1]);
  if (gradient) {
    const Local local = local_at(x[0], s, f.degree);
    gradient[0] = local.angle_by_alpha;
    gradient[1] = local.angle_by_log_s;
    if (n > 2) gradient[2] = -f.slack * rim_rates(f, rim).angle;
  }
  return end_angle({x[0], s}, f.degree) - target_at(f, {rim, search.winding}).angle;
}

/// ln s against ln(1/cos(alpha)) or ln(cos(alpha)): <= 0 in the Class A region.
double class_a_excess(unsigned n, const double* x, double* gradient, void* data) {
  const double sign = static_cast<const Search*>(data)->frame->growing ? 1 : -1;
  if (gradient) {
    std::fill(gradient, gradient + n, 0.0);
    gradient[0] = std::tan(x[0]);
    gradient[1] = -sign;
  }
  return -sign * x[1] - std::log(std::cos(x[0]));
}

/// A point near the minimum, its end met roughly; the start where the optimizer fails.
Candidate search_from(const Frame& f, const Candidate& start) {
  Search search{&f, start.rim.winding};
  const unsigned n = f.slack > 0 ? 3 : 2;
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimizer(nlopt_create(NLOPT_LD_SLSQP, n),
                                                                    nlopt_destroy);
  const double lower[] = {f.alpha.low, std::log(f.s.low), -4 * kPi};
  const double upper[] = {f.alpha.high, std::log(f.s.high), 4 * kPi};
  double x[] = {start.alpha, std::log(start.s), start.rim.direction};
  x[0] = std::clamp(x[0], std::max(lower[0], 1e-9), upper[0]);
  x[1] = std::clamp(x[1], lower[1], upper[1]);
  nlopt_set_lower_bounds(optimizer.get(), lower);
  nlopt_set_upper_bounds(optimizer.get(), upper);
  nlopt_set_min_objective(optimizer.get(), log_energy, &search);
  // Iterates farther off than this are forgotten: too strict, and none is left but the start.
  nlopt_add_equality_constraint(optimizer.get(), end_misfit, &search, 1e-10);
  nlopt_add_inequality_constraint(optimizer.get(), class_a_excess, &search, 1e-10);
  nlopt_set_xtol_rel(optimizer.get(), 1e-8);
  nlopt_set_maxeval(optimizer.get(), 60);
  double least = 0;
  nlopt_optimize(optimizer.get(), x, &least);  // whatever its verdict: the point is judged later
  if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || (n > 2 && !std::isfinite(x[2]))) return start;
  return {x[0], std::exp(x[1]), {n > 2 ? x[2] : 0, start.rim.winding}, HUGE_VAL};
}

/// The candidate nearest to alpha on the given rim, its end met exactly; where no alpha reaches
/// that rim, on the way back to the start's, which one does.
Candidate feasible_near(const Frame& f, const ReachTable& table, const Candidate& start,
                        double alpha, const Rim& rim) {
  const auto nearest_alpha = [&](const Rim& r) {
    double nearest = HUGE_VAL;
    for (const Interval& range : feasible_alpha(f, table, target_at(f, r).angle)) {
      const double a = clamp(range, alpha);
      if (std::abs(a - alpha) < std::abs(nearest - alpha)) nearest = a;
    }
    return nearest;
  };
  Rim reached = rim;
  double best = nearest_alpha(rim);
  if (!std::isfinite(best)) {
    double inside = start.rim.direction;
    double outside = rim.direction;
    while (std::abs(outside - inside) > 1e-14) {
      reached.direction = 0.5 * (inside + outside);
      if (reached.direction == inside || reached.direction == outside) break;
      (std::isfinite(nearest_alpha(reached)) ? inside : outside) = reached.direction;
    }
    reached.direction = inside;
    best = nearest_alpha(reached);
  }
  return std::isfinite(best) ? candidate_at(f, reached, best) : start;
}

/// Rates of ln(energy) along the curves that meet the end: by alpha, and by the direction on the
/// rim over the slack.
struct Slope {
  double by_alpha, by_rim;
};

Slope slope_at(const Frame& f, const Candidate& c) {
  const Local local = local_at(c.alpha, c.s, f.degree);
  const RimRates rim = rim_rates(f, c.rim.direction);
  const double by_angle = local.energy_by_log_s / local.angle_by_log_s;
  return {local.energy_by_alpha - by_angle * local.angle_by_alpha,
          by_angle * rim.angle - rim.log_length};
}

/// The candidate with its end met, or one with s = 0 where alpha cannot reach it.
Candidate moved(const Frame& f, const Candidate& from, double by_alpha, double by_rim) {
  const double alpha = from.alpha + by_alpha;
  const Rim rim{from.rim.direction + by_rim, from.rim.winding};
  const bool inside = contains(f.alpha, alpha) && alpha > 0;
  const double target = target_at(f, rim).angle;
  if (!inside || f.lowest_angle(alpha) > target || f.highest_angle(alpha) < target)
    return {alpha, 0, rim, HUGE_VAL};
  return candidate_at(f, rim, alpha);
}

/// Newton's method to where both slopes vanish, inside the region; the best point met. `converged`
/// is false where the way leads out of the region or the method wanders.
Candidate polish_inside(const Frame& f, const Candidate& start, bool& converged) {
  constexpr double kStep = 1e-5;
  const bool rim_fixed = f.slack == 0;
  Candidate c = start;
  converged = false;
  for (int iteration = 0; iteration < 8 && !converged; ++iteration) {
    const Candidate to_alpha = moved(f, c, kStep, 0);
    const Candidate to_rim = moved(f, c, 0, kStep);
    if (to_alpha.s == 0 || to_rim.s == 0) return c;
    const Slope g = slope_at(f, c);
    const Slope a = slope_at(f, to_alpha);
    const Slope r = slope_at(f, to_rim);
    const double aa = (a.by_alpha - g.by_alpha) / kStep;
    const double ar = rim_fixed ? 0 : (r.by_alpha - g.by_alpha) / kStep;
    const double ra = rim_fixed ? 0 : (a.by_rim - g.by_rim) / kStep;
    const double rr = rim_fixed ? 1 : (r.by_rim - g.by_rim) / kStep;
    const double determinant = aa * rr - ar * ra;
    if (!(aa > 0 && determinant > 0)) return c;
    const double by_rim_slope = rim_fixed ? 0 : g.by_rim;
    const double by_alpha = -(g.by_alpha * rr - ar * by_rim_slope) / determinant;
    const double by_rim = -(aa * by_rim_slope - ra * g.by_alpha) / determinant;
    if (std::hypot(by_alpha, by_rim) > 0.5) return c;
    const Candidate next = moved(f, c, by_alpha, by_rim);
    if (next.s == 0) return c;
    c = next;
    converged = std::abs(by_alpha) < 1e-9 * (1 + c.alpha) && std::abs(by_rim) < 1e-7;
  }
  return c;
}

/// Golden section over the rim, alpha kept at the end of its range.
Candidate polish_at_edge(const Frame& f, const ReachTable& table, const Candidate& start) {
  if (f.slack == 0) return start;
  constexpr double kShare = 0.6180339887498949;
  Candidate best = start;
  const auto probe = [&](double direction) {
    const Rim rim{direction, start.rim.winding};
    Candidate c{0, 0, rim, HUGE_VAL};
    for (const Interval& range : feasible_alpha(f, table, target_at(f, rim).angle)) {
      for (const double alpha : {range.low, range.high}) {
        const Candidate end = candidate_at(f, rim, alpha);
        if (std::abs(alpha - start.alpha) < 0.2 && end.energy < c.energy) c = end;
      }
    }
    if (c.energy < best.energy) best = c;
    return c.energy;
  };
  double low = start.rim.direction - 0.6;
  double high = start.rim.direction + 0.6;
  while (high - low > 1e-7) {
    const double left = high - kShare * (high - low);
    const double right = low + kShare * (high - low);
    const double at_left = probe(left);
    const double at_right = probe(right);
    const bool keep_left = at_left < at_right || (at_left == at_right && left > best.rim.direction);
    (keep_left ? high : low) = keep_left ? right : left;
  }
  return best;
}

Candidate refine(const Frame& f, const ReachTable& table, const Candidate& start) {
  const Candidate rough = search_from(f, start);
  Candidate best = feasible_near(f, table, start, rough.alpha, rough.rim);
  if (start.energy < best.energy) best = start;
  bool converged = false;
  const Candidate inside = polish_inside(f, best, converged);
  // Rounding decides between points as near as this: take the one where the slopes vanish.
  if (converged && inside.energy <= best.energy * (1 + 1e-13)) return inside;
  return polish_at_edge(f, table, best);
}

// ---- Conditions in and out ----------------------------------------------------------------

core::Result<void> check(const EnergyConditions& c) {
  const double chord = norm(c.chord);
  if (!is_finite(c.tangent) || !(norm(c.tangent) > 0))
    return fail(ErrorCode::bad_input, "the tangent has no direction",
                "give a finite vector that is not zero", "tangent");
  if (!is_finite(c.chord)) return fail(ErrorCode::bad_input, "the end is not finite", {}, "chord");
  if (!(c.end_tolerance >= 0 && std::isfinite(c.end_tolerance)))
    return fail(ErrorCode::bad_input, "the end tolerance is negative or not finite",
                "give a length of 0 or more", "end_tolerance");
  if (c.degree < 2 || c.degree > curve::kMaxBezierDegree)
    return fail(ErrorCode::bad_input, "the degree has to lie between 2 and 30", {}, "degree");
  if (!(c.alpha.low >= 0 && c.alpha.low <= c.alpha.high && c.alpha.high < kPi / 2))
    return fail(ErrorCode::bad_input, "the range of alpha has to lie within [0, pi/2)",
                "give alpha_max below 1.5707", "alpha_max");
  if (!(c.s.low > 0 && c.s.low <= c.s.high && std::isfinite(c.s.high)))
    return fail(ErrorCode::bad_input, "the range of s is empty or not positive", {}, "s");
  if (!(chord > 0))
    return fail(ErrorCode::undrawable, "the curve ends where it starts: no Class A curve does",
                "move the end away from the start", "chord");
  if (!(c.end_tolerance < chord))
    return fail(ErrorCode::bad_input, "the end tolerance is not smaller than the chord",
                "give less than " + core::number_text(chord, 6), "end_tolerance");
  return {};
}

/// The range of alpha in which the branch meets the range of s.
bool restrict_alpha(Frame& f) {
  if (f.growing && f.s.high < 1) return false;
  if (!f.growing && f.s.low > 1) return false;
  f.alpha.high = std::min(f.alpha.high, std::acos(f.growing ? 1 / f.s.high : f.s.low));
  return f.alpha.low <= f.alpha.high;
}

core::Failure infeasible(const EnergyConditions& c, const Frame& f) {
  const std::string branch = f.growing ? "s >= 1/cos(alpha)" : "s <= cos(alpha)";
  return {ErrorCode::undrawable,
          "no Class A curve of degree " + std::to_string(c.degree) + " with " + branch +
              ", alpha in [" + core::number_text(c.alpha.low, 6) + ", " +
              core::number_text(c.alpha.high, 6) + "] and s in [" + core::number_text(c.s.low, 6) +
              ", " + core::number_text(c.s.high, 6) +
              "] reaches the end, which lies at an angle of " + core::number_text(f.angle, 6) +
              " to the tangent",
          "widen the ranges, raise the degree, or ask for the other branch", "alpha"};
}

EnergyMinimum straight(const EnergyConditions& c, const Frame& f, double offset) {
  EnergyMinimum m;
  m.s = clamp(f.s, c.near_s);
  m.s = f.growing ? std::max(m.s, 1.0) : std::min(m.s, 1.0);
  const double tolerance = c.end_tolerance;
  const double length = norm(c.chord) * std::cos(offset) +
                        std::sqrt(std::max(0.0, tolerance * tolerance -
                                                    std::pow(norm(c.chord) * std::sin(offset), 2)));
  m.beta = length / (norm(c.tangent) * end_in_frame({0, m.s}, c.degree).x);
  m.chord = (length / norm(c.tangent)) * c.tangent;
  m.left = c.left.value_or(true);
  return m;
}

EnergyMinimum finish(const EnergyConditions& c, const Frame& f, const Candidate& best, bool left) {
  const Target target = target_at(f, best.rim);
  const double length = target.length * norm(c.chord);
  EnergyMinimum m{best.alpha, best.s, 1, best.energy / norm(c.chord), {}, left};
  m.beta = length / (norm(c.tangent) * norm(end_in_frame({best.alpha, best.s}, c.degree)));
  m.chord = length * core::unit_vector(core::direction_of(c.tangent) +
                                       (left ? target.angle : -target.angle));
  return m;
}

}  // namespace

core::Result<EnergyMinimum> minimum_energy(const EnergyConditions& conditions) {
  if (auto checked = check(conditions); !checked) return std::unexpected(checked.error());
  const double offset = core::angle_between(conditions.tangent, conditions.chord);
  const bool left = conditions.left.value_or(offset >= 0);
  Frame f{conditions.degree,
          left ? offset : -offset,
          conditions.end_tolerance,
          conditions.alpha,
          conditions.s,
          conditions.branch == Branch::growing};
  f.slack /= norm(conditions.chord);
  const bool possible = restrict_alpha(f);
  if (possible && f.alpha.low == 0 && std::cos(offset) > 0 &&
      std::abs(std::sin(offset)) <= std::max(f.slack, 1e-15))
    return straight(conditions, f, offset);
  if (f.angle < 0) f.angle += 2 * kPi;
  if (!possible) return std::unexpected(infeasible(conditions, f));
  const ReachTable table = tabulate(f);
  const int windings = static_cast<int>((f.degree - 1) * f.alpha.high / (2 * kPi));
  std::vector<Candidate> starts;
  for (int winding = -1; winding <= windings; ++winding) {
    const std::vector<Candidate> more = starts_of(f, table, winding);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  Candidate best;
  for (const Candidate& start : choose(std::move(starts))) {
    const Candidate c = refine(f, table, start);
    if (c.energy < best.energy) best = c;
  }
  if (!std::isfinite(best.energy)) return std::unexpected(infeasible(conditions, f));
  return finish(conditions, f, best, left);
}

}  // namespace keyline::classa
