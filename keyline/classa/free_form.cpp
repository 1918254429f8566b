#include "keyline/classa/free_form.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "keyline/core/text.h"
#include "keyline/fit/bezier_fit.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Point2;

core::Result<Approximation> approximate(const curve::PlanarView& c,
                                        std::optional<double> tolerance) {
  constexpr int kSamples = 400;
  std::vector<Point2> points;
  const std::vector<double>& breaks = c.breaks();
  const int per_stretch = std::max<int>(2, kSamples / static_cast<int>(breaks.size() - 1));
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < per_stretch; ++k)
      points.push_back(
          evaluate(c, std::lerp(breaks[i], breaks[i + 1], k / static_cast<double>(per_stretch))));
  points.push_back(evaluate(c, 1.0));
  double size = 0;
  for (const Point2& p : points) size = std::max(size, distance(p, points.front()));
  fit::BezierFitOptions options;
  options.tolerance = tolerance.value_or(1e-3 * size);
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
    return fail(ErrorCode::bad_input, "the tolerance of the approximation is not positive",
                "give a length greater than 0 and a curve that has one", "fit_tolerance");
  const auto tangent = [&](double t) { return curve::unit_tangent(jet(c, t)); };
  auto fit = fit::fit_bezier(points, tangent(0), tangent(std::nextafter(1.0, 0.0)), options);
  if (!fit) return std::unexpected(std::move(fit.error()));
  if (!fit->within)
    return fail(ErrorCode::not_converged,
                "no Bezier curve of degree 8 comes within " +
                    core::number_text(options.tolerance, 4) + " of the curve; the best stays " +
                    core::number_text(fit->deviation, 4) + " away",
                "give a larger fit tolerance, or one monotone piece of the curve", "fit_tolerance");
  return Approximation{std::move(fit->curve), false, fit->deviation, options.tolerance};
}

core::Result<Evaluation> evaluate_curve(Approximation approximation, const CavOptions& options) {
  auto value = cav(approximation.curve, options);
  if (!value) return std::unexpected(std::move(value.error()));
  Evaluation e{std::move(approximation), std::move(*value), {}, {}};
  if (e.value.type <= 3) return e;
  const core::Interval s{std::min(options.s.low, 1.0), std::max(options.s.high, 1.0)};
  e.nearest = nearest_matrix_curve(e.approximation.curve, {options.alpha_max, s});
  if (!e.nearest) return e;
  CavOptions own = options;
  own.minimum.reset();
  if (auto nearest = cav(e.nearest->curve, own)) e.nearest_value = std::move(*nearest);
  return e;
}

}  // namespace keyline::classa
