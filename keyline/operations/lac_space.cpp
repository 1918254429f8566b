#include <cmath>

#include "keyline/lac/space/space_compound.h"
#include "keyline/lac/space/space_graphs.h"
#include "keyline/lac/space/space_hermite.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

struct SpaceRequest {
  core::Point3 start;
  core::Point3 end;
  std::array<core::Point3, 2> tangents;
  std::vector<double> alpha{-1};
  std::vector<double> beta{-1};
  double omega = 0;
  double ratio = 0.5;
  std::optional<double> graphs_within;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SpaceRequest::start>("where the curve starts").needed(),
        core::field<&SpaceRequest::end>("where it ends").needed(),
        core::field<&SpaceRequest::tangents>("directions of travel at start and end, any length")
            .needed(),
        core::field<&SpaceRequest::alpha>(
            "slope of the logarithmic curvature graph, or two for a compound rhythm, the first at "
            "the start")
            .count(1, 2)
            .or_bare_item()
            .needed(),
        core::field<&SpaceRequest::beta>("slope of the logarithmic torsion graph, or two")
            .count(1, 2)
            .or_bare_item()
            .needed(),
        core::field<&SpaceRequest::omega>("rate of the radius of torsion in the standard form")
            .needed(),
        core::field<&SpaceRequest::ratio>(
            "with two slopes: share of the length that falls to the first")
            .within(core::between(0, 1)),
        core::field<&SpaceRequest::graphs_within>(
            "adds what the graphs of quintics within this distance show")
            .in("length")
            .within(core::kPositive));
  }
};

struct SpaceSlopes {
  std::optional<double> curvature;
  std::optional<double> torsion;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SpaceSlopes::curvature>("null where it is constant").null_if_empty(),
        core::field<&SpaceSlopes::torsion>("null where it is constant").null_if_empty());
  }
};

struct GraphShown {
  double slope = 0;
  double variance = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&GraphShown::slope>("of the line through the graph"),
        core::field<&GraphShown::variance>("mean square of the vertical residuals"));
  }
};

/// The curve as quintics, and what their graphs show.
struct ApproximatedShown {
  std::size_t pieces = 0;
  double deviation = 0;
  std::optional<GraphShown> curvature;
  std::optional<GraphShown> torsion;
  static constexpr auto describe() {
    using Shown = ApproximatedShown;
    return core::fields(
        core::field<&Shown::pieces>("quintics"),
        core::field<&Shown::deviation>("bound of their distance").in("length"),
        core::field<&Shown::curvature>("logarithmic curvature graph; null where it is constant")
            .null_if_empty(),
        core::field<&Shown::torsion>("logarithmic torsion graph; null where it is constant")
            .null_if_empty());
  }
};

struct SpaceResult {
  MadeCurve curve;
  std::optional<double> lambda;
  double nu = 0;
  double length = 0;
  bool planar = false;
  std::variant<SpaceSlopes, std::array<SpaceSlopes, 2>> slopes;
  std::optional<ApproximatedShown> approximated;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&SpaceResult::curve>(),
        core::field<&SpaceResult::lambda>(
            "rate of the radius of curvature, standard form; null where the start has no curvature "
            "to take for its unit and the rest has")
            .null_if_empty(),
        core::field<&SpaceResult::nu>("torsion in the standard form"),
        core::field<&SpaceResult::length>("of the curve").in("length"),
        core::field<&SpaceResult::planar>("whether the data lie in one plane"),
        core::field<&SpaceResult::slopes>(
            "of both logarithmic graphs; of two pieces one after the other"),
        core::field<&SpaceResult::approximated>("by quintics, where their graphs are asked for"));
  }
};

std::optional<GraphShown> shown(const std::optional<lac::GraphLine>& line) {
  if (!line) return std::nullopt;
  return GraphShown{line->slope, line->variance};
}

ApproximatedShown approximated(const lac::SpaceChain& chain, double tolerance) {
  const lac::SpaceBeziers quintics = lac::approximate_by_quintics(chain, tolerance);
  const lac::GraphLines lines = lac::graph_lines(quintics.pieces);
  return {quintics.pieces.size(), quintics.deviation, shown(lines.curvature), shown(lines.torsion)};
}

SpaceSlopes slopes_of(const lac::SpacePiece& piece) {
  const lac::SpaceGraphs graphs = lac::logarithmic_graphs(piece);
  SpaceSlopes slopes;
  if (graphs.curvature_defined) slopes.curvature = graphs.curvature_slope;
  if (graphs.torsion_defined) slopes.torsion = graphs.torsion_slope;
  return slopes;
}

core::Result<lac::SpaceSolution> solve(const SpaceRequest& request) {
  const lac::SpaceHermite data{request.start, request.end, request.tangents[0] - core::Point3{},
                               request.tangents[1] - core::Point3{}};
  const auto& [alpha, beta] = std::pair(request.alpha, request.beta);
  if (alpha.size() == 1 && beta.size() == 1)
    return lac::solve_g1_space(data, alpha[0], beta[0], request.omega);
  return lac::solve_compound_space(data, {.alpha = {alpha.front(), alpha.back()},
                                          .beta = {beta.front(), beta.back()},
                                          .omega = request.omega,
                                          .length_share = request.ratio});
}

core::Result<SpaceResult> run(const SpaceRequest& request, const Context&) {
  auto solved = solve(request);
  if (!solved) return std::unexpected(solved.error());
  SpaceResult result;
  if (std::isfinite(solved->lambda)) result.lambda = solved->lambda;
  result.nu = solved->nu;
  result.length = lac::arc_length(solved->chain);
  result.planar = solved->planar;
  const auto& pieces = solved->chain.pieces;
  if (pieces.size() == 1)
    result.slopes = slopes_of(pieces[0]);
  else
    result.slopes = std::array{slopes_of(pieces[0]), slopes_of(pieces[1])};
  if (request.graphs_within)
    result.approximated = approximated(solved->chain, *request.graphs_within);
  result.curve.curve = document::SpaceCurve{std::move(solved->chain)};
  return result;
}

}  // namespace

Operation lac_space_operation() {
  return declare<run>(
      {.name = "lac.space",
       .summary = "The log-aesthetic space curve between two points with given tangents: curvature "
                  "of slope alpha, torsion of slope beta. lambda, nu and omega are in units of the "
                  "radius of curvature at the start; data in one plane give the plane curve. Two "
                  "slopes of either make two pieces with all rates continuous at the joint.",
       .examples = {R"({"start":[0,0,0],"end":[3,1,0.5],"tangents":[[1,0,0],[1,1,0.6]],
                        "alpha":-1,"beta":-1,"omega":0.1})",
                    R"({"start":[0,0,0],"end":[3,1,0.5],"tangents":[[1,0,0],[1,1,0.6]],
                        "alpha":[-1,0.5],"beta":[-1,1],"omega":0.1,"ratio":0.4})"}});
}

}  // namespace keyline::operations
