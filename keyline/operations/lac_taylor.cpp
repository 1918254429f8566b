#include <algorithm>
#include <cmath>

#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi.h"
#include "keyline/lac/segment/taylor_error.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/paper_operations.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

struct TaylorRequest {
  std::optional<Handles> points;
  double alpha = -1;
  std::optional<double> lambda;
  std::optional<std::array<double, 2>> interval;
  lac::TaylorVariable variable = lac::TaylorVariable::tangent_angle;
  double about = 0;
  int degree = 12;
  std::optional<double> tolerance;
  static constexpr auto describe() {
    using Request = TaylorRequest;
    return core::fields(
        core::field<&Request::points>(kHandles), core::field<&Request::alpha>(kSlope).needed(),
        core::field<&Request::lambda>("of the standard form, with interval; instead of points"),
        core::field<&Request::interval>("[from, to] in tangent angle").in("radian"),
        core::field<&Request::variable>("in which the curve is expanded"),
        core::field<&Request::about>("fraction of its angle or length to expand at")
            .within(core::from_to(0, 1)),
        core::field<&Request::degree>("the last one looked at").within(core::from_to(1, 30)),
        core::field<&Request::tolerance>("to find the least degree that is certain to meet it")
            .in("length")
            .within(core::kPositive));
  }
};

struct DegreeError {
  int degree = 1;
  std::optional<double> bound;
  double largest = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&DegreeError::degree>("of the sum"),
        core::field<&DegreeError::bound>(
            "of the terms left out, by Cauchy's estimate; null outside the circle of convergence")
            .in("length")
            .null_if_empty(),
        core::field<&DegreeError::largest>("found at 257 even places").in("length"));
  }
};

struct TaylorAnswer {
  std::optional<double> radius;
  bool converges = false;
  std::vector<DegreeError> degrees;
  std::optional<int> enough;
  static constexpr auto describe() {
    using Answer = TaylorAnswer;
    return core::fields(
        core::field<&Answer::radius>(
            "of convergence, as a share of the curve's angle or length; null: infinite")
            .null_if_empty(),
        core::field<&Answer::converges>("whether the whole curve lies within it"),
        core::field<&Answer::degrees>("errors, degree by degree"),
        core::field<&Answer::enough>("least degree whose bound meets the tolerance; null: none")
            .null_if_empty());
  }
};

Result<lac::Segment> target_of(const TaylorRequest& request) {
  if (request.points.has_value() == (request.lambda || request.interval))
    return core::fail(ErrorCode::bad_input, "either handles or the standard form are wanted",
                      "give points, or lambda and interval", "points");
  if (request.points) {
    const auto& [p0, p1, p2] = *request.points;
    const auto solved = lac::solve_g1(p0, p1, p2, request.alpha);
    if (!solved) return std::unexpected(solved.error());
    return solved->segment;
  }
  if (!request.lambda || !request.interval)
    return core::fail(ErrorCode::bad_input, "the standard form takes lambda and interval",
                      "give both", request.lambda ? "interval" : "lambda");
  const auto& [from, to] = *request.interval;
  return lac::standard_segment(request.alpha, *request.lambda, {from, to});
}

Result<TaylorAnswer> run(const TaylorRequest& request, const Context&) {
  const auto target = target_of(request);
  if (!target) return std::unexpected(target.error());
  const auto found = lac::taylor_errors(*target, request.variable, request.about, request.degree);
  if (!found) return std::unexpected(found.error());
  TaylorAnswer answer;
  if (std::isfinite(found->radius)) answer.radius = found->radius;
  answer.converges = found->converges;
  for (const lac::TaylorError& e : found->degrees) {
    answer.degrees.push_back({e.degree, {}, e.largest});
    if (std::isfinite(e.bound)) answer.degrees.back().bound = e.bound;
  }
  if (!request.tolerance) return answer;
  const auto enough = std::ranges::find_if(
      found->degrees, [&](const lac::TaylorError& e) { return e.bound <= *request.tolerance; });
  if (enough != found->degrees.end()) answer.enough = enough->degree;
  return answer;
}

}  // namespace

Operation lac_taylor_operation() {
  return declare<run>(
      {.name = "lac.taylor",
       .summary = "Tells the errors of the Taylor forms of a quasi-log-aesthetic curve: radius of "
                  "convergence, and for every degree a bound and the largest error found.",
       .examples = {R"({"alpha":2,"lambda":0.4,"interval":[0,1],"variable":"arc-length",
                        "tolerance":1e-6})"}});
}

}  // namespace keyline::operations
