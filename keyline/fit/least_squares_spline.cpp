#include "keyline/fit/least_squares_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "keyline/fit/basis_rows.h"
#include "keyline/fit/near_data.h"

namespace keyline::fit {
namespace {

using core::ErrorCode;
using detail::kLanes;
using detail::padded;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRankTolerance = 1e-7;

double dot(const double* a, const double* b, std::size_t n) {
  std::array<double, kLanes> sum{};
  for (std::size_t i = 0; i < n; i += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) sum[l] += a[i + l] * b[i + l];
  }
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

void subtract_multiple(double* a, const double* b, double factor, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] -= factor * b[i];
}

/// The order B-splines that are not zero on [knots[span], knots[span + 1]), at x.
void basis_at(const double* knots, std::size_t span, int order, double x, double* out) {
  out[0] = 1;
  for (int r = 1; r < order; ++r) {
    double saved = 0;
    for (int j = 0; j < r; ++j) {
      const double right = knots[span + 1 + static_cast<std::size_t>(j)];
      const double left =
          knots[span + 1 + static_cast<std::size_t>(j) - static_cast<std::size_t>(r)];
      const double part = out[j] / (right - left);
      out[j] = saved + (right - x) * part;
      saved = (x - left) * part;
    }
    out[r] = saved;
  }
}

bool all_finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

core::Result<void> validate(const SplineData& data) {
  const std::size_t n = data.parameters.size();
  if (n == 0 || data.columns.empty()) return core::fail(ErrorCode::bad_input, "no data to fit");
  if (!all_finite(data.parameters)) {
    return core::fail(ErrorCode::bad_input, "a parameter is not a finite number");
  }
  if (!std::is_sorted(data.parameters.begin(), data.parameters.end())) {
    return core::fail(ErrorCode::bad_input, "parameters decrease", "sort the data first");
  }
  for (const auto& column : data.columns) {
    if (column.size() != n) {
      return core::fail(ErrorCode::bad_input, "as many values as parameters are needed");
    }
    if (!all_finite(column)) return core::fail(ErrorCode::bad_input, "a value is not finite");
  }
  if (data.weights.empty()) return {};
  if (data.weights.size() != n) {
    return core::fail(ErrorCode::bad_input, "as many weights as values are needed");
  }
  for (const double w : data.weights) {
    if (!(w > 0) || !std::isfinite(w)) {
      return core::fail(ErrorCode::bad_input, "weights must be positive and finite");
    }
  }
  return {};
}

SplineSolver::SplineSolver(SplineData data, core::Interval domain, int order)
    : domain_(domain), order_(order) {
  if (const auto valid = validate(data); !valid) throw core::InvalidInput(valid.error().message);
  if (order < kMinimumOrder || order > kMaximumOrder) {
    throw core::InvalidInput("spline order outside [2, 8]");
  }
  if (!(domain.low < domain.high) || data.parameters.front() < domain.low ||
      data.parameters.back() > domain.high) {
    throw core::InvalidInput("domain of a spline must hold its data");
  }
  SplineData weighted = data;
  for (double& w : weighted.weights) w = std::sqrt(w);
  for (auto& column : weighted.columns) {
    for (std::size_t i = 0; i < weighted.weights.size(); ++i) column[i] *= weighted.weights[i];
  }
  room_ = detail::room_about(data);
  stride_ = padded(data.parameters.size());
  basis_.resize(stride_ * static_cast<std::size_t>(order));
  rows_.resize(stride_ * (static_cast<std::size_t>(order) + data.columns.size() + 1));
  data_ = std::make_shared<const SplineData>(std::move(data));
  weighted_ = std::make_shared<const SplineData>(std::move(weighted));
}

bool SplineSolver::set_knots(std::span<const double> interior) {
  const auto order = static_cast<std::size_t>(order_);
  knot_count_ = interior.size() + 2 * order;
  if (knots_.size() < knot_count_) knots_.resize(2 * knot_count_);
  std::fill_n(knots_.begin(), order, domain_.low);
  double previous = domain_.low;
  for (std::size_t i = 0; i < interior.size(); ++i) {
    const double t = interior[i];
    if (!(t >= previous) || !(t > domain_.low) || !(t < domain_.high)) return false;
    if (i >= order && t == interior[i - order]) return false;
    knots_[order + i] = previous = t;
  }
  std::fill_n(knots_.begin() + static_cast<std::ptrdiff_t>(order + interior.size()), order,
              domain_.high);
  return interior.size() + order <= data_count();
}

/// Rows [first, last) of the observation matrix, those of one knot span, and their right-hand sides
/// into the scratch; the rows are kept.
template <int order>
void SplineSolver::take_rows(std::size_t span, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  const double* const w = weighted_->weights.empty() ? nullptr : weighted_->weights.data() + first;
  detail::basis_rows<order>(knots_.data(), span, {weighted_->parameters.data() + first, count}, w,
                            rows_.data(), stride_);
  for (std::size_t c = 0; c < order; ++c)
    std::copy_n(rows_.data() + c * stride_, count, basis_.data() + c * stride_ + first);
  for (std::size_t k = 0; k < column_count(); ++k) {
    double* const target = rows_.data() + (static_cast<std::size_t>(order) + k) * stride_;
    std::copy_n(weighted_->columns[k].data() + first, count, target);
    std::fill(target + count, target + padded(count), 0.0);
  }
}

/// Reflects the scratch rows into the triangle below band row `row`; what is left of the
/// right-hand sides is residual and added to `rest`.
template <int order>
void SplineSolver::eliminate(std::size_t row, std::size_t rows, double& rest) {
  const std::size_t columns = column_count();
  for (int j = 0; j < order; ++j) {
    const double* const pivot = rows_.data() + static_cast<std::size_t>(j) * stride_;
    const double below = dot(pivot, pivot, rows);
    if (below == 0) continue;
    const std::size_t r = row + static_cast<std::size_t>(j);
    double* const band = band_.data() + r * order;
    double* const right = right_.data() + r * columns;
    const double diagonal = band[0];
    const double length = std::sqrt(diagonal * diagonal + below);
    const double v0 = diagonal + (diagonal >= 0 ? length : -length);
    const double factor = 1 / (length * std::abs(v0));
    band[0] = diagonal >= 0 ? -length : length;
    const auto reflect = [&](double& entry, double* column) {
      const double g = factor * (v0 * entry + dot(pivot, column, rows));
      entry -= g * v0;
      subtract_multiple(column, pivot, g, rows);
    };
    for (int c = j + 1; c < order; ++c) {
      reflect(band[c - j], rows_.data() + static_cast<std::size_t>(c) * stride_);
    }
    for (std::size_t k = 0; k < columns; ++k) {
      reflect(right[k], rows_.data() + (static_cast<std::size_t>(order) + k) * stride_);
    }
  }
  for (std::size_t k = 0; k < columns; ++k) {
    const double* const left = rows_.data() + (static_cast<std::size_t>(order) + k) * stride_;
    rest += dot(left, left, rows);
  }
}

bool SplineSolver::full_rank(std::size_t coefficients) const {
  const auto order = static_cast<std::size_t>(order_);
  for (std::size_t c = 0; c < coefficients; ++c) {
    double squares = 0;
    for (std::size_t back = 0; back < order && back <= c; ++back) {
      const double entry = band_[(c - back) * order + back];
      squares += entry * entry;
    }
    const double diagonal = band_[c * order];
    if (!(diagonal * diagonal > kRankTolerance * kRankTolerance * squares)) return false;
  }
  return true;
}

/// Calls visit(span, first, last) for each knot span with data, from a span on, up to which so many
/// data belong to others.
template <class Visit>
void SplineSolver::for_spans_after(std::size_t span, std::size_t first, Visit visit) const {
  const std::vector<double>& x = weighted_->parameters;
  const auto order = static_cast<std::size_t>(order_);
  const std::size_t coefficients = knot_count_ - order;
  for (; span < coefficients; ++span) {
    const double end = knots_[span + 1];
    if (!(knots_[span] < end)) continue;
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(first);
    // The last span owns its end.
    const auto stop = span + 1 == coefficients ? x.end() : std::lower_bound(from, x.end(), end);
    const auto last = static_cast<std::size_t>(stop - x.begin());
    if (last > first) visit(span, first, last);
    first = last;
  }
}

/// Band and right-hand sides as the spans left them whose knots are as they were; where to go on.
template <int order>
detail::ReductionStages::Stage SplineSolver::resume(std::size_t coefficients) {
  const std::size_t columns = column_count();
  const auto known = stages_.resume(knots(), order);
  const std::size_t used = known ? known->span : 0;  // rows that are not still 0
  std::fill_n(band_.begin() + used * order, (coefficients + order - used) * order, 0.0);
  std::fill_n(right_.begin() + used * columns, (coefficients + order - used) * columns, 0.0);
  if (!known) return {order - 1, 0, 0};
  const std::size_t open = used + 1 - order;
  stages_.put_back({band_.data() + open * order, (order - 1) * order},
                   {right_.data() + open * columns, (order - 1) * columns});
  return *known;
}

template <int order>
double SplineSolver::reduce(std::size_t interior) {
  const std::size_t coefficients = interior + order;
  const std::size_t columns = column_count();
  if (band_.size() < (coefficients + order) * order) {
    band_.resize(2 * (coefficients + order) * order);
    right_.resize(2 * (coefficients + order) * columns);
  }
  const detail::ReductionStages::Stage from = resume<order>(coefficients);
  double rest = from.rest;
  for_spans_after(from.span, from.data, [&](std::size_t span, std::size_t first, std::size_t last) {
    take_rows<order>(span, first, last);
    eliminate<order>(span + 1 - order, padded(last - first), rest);
    const std::size_t open = span + 2 - order;
    stages_.keep({span + 1, last, rest}, {band_.data() + open * order, (order - 1) * order},
                 {right_.data() + open * columns, (order - 1) * columns});
  });
  return full_rank(coefficients) ? rest : kInfinity;
}

double SplineSolver::sum_of_squares(std::span<const double> interior_knots) {
  if (!set_knots(interior_knots)) return kInfinity;
  return detail::with_order(order_,
                            [&]<int order>() { return reduce<order>(interior_knots.size()); });
}

void SplineSolver::substitute_back(std::size_t coefficients) {
  const auto order = static_cast<std::size_t>(order_);
  const std::size_t columns = column_count();
  solution_.resize(coefficients * columns);
  for (std::size_t r = coefficients; r-- > 0;) {
    for (std::size_t k = 0; k < columns; ++k) {
      double value = right_[r * columns + k];
      for (std::size_t c = 1; c < order && r + c < coefficients; ++c) {
        value -= band_[r * order + c] * solution_[(r + c) * columns + k];
      }
      solution_[r * columns + k] = value / band_[r * order];
    }
  }
}

bool SplineSolver::solve(std::span<const double> interior_knots) {
  if (!std::isfinite(sum_of_squares(interior_knots))) return false;
  substitute_back(interior_knots.size() + static_cast<std::size_t>(order_));
  return true;
}

double SplineSolver::coefficient(std::size_t i, std::size_t column) const {
  return solution_[i * column_count() + column];
}

/// Adds the values of the spline, times the data's weights.
template <int order>
void SplineSolver::add_values(std::span<double> out) const {
  const std::size_t columns = column_count();
  std::size_t first = 0;
  for (const detail::ReductionStages::Stage& stage : stages_.all()) {
    for (std::size_t k = 0; k < columns; ++k) {
      double c[order];
      for (std::size_t j = 0; j < order; ++j)
        c[j] = solution_[(stage.span - order + j) * columns + k];
      double* const target = out.data() + k * data_count();
      const double* const rows = basis_.data();
      for (std::size_t i = first; i < stage.data; ++i) {
        double sum = target[i];
        for (std::size_t j = 0; j < order; ++j) sum += c[j] * rows[j * stride_ + i];
        target[i] = sum;
      }
    }
    first = stage.data;
  }
}

void SplineSolver::residuals(std::span<double> out) const {
  for (std::size_t k = 0; k < column_count(); ++k)
    std::transform(weighted_->columns[k].begin(), weighted_->columns[k].end(),
                   out.data() + k * data_count(), std::negate<>{});
  detail::with_order(order_, [&]<int order>() { add_values<order>(out); });
}

double evaluate(const LeastSquaresSpline& spline, double x, std::size_t column) {
  const auto order = static_cast<std::size_t>(spline.order);
  const auto begin = spline.knots.begin() + spline.order;
  const auto end = spline.knots.end() - spline.order;
  const auto span =
      static_cast<std::size_t>(std::upper_bound(begin, end, x) - spline.knots.begin()) - 1;
  std::array<double, kMaximumOrder> basis{};
  basis_at(spline.knots.data(), span, spline.order, x, basis.data());
  double value = 0;
  for (std::size_t j = 0; j < order; ++j) {
    value += basis[j] * spline.coefficients[column][span + 1 - order + j];
  }
  return value;
}

core::Result<LeastSquaresSpline> least_squares_spline(const SplineData& data,
                                                      std::vector<double> interior_knots,
                                                      int order) {
  if (auto valid = validate(data); !valid) return std::unexpected(valid.error());
  if (order < kMinimumOrder || order > kMaximumOrder) {
    return core::fail(ErrorCode::bad_input, "the order of a spline must lie in [2, 8]");
  }
  const core::Interval domain{data.parameters.front(), data.parameters.back()};
  if (!(domain.low < domain.high)) {
    return core::fail(ErrorCode::bad_input, "all parameters are equal");
  }
  for (const double t : interior_knots) {
    if (!(t > domain.low && t < domain.high)) {
      return core::fail(ErrorCode::bad_input, "a knot lies outside the data");
    }
  }
  std::sort(interior_knots.begin(), interior_knots.end());
  SplineSolver solver(data, domain, order);
  if (!solver.solve(interior_knots)) {
    return core::fail(ErrorCode::not_converged, "too few data between some knots",
                      "remove knots where data are sparse");
  }
  LeastSquaresSpline result;
  result.order = order;
  result.knots.assign(solver.knots().begin(), solver.knots().end());
  std::vector<double> residuals(solver.data_count() * solver.column_count());
  solver.residuals(residuals);
  for (const double r : residuals) result.sum_of_squares += r * r;
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    auto& column = result.coefficients.emplace_back();
    for (std::size_t i = 0; i + static_cast<std::size_t>(order) < result.knots.size(); ++i) {
      column.push_back(solver.coefficient(i, k));
    }
  }
  return result;
}

}  // namespace keyline::fit
