#include "keyline/operations/class_a.h"

#include <cmath>

#include "keyline/operations/curve_analyze.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/subject.h"

namespace keyline::operations {

using core::ErrorCode;
using core::fail;
using core::Result;

namespace {

constexpr std::size_t kSmallestMatrixDegree = 2;  // in space

Result<ClassASubject> farin_subject(const ClassARequest& request) {
  if (request.degree < static_cast<int>(kSmallestMatrixDegree))
    return fail(ErrorCode::bad_input, "\"degree\" is out of range",
                "give a whole number from 2 to 30", "degree");
  const classa::SpaceMatrixCurve c{
      {}, request.tangent - core::Point3{}, *request.matrix, request.degree};
  if (auto sound = classa::validate(c); !sound) return std::unexpected(sound.error());
  return ClassASubject{{}, 1, {}, classa::to_bezier(c), c};
}

Result<ClassASubject> matrix_subject(const ClassARequest& request) {
  if (!request.alpha || !request.s)
    return fail(ErrorCode::bad_input, "a curve is missing",
                "give \"curve\", or \"alpha\" and \"s\" with \"degree\" and \"tangent\"",
                request.alpha ? "s" : "alpha");
  if (request.tangent.z != 0)
    return fail(ErrorCode::unsupported, "a point in space where a planar one is wanted",
                "give [x, y], or a \"matrix\"", "tangent");
  classa::MatrixCurve c{
      request.start, {request.tangent.x, request.tangent.y}, request.beta, {}, request.degree};
  c.matrix = {*request.alpha, *request.s};
  if (auto sound = classa::validate(c); !sound) return std::unexpected(sound.error());
  return ClassASubject{classa::Approximation{classa::to_bezier(c), true}, c.beta, {}, {}, {}};
}

Result<ClassASubject> space_subject(const AnyCurve& curve) {
  const auto* space = std::get_if<document::SpaceCurve>(&curve);
  if (const auto* bezier = space ? std::get_if<curve::Bezier3>(&space->value) : nullptr)
    return ClassASubject{{}, 1, {}, *bezier, {}};
  const auto* spline = space ? std::get_if<curve::BSpline3>(&space->value) : nullptr;
  if (spline && !is_rational(*spline))
    if (auto pieces = curve::to_beziers(*spline); pieces.size() == 1)
      return ClassASubject{{}, 1, {}, std::move(pieces.front()), {}};
  return fail(ErrorCode::unsupported,
              "of curves in space only a bezier, or a spline of one piece, is placed in the plane",
              "cut the curve into beziers, or lay it into a plane", "curve");
}

MinimumShown minimum_shown(const classa::EnergyMinimum& m) {
  return {m.alpha, m.s, m.beta, m.energy, {m.chord.x, m.chord.y}};
}

NearestShown nearest_shown(const classa::NearestCurve& nearest,
                           const std::optional<classa::CurveValue>& value) {
  NearestShown near;
  near.distance = nearest.distance;
  near.rms = nearest.rms;
  near.alpha = std::abs(nearest.matrix.alpha);
  near.s = nearest.matrix.s;
  near.curve = document::PlanarCurve{nearest.curve};
  if (!value) return near;
  near.cav = value->cav;
  near.type = value->type;
  if (value->matrix) {  // in the direction it is read in, like every place in the plane
    near.alpha = value->matrix->alpha;
    near.s = value->matrix->s;
  }
  return near;
}

}  // namespace

std::optional<classa::Branch> branch_of(BranchChoice choice) {
  if (choice == BranchChoice::growing) return classa::Branch::growing;
  if (choice == BranchChoice::falling) return classa::Branch::falling;
  return std::nullopt;
}

classa::CavOptions cav_options(const CavRequest& request) {
  classa::CavOptions options = request.cav;
  options.branch = branch_of(request.branch);
  return options;
}

Result<ClassASubject> class_a_subject(const ClassARequest& request) {
  if (request.matrix) return farin_subject(request);
  if (!request.curve) return matrix_subject(request);
  const auto path = planar_path(*request.curve);
  if (!path) return space_subject(*request.curve);
  if (auto extent = check_extent(*path); !extent) return std::unexpected(extent.error());
  auto bezier = class_a_bezier(*path, request.fit_tolerance);
  if (!bezier) return std::unexpected(std::move(bezier.error()));
  return ClassASubject{std::move(*bezier), 1, *path, {}, {}};
}

Result<classa::Approximation> class_a_bezier(const document::Path& path,
                                             std::optional<double> tolerance) {
  if (path.curves.size() == 1) {
    const auto* bezier = std::get_if<curve::Bezier2>(&path.curves[0].value);
    if (bezier && !is_rational(*bezier)) return classa::Approximation{*bezier, true};
  }
  const auto pieces = [&path](double within) { return bounded_pieces(path, within); };
  if (path.curves.size() == 1)
    return classa::approximate(curve::PlanarView(path.curves[0]), tolerance, pieces);
  return classa::approximate(curve::PlanarView(path), tolerance, pieces);
}

ValueShown shown(const classa::CurveValue& value) {
  ValueShown v;
  v.type = value.type;
  v.cav = value.cav;
  if (value.matrix) {
    v.alpha = value.matrix->alpha;
    v.s = value.matrix->s;
  }
  v.degree = value.degree;
  v.reversed = value.reversed;
  v.turn = value.left ? Turn::left : Turn::right;
  if (std::isfinite(value.energy)) v.energy = value.energy;
  if (value.minimum) v.minimum = minimum_shown(*value.minimum);
  v.monotone = verdict_of(value.monotone.answer);
  if (v.monotone != Verdict::yes) v.witness = value.monotone.witness;
  if (!value.no_minimum.empty()) v.no_minimum = value.no_minimum;
  return v;
}

EvaluationShown shown(const classa::Evaluation& e) {
  EvaluationShown all;
  all.value = shown(e.value);
  if (e.value.type > 3) {
    all.nearest.emplace();
    if (e.nearest) *all.nearest = nearest_shown(*e.nearest, e.nearest_value);
  }
  if (!e.approximation.exact)
    all.approximation = ApproximationShown{curve::degree(e.approximation.curve),
                                           e.approximation.deviation,
                                           e.approximation.tolerance,
                                           document::PlanarCurve{e.approximation.curve},
                                           {}};
  all.evaluation = e;
  return all;
}

namespace {

/// A curve in space: its value, curvature judged on the curve itself, and what Farin's conditions
/// say beside it.
Result<EvaluationShown> space_value(const ClassASubject& subject,
                                    const classa::CavOptions& options) {
  const auto value = classa::cav(*subject.space, options);
  if (!value) return std::unexpected(value.error());
  EvaluationShown result;
  result.value = shown(*value);
  if (subject.farin) {
    const classa::FarinConditions farin = classa::farin_conditions(*subject.farin);
    result.farin = FarinShown{farin.segment, farin.expands, farin.singular_values, farin.sigma};
  }
  return result;
}

}  // namespace

Result<EvaluationShown> value_of(const ClassASubject& subject, const classa::CavOptions& options) {
  if (subject.space) return space_value(subject, options);
  auto evaluation = classa::evaluate_curve(*subject.planar, options);
  if (!evaluation) return std::unexpected(evaluation.error());
  classa::CurveValue& value = evaluation->value;
  if (value.minimum && !value.reversed) value.minimum->beta *= subject.beta;
  EvaluationShown result = shown(*evaluation);
  if (result.approximation && subject.given)
    result.approximation->given_monotone = verdict_of(certified_monotone(*subject.given).value);
  return result;
}

}  // namespace keyline::operations
