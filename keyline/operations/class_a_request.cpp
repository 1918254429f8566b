#include "keyline/operations/class_a_request.h"

#include <utility>

#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/json_space.h"
#include "keyline/operations/derived_forms.h"
#include "keyline/operations/fields.h"

namespace keyline::operations {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

namespace {

/// [low, high] of an interval field.
Result<std::optional<core::Interval>> range_of(const json& request, const char* name) {
  if (!request.contains(name)) return std::optional<core::Interval>{};
  const auto ends = numbers_of_count(request, name, 2, 2);
  if (!ends) return std::unexpected(ends.error());
  if (!((*ends)[0] <= (*ends)[1]))
    return fail(ErrorCode::bad_input, "the range ends before it starts", "give [low, high]", name);
  return core::Interval{(*ends)[0], (*ends)[1]};
}

Result<void> read_words(const json& request, classa::CavOptions& o) {
  const std::string direction = string_or(request, "direction", "growing");
  if (direction != "growing" && direction != "as-given")
    return fail(ErrorCode::bad_input, "there is no direction \"" + direction + "\"",
                "use growing or as-given", "direction");
  if (direction == "as-given") o.direction = classa::Direction::as_given;
  const std::string branch = string_or(request, "branch", "own");
  if (branch == "growing") {
    o.branch = classa::Branch::growing;
  } else if (branch == "falling") {
    o.branch = classa::Branch::falling;
  } else if (branch != "own") {
    return fail(ErrorCode::bad_input, "there is no branch \"" + branch + "\"",
                "use own, growing (s >= 1/cos alpha) or falling (s <= cos alpha)", "branch");
  }
  return {};
}

/// Rows of the matrix, all finite.
Result<classa::Matrix3> matrix_of(const json& value) {
  classa::Matrix3 m;
  const bool square = value.is_array() && value.size() == 3;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!square || !value[i].is_array() || value[i].size() != 3)
      return fail(ErrorCode::bad_input, "the matrix is not 3 by 3", "give three rows of three",
                  "matrix");
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = exchange::number_from_json(
          value[i][k], "matrix[" + std::to_string(i) + "][" + std::to_string(k) + "]");
      if (!number) return std::unexpected(number.error());
      m[i][k] = *number;
    }
  }
  return m;
}

Result<ClassASubject> farin_subject(const json& request) {
  const auto matrix = matrix_of(request.at("matrix"));
  if (!matrix) return std::unexpected(matrix.error());
  const auto degree = integer_between(request, "degree", 3, 2, curve::kMaxBezierDegree);
  if (!degree) return std::unexpected(degree.error());
  classa::SpaceMatrixCurve c{{}, {1, 0, 0}, *matrix, *degree};
  if (request.contains("tangent")) {
    const auto tangent = exchange::point3_from_json(request.at("tangent"), "tangent");
    if (!tangent) return std::unexpected(tangent.error());
    c.tangent = *tangent - core::Point3{};
  }
  if (auto sound = classa::validate(c); !sound) return std::unexpected(sound.error());
  return ClassASubject{{}, 1, {}, classa::to_bezier(c), c};
}

Result<ClassASubject> matrix_subject(const json& request) {
  for (const char* name : {"alpha", "s"})
    if (!request.contains(name))
      return fail(ErrorCode::bad_input, "a curve is missing",
                  "give \"curve\", or \"alpha\" and \"s\" with \"degree\" and \"tangent\"", name);
  const auto degree = integer_between(request, "degree", 3, 1, curve::kMaxBezierDegree);
  if (!degree) return std::unexpected(degree.error());
  classa::MatrixCurve c{{}, {1, 0}, number_or(request, "beta", 1), {}, *degree};
  c.matrix = {number_or(request, "alpha", 0), number_or(request, "s", 1)};
  if (request.contains("start")) c.start = point_of(request, "start");
  if (request.contains("tangent")) {
    const auto tangent = exchange::point_from_json(request.at("tangent"), "tangent");
    if (!tangent) return std::unexpected(tangent.error());
    c.tangent = *tangent - core::Point2{};
  }
  if (auto sound = classa::validate(c); !sound) return std::unexpected(sound.error());
  return ClassASubject{classa::Approximation{classa::to_bezier(c), true}, c.beta, {}, {}, {}};
}

Result<ClassASubject> space_subject(const json& value) {
  const auto c = exchange::space_curve_from_json(value, "curve");
  if (!c) return std::unexpected(c.error());
  const auto* bezier = std::get_if<curve::Bezier3>(&c->value);
  if (!bezier)
    return fail(ErrorCode::unsupported, "of curves in space only a bezier is placed in the plane",
                "convert the curve to a bezier, or lay it into a plane", "curve");
  return ClassASubject{{}, 1, {}, *bezier, {}};
}

}  // namespace

std::vector<Field> class_a_fields() {
  using Type = Field::Type;
  return {
      {"curve", Type::any, false,
       "any planar curve or path, or a bezier in space; other than a polynomial bezier it is "
       "approximated"},
      {"alpha", Type::number, false, "instead of a curve: rotation of its matrix, radians"},
      {"s", Type::number, false, "and its scale"},
      {"degree", Type::integer, false, "of the curve given by its matrix, 3 unless given"},
      {"tangent", Type::any, false, "its first edge for beta 1, [1,0] unless given"},
      {"beta", Type::number, false, "factor of the tangent, 1 unless given"},
      {"start", Type::point, false, "its start point, [0,0] unless given"},
      {"matrix", Type::any, false, "instead of alpha and s: a 3 by 3 matrix after Farin, by rows"},
      {"alpha_max", Type::number, false, "bound of alpha and of Tab. 2, 1.0982 unless given"},
      {"tolerance", Type::number, false,
       "in the alpha-s plane: below it ratios are one and the same, 1e-6 unless given"},
      {"end_tolerance", Type::number, false,
       "how far the minimum's end may lie off, a length; 0.01 of the chord unless given"},
      {"direction", Type::string, false, "growing (default: s >= 1) or as-given"},
      {"branch", Type::string, false, "of the minimum: own (default), growing or falling"},
      {"alpha_range", Type::numbers, false, "of the minimum, [0, alpha_max] unless given"},
      {"s_range", Type::numbers, false, "of the minimum, [0.01, 100] unless given"},
      {"fit_tolerance", Type::number, false,
       "of the approximation of other curves, a length; 0.001 of the size unless given"}};
}

Result<classa::CavOptions> cav_options(const json& request) {
  classa::CavOptions o;
  o.alpha_max = number_or(request, "alpha_max", o.alpha_max);
  o.tolerance = number_or(request, "tolerance", o.tolerance);
  o.end_tolerance = optional_number(request, "end_tolerance");
  if (auto words = read_words(request, o); !words) return std::unexpected(words.error());
  const auto alpha = range_of(request, "alpha_range");
  if (!alpha) return std::unexpected(alpha.error());
  const auto s = range_of(request, "s_range");
  if (!s) return std::unexpected(s.error());
  o.alpha = *alpha;
  o.s = s->value_or(o.s);
  return o;
}

Result<ClassASubject> class_a_subject(const json& request) {
  if (request.contains("matrix")) return farin_subject(request);
  if (!request.contains("curve")) return matrix_subject(request);
  if (exchange::is_space_curve(request.at("curve"))) return space_subject(request.at("curve"));
  const auto path = exchange::path_from_json(request.at("curve"), "curve");
  if (!path) return std::unexpected(path.error());
  auto bezier = class_a_bezier(*path, optional_number(request, "fit_tolerance"));
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

Result<classa::EditOptions> edit_options(const json& request) {
  const auto cav = cav_options(request);
  if (!cav) return std::unexpected(cav.error());
  classa::EditOptions o{.cav = *cav};
  o.amount = number_or(request, "amount", 1);
  if (request.contains("target")) {
    const json& target = request.at("target");
    if (!target.is_object() || !target.contains("alpha") || !target.contains("s"))
      return fail(ErrorCode::bad_input, "the target is no place of the plane",
                  "give {\"alpha\": …, \"s\": …}", "target");
    const auto alpha = exchange::number_from_json(target["alpha"], "target.alpha");
    if (!alpha) return std::unexpected(alpha.error());
    const auto s = exchange::number_from_json(target["s"], "target.s");
    if (!s) return std::unexpected(s.error());
    o.target = classa::ControlMatrix{*alpha, *s};
  }
  const std::string hold = string_or(request, "hold", "ends-and-tangent");
  if (hold == "ends") {
    o.hold = classa::Hold::ends;
  } else if (hold == "start") {
    o.hold = classa::Hold::start;
  } else if (hold != "ends-and-tangent") {
    return fail(ErrorCode::bad_input, "\"" + hold + "\" cannot be held",
                "use ends-and-tangent, ends or start", "hold");
  }
  return o;
}

}  // namespace keyline::operations
