#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "keyline/core/interval.h"

namespace keyline::analysis::detail {

/// The curves fitted to a piece, all in its frame (length 1, radius growing).
///
/// One and two lines share one form around an anchor b: with x = s - b,
///   kappa = km (1 - alpha lambda x)^(-1/alpha),   alpha = alpha0 before b, alpha1 after it,
/// so that curvature and its rate (km lambda) agree at b: the power mean (docs/readings.md) with
/// a G3 joint. One line is alpha0 = alpha1.
struct LineModel {
  double curvature = 1;  ///< km
  double rate = 0;       ///< lambda, relative to km
  double anchor = 0.5;   ///< b in (0, 1)
  double slope0 = 0;
  double slope1 = 0;
};

/// Rates with which the whole piece exists (no cusp, no inflection inside).
core::Interval drawable_rates(const LineModel& m);
/// The model's rate folded back to where it is drawable.
double drawable_rate(const LineModel& m);
/// Curvature at s; the model's rate must be drawable.
double curvature_at(const LineModel& m, double s);
/// Turning of every one of so many cells.
Eigen::VectorXd turning_of(const LineModel& m, int cells);

/// A model without its curvature, at the ends of the cells: there the turning from the anchor is
/// the product of curvature, stretched and ratio.
struct Shape {
  LineModel model;
  std::vector<double> stretched;
  std::vector<double> ratio;
};

/// Turnings of line models, by their parameters, in as many cells as the frame has.
class Lines {
 public:
  using Model = std::function<LineModel(const Eigen::VectorXd&)>;
  explicit Lines(Model model) : model_(std::move(model)) {}

  Eigen::VectorXd at(const Eigen::VectorXd& x, int cells);
  /// Of parameters some of which are those asked for last.
  Eigen::VectorXd beside(const Eigen::VectorXd& x, int cells) const;

 private:
  Model model_;
  Shape last_;
};

}  // namespace keyline::analysis::detail
