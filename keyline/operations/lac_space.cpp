#include "keyline/lac/space_hermite.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

struct SpaceRequest {
  core::Point3 start;
  core::Point3 end;
  std::array<core::Point3, 2> tangents;
  double alpha = -1;
  double beta = -1;
  double omega = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SpaceRequest::start>("where the curve starts").needed(),
        core::field<&SpaceRequest::end>("where it ends").needed(),
        core::field<&SpaceRequest::tangents>("directions of travel at start and end, any length")
            .needed(),
        core::field<&SpaceRequest::alpha>("slope of the logarithmic curvature graph").needed(),
        core::field<&SpaceRequest::beta>("slope of the logarithmic torsion graph").needed(),
        core::field<&SpaceRequest::omega>("rate of the radius of torsion in the standard form")
            .needed());
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

struct SpaceResult {
  MadeCurve curve;
  double lambda = 0;
  double nu = 0;
  double length = 0;
  bool planar = false;
  SpaceSlopes slopes;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&SpaceResult::curve>(),
        core::field<&SpaceResult::lambda>("rate of the radius of curvature, standard form"),
        core::field<&SpaceResult::nu>("torsion in the standard form"),
        core::field<&SpaceResult::length>("of the curve").in("length"),
        core::field<&SpaceResult::planar>("whether the data lie in one plane"),
        core::field<&SpaceResult::slopes>("of both logarithmic graphs"));
  }
};

core::Result<SpaceResult> run(const SpaceRequest& request, const Context&) {
  const lac::SpaceHermite data{request.start, request.end, request.tangents[0] - core::Point3{},
                               request.tangents[1] - core::Point3{}};
  auto solved = lac::solve_g1_space(data, request.alpha, request.beta, request.omega);
  if (!solved) return std::unexpected(solved.error());
  const lac::SpaceGraphs graphs = lac::logarithmic_graphs(solved->chain.pieces[0]);
  SpaceResult result;
  result.lambda = solved->lambda;
  result.nu = solved->nu;
  result.length = lac::arc_length(solved->chain);
  result.planar = solved->planar;
  if (graphs.curvature_defined) result.slopes.curvature = graphs.curvature_slope;
  if (graphs.torsion_defined) result.slopes.torsion = graphs.torsion_slope;
  result.curve.curve = document::SpaceCurve{std::move(solved->chain)};
  return result;
}

}  // namespace

Operation lac_space_operation() {
  return declare<run>(
      {.name = "lac.space",
       .summary = "The log-aesthetic space curve between two points with given tangents: curvature "
                  "of slope alpha, torsion of slope beta. lambda, nu and omega are in units of the "
                  "radius of curvature at the start; data in one plane give the plane curve.",
       .examples = {R"({"start":[0,0,0],"end":[3,1,0.5],"tangents":[[1,0,0],[1,1,0.6]],
                        "alpha":-1,"beta":-1,"omega":0.1})"}});
}

}  // namespace keyline::operations
