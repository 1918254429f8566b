#include "keyline/lac/quasi/quasi_hermite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi_search.h"
#include "keyline/lac/segment/deviation.h"
#include "keyline/lac/segment/lambda.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {

using core::ErrorCode;
using core::Point2;
using core::Result;
using core::Vector2;
using detail::ControlPolygon;
using detail::UnitPiece;
using detail::Unknowns;

namespace {

/// Ends and end tangents, off by rounding, put exactly in place.
void settle_ends(curve::Bezier2& c, Point2 p0, Point2 p1, Point2 p2) {
  const std::size_t n = c.control.size() - 1;
  const Vector2 first = (p1 - p0) / distance(p0, p1);
  const Vector2 last = (p2 - p1) / distance(p1, p2);
  c.control[0] = p0;
  c.control[1] = p0 + dot(c.control[1] - p0, first) * first;
  c.control[n] = p2;
  c.control[n - 1] = p2 - dot(p2 - c.control[n - 1], last) * last;
}

/// The polygon laid over the handles.
curve::Bezier2 laid_over(const detail::Drawn& drawn, Point2 p0, Point2 p1, Point2 p2,
                         double mirror) {
  const ControlPolygon& b = drawn.polygon;
  const std::size_t n = b.size() - 1;
  const Vector2 chord = b[n] - b[0];
  const double scale = distance(p0, p2) / norm(chord);
  const double rotation = core::direction_of(p2 - p0) - mirror * core::direction_of(chord);
  curve::Bezier2 c;
  for (const Vector2 v : b)
    c.control.push_back(
        p0 + scale * core::rotate_ccw({v.x - b[0].x, mirror * (v.y - b[0].y)}, rotation));
  c.weights = drawn.weights;
  settle_ends(c, p0, p1, p2);
  return c;
}

/// The forms over three handles.
class OverHandles {
 public:
  OverHandles(const Segment& target, double alpha, const std::array<Point2, 3>& handles)
      : target_(target),
        unit_(detail::unit_piece(piece_of(target))),
        angles_(*handle_angles(handles[0], handles[1], handles[2])),
        alpha_(alpha),
        handles_(handles) {}

  Result<QuasiOptions> settled(const QuasiOptions& options) const {
    return detail::settled(unit_, options);
  }

  /// Of the curves of settled options the closest to the target; nothing where there is none, or,
  /// cut_short is set then, where the search did not see all.
  std::optional<QuasiResult> closest(const QuasiOptions& settled, bool& cut_short) const {
    Unknowns x{numeric::log_ratio(unit_.piece.curvature_end, unit_.piece.curvature_start),
               unit_.turning};
    detail::HandleSearch search(angles_, alpha_, settled);
    if (search.solve(x)) {
      if (auto r = laid(x, settled)) {
        r->iterations = search.iterations;
        return r;
      }
    }
    std::optional<QuasiResult> closest;
    for (const Unknowns& found : search.all()) {
      auto r = laid(found, settled);
      if (r && !(closest && closest->deviation <= r->deviation)) closest = std::move(r);
    }
    cut_short = cut_short || search.cut_short;
    return closest;
  }

  /// The same of options whose expansion is chosen: as it is best for the target, else, where that
  /// has none over the handles, the closest expanded at eighths of the interval.
  std::optional<QuasiResult> closest_expanded(const QuasiOptions& options, const QuasiOptions& best,
                                              bool& cut_short) const {
    std::optional<QuasiResult> all = closest(best, cut_short);
    if (all || !options.automatic) return all;
    for (const QuasiForm form : {QuasiForm::taylor_angle, QuasiForm::taylor_arc})
      for (int i = 0; i <= 8; ++i) {
        const auto at = settled({form, options.degree, i / 8.0, false});
        auto r = at ? closest(*at, cut_short) : std::nullopt;
        if (r && !(all && all->deviation <= r->deviation)) all = std::move(r);
      }
    return all;
  }

  /// Of all forms that give up end curvatures.
  std::optional<detail::Approximation> closest_form(int degree) const {
    std::optional<detail::Approximation> all;
    bool cut_short = false;  // there are others
    if (degree == 3) all = cubic_within();
    for (const QuasiForm form : {QuasiForm::taylor_angle, QuasiForm::taylor_arc,
                                 QuasiForm::discrete_angle, QuasiForm::discrete_arc}) {
      const auto options = settled({form, degree, {}, false});
      if (!options) continue;
      auto r = closest(*options, cut_short);
      if (r && !(all && all->deviation <= r->deviation))
        all = {std::move(r->curve), r->deviation, false};
    }
    return all;
  }

 private:
  /// The closest found of cubics whose control points lie on the handles: as near to the target as
  /// the triangle of the handles is low, so that next to a corner there is something.
  detail::Approximation cubic_within() const {
    const auto along = [&](double a, double b) {
      const auto& [p0, p1, p2] = handles_;
      detail::Approximation c{{{p0, p0 + a * (p1 - p0), p2 + b * (p1 - p2), p2}, {}}, 0, false};
      c.deviation = holds_tangents(c.curve) ? deviation_bound(target_, c.curve) : HUGE_VAL;
      return c;
    };
    double a = 0.6, b = 0.6;
    detail::Approximation best = along(a, b);
    for (double factor = 2; factor > 1.01; factor = std::sqrt(factor)) {
      for (const auto& [u, v] : {std::pair{factor, 1.0},
                                 {1 / factor, 1.0},
                                 {1.0, factor},
                                 {1.0, 1 / factor},
                                 {factor, 1 / factor},
                                 {1 / factor, factor}}) {
        const double c = std::min(a * u, 1.0), d = std::min(b * v, 1.0);
        detail::Approximation next = along(c, d);
        if (!(next.deviation < best.deviation)) continue;
        best = std::move(next);
        a = c;
        b = d;
      }
    }
    return best;
  }

  /// Whether the end edges are long enough for their directions to outlast the coordinates'
  /// rounding.
  bool holds_tangents(const curve::Bezier2& c) const {
    double extent = distance(handles_[0], handles_[2]);
    for (const Point2& p : handles_) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
    const std::size_t n = c.control.size() - 1;
    const double edge =
        std::min(distance(c.control[0], c.control[1]), distance(c.control[n - 1], c.control[n]));
    return edge > detail::kShortestHandle * extent;
  }

  /// The curve of solved unknowns, with its deviation and nothing else measured; nothing where it
  /// does not hold its tangents.
  std::optional<QuasiResult> laid(const Unknowns& x, const QuasiOptions& settled) const {
    const UnitPiece solved = detail::piece_from(alpha_, x);
    const detail::Drawn drawn = detail::draw_form(solved, settled);
    QuasiResult r;
    r.target = target_;
    r.form = settled.form;
    r.about = settled.about.value_or(0);
    r.lambda = lambda_of(solved.piece);
    r.curve = laid_over(drawn, handles_[0], handles_[1], handles_[2], unit_.mirror);
    if (!holds_tangents(r.curve)) return std::nullopt;
    const double chord = norm(drawn.polygon.back() - drawn.polygon.front());
    r.series_bound = distance(handles_[0], handles_[2]) / chord * drawn.series_bound;
    r.deviation = deviation_bound(target_, r.curve);
    return r;
  }

  const Segment& target_;
  UnitPiece unit_;
  HandleAngles angles_;
  double alpha_;
  std::array<Point2, 3> handles_;
};

/// Those of the forms that are fitted to the target, whose ends are those of the handles.
Result<QuasiResult> fitted(const OverHandles& forms, const Segment& target,
                           const QuasiOptions& options) {
  if (options.form != QuasiForm::best) return quasi_log_aesthetic(target, options);
  if (auto checked = forms.settled(options); !checked) return std::unexpected(checked.error());
  return detail::best_result(target, options.degree,
                             [&](int degree) { return forms.closest_form(degree); });
}

/// Why there is no target. What the hint advises leads to one next to the border of what can be
/// drawn, where its end curvatures are far apart: the form best bears that, others need not.
std::unexpected<core::Failure> no_target(core::Failure failure, QuasiForm form) {
  if (failure.code == ErrorCode::undrawable && form != QuasiForm::best)
    failure.hint += ", with the form best";
  return std::unexpected(std::move(failure));
}

std::unexpected<core::Failure> no_lambda(bool cut_short) {
  if (cut_short)
    return core::fail(
        ErrorCode::not_converged,
        "no Lambda was found for these end tangents, and the search was cut short: at "
        "this degree and slope rounding hides where it may lie",
        "lower the degree, or take the form best or rational-cubic", "degree");
  return core::fail(
      ErrorCode::undrawable,
      "no Lambda was found that gives a curve of this form and degree with these end tangents "
      "whose end edges outlast rounding",
      "raise the degree, or take the form best or rational-cubic");
}

bool keeps_ends(QuasiForm f) { return f == QuasiForm::rational_cubic || f == QuasiForm::best; }

}  // namespace

Result<QuasiResult> quasi_log_aesthetic(Point2 p0, Point2 p1, Point2 p2, double alpha,
                                        const QuasiOptions& options) {
  const auto solution = solve_g1(p0, p1, p2, alpha);
  if (!solution) return no_target(solution.error(), options.form);
  if (solution->turning == 0) return quasi_log_aesthetic(solution->segment, options);
  const OverHandles forms(solution->segment, alpha, {p0, p1, p2});
  if (keeps_ends(options.form)) {
    auto result = fitted(forms, solution->segment, options);
    if (result) settle_ends(result->curve, p0, p1, p2);
    return result;
  }
  const auto settled = forms.settled(options);
  if (!settled) return std::unexpected(settled.error());
  bool cut_short = false;
  auto closest = forms.closest_expanded(options, *settled, cut_short);
  if (!closest) return no_lambda(cut_short);
  detail::measure(*closest);
  return *std::move(closest);
}

}  // namespace keyline::lac
