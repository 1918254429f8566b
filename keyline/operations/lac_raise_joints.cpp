#include <cmath>

#include "keyline/lac/g2/raise_joints.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/paper_operations.h"

namespace keyline::operations {
namespace {

struct RaiseRequest {
  document::Path curve;
  lac::RaiseOptions options;
  static constexpr auto describe() {
    return core::fields(
        core::field<&RaiseRequest::curve>("a log-aesthetic curve, or a path of such").needed(),
        core::flattened<&RaiseRequest::options>());
  }
};

/// Of curvature by arc length.
struct Rates {
  std::optional<double> before;
  std::optional<double> after;
  static constexpr auto describe() {
    return core::fields(core::field<&Rates::before>("the joint; null where it is infinite")
                            .in("1/length^2")
                            .null_if_empty(),
                        core::field<&Rates::after>("the joint; null where it is infinite")
                            .in("1/length^2")
                            .null_if_empty());
  }
};

struct RaisedJoint {
  std::size_t member = 0;
  std::size_t piece = 0;
  core::Point2 place;
  lac::JointFate fate = lac::JointFate::already;
  Rates given;
  Rates now;
  std::optional<std::string> why;
  static constexpr auto describe() {
    using Joint = RaisedJoint;
    return core::fields(
        core::field<&Joint::member>("of the path, from 0"),
        core::field<&Joint::piece>("of the given curve that starts here, from 0"),
        core::field<&Joint::place>("of the joint now"),
        core::field<&Joint::fate>("what became of it"),
        core::field<&Joint::given>("rates of curvature at the joint of the given curve"),
        core::field<&Joint::now>("the same of the new one"),
        core::field<&Joint::why>("it stays as it was"));
  }
};

struct RaiseResult {
  MadeCurve curve;
  std::vector<RaisedJoint> joints;
  std::size_t raised = 0;
  double departure = 0;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&RaiseResult::curve>(),
        core::field<&RaiseResult::joints>("inside each member, in order; a closing one last"),
        core::field<&RaiseResult::raised>("joints that are G3 now and were not"),
        core::field<&RaiseResult::departure>("bound of the distance from the given curve, both "
                                             "ways")
            .in("length"));
  }
};

/// Why a joint stays, or nothing.
const char* reason(lac::JointFate fate) {
  switch (fate) {
    case lac::JointFate::raised:
    case lac::JointFate::already:
      return nullptr;
    case lac::JointFate::turn:
      return "curvature rises on one side and falls on the other, and the rate of a log-aesthetic "
             "piece never vanishes: no pieces are G3 here";
    case lac::JointFate::constant:
      return "one side is an arc or a straight line, whose rate is 0, and that of a log-aesthetic "
             "piece never vanishes: no pieces are G3 here";
    case lac::JointFate::jump:
      return "the curvatures of both sides differ: make the joint G2 first";
    case lac::JointFate::cusp:
      return "a piece beside it ends in a cusp, where curvature is infinite";
    case lac::JointFate::not_found:
      return "no pieces with these ends, directions and curvatures were found";
    case lac::JointFate::beyond_limit:
      return "the curve would depart from the given one by more than the limit";
  }
  return nullptr;
}

Rates finite(const std::array<double, 2>& rates) {
  Rates told;
  if (std::isfinite(rates[0])) told.before = rates[0];
  if (std::isfinite(rates[1])) told.after = rates[1];
  return told;
}

core::Result<RaiseResult> run(const RaiseRequest& request, const Context&) {
  RaiseResult result;
  document::Path path{{}, request.curve.closed};
  for (std::size_t member = 0; member < request.curve.curves.size(); ++member) {
    const auto* chain = std::get_if<lac::Chain>(&request.curve.curves[member].value);
    if (!chain)
      return core::fail(core::ErrorCode::unsupported,
                        "only the joints of log-aesthetic curves can be raised",
                        "fair the curve first", "curve");
    auto solved = lac::raise_joints(*chain, request.options);
    if (!solved) return std::unexpected(solved.error());
    for (const lac::RaisedJoint& j : solved->joints) {
      RaisedJoint told{
          member, j.piece, j.place, j.fate, finite(j.rate_before), finite(j.rate_after), {}};
      if (const char* why = reason(j.fate)) told.why = why;
      result.raised += j.fate == lac::JointFate::raised ? 1 : 0;
      result.joints.push_back(std::move(told));
    }
    result.departure = std::max(result.departure, solved->departure);
    path.curves.push_back({std::move(solved->chain)});
  }
  result.curve.curve = simplest(std::move(path));
  return result;
}

}  // namespace

Operation lac_raise_joints_operation() {
  return declare<run>(
      {.name = "lac.raise_joints",
       .summary =
           "Makes joints of a log-aesthetic curve G3 where curvature rises, or falls, on both "
           "sides; says why for those that stay as they were.",
       .examples = {R"({"curve":{"type":"log-aesthetic","start":[0,0],"direction":0,"pieces":[
                        {"alpha":-1,"length":1,"curvature":[0.1,0.3]},
                        {"alpha":0.5,"length":1,"curvature":[0.3,0.9]},
                        {"alpha":-1,"length":1,"curvature":[0.9,0.4]}]}})"},
       .long_running = true});
}

}  // namespace keyline::operations
