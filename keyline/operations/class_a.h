#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/classa/edit.h"
#include "keyline/classa/farin.h"
#include "keyline/classa/free_form.h"
#include "keyline/operations/values.h"
#include "keyline/operations/verdict.h"

/// What curve.cav, curve.edit and the surface operations have in common: requests for the value of
/// a curve, and that value in results.
namespace keyline::operations {

enum class BranchChoice { own, growing, falling };
constexpr auto choices(const BranchChoice*) {
  return core::words<BranchChoice>({{BranchChoice::own, "own"},
                                    {BranchChoice::growing, "growing"},
                                    {BranchChoice::falling, "falling"}});
}
std::optional<classa::Branch> branch_of(BranchChoice choice);

/// The value's options.
struct CavRequest {
  classa::CavOptions cav;
  BranchChoice branch = BranchChoice::own;
  static constexpr auto describe() {
    using Cav = classa::CavOptions;
    return core::fields(
        core::flattened<&CavRequest::cav>(),
        core::field<&CavRequest::cav, &Cav::direction>(
            "direction to read a curve in: the one in which edges grow (s >= 1), or as given"),
        core::field<&CavRequest::branch>(
            "where to look for the minimum: the curve's own branch, growing (s >= 1/cos alpha) or "
            "falling (s <= cos alpha)"),
        core::field<&CavRequest::cav, &Cav::alpha>(
            "range of alpha for the minimum; [0, alpha_max] unless given")
            .named("alpha_range")
            .in("radian"),
        core::field<&CavRequest::cav, &Cav::s>("range of s for the minimum").named("s_range"));
  }
};
classa::CavOptions cav_options(const CavRequest& request);

/// Which curve: a value, or one given by its matrix.
struct ClassARequest {
  std::optional<AnyCurve> curve;
  std::optional<double> alpha;
  std::optional<double> s;
  int degree = 3;
  core::Point3 tangent{1, 0, 0};
  double beta = 1;
  core::Point2 start;
  std::optional<classa::Matrix3> matrix;
  std::optional<double> fit_tolerance;
  CavRequest options;
  static constexpr auto describe() {
    using Request = ClassARequest;
    return core::fields(
        core::field<&Request::curve>(
            "any planar curve or path, or a bezier in space; other than a polynomial bezier it is "
            "approximated"),
        core::field<&Request::alpha>("instead of a curve: rotation of its matrix").in("radian"),
        core::field<&Request::s>("and its scale"),
        core::field<&Request::degree>("of the curve given by its matrix")
            .within(core::from_to(1, 30)),
        core::field<&Request::tangent>("its first edge for beta 1; [1, 0] unless given"),
        core::field<&Request::beta>("factor of the tangent"),
        core::field<&Request::start>("its start point; [0, 0] unless given"),
        core::field<&Request::matrix>("instead of alpha and s: a matrix after Farin, by rows"),
        core::field<&Request::fit_tolerance>("deviation of the Bezier that approximates other "
                                             "curves; 0.001 of the size unless given")
            .in("length")
            .within(core::kPositive),
        core::flattened<&Request::options>());
  }
};

/// A curve to be placed in the plane: planar, in space, or by a matrix of Farin's.
struct ClassASubject {
  std::optional<classa::Approximation> planar;
  double beta = 1;  ///< of a curve given by (alpha, s): unit of the minimum's beta
  std::optional<document::Path> given;  ///< what was approximated
  std::optional<curve::Bezier3> space;
  std::optional<classa::SpaceMatrixCurve> farin;  ///< `space` is then its curve
};
core::Result<ClassASubject> class_a_subject(const ClassARequest& request);

/// The curve as one polynomial Bezier curve: itself, or its approximation within the tolerance.
core::Result<classa::Approximation> class_a_bezier(const document::Path& path,
                                                   std::optional<double> tolerance);

enum class Turn { left, right };
constexpr auto choices(const Turn*) {
  return core::words<Turn>({{Turn::left, "left"}, {Turn::right, "right"}});
}

struct MinimumShown {
  double alpha = 0;
  double s = 0;
  double beta = 0;
  double energy = 0;
  std::array<double, 2> chord{};
  static constexpr auto describe() {
    return core::fields(core::field<&MinimumShown::alpha>("rotation").in("radian"),
                        core::field<&MinimumShown::s>("scale"),
                        core::field<&MinimumShown::beta>("factor of the first edge"),
                        core::field<&MinimumShown::energy>("strain energy").in("1/length"),
                        core::field<&MinimumShown::chord>("from start to end").in("length"));
  }
};

/// Where a curve stands.
struct ValueShown {
  int type = 5;
  double cav = 0;
  std::optional<double> alpha;
  std::optional<double> s;
  int degree = 0;
  bool reversed = false;
  Turn turn = Turn::left;
  std::optional<double> energy;
  std::optional<MinimumShown> minimum;
  Verdict monotone = Verdict::undecided;
  std::optional<double> witness;
  std::optional<std::string> no_minimum;
  static constexpr auto describe() {
    using Value = ValueShown;
    return core::fields(
        core::field<&Value::type>("1 at the minimum, 2 Class A, 3 one matrix, 4 several, 5 none")
            .within(core::from_to(1, 5)),
        core::field<&Value::cav>("curve aesthetic value, less is better"),
        core::field<&Value::alpha>("types 1 to 3: rotation").in("radian").null_if_empty(),
        core::field<&Value::s>("types 1 to 3: scale").null_if_empty(),
        core::field<&Value::degree>("of the curve"),
        core::field<&Value::reversed>("read from its end to its start"),
        core::field<&Value::turn>("in the direction it is read in"),
        core::field<&Value::energy>("strain energy; null at a cusp").in("1/length").null_if_empty(),
        core::field<&Value::minimum>("the minimum-energy point").null_if_empty(),
        core::field<&Value::monotone>("whether curvature is, certified"),
        core::field<&Value::witness>("a parameter where it is not, or not certainly"),
        core::field<&Value::no_minimum>("why there is no minimum"));
  }
};
ValueShown shown(const classa::CurveValue& value);

/// The nearest curve of one matrix to one of type 4 or 5.
struct NearestShown {
  double distance = 0;
  std::optional<double> rms;
  double alpha = 0;
  double s = 0;
  std::optional<double> cav;
  std::optional<int> type;
  AnyCurve curve;
  static constexpr auto describe() {
    using Near = NearestShown;
    return core::fields(
        core::field<&Near::distance>("largest between the two curves, either way, at samples")
            .in("length"),
        core::field<&Near::rms>("root mean square of the distances of the given curve's samples")
            .in("length"),
        core::field<&Near::alpha>("rotation").in("radian"), core::field<&Near::s>("scale"),
        core::field<&Near::cav>("its value; null where it has none").null_if_empty(),
        core::field<&Near::type>("its type"), core::field<&Near::curve>("the curve"));
  }
};

struct ApproximationShown {
  int degree = 0;
  double deviation = 0;
  double tolerance = 0;
  AnyCurve curve;
  std::optional<Verdict> given_monotone;
  static constexpr auto describe() {
    using Approximation = ApproximationShown;
    return core::fields(
        core::field<&Approximation::degree>("of the Bezier"),
        core::field<&Approximation::deviation>("bound of the distance").in("length"),
        core::field<&Approximation::tolerance>("asked for").in("length"),
        core::field<&Approximation::curve>("the Bezier that was valued"),
        core::field<&Approximation::given_monotone>("whether the given curve's curvature is"));
  }
};

/// What Farin's conditions say of a curve given by a matrix in space.
struct FarinShown {
  bool segment = false;
  bool expands = false;
  bool singular_values = false;
  std::array<double, 3> sigma{};
  static constexpr auto describe() {
    return core::fields(
        core::field<&FarinShown::segment>("the segment from v to Mv keeps out of the sphere"),
        core::field<&FarinShown::expands>("the same for every v"),
        core::field<&FarinShown::singular_values>("sigma_3^2 >= sigma_1"),
        core::field<&FarinShown::sigma>("singular values, largest first"));
  }
};

/// A curve.cav result.
struct EvaluationShown {
  ValueShown value;
  std::optional<std::optional<NearestShown>> nearest;
  std::optional<ApproximationShown> approximation;
  std::optional<FarinShown> farin;

  std::optional<classa::Evaluation> evaluation;  ///< not part of the public form: for pictures

  static constexpr auto describe() {
    using Evaluation = EvaluationShown;
    return core::fields(
        core::flattened<&Evaluation::value>(),
        core::field<&Evaluation::nearest>(
            "types 4 and 5: nearest curve of one matrix; null where there is none"),
        core::field<&Evaluation::approximation>("of a curve that is no polynomial bezier"),
        core::field<&Evaluation::farin>("of a matrix in space"));
  }
};
EvaluationShown shown(const classa::Evaluation& evaluation);

/// Of a planar curve or one in space, in the units of the request.
core::Result<EvaluationShown> value_of(const ClassASubject& subject,
                                       const classa::CavOptions& options);

}  // namespace keyline::operations
