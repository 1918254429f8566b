#include "keyline/classa/free_form.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "keyline/classa/deviation.h"
#include "keyline/core/extent.h"
#include "keyline/core/text.h"
#include "keyline/curve/conversion.h"
#include "keyline/fit/bezier_fit.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Point2;

namespace {

constexpr int kSamples = 400;

std::vector<Point2> sample(const curve::PlanarView& c) {
  std::vector<Point2> points;
  const std::vector<double>& breaks = c.breaks();
  const int per_stretch = std::max<int>(2, kSamples / static_cast<int>(breaks.size() - 1));
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < per_stretch; ++k)
      points.push_back(
          evaluate(c, std::lerp(breaks[i], breaks[i + 1], k / static_cast<double>(per_stretch))));
  points.push_back(evaluate(c, 1.0));
  return points;
}

std::unexpected<core::Failure> not_within(double tolerance, double deviation) {
  return fail(ErrorCode::not_converged,
              "no Bezier curve of degree 8 comes within " + core::number_text(tolerance, 4) +
                  " of the curve; the best stays " + core::number_text(deviation, 4) + " away",
              "give a larger fit tolerance, or one monotone piece of the curve", "fit_tolerance");
}

/// Lowest degree whose bound meets the tolerance: samples may be met by a curve that leaves it
/// between them, so that they are asked for a little more, then for a degree more.
core::Result<Approximation> fit_within(const std::vector<Point2>& points, core::Vector2 start,
                                       core::Vector2 end, double tolerance,
                                       const curve::PiecewiseBezier& pieces) {
  fit::BezierFitOptions options;
  options.tolerance = tolerance - pieces.deviation;
  for (int attempt = 0;; ++attempt) {
    auto fit = fit::fit_bezier(points, start, end, options);
    if (!fit) return std::unexpected(std::move(fit.error()));
    const double sharp = std::max(1.01 * fit->deviation, 0.01 * tolerance);
    const double bound = pieces.deviation + deviation_bound(pieces.pieces, fit->curve, sharp);
    if (bound <= tolerance) return Approximation{std::move(fit->curve), false, bound, tolerance};
    if (!fit->within || attempt == 8) return not_within(tolerance, bound);
    options.tolerance *= 0.9;
    if (attempt > 1) options.lowest_degree = curve::degree(fit->curve) + 1;
    if (options.lowest_degree > options.highest_degree) return not_within(tolerance, bound);
  }
}

}  // namespace

core::Result<Approximation> approximate(const curve::PlanarView& c, std::optional<double> tolerance,
                                        const PiecesWithin& pieces) {
  const std::vector<Point2> points = sample(c);
  const double size = core::reach(points);
  const double wanted = tolerance.value_or(1e-3 * size);
  if (!(wanted > 0 && std::isfinite(wanted)))
    return fail(ErrorCode::bad_input, "the tolerance of the approximation is not positive",
                "give a length greater than 0 and a curve that has one", "fit_tolerance");
  const double share = std::max(0.01 * wanted, 1e-12 * size);
  auto row = pieces ? pieces(share)
                    : core::Result<curve::PiecewiseBezier>(curve::approximate_by_cubics(c, share));
  if (!row) return std::unexpected(std::move(row.error()));
  if (!(row->deviation < wanted)) return not_within(wanted, row->deviation);
  const auto tangent = [&](double t) { return curve::unit_tangent(jet(c, t)); };
  return fit_within(points, tangent(0), tangent(std::nextafter(1.0, 0.0)), wanted, *row);
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
