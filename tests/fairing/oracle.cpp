#include "oracle.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/free_ends.h"
#include "keyline/fairing/run.h"
#include "keyline/fairing/settle.h"

namespace keyline::fairing::testing {
namespace {

core::Point2 scaled(core::Point2 p, double scale) { return {scale * p.x, scale * p.y}; }

/// The truth in a frame where its length is 1, as a chain to be fitted.
FitChain told_chain(const lac::Chain& truth, double scale, std::size_t points) {
  FitChain chain;
  const double whole = lac::arc_length(truth);
  double direction = truth.start.direction;
  std::vector<double> ends;
  for (const lac::Segment& s : lac::segments(truth)) {
    chain.joints.push_back({scaled(s.start.position, scale), direction, s.curvature_start / scale});
    chain.pieces.push_back({scale * s.length, s.alpha});
    direction += lac::total_turning(s);
    ends.push_back((ends.empty() ? 0 : ends.back()) + s.length);
  }
  const core::Pose2 end = lac::end_pose(truth);
  chain.joints.push_back(
      {scaled(end.position, scale), direction, truth.pieces.back().curvature_end / scale});
  for (std::size_t j = 0; j < points; ++j) {
    const double at = whole * static_cast<double>(j) / static_cast<double>(points - 1);
    std::size_t i = 0;
    while (i + 1 < ends.size() && ends[i] < at) ++i;
    const double from = i == 0 ? 0 : ends[i - 1];
    chain.feet.push_back(
        {static_cast<int>(i), std::clamp((at - from) / (ends[i] - from), 0.0, 1.0)});
  }
  chain.first_at_start = chain.last_at_end = true;
  return chain;
}

}  // namespace

FairResult oracle_fit(const lac::Chain& truth, const std::vector<core::Point2>& points,
                      double noise) {
  const double scale = 1 / lac::arc_length(truth);
  detail::RunResult solved;
  solved.to_canonical.scale = scale;
  for (const core::Point2 p : points) solved.points.push_back({scaled(p, scale)});
  solved.fit = told_chain(truth, scale, points.size());
  solved.accept = {1, scale * noise};
  ChainFitOptions fit;
  fit.fine = true;
  fit.iterations = 200;
  fit.gradient_tolerance = 1e-10;
  fit.slope_prior = 1e-3;
  fit.scale = 4 * scale * noise;
  fit_chain(solved.fit, solved.points, fit);
  fit.close_gaps = true;
  fit_chain(solved.fit, solved.points, fit);
  solved.chain = detail::lay_out(solved.fit, solved.to_canonical, false);
  for (std::size_t j = 0; j < points.size(); ++j) solved.point_of.push_back(j);
  solved.accept.tolerance = 5 * scale * noise;
  detail::Run run;
  run.points = points;
  run.length = 1 / scale;
  detail::RunOptions options;
  options.tolerance = 5 * noise;
  options.noise = noise;
  detail::place_free_ends(solved, run, options);
  FairResult result;
  result.curves.push_back(solved.chain);
  return result;
}

}  // namespace keyline::fairing::testing
