#include "keyline/lac/quasi/quasi.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/analysis/lcg.h"
#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/lac/quasi/quasi_hermite.h"
#include "keyline/lac/segment/deviation.h"
#include "keyline/lac/segment/lambda.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {

using core::ErrorCode;
using core::Result;
using core::Vector2;
using detail::SeriesVariable;
using detail::UnitPiece;

namespace {

bool is_taylor(QuasiForm f) { return f == QuasiForm::taylor_angle || f == QuasiForm::taylor_arc; }

SeriesVariable variable_of(QuasiForm f) {
  return f == QuasiForm::taylor_angle || f == QuasiForm::discrete_angle
             ? SeriesVariable::tangent_angle
             : SeriesVariable::arc_length;
}

Result<void> check_options(const QuasiOptions& o) {
  const auto bad = [](const char* message, const char* path) {
    return core::fail(ErrorCode::bad_input, message, "", path);
  };
  const bool rational = o.form == QuasiForm::rational_cubic;
  if (!rational && (o.degree < 3 || o.degree > curve::kMaxBezierDegree))
    return bad("the degree must be from 3 to 30", "degree");
  if (o.form == QuasiForm::best && o.degree < 5)
    return bad("the best form needs a degree of at least 5", "degree");
  if (o.about && !(*o.about >= 0 && *o.about <= 1))
    return bad("the point of expansion must be a fraction from 0 to 1", "about");
  return {};
}

std::unexpected<core::Failure> unsupported(const char* message, const char* hint = "") {
  return core::fail(ErrorCode::unsupported, message, hint, "form");
}

std::unexpected<core::Failure> no_such_ends() {
  return core::fail(ErrorCode::undrawable, "no Bézier of this form meets these ends",
                    "split the curve", "form");
}

bool has_inflection(const UnitPiece& u) { return inflection(u.piece) > 0; }

Result<void> check_ends(const UnitPiece& u, const QuasiOptions& o) {
  const double k0 = u.piece.curvature_start;
  const double k1 = u.piece.curvature_end;
  const bool infinite = std::isinf(k0) || std::isinf(k1);
  const bool angle = variable_of(o.form) == SeriesVariable::tangent_angle;
  const bool choosing = o.automatic && is_taylor(o.form);
  if (angle && !choosing && has_inflection(u))
    return unsupported("tangent angle does not run through an inflection", "use arc length");
  if (o.form == QuasiForm::rational_cubic && (infinite || (u.turning > 0 && !(k0 * k1 > 0))))
    return unsupported("the rational cubic needs end curvatures of one sign, finite and not zero");
  if (o.form == QuasiForm::rational_cubic && !(u.turning < 4))
    return unsupported("the rational cubic reaches turnings up to 4 radians", "split the curve");
  return {};
}

}  // namespace

namespace detail {

Result<void> check_form(const UnitPiece& unit, const QuasiOptions& options) {
  if (auto checked = check_options(options); !checked) return checked;
  return check_ends(unit, options);
}

Result<QuasiOptions> settled(const UnitPiece& unit, QuasiOptions o) {
  if (auto checked = check_form(unit, o); !checked) return std::unexpected(checked.error());
  if (!is_taylor(o.form)) return o;
  if (o.automatic) {
    const Expansion e = best_expansion(unit, o.degree);
    o.automatic = false;
    o.about = e.about;
    o.form = e.variable == SeriesVariable::tangent_angle ? QuasiForm::taylor_angle
                                                         : QuasiForm::taylor_arc;
  }
  if (unit.turning == 0 && !has_inflection(unit)) o.form = QuasiForm::taylor_arc;  // straight
  if (!o.about) o.about = ruled_about(unit, variable_of(o.form));
  if (!taylor_series(unit, variable_of(o.form), *o.about, o.degree).analytic)
    return core::fail(ErrorCode::unsupported,
                      "there is no Taylor series at an inflection or a cusp",
                      "expand at another point of the interval", "about");
  return o;
}

Drawn draw_form(const UnitPiece& unit, const QuasiOptions& o) {
  const SeriesVariable variable = variable_of(o.form);
  if (is_taylor(o.form)) {
    const TaylorSeries s = taylor_series(unit, variable, *o.about, o.degree);
    return {taylor_polygon(unit, s), {}, remainder_bound(s, std::max(*o.about, 1 - *o.about))};
  }
  if (o.form == QuasiForm::rational_cubic) {
    RationalCubic c = rational_cubic(unit);
    return {std::move(c.polygon), std::move(c.weights), 0};
  }
  return {discrete_polygon(unit, variable, o.degree), {}, 0};
}

void measure(QuasiResult& r) {
  const analysis::Lcg graph = analysis::logarithmic_curvature_graph(r.curve);
  r.lcg_defined = graph.defined;
  r.lcg_slope = graph.slope;
  r.lcg_variance = graph.variance;
  r.deviation = deviation_bound(r.target, r.curve);
  r.monotone = curve::certify_monotone_curvature(r.curve);
}

}  // namespace detail

Result<Segment> standard_segment(double alpha, double lambda, const core::Interval& angles) {
  const auto bad = [](const char* message, const char* path) {
    return core::fail(ErrorCode::bad_input, message, "", path);
  };
  if (!is_slope(alpha)) return bad(kSlopeRule, "alpha");
  if (!std::isfinite(lambda)) return bad("lambda must be a finite number", "lambda");
  if (!std::isfinite(angles.low) || !std::isfinite(angles.high) || !(angles.low < angles.high))
    return bad("the interval of tangent angle must be two growing finite numbers", "interval");
  const auto radius = [&](double angle) {
    const double x = (alpha - 1) * lambda * angle;
    if (x < -1) return std::numeric_limits<double>::quiet_NaN();
    return std::exp(x == 0 ? lambda * angle : lambda * angle * (std::log1p(x) / x));
  };
  const auto piece = [&](double from, double to) {
    const double r0 = radius(from);
    const double r1 = radius(to);
    const double length = (to - from) * numeric::power_mean_integral(r0, r1, alpha - 1, 1);
    return Piece{alpha, length, 1 / r0, 1 / r1};
  };
  const Piece asked = piece(angles.low, angles.high);
  if (std::isnan(asked.curvature_start + asked.curvature_end) || !validate(asked))
    return bad("the interval leaves the curve: 1 + (alpha - 1) lambda angle must stay above 0",
               "interval");
  core::Pose2 start;
  if (angles.low > 0) start = end_pose(place(piece(0, angles.low), {}));
  if (angles.low < 0) {
    // From the interval's start to the origin, laid so that it ends there along x.
    const Vector2 v = displacement(piece(angles.low, 0), 1);
    const Vector2 back = core::rotate_ccw(v, angles.low);
    start = {{-back.x, -back.y}, angles.low};
  }
  start.direction = angles.low;
  return place(asked, start);
}

namespace detail {

Result<QuasiResult> best_result(const Segment& segment, int degree, const OtherForms& others) {
  auto best = best_of_degrees(segment, degree, others);
  if (!best) return no_such_ends();
  QuasiResult r;
  r.target = segment;
  r.form = QuasiForm::best;
  r.lambda = lambda_of(piece_of(segment));
  r.curve = std::move(best->curve);
  measure(r);
  r.deviation = std::min(r.deviation, best->deviation);  // a raised curve stays where it was
  return r;
}

}  // namespace detail

Result<QuasiResult> quasi_log_aesthetic(const Segment& segment, const QuasiOptions& options) {
  if (auto valid = validate(segment); !valid) return std::unexpected(valid.error());
  const UnitPiece unit = detail::unit_piece(piece_of(segment));
  const auto settled = detail::settled(unit, options);
  if (!settled) return std::unexpected(settled.error());
  if (settled->form == QuasiForm::best) return detail::best_result(segment, settled->degree, {});
  const detail::Drawn drawn = detail::draw_form(unit, *settled);
  if (drawn.polygon.empty())
    return core::fail(ErrorCode::undrawable,
                      "no rational cubic with weights from 1e-4 to 1e4 and handles that outlast "
                      "rounding meets these ends",
                      "split the curve", "form");
  QuasiResult r;
  r.target = segment;
  r.form = settled->form;
  r.about = settled->about.value_or(0);
  r.lambda = lambda_of(piece_of(segment));
  r.series_bound = unit.length * drawn.series_bound;
  r.curve = detail::in_place(segment, unit, drawn);
  detail::measure(r);
  return r;
}

Result<QuasiResult> quasi_log_aesthetic(double alpha, double lambda, const core::Interval& angles,
                                        const QuasiOptions& options) {
  const auto segment = standard_segment(alpha, lambda, angles);
  if (!segment) return std::unexpected(segment.error());
  auto result = quasi_log_aesthetic(*segment, options);
  if (result) result->lambda = lambda;
  return result;
}

}  // namespace keyline::lac
