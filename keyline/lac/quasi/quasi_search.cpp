#include "keyline/lac/quasi/quasi_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_hermite.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail {

namespace {

constexpr double kMostSeriesTurning = 6.2;
constexpr double kMet = 1e-11;         // radians
constexpr double kMostTurning = 1e30;  // of a polygon's piece
constexpr double kFarthest = 350;      // log of the ratio of polygons' radii

bool is_discrete(QuasiForm f) {
  return f == QuasiForm::discrete_angle || f == QuasiForm::discrete_arc;
}

}  // namespace

UnitPiece piece_from(double alpha, const Unknowns& x) {
  const double end = std::exp(-x.log_ratio);
  const double start_curvature = x.turning / numeric::power_mean_integral(1, end, -alpha, 1);
  return unit_piece({alpha, 1, start_curvature, start_curvature * end});
}

double Miss::size() const { return std::max(std::abs(turning), std::abs(chord_angle)); }

HandleSearch::HandleSearch(const HandleAngles& angles, double alpha, const QuasiOptions& options)
    : turning_(std::abs(angles.turning)),
      chord_angle_(std::abs(angles.chord_angle)),
      alpha_(alpha),
      options_(options) {}

bool HandleSearch::solve(Unknowns& x) {
  std::optional<Miss> miss = at(x);
  if (!miss) return false;
  for (iterations = 0; iterations < 60 && miss->size() > 2e-16 * (1 + turning_); ++iterations) {
    const std::optional<Unknowns> step = newton_step(x, *miss);
    if (!step) return false;
    double factor = 1;
    std::optional<Miss> next;
    for (; factor > 1e-3; factor /= 2) {
      next = at({x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning});
      if (next && next->size() < miss->size()) break;
    }
    if (!(factor > 1e-3)) break;  // as good as rounding lets it be, or stuck
    x = {x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning};
    miss = next;
  }
  return miss->size() < kMet;
}

std::optional<Miss> HandleSearch::at(const Unknowns& x) const {
  const bool discrete = is_discrete(options_.form);
  if (!(x.turning > 1e-3 * turning_ &&
        x.turning <= (discrete ? kMostTurning : kMostSeriesTurning)) ||
      !(std::abs(x.log_ratio) <= kFarthest))
    return std::nullopt;
  const EndEdges edges = end_edges(piece_from(alpha_, x));
  const double turned = core::angle_between(edges.first, edges.last) - turning_;
  const double chord = core::angle_between(edges.first, edges.chord) - chord_angle_;
  if (!std::isfinite(turned) || !std::isfinite(chord)) return std::nullopt;
  return Miss{core::wrap_angle(turned), chord};
}

SeriesVariable HandleSearch::variable() const {
  return options_.form == QuasiForm::taylor_angle ? SeriesVariable::tangent_angle
                                                  : SeriesVariable::arc_length;
}

EndEdges HandleSearch::end_edges(const UnitPiece& unit) const {
  const int n = options_.degree;
  if (!is_discrete(options_.form)) {
    return taylor_end_edges(taylor_series(unit, variable(), *options_.about, n));
  }
  const ControlPolygon b = draw_form(unit, options_).polygon;
  return {b[1] - b[0], b[n] - b[n - 1], b[n] - b[0]};
}

/// By central differences of the two angles: the step's accuracy is no matter of the result's.
std::optional<Unknowns> HandleSearch::newton_step(const Unknowns& x, const Miss& miss) const {
  const double h = 1e-5;
  const double k = 1e-5 * x.turning;
  const auto a0 = at({x.log_ratio - h, x.turning});
  const auto a1 = at({x.log_ratio + h, x.turning});
  const auto b0 = at({x.log_ratio, x.turning - k});
  const auto b1 = at({x.log_ratio, x.turning + k});
  if (!a0 || !a1 || !b0 || !b1) return std::nullopt;
  const double tq = (a1->turning - a0->turning) / (2 * h);
  const double cq = (a1->chord_angle - a0->chord_angle) / (2 * h);
  const double tt = (b1->turning - b0->turning) / (2 * k);
  const double ct = (b1->chord_angle - b0->chord_angle) / (2 * k);
  const double determinant = tq * ct - cq * tt;
  if (!(std::abs(determinant) > 0)) return std::nullopt;
  const double dq = -(ct * miss.turning - tt * miss.chord_angle) / determinant;
  const double dt = -(tq * miss.chord_angle - cq * miss.turning) / determinant;
  return Unknowns{std::clamp(dq, -1.5, 1.5), std::clamp(dt, -0.5 * x.turning, 0.5 * x.turning)};
}

std::vector<Unknowns> HandleSearch::all() {
  return is_discrete(options_.form) ? polygons() : series();
}

// ---- Polygons -----------------------------------------------------------------------------

/// Of a polygon the turning of its edges is in proportion to that of the piece, so only the ratio
/// of the radii is looked for, by sign: the piece itself may turn many times round within half an
/// edge.
std::vector<Unknowns> HandleSearch::polygons() const {
  std::vector<Unknowns> found;
  std::optional<Miss> before;
  double last = 0;
  for (double log_ratio = -kFarthest; log_ratio <= kFarthest;
       log_ratio += std::max(1.0, 0.1 * std::abs(log_ratio))) {
    const auto now = at(turning_rightly(log_ratio));
    if (before && now && before->chord_angle * now->chord_angle <= 0) {
      const Unknowns x = between(last, log_ratio, before->chord_angle);
      const auto miss = at(x);
      if (miss && miss->size() < kMet) found.push_back(x);
    }
    before = now;
    last = log_ratio;
  }
  return found;
}

/// Where the chord angle is met between two ratios, halved down; `off` is the miss at the first.
Unknowns HandleSearch::between(double low, double high, double off) const {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const auto miss = at(turning_rightly(middle));
    if (!miss) break;
    (miss->chord_angle * off > 0 ? low : high) = middle;
  }
  return turning_rightly(0.5 * (low + high));
}

/// The piece of a ratio whose polygon turns as wanted from its first edge to its last.
Unknowns HandleSearch::turning_rightly(double log_ratio) const {
  const double n = options_.degree;
  if (options_.form == QuasiForm::discrete_angle) return {log_ratio, turning_ * n / (n - 1)};
  const Piece whole = piece_from(alpha_, {log_ratio, 1}).piece;
  return {log_ratio, turning_ / total_turning(part(whole, 0.5 / n, 1 - 0.5 / n))};
}

// ---- Taylor forms -------------------------------------------------------------------------

std::vector<Unknowns> HandleSearch::series() {
  std::vector<Unknowns> found;
  const SeriesPlaces looked_at =
      series_places({variable(), alpha_, *options_.about, options_.degree, turning_, chord_angle_});
  cut_short = !looked_at.complete;
  for (const SeriesPlace& place : looked_at.places) {
    Unknowns x = unknowns_of(place);
    if (!solve(x)) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const Unknowns& y) {
      return std::abs(y.log_ratio - x.log_ratio) + std::abs(y.turning - x.turning) < 1e-7;
    });
    if (!known) found.push_back(x);
  }
  return found;
}

/// Not finite where there is no piece.
Unknowns HandleSearch::unknowns_of(const SeriesPlace& place) const {
  const bool by_angle = options_.form == QuasiForm::taylor_angle;
  const double decay = by_angle ? 1 - alpha_ : alpha_;
  // Of curvature or radius: its logarithm, 0 at the point of expansion.
  const auto grown = [&](double x) {
    const double step = place.log_rate * x;
    return decay == 0 ? step : -std::log1p(-decay * step) / decay;
  };
  const double start = grown(-*options_.about), end = grown(1 - *options_.about);
  if (by_angle) return {end - start, place.value};
  const Piece piece{alpha_, 1, place.value * std::exp(start), place.value * std::exp(end)};
  return {start - end, total_turning(piece)};
}

}  // namespace keyline::lac::detail
