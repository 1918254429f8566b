#include "keyline/classa/space_reading.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/axis.h"

namespace keyline::classa::detail {
namespace {

using core::Point3;
using core::Vector3;

/// Lengths of the outermost edges against each other, then inwards.
bool shrinks(const std::vector<Point3>& control) {
  for (std::size_t i = 1, j = control.size() - 1; i < j; ++i, --j) {
    const double first = distance(control[i - 1], control[i]);
    const double last = distance(control[j - 1], control[j]);
    if (std::abs(first - last) > 1e-12 * std::max(first, last)) return last < first;
  }
  return false;
}

/// Of length 1, at right angles to the unit vector x; towards v where that leaves x.
Vector3 beside(Vector3 x, Vector3 v) {
  Vector3 across = v - dot(v, x) * x;
  if (!(norm(across) > 1e-12 * norm(v))) across = cross(core::any_normal(x), x);
  return across / norm(across);
}

}  // namespace

SpaceReading read_in_space(std::vector<Point3> control, const CavOptions& options) {
  SpaceReading r;
  r.control = std::move(control);
  r.reversed = options.direction == Direction::growing && shrinks(r.control);
  if (r.reversed) std::reverse(r.control.begin(), r.control.end());
  const Point3 start = r.control.front();
  const Vector3 tangent = leaving_edge(r.control);
  const Vector3 chord = r.control.back() - start;
  r.x = tangent / norm(tangent);
  r.y = beside(r.x, chord);
  EnergyConditions& c = r.conditions;
  c.tangent = {norm(tangent), 0};
  c.chord = {dot(chord, r.x), dot(chord, r.y)};
  c.degree = std::max<int>(static_cast<int>(r.control.size()) - 1, 2);
  c.end_tolerance = options.end_tolerance.value_or(0.01 * norm(c.chord));
  c.alpha = options.alpha.value_or(core::Interval{0, options.alpha_max});
  c.s = options.s;
  const bool falls = options.direction == Direction::as_given && shrinks(r.control);
  c.branch = options.branch.value_or(falls ? Branch::falling : Branch::growing);
  return r;
}

}  // namespace keyline::classa::detail
