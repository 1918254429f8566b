#include "keyline/lac/space/space_shooting.h"

#include <algorithm>
#include <span>
#include <vector>

#include "keyline/lac/space/space_stretch.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac::detail {
namespace {

/// Curvature and torsion times length over the fraction of the length.
struct Laws {
  double alpha, beta;
  double bend, length;
  double start_torsion;
  double torsion_rate;  ///< T^-beta = T0^-beta + beta torsion_rate t

  double curvature(double t) const { return length * carried(1, alpha, bend * t); }
  double torsion(double t) const { return carried(start_torsion, beta, torsion_rate * t); }
};

void find_changes(const Laws& laws, double omega, std::span<const RideNode> nodes,
                  std::span<Change<3>> change) {
  const double by_length =
      omega == 0 ? 0.0 : omega * (1 - laws.beta) * std::pow(laws.length, -laws.beta);
  const bool none = laws.start_torsion == 0 && laws.beta >= 0;
  double all = 0;
  double shifted = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = nodes[i].place;
    const double bend = laws.curvature(t) / laws.length;
    const bool counts = nodes[i].weight > 0;
    change[i].curvature[2] = bend;
    change[i].curvature[0] = counts ? -t * laws.length * bounded_power(bend, 1 + laws.alpha) : 0.0;
    const double sensitive = none ? 1 : bounded_power(laws.torsion(t), 1 + laws.beta);
    change[i].torsion[1] = counts ? sensitive : 0.0;
    all += nodes[i].weight * change[i].torsion[1];
    shifted -= nodes[i].weight * by_length * t * change[i].torsion[1];
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    change[i].torsion[2] = -(by_length * nodes[i].place + shifted / all) * change[i].torsion[1];
    change[i].torsion[1] /= all;
  }
}

/// Cut where a law's few steps would not follow it.
std::vector<Stretch> stretches_of(const Laws& laws) {
  LawRun bend{HUGE_VAL, laws.alpha, -laws.bend};
  LawRun twist{HUGE_VAL, laws.beta, -laws.torsion_rate};
  if (laws.alpha != 0 && laws.bend != 0) bend.place = -1 / (laws.alpha * laws.bend);
  const double t = laws.start_torsion;
  if (laws.beta != 0 && laws.torsion_rate != 0)
    twist.place = -std::copysign(std::pow(std::abs(t), -laws.beta), laws.beta < 0 ? t : 1) /
                  (laws.beta * laws.torsion_rate);
  return graded_stretches(bend, twist);
}

}  // namespace

std::optional<double> start_torsion(double beta, double omega, const SpaceUnknowns& x) {
  const double rate = unit_rate(beta, omega, x.length);
  if (rate == 0 || (x.twist == 0 && beta >= 0)) return x.twist;
  // Somewhere the torsion is its own mean: there the law is anchored, and the place is sought.
  const auto excess = [&](double place) {
    const double first = carried(x.twist, beta, -rate * place);
    const double last = carried(x.twist, beta, rate * (1 - place));
    if (std::isnan(first) || std::isnan(last)) return 1e300;  // infinite torsion on the way
    const double mean =
        beta < 0 ? numeric::signed_power_mean_integral(first, last, -beta, 1)
                 : numeric::power_mean_integral(std::abs(first), std::abs(last), -beta, 1);
    return beta < 0 ? mean - x.twist : mean - std::abs(x.twist);
  };
  if (excess(0.5) == 0) return carried(x.twist, beta, -rate / 2);
  const auto place = numeric::bracketed_root(excess, 0, 1, 0);
  if (!place) return std::nullopt;
  const double start = carried(x.twist, beta, -rate * *place);
  const double end = carried(x.twist, beta, rate * (1 - *place));
  if (!std::isfinite(start) || !std::isfinite(end)) return std::nullopt;
  return start;
}

std::optional<SpaceShot> shoot_space(const SpaceStandardForm& form, const SpaceUnknowns& x) {
  const auto torsion = start_torsion(form.beta, form.omega, x);
  if (!torsion || !(x.length > 0)) return std::nullopt;
  const Laws laws{form.alpha, form.beta, x.bend,
                  x.length,   *torsion,  unit_rate(form.beta, form.omega, x.length)};
  if (!std::isfinite(laws.curvature(1)) || !std::isfinite(laws.torsion(1))) return std::nullopt;
  const std::vector<Stretch> stretches = stretches_of(laws);
  const Ride ride = ride_along(laws, std::span<const Stretch>(stretches));
  std::vector<Change<3>> change(ride.nodes.size());
  find_changes(laws, form.omega, ride.nodes, change);
  return ride.shot<3>(std::span<const Change<3>>(change));
}

}  // namespace keyline::lac::detail
