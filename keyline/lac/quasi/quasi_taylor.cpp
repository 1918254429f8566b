#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_forms.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

using Row = std::array<double, kMaxTaylorDegree + 1>;

/// Multiplies the polynomial of the given degree in z by (1 + a z).
void multiply(Row& e, int degree, double a) {
  e[degree + 1] = 0;
  for (int k = degree; k >= 0; --k) e[k + 1] += a * e[k];
}

Vector2 from_frame(const UnitPiece& unit, const TaylorSeries& s, Vector2 v) {
  return displacement(unit.piece, s.arc) + core::rotate_ccw(v, turning(unit.piece, s.arc));
}

/// Largest distance of the series' ends from those of the piece.
double end_error(const UnitPiece& unit, SeriesVariable variable, double about, int degree) {
  const TaylorSeries s = taylor_series(unit, variable, about, degree);
  if (!s.analytic) return std::numeric_limits<double>::infinity();
  const Vector2 start = from_frame(unit, s, sum(s, -about));
  const Vector2 end = from_frame(unit, s, sum(s, 1 - about));
  const double error = std::max(norm(start), norm(end - displacement(unit.piece, 1)));
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// Control points of a series in its own frame: its polar form at i ones.
class Polar {
 public:
  explicit Polar(const TaylorSeries& s) : s_(s) {
    binomial_[0] = 1;
    for (int i = 0; i < s.degree; ++i) multiply(binomial_, i, 1);
  }

  Vector2 at(int ones) const {
    Row e{};
    e[0] = 1;
    for (int m = 0; m < s_.degree; ++m) multiply(e, m, m < ones ? 1 - s_.about : -s_.about);
    Vector2 b;
    for (int k = s_.degree; k > 0; --k) b = b + (e[k] / binomial_[k]) * s_.coefficient[k];
    return b;
  }

 private:
  const TaylorSeries& s_;
  Row binomial_{};
};

struct Candidate {
  double about = 0;
  double error = 0;
};

/// Least end error: the best of 33 places, refined by sections.
Candidate best_about(const UnitPiece& unit, SeriesVariable variable, int degree) {
  Candidate best{0, std::numeric_limits<double>::infinity()};
  const auto offer = [&](double about) {
    const double error = end_error(unit, variable, about, degree);
    if (error < best.error) best = {about, error};
  };
  constexpr int kPlaces = 32;
  for (int i = 0; i <= kPlaces; ++i) offer(static_cast<double>(i) / kPlaces);
  for (double width = 1.0 / kPlaces; width > 1e-4; width /= 2) {
    const double at = best.about;
    offer(std::max(at - width / 2, 0.0));
    offer(std::min(at + width / 2, 1.0));
  }
  return best;
}

}  // namespace

ControlPolygon taylor_polygon(const UnitPiece& unit, const TaylorSeries& s) {
  const Polar polar(s);
  const Vector2 origin = displacement(unit.piece, s.arc);
  const double direction = turning(unit.piece, s.arc);
  ControlPolygon polygon;
  for (int i = 0; i <= s.degree; ++i)
    polygon.push_back(origin + core::rotate_ccw(polar.at(i), direction));
  return polygon;
}

EndEdges taylor_end_edges(const TaylorSeries& s) {
  const Polar polar(s);
  const Vector2 start = polar.at(0), end = polar.at(s.degree);
  return {polar.at(1) - start, end - polar.at(s.degree - 1), end - start};
}

ControlPolygon discrete_polygon(const UnitPiece& unit, SeriesVariable variable, int degree) {
  const bool by_angle = variable == SeriesVariable::tangent_angle;
  const auto arc_at = [&](double u) { return by_angle ? fraction_at_turning(unit.piece, u) : u; };
  // Of equal lengths: beyond the first and last edge's middles the piece may turn many times round;
  // by which angle the edges part must not drown in that.
  const Piece inner = part(unit.piece, 0.5 / degree, 1 - 0.5 / degree);
  const double first = core::wrap_angle(turning(unit.piece, 0.5 / degree));
  ControlPolygon polygon{{0, 0}};
  for (int i = 0; i < degree; ++i) {
    const double edge = arc_at((i + 1.0) / degree) - arc_at(1.0 * i / degree);
    const double direction =
        by_angle ? unit.turning * (i + 0.5) / degree : first + turning(inner, i / (degree - 1.0));
    polygon.push_back(polygon.back() + edge * core::unit_vector(direction));
  }
  return polygon;
}

double ruled_about(const UnitPiece& unit, SeriesVariable variable) {
  const double k0 = std::abs(unit.piece.curvature_start);
  const double k1 = std::abs(unit.piece.curvature_end);
  const double small_radius = k0 >= k1 ? 0 : 1;
  const double edge = variable == SeriesVariable::tangent_angle ? 1 : 0;
  return unit.piece.alpha < edge ? small_radius : 1 - small_radius;
}

Expansion best_expansion(const UnitPiece& unit, int degree) {
  const Candidate arc = best_about(unit, SeriesVariable::arc_length, degree);
  const bool one_sign = unit.piece.curvature_start * unit.piece.curvature_end > 0 ||
                        (unit.turning > 0 && !(inflection(unit.piece) > 0));
  if (!one_sign) return {SeriesVariable::arc_length, arc.about};
  const Candidate angle = best_about(unit, SeriesVariable::tangent_angle, degree);
  return angle.error < arc.error ? Expansion{SeriesVariable::tangent_angle, angle.about}
                                 : Expansion{SeriesVariable::arc_length, arc.about};
}

}  // namespace keyline::lac::detail
