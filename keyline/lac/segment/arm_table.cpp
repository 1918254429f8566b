#include "keyline/lac/segment/arm_table.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr int kNodes = 16;

/// Chebyshev points of the first kind on [-1, 1] and the cosines of the discrete transform.
struct ChebyshevGrid {
  std::array<double, kNodes> node{};
  std::array<std::array<double, kNodes>, kNodes> cosine{};  // [degree][node]
  ChebyshevGrid() {
    for (int k = 0; k < kNodes; ++k) {
      const double angle = core::kPi * (k + 0.5) / kNodes;
      node[k] = std::cos(angle);
      for (int j = 0; j < kNodes; ++j) cosine[j][k] = std::cos(j * angle) * 2 / kNodes;
    }
  }
};

const ChebyshevGrid& grid() {
  static const ChebyshevGrid instance;
  return instance;
}

/// Sum of c_j T_j(x): Clenshaw's recurrence in T_2(x), even and odd terms side by side, so that the
/// chain of dependent operations is half as long.
template <std::size_t N>
Vector2 chebyshev_sum(const std::array<Vector2, N>& c, double x) {
  static_assert(N % 2 == 1);
  const double second = 2 * x * x - 1;
  const double step = 2 * second;
  Vector2 even1, even2, odd1, odd2;
  for (std::size_t j = N / 2; j >= 1; --j) {
    const Vector2 even0 = step * even1 - even2 + c[2 * j];
    const Vector2 odd0 = step * odd1 - odd2 + c[2 * j - 1];
    even2 = even1;
    even1 = even0;
    odd2 = odd1;
    odd1 = odd0;
  }
  return (second * even1 - even2 + c[0]) + x * (odd1 - odd2);
}

}  // namespace

ArmTable::ArmTable(const Arm& arm) : arm_(arm) {
  if (arm.range == 0) {
    end_ = arm_vector_at(arm, 1, 0);
    return;
  }
  PanelWalk walk(arm, arm.range, 1.5, 1);
  Panel panel;
  while (walk.next(panel)) {
    Series series{panel.from, panel.to, panel.straight, end_, {}, 0, {}};
    add_series(series, panel);
    // Straight panels are measured by the arc: one that begins the arm does not end it.
    end_ = value(series, panel.to, panel.to < arm.range ? arm.arc_fraction(panel.to) : 1);
    series_.push_back(series);
  }
}

void ArmTable::add_series(Series& series, const Panel& panel) const {
  if (panel.straight) {
    series.direction =
        core::unit_vector(panel.from == 0 ? 0.0 : arm_.turning * arm_.angle_fraction(panel.from));
    series.arc = panel.from == 0 ? 0.0 : arm_.arc_fraction(panel.from);
    return;
  }
  const ChebyshevGrid& g = grid();
  const double half = (panel.to - panel.from) / 2;
  std::array<Vector2, kNodes> value_at{};
  for (int k = 0; k < kNodes; ++k) {
    const double lambda = panel.from + half * (1 + g.node[k]);
    const double angle = arm_.turning * arm_.angle_fraction(lambda);
    value_at[k] = (half * std::exp(-arm_.a * lambda) / arm_.arc_total) * core::unit_vector(angle);
  }
  std::array<Vector2, kNodes + 2> c{};
  for (int j = 0; j < kNodes; ++j) {
    for (int k = 0; k < kNodes; ++k) c[j] = c[j] + g.cosine[j][k] * value_at[k];
  }
  Vector2 at_start;
  for (int j = 1; j <= kOrder; ++j) {
    series.coefficient[j] = (1.0 / (2 * j)) * (c[j - 1] - c[j + 1]);
    at_start = j % 2 == 0 ? at_start + series.coefficient[j] : at_start - series.coefficient[j];
  }
  series.coefficient[0] = -at_start;
}

Vector2 ArmTable::value(const Series& series, double lambda, double fraction) const {
  if (series.straight) {
    const double arc = std::isinf(lambda) ? 1 : fraction;
    return series.origin + (arc - series.arc) * series.direction;
  }
  const double x = 2 * ((lambda - series.from) / (series.to - series.from)) - 1;
  return series.origin + chebyshev_sum(series.coefficient, x);
}

Vector2 ArmTable::vector_at(double fraction, double complement) const {
  if (arm_.range == 0) return arm_vector_at(arm_, fraction, complement);
  const double lambda = arm_.lambda_at(fraction, complement);
  const auto beyond = [](double x, const Series& s) { return x < s.to; };
  auto it = std::upper_bound(series_.begin(), series_.end(), lambda, beyond);
  if (it == series_.end()) --it;
  return value(*it, lambda, fraction);
}

}  // namespace keyline::lac::detail
