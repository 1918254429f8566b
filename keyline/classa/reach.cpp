#include "keyline/classa/reach.h"

#include <algorithm>
#include <cmath>

#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/golden_section.h"
#include "keyline/numeric/roots.h"

namespace keyline::classa::detail {

using core::Interval;
using core::kPi;

namespace {

constexpr int kCells = 48;  // of alpha, to find where an end angle can be reached

/// Alpha between a and b at which `angle_of` passes the target.
template <class AngleOf>
void add_crossing(std::vector<double>& nodes, const AngleOf& angle_of, double a, double b,
                  double target) {
  const auto root =
      numeric::bracketed_root([&](double x) { return angle_of(x) - target; }, a, b, 1e-15);
  if (root) nodes.push_back(*root);
}

}  // namespace

Target target_at(const Frame& f, const Rim& rim) {
  const double x = 1 + f.slack * std::cos(rim.direction);
  const double y = f.slack * std::sin(rim.direction);
  return {f.angle + std::atan2(y, x) + 2 * kPi * rim.winding, std::hypot(x, y)};
}

Candidate candidate_at(const Frame& f, const Rim& rim, double alpha) {
  const Target target = target_at(f, rim);
  Candidate c{alpha, 1, rim, HUGE_VAL};
  c.s = scale_at_end_angle(alpha, target.angle, f.degree, {f.lowest_s(alpha), f.highest_s(alpha)});
  const double reach = norm(end_in_frame({c.alpha, c.s}, f.degree));
  c.energy = matrix_energy({c.alpha, c.s}, f.degree).value * reach / target.length;
  return c;
}

ReachTable tabulate(const Frame& f) {
  std::vector<double> nodes;
  for (int i = 0; i <= kCells; ++i) nodes.push_back(at(f.alpha, i / static_cast<double>(kCells)));
  const auto angle_of = [&f](double a) { return f.highest_angle(a); };
  if (!f.growing && f.alpha.low < f.alpha.high) {  // the only side that comes back
    const auto top = std::max_element(
        nodes.begin(), nodes.end(), [&](double a, double b) { return angle_of(a) < angle_of(b); });
    if (top != nodes.begin() && top + 1 != nodes.end())
      nodes.insert(top, numeric::golden_section([&](double a) { return -angle_of(a); }, *(top - 1),
                                                *(top + 1), 1e-9));
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

}  // namespace keyline::classa::detail
