#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/run.h"
#include "keyline/fit/fit_spline.h"

/// A part of a key-line to be faired, and what stays as it is.
namespace keyline::fairing::detail {

/// Points of a region given in fractions of the length, with the parameters of the feet of the
/// first and the last of them on the spline through the points (which runs by chord length, nearly
/// where points are dense and noisy).
struct RegionPoints {
  std::size_t first = 0;
  std::size_t last = 0;
  double t_first = 0;
  double t_last = 1;
};
RegionPoints points_in_region(const std::vector<core::Point2>& points, bool closed,
                              core::Interval region, const curve::BSpline2& spline);

/// The answer's members in order: a spline that is kept, or nothing for the next of the runs.
using AnswerMembers = std::vector<std::optional<curve::BSpline2>>;

struct RegionPlan {
  std::vector<Run> runs;                 ///< to be faired
  std::vector<curve::BSpline2> splines;  ///< of them, parts of the splines between corners
  AnswerMembers members;
  double kept_deviation = 0;  ///< largest distance of a point outside from what is kept
  double bic = 0;
};

/// Cuts the key-line at its corners, where these are kept, and at the ends of the region. Splines
/// meet at the corners' points. bad_input where no part of the region between two corners holds
/// five points. `fit`: as solve_runs takes it.
core::Result<RegionPlan> plan_region(const acquire::KeyLine& line, const FairOptions& options,
                                     const fit::SplineFitOptions& fit);

/// Lengths of what is kept before each of so many runs, since the one before.
std::vector<double> kept_before(const AnswerMembers& members, std::size_t runs);

/// Tells what stays outside the region: how far it is from its points, and by how much it passes
/// the bounds that the runs stay inside of.
std::string note_of_kept(const RegionPlan& plan, const std::vector<core::HalfPlane>& inside,
                         double tolerance);

}  // namespace keyline::fairing::detail
