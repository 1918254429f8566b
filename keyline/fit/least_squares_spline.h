#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/fit/reduction_stages.h"

/// Least-squares splines with given knots.
///
/// Order m = degree + 1. The interior knots, increasing, may coincide up to m times: a cubic
/// (m = 4) has a kink at a triple knot and a jump at a fourfold one. The full knot vector repeats
/// both ends of the domain m times; n interior knots give n + m coefficients.
namespace keyline::fit {

/// Values at increasing parameters, one or several columns (x and y of a plane curve), and their
/// weights w > 0 (none: all 1). Parameters may repeat.
struct SplineData {
  std::vector<double> parameters;
  std::vector<std::vector<double>> columns;
  std::vector<double> weights;
};

/// bad_input where sizes differ, a number is not finite, parameters decrease, a weight is not
/// positive, or there is no data.
core::Result<void> validate(const SplineData& data);

inline constexpr int kMinimumOrder = 2;
inline constexpr int kMaximumOrder = 8;

/// Solves one set of data for many knot vectors, without allocating once the largest number of
/// knots has been seen. Not for two threads at once: copies are cheap (the data are shared).
///
/// Method: the observation matrix is reduced span by span to a banded triangle by Householder
/// reflections (the sequential accumulation of Lawson & Hanson, Solving Least Squares Problems,
/// ch. 27; de Boor, A Practical Guide to Splines, for the B-splines). Unlike banded normal
/// equations it does not square the condition number, which close knots make large. Cost:
/// O(N m (m + columns)) for N data, whatever the number of knots.
///
/// Rank: knots that violate the Schoenberg-Whitney conditions, or come so near to doing so that
/// a diagonal entry of the triangle falls below 1e-7 of its column, have no fit: infinity.
class SplineSolver {
 public:
  /// Throws InvalidInput where validate(data) fails, order is outside [2, 8], or the domain is
  /// empty or does not hold all parameters.
  SplineSolver(SplineData data, core::Interval domain, int order);

  /// Least Q = sum of w_j |F_j - S(x_j)|^2 over all columns ([Fairing] Eq. 4); infinity where the
  /// knots have no fit: not increasing, not inside the open domain, or deficient in rank.
  double sum_of_squares(std::span<const double> interior_knots);

  /// The same, and makes coefficients() and residuals() those of these knots. False: no fit.
  bool solve(std::span<const double> interior_knots);

  /// The same two, but the knots have no fit either where their spline leaves the data: where,
  /// between the first of them and the last, it goes farther from their bounding box than this is
  /// long. Near knots and few data can determine a coefficient so barely that what is left of the
  /// data at a neighbour's foot sends it billions of lengths away.
  double sum_near_data(std::span<const double> interior_knots);
  bool solve_near_data(std::span<const double> interior_knots);

  /// After solve(): coefficient i of a column, i in [0, n + m).
  double coefficient(std::size_t i, std::size_t column) const;

  /// Entry (i, j), i <= j < i + m, of the banded triangle the observations were reduced to.
  double triangle(std::size_t i, std::size_t j) const {
    return band_[i * static_cast<std::size_t>(order_) + (j - i)];
  }

  /// After solve(): sqrt(w_j) (S(x_j) - F_j), the columns one after another; size N * columns.
  void residuals(std::span<double> out) const;

  /// Full knot vector of the last call.
  std::span<const double> knots() const { return {knots_.data(), knot_count_}; }

  int order() const { return order_; }
  std::size_t data_count() const { return data_->parameters.size(); }
  std::size_t column_count() const { return data_->columns.size(); }
  const SplineData& data() const { return *data_; }
  const core::Interval& domain() const { return domain_; }

 private:
  template <int order>
  double reduce(std::size_t interior);
  template <int order>
  detail::ReductionStages::Stage resume(std::size_t coefficients);
  template <int order>
  void take_rows(std::size_t span, std::size_t first, std::size_t last);
  template <int order>
  void eliminate(std::size_t row, std::size_t rows, double& rest);
  template <int order>
  void add_values(std::span<double> out) const;
  template <class Visit>
  void for_spans_after(std::size_t span, std::size_t first, Visit visit) const;
  bool set_knots(std::span<const double> interior);
  bool full_rank(std::size_t coefficients) const;
  void substitute_back(std::size_t coefficients);
  bool stays_near_data() const;

  std::shared_ptr<const SplineData> data_;      // as given
  std::shared_ptr<const SplineData> weighted_;  // columns times sqrt(w), weights = sqrt(w)
  std::vector<core::Interval> room_;            // of each column, for a spline near the data
  core::Interval domain_;
  int order_;
  std::vector<double> knots_;
  std::size_t knot_count_ = 0;
  std::vector<double> band_;      // row i: entries of columns i … i + order - 1
  std::vector<double> right_;     // row i: right-hand sides
  std::vector<double> solution_;  // row i: coefficients
  detail::ReductionStages stages_;
  std::vector<double> basis_;  // columns of the observation matrix, each datum's of its own span
  std::vector<double> rows_;   // scratch: columns of the rows of one span
  std::size_t stride_ = 0;
};

/// A spline with one or several columns of coefficients, in the parameter of its data.
struct LeastSquaresSpline {
  int order = 4;
  std::vector<double> knots;                      ///< full
  std::vector<std::vector<double>> coefficients;  ///< per column, knots.size() - order of them
  double sum_of_squares = 0;                      ///< weighted
};

/// Value of one column at x; continued by its end pieces outside the domain, continuous from the
/// right at a jump (from the left at the domain's end).
double evaluate(const LeastSquaresSpline& spline, double x, std::size_t column = 0);

/// Best spline for the given interior knots (any order of them) on the domain of the data.
/// bad_input where the data are not valid or the knots are not inside; not_converged with a hint
/// where some knots have too few data between them (Schoenberg-Whitney).
core::Result<LeastSquaresSpline> least_squares_spline(const SplineData& data,
                                                      std::vector<double> interior_knots,
                                                      int order);

}  // namespace keyline::fit
