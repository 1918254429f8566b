#include "keyline/classa/energy_refine.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <utility>

#include <nlopt.h>

#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/golden_section.h"
#include "keyline/numeric/halving.h"

namespace keyline::classa::detail {

using core::Interval;
using core::kPi;

namespace {

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
  // Not std::polar: the optimiser also tries what is no number, and takes the answer for bad.
  const std::complex<double> z{s * std::cos(alpha), s * std::sin(alpha)};
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
    constexpr int kHalvings = 50;  // to rounding
    const auto is_reached = [&](double direction) {
      return std::isfinite(nearest_alpha({direction, rim.winding}));
    };
    reached.direction =
        numeric::last_that_holds(is_reached, start.rim.direction, rim.direction, kHalvings);
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
    const double step = kStep * std::min(1.0, c.alpha);  // nearly straight curves are as exact
    const Candidate to_alpha = moved(f, c, step, 0);
    const Candidate to_rim = moved(f, c, 0, kStep);
    if (to_alpha.s == 0 || to_rim.s == 0) return c;
    const Slope g = slope_at(f, c);
    const Slope a = slope_at(f, to_alpha);
    const Slope r = slope_at(f, to_rim);
    const double aa = (a.by_alpha - g.by_alpha) / step;
    const double ar = rim_fixed ? 0 : (r.by_alpha - g.by_alpha) / kStep;
    const double ra = rim_fixed ? 0 : (a.by_rim - g.by_rim) / step;
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
    converged = std::abs(by_alpha) < 1e-9 * std::min(1.0, c.alpha) && std::abs(by_rim) < 1e-7;
  }
  return c;
}

/// Golden section over the rim, alpha kept at the end of its range.
Candidate polish_at_edge(const Frame& f, const ReachTable& table, const Candidate& start) {
  if (f.slack == 0) return start;
  Candidate best = start;
  // What is no curve is the worse the farther it is from the best so far.
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
    return std::pair(c.energy, std::abs(direction - best.rim.direction));
  };
  numeric::golden_section(probe, start.rim.direction - 0.6, start.rim.direction + 0.6, 1e-7);
  return best;
}

}  // namespace

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

}  // namespace keyline::classa::detail
