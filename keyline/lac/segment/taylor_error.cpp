#include "keyline/lac/segment/taylor_error.h"

#include <algorithm>
#include <cmath>

#include "keyline/lac/segment/taylor.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Vector2;
using detail::SeriesVariable;
using detail::TaylorSeries;
using detail::UnitPiece;

constexpr int kMostDegree = 30;
constexpr int kPlaces = 256;

core::Result<void> check(const Segment& segment, TaylorVariable variable, double about, int most) {
  if (auto sound = validate(segment); !sound) return sound;
  if (!(about >= 0 && about <= 1))
    return core::fail(ErrorCode::bad_input, "the place to expand at must lie in [0, 1]", {},
                      "about");
  if (most < 1 || most > kMostDegree)
    return core::fail(ErrorCode::bad_input, "the degree must lie between 1 and 30", {}, "degree");
  if (variable == TaylorVariable::tangent_angle &&
      (inflection(piece_of(segment)) > 0 || segment.curvature_start == 0 ||
       segment.curvature_end == 0))
    return core::fail(ErrorCode::unsupported,
                      "tangent angle runs no further where the curvature is zero",
                      "expand in arc length");
  return {};
}

/// The curve at even places of the variable, in the frame at the place of expansion.
std::vector<Vector2> places_of(const UnitPiece& unit, const TaylorSeries& series) {
  const Vector2 origin = displacement(unit.piece, series.arc);
  const double direction = turning(unit.piece, series.arc);
  std::vector<Vector2> places;
  for (int i = 0; i <= kPlaces; ++i) {
    const double u = static_cast<double>(i) / kPlaces;
    const double arc =
        series.variable == SeriesVariable::tangent_angle ? fraction_at_turning(unit.piece, u) : u;
    places.push_back(core::rotate_ccw(displacement(unit.piece, arc) - origin, -direction));
  }
  return places;
}

double largest_error(const TaylorSeries& series, const std::vector<Vector2>& places) {
  double largest = 0;
  for (int i = 0; i <= kPlaces; ++i) {
    const Vector2 off = sum(series, static_cast<double>(i) / kPlaces - series.about) - places[i];
    largest = std::max(largest, norm(off));
  }
  return largest;
}

}  // namespace

core::Result<TaylorErrors> taylor_errors(const Segment& segment, TaylorVariable variable,
                                         double about, int most) {
  if (auto sound = check(segment, variable, about, most); !sound)
    return std::unexpected(sound.error());
  const UnitPiece unit = detail::unit_piece(piece_of(segment));
  const auto by = variable == TaylorVariable::tangent_angle ? SeriesVariable::tangent_angle
                                                            : SeriesVariable::arc_length;
  TaylorSeries series = taylor_series(unit, by, about, most);
  if (!series.analytic)
    return core::fail(ErrorCode::unsupported,
                      "curvature is zero or infinite where it is to be expanded: no series",
                      "expand at another place", "about");
  const double reach = std::max(about, 1 - about);
  TaylorErrors errors{series.radius, reach < series.radius, {}};
  const auto places = places_of(unit, series);
  for (series.degree = 1; series.degree <= most; ++series.degree)
    errors.degrees.push_back({series.degree, unit.length * remainder_bound(series, reach),
                              unit.length * largest_error(series, places)});
  return errors;
}

}  // namespace keyline::lac
