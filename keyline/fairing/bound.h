#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/half_plane.h"
#include "keyline/fairing/chain_fit.h"
#include "keyline/lac/chain/chain.h"

/// Sides of lines that the curve is to stay on: a hull's half-breadths do not pass its centre
/// plane.
namespace keyline::fairing {

enum class Axis { x, y };
constexpr auto choices(const Axis*) { return core::words<Axis>({{Axis::x, "x"}, {Axis::y, "y"}}); }

/// A limit of one coordinate, in the points' own unit.
struct Bound {
  Axis axis = Axis::x;
  std::optional<double> at_least;
  std::optional<double> at_most;
  friend bool operator==(const Bound&, const Bound&) = default;
  static constexpr auto describe() {
    return core::fields(core::field<&Bound::axis>("the coordinate").needed(),
                        core::field<&Bound::at_least>("its least value").in("length"),
                        core::field<&Bound::at_most>("its largest value").in("length"));
  }
  static constexpr std::string_view kTextForm = "x>=0, x<=0, y>=0 or y<=0 with any number";
  static core::Result<Bound> from_text(std::string_view text);
  /// bad_input where it limits nothing.
  static core::Result<void> check(const Bound& bound);
};

std::vector<core::HalfPlane> half_planes(std::span<const Bound> bounds);

namespace detail {

/// The points and, where a border is nearer than they are to each other, more guides between them,
/// for a curve may pass it there: they hold it to no tolerance, only to limits.
std::vector<FitPoint> with_watchers(const std::vector<FitPoint>& points, bool closed,
                                    std::span<const core::HalfPlane> inside, double tolerance);

/// Ends of an open run that lie outside by no more than the tolerance stand on the border: where
/// the curve comes to it, it ends a little earlier, and need not go sideways.
void draw_ends_inside(std::vector<FitPoint>& points, std::span<const core::HalfPlane> inside,
                      double tolerance);

/// Limits to the points' offsets that leave the curve inside. Nothing where the curve stands square
/// to a border: there its ends count.
///
/// margin: how much farther in, one per half-plane; less beside the places `held`, at which ends
/// stand, on the border perhaps, and no margin or limit there.
void limit_offsets(std::vector<FitPoint>& points, bool closed,
                   std::span<const core::HalfPlane> inside, std::span<const double> margin,
                   std::span<const core::Point2> held);

/// The most that the chain passes the half-plane's border by; 0 where it stays inside, to rounding.
double outside(const lac::Chain& chain, const core::HalfPlane& half);

}  // namespace detail
}  // namespace keyline::fairing
