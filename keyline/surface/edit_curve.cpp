#include "keyline/surface/edit_curve.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/axis.h"
#include "keyline/core/text.h"
#include "keyline/numeric/halving.h"

namespace keyline::surface::detail {

using core::cross;
using core::dot;
using core::Interval;
using core::norm;
using core::number_text;
using core::Vector3;

namespace {

/// In the direction its minimum is looked for.
Curve oriented(const CurveTask& task) {
  Curve c = task.control;
  if (task.from_end) std::reverse(c.begin(), c.end());
  return c;
}

classa::EnergyConditions conditions_of(const CurveTask& task) {
  const Curve c = oriented(task);
  const Vector3 tangent = c[1] - c[0];
  const Vector3 chord = c.back() - c[0];
  const double angle = core::angle_between(tangent, chord);
  const CurveCondition& asked = task.condition;
  classa::EnergyConditions e;
  e.tangent = {norm(tangent), 0};
  e.chord = {norm(chord) * std::cos(angle), norm(chord) * std::sin(angle)};
  e.degree = static_cast<int>(c.size()) - 1;
  e.end_tolerance = asked.end_tolerance.value_or(task.end_tolerance.value_or(0.01 * norm(chord)));
  e.alpha = asked.alpha.value_or(Interval{0, task.alpha_max});
  e.s = asked.s.value_or(e.s);
  e.branch = asked.branch.value_or(classa::Branch::growing);
  return e;
}

/// The ranges `share` of the way to the widest ones.
classa::EnergyConditions widened(classa::EnergyConditions e, double share, double alpha_max) {
  const auto scale = [share](double from, double to) {
    return std::exp(std::lerp(std::log(from), std::log(to), share));
  };
  e.alpha = {std::lerp(e.alpha.low, 0.0, share), std::lerp(e.alpha.high, alpha_max, share)};
  e.s = {scale(e.s.low, 0.01), scale(e.s.high, 100)};
  return e;
}

}  // namespace

core::Result<classa::EnergyMinimum> minimum_of(const CurveTask& task) {
  if (task.control.size() < 3) return classa::EnergyMinimum{};
  return classa::minimum_energy(conditions_of(task));
}

std::optional<classa::EnergyMinimum> nearest_minimum(const CurveTask& task) {
  if (task.control.size() < 3) return classa::EnergyMinimum{};
  const classa::EnergyConditions e = conditions_of(task);
  const auto at = [&](double share) {
    return classa::minimum_energy(widened(e, share, task.alpha_max));
  };
  auto best = at(1);
  if (!best) return std::nullopt;
  const auto has_one = [&](double share) {
    auto found = at(share);
    if (found) best = std::move(found);
    return found.has_value();
  };
  constexpr int kHalvings = 24;  // to 1e-7 of the way
  numeric::last_that_holds(has_one, 1, 0, kHalvings);
  return *best;
}

Curve least_energy_curve(const CurveTask& task) {
  Curve c = oriented(task);
  if (c.size() > 2) {
    const auto m = minimum_of(task);
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
  if (task.from_end) std::reverse(c.begin(), c.end());
  return c;
}

std::string why_no_minimum(const CurveTask& task) {
  const std::string asked = ranges_text(task.condition);
  const auto nearest = nearest_minimum(task);
  if (!nearest || asked.empty()) return "no Class A curve meets its ends and tangent";
  return "no Class A curve with " + asked +
         " meets its ends and tangent; the nearest has alpha = " + number_text(nearest->alpha, 6) +
         ", s = " + number_text(nearest->s, 6);
}

}  // namespace keyline::surface::detail
