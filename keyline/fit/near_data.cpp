#include "keyline/fit/near_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace keyline::fit {
namespace {

/// Coefficients of one column over full knots.
template <class Coefficient>
struct Column {
  std::span<const double> knots;
  std::size_t order = 0;
  Coefficient coefficient;

  /// Value on [knots[span], knots[span + 1]] by de Boor's algorithm.
  double value(std::size_t span, double x) const {
    std::array<double, kMaximumOrder> d{};
    for (std::size_t j = 0; j < order; ++j) d[j] = coefficient(span + 1 - order + j);
    for (std::size_t r = 1; r < order; ++r) {
      for (std::size_t j = order - 1; j >= r; --j) {
        const std::size_t i = span + 1 - order + j;
        const double share = (x - knots[i]) / (knots[i + order - r] - knots[i]);
        d[j] = (1 - share) * d[j - 1] + share * d[j];
      }
    }
    return d[order - 1];
  }
};
// For clang before 17, which does not deduce it of a struct without constructors.
template <class Coefficient>
Column(std::span<const double>, std::size_t, Coefficient) -> Column<Coefficient>;

/// Whether the column keeps within its room on the shown part of its domain: surely where its
/// coefficients do, otherwise by its value at the extrema of Chebyshev's polynomial of degree
/// 2m on every span: a polynomial of degree below m is nowhere larger than 1 / cos(pi (m - 1) / (4
/// m)) of its largest value there (Ehlich & Zeller, Math. Z. 86, 1964).
template <class Coefficient>
bool keeps_within(const Column<Coefficient>& column, core::Interval room, core::Interval shown) {
  const std::size_t order = column.order;
  const std::size_t count = column.knots.size() - order;
  bool inside = true;
  for (std::size_t i = 0; i < count; ++i) inside &= core::contains(room, column.coefficient(i));
  if (inside) return true;
  const std::size_t places = 2 * order;
  for (std::size_t span = order - 1; span < count; ++span) {
    const core::Interval part{std::max(column.knots[span], shown.low),
                              std::min(column.knots[span + 1], shown.high)};
    if (!(part.low < part.high)) continue;
    for (std::size_t i = 0; i <= places; ++i) {
      const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(places);
      const double x = core::at(part, (1 - std::cos(angle)) / 2);
      if (!core::contains(room, column.value(span, x))) return false;
    }
  }
  return true;
}

core::Interval range_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high};
}

}  // namespace

namespace detail {

std::vector<core::Interval> room_about(const SplineData& data) {
  std::vector<core::Interval> room;
  double longest = 0;
  for (const auto& column : data.columns) {
    room.push_back(range_of(column));
    longest = std::max(longest, core::length(room.back()));
  }
  for (core::Interval& side : room) side = {side.low - longest, side.high + longest};
  return room;
}

bool stays_near(const LeastSquaresSpline& spline, const SplineData& data) {
  const std::vector<core::Interval> room = room_about(data);
  const core::Interval shown{data.parameters.front(), data.parameters.back()};
  for (std::size_t k = 0; k < room.size(); ++k) {
    const Column column{spline.knots, static_cast<std::size_t>(spline.order),
                        [&](std::size_t i) { return spline.coefficients[k][i]; }};
    if (!keeps_within(column, room[k], shown)) return false;
  }
  return true;
}

}  // namespace detail

bool SplineSolver::stays_near_data() const {
  const core::Interval shown{data_->parameters.front(), data_->parameters.back()};
  for (std::size_t k = 0; k < room_.size(); ++k) {
    const Column column{knots(), static_cast<std::size_t>(order_),
                        [&](std::size_t i) { return coefficient(i, k); }};
    if (!keeps_within(column, room_[k], shown)) return false;
  }
  return true;
}

bool SplineSolver::solve_near_data(std::span<const double> interior_knots) {
  return solve(interior_knots) && stays_near_data();
}

double SplineSolver::sum_near_data(std::span<const double> interior_knots) {
  const double sum = sum_of_squares(interior_knots);
  if (!std::isfinite(sum)) return sum;
  substitute_back(interior_knots.size() + static_cast<std::size_t>(order_));
  return stays_near_data() ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace keyline::fit
