#include <algorithm>

#include "keyline/core/text.h"
#include "keyline/lac/g2/spline.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using Ends = std::array<std::optional<double>, 2>;

struct SplineRequest {
  std::vector<core::Point2> points;
  std::vector<double> alpha{-1};
  bool closed = false;
  Ends directions;
  Ends curvatures;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SplineRequest::points>("what the curve passes, in order").count(1).needed(),
        core::field<&SplineRequest::alpha>("one slope, or one per span").count(1).or_bare_item(),
        core::field<&SplineRequest::closed>("whether the curve returns to the first point"),
        core::field<&SplineRequest::directions>(
            "[start, end] direction of travel; null for a free end")
            .in("radian"),
        core::field<&SplineRequest::curvatures>(
            "[start, end] signed curvature; null for a free end")
            .in("1/length"));
  }
};

struct OverriddenSpan {
  std::size_t span = 0;
  double alpha = -1;
  static constexpr auto describe() {
    return core::fields(core::field<&OverriddenSpan::span>("which, from 0"),
                        core::field<&OverriddenSpan::alpha>("the slope it got"));
  }
};

struct SplineReport {
  std::size_t spans = 0;
  std::vector<OverriddenSpan> overridden;
  double deviation = 0;
  int iterations = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SplineReport::spans>("pieces between points"),
        core::field<&SplineReport::overridden>(
            "spans whose curvature changes sign, or that have a needle otherwise"),
        core::field<&SplineReport::deviation>("largest distance of a point").in("length"),
        core::field<&SplineReport::iterations>("of the solver"));
  }
};

struct SplineResult {
  MadeCurve curve;
  SplineReport report;
  static constexpr auto describe() {
    return core::fields(core::flattened<&SplineResult::curve>(),
                        core::field<&SplineResult::report>("what was overridden, how it went"));
  }
};

lac::SplineOptions options_of(const SplineRequest& request) {
  lac::SplineOptions options;
  options.closed = request.closed;
  options.alpha = request.alpha;
  options.start = {request.directions[0], request.curvatures[0]};
  options.end = {request.directions[1], request.curvatures[1]};
  return options;
}

Result<SplineResult> run(const SplineRequest& request, const Context&) {
  const bool repeats = request.points.front() == request.points.back();  // a closed one's first
  const std::size_t spans = request.points.size() - (request.closed && !repeats ? 0 : 1);
  if (request.alpha.size() > std::max<std::size_t>(spans, 1))
    return core::fail(ErrorCode::bad_input,
                      "\"alpha\" holds " + core::counted(request.alpha.size(), "number"),
                      "give 1, or one for each of the " + core::counted(spans, "span"), "alpha");
  auto solved = lac::solve_spline(request.points, options_of(request));
  if (!solved) return std::unexpected(solved.error());
  SplineResult result;
  result.report.spans = spans;
  for (const std::size_t span : solved->overridden) result.report.overridden.push_back({span, -1});
  result.report.deviation = solved->deviation;
  result.report.iterations = solved->iterations;
  result.curve = made({std::move(solved->chain)});
  return result;
}

}  // namespace

Operation lac_spline_operation() {
  return declare<run>(
      {.name = "lac.spline",
       .summary =
           "The G2 spline of log-aesthetic pieces through the points, one piece per span. "
           "Spans whose curvature changes sign need a slope below 0, and not next to it; the "
           "report lists those overridden.",
       .examples = {R"({"points":[[0,0],[1,0.8],[2.5,1],[4,0.2]],"alpha":-1})",
                    R"({"points":[[0,0],[3,0],[3,2],[0,2]],"closed":true})"}});
}

}  // namespace keyline::operations
