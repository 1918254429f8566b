#include "keyline/operations/joint.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/values.h"
#include "keyline/surface/continuity.h"

namespace keyline::operations {
namespace {

using surface::Edge;

struct EdgeRequest {
  std::vector<surface::Surface> surfaces;
  std::optional<std::array<Edge, 2>> edges;
  surface::EdgeTolerance tolerance;
  int places = 101;
  static constexpr auto describe() {
    using Request = EdgeRequest;
    return core::fields(
        core::field<&Request::surfaces>("the two surfaces").count(2, 2).needed(),
        core::field<&Request::edges>(
            "an edge of each; unless given, the two nearest to each other, of those that are not "
            "collapsed into a point"),
        core::flattened<&Request::tolerance>(),
        core::field<&Request::places>(
            "places along the edge; where one edge lies along part of the other, along that part; "
            "knots of both edges and the middles between are compared besides")
            .within(core::from_to(2, 100'000)));
  }
};

struct EdgeSampleShown {
  double along = 0;
  core::Point3 position;
  double gap = 0;
  std::optional<double> angle;
  std::optional<double> curvature_jump;
  std::optional<double> rate_jump;
  static constexpr auto describe() {
    using Sample = EdgeSampleShown;
    return core::fields(
        core::field<&Sample::along>("parameter of the first edge"),
        core::field<&Sample::position>("on the first edge"),
        core::field<&Sample::gap>("to the second edge").in("length"),
        core::field<&Sample::angle>("fold, where both sides have a normal").in("radian"),
        core::field<&Sample::curvature_jump>("of normal curvature, largest").in("1/length"),
        core::field<&Sample::rate_jump>("of its rate across the edge").in("1/length^2"));
  }
};

struct Passed {
  bool g0 = false;
  bool g1 = false;
  bool g2 = false;
  bool g3 = false;
  static constexpr auto describe() {
    return core::fields(core::field<&Passed::g0>("no gap").named("G0"),
                        core::field<&Passed::g1>("no fold").named("G1"),
                        core::field<&Passed::g2>("no jump of curvature").named("G2"),
                        core::field<&Passed::g3>("nor of its rate").named("G3"));
  }
};

struct EdgeAnswer {
  std::array<Edge, 2> edges{};
  Order order = Order::none;
  Passed pass;
  surface::EdgeContinuity largest;
  std::vector<EdgeSampleShown> along;
  static constexpr auto describe() {
    using Answer = EdgeAnswer;
    using Found = surface::EdgeContinuity;
    return core::fields(
        core::field<&Answer::edges>("that were compared"),
        core::field<&Answer::order>("of continuity; none where there is a gap"),
        core::field<&Answer::pass>("whether each order is reached"),
        core::field<&Answer::largest, &Found::gap>("largest").in("length"),
        core::field<&Answer::largest, &Found::angle>(
            "largest fold, of places where both sides have a normal")
            .in("radian"),
        core::field<&Answer::largest, &Found::curvature_jump>("largest").in("1/length"),
        core::field<&Answer::largest, &Found::rate_jump>("largest").in("1/length^2"),
        core::field<&Answer::largest, &Found::relative_curvature_jump>("as compared"),
        core::field<&Answer::largest, &Found::relative_rate_jump>("as compared"),
        core::field<&Answer::largest, &Found::stripe_turn>(
            "of zebra stripes that cross, in the mean over all lights; means something from G1 on")
            .in("radian"),
        core::field<&Answer::largest, &Found::turning>(
            "of the normal along the edge; the number of stripes grows with it")
            .in("radian"),
        core::field<&Answer::largest, &Found::without_normal>(
            "places where a side has no normal and only the gap is compared; where two follow each "
            "other the order is G0 at most"),
        core::field<&Answer::largest, &Found::tolerance>("that was applied"),
        core::field<&Answer::along>("place by place"));
  }
};

EdgeSampleShown shown(const surface::EdgeSample& s) {
  if (!s.defined) return {s.along, s.position, s.gap, {}, {}, {}};
  return {s.along, s.position, s.gap, s.angle, s.curvature_jump, s.rate_jump};
}

core::Result<EdgeAnswer> run(const EdgeRequest& request, const Context&) {
  auto found = surface::edge_continuity(request.surfaces[0], request.surfaces[1], request.edges,
                                        request.tolerance, request.places);
  if (!found) return std::unexpected(found.error());
  EdgeAnswer answer;
  answer.edges = found->edges;
  answer.order = order_of(found->order);
  answer.pass = {found->order >= 0, found->order >= 1, found->order >= 2, found->order >= 3};
  for (const surface::EdgeSample& s : found->samples) answer.along.push_back(shown(s));
  answer.largest = std::move(*found);
  return answer;
}

}  // namespace

Operation surface_continuity_operation() {
  return declare<run>(
      {.name = "surface.continuity",
       .summary = "Gap, fold angle, curvature jump and jump of its rate along the common edge of "
                  "two surfaces, and the order G0 to G3 they amount to.",
       .examples = {R"({"surfaces":[
           {"type":"bezier-surface","points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
           {"type":"bezier-surface","points":[[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]]}]})"}});
}

}  // namespace keyline::operations
