#include "keyline/curve/conversion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/core/polygon.h"

namespace keyline::curve {

using core::ErrorCode;
using core::fail;

namespace {

template <class P>
core::Result<void> validate_path(const std::vector<Bezier<P>>& path, double tolerance) {
  if (path.empty()) return fail(ErrorCode::bad_input, "the path has no piece", "", "pieces");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string where = "pieces[" + std::to_string(i) + "]";
    if (auto ok = validate(path[i]); !ok) {
      ok.error().path = where + "." + ok.error().path;
      return ok;
    }
    if (i > 0 && !(distance(path[i - 1].control.back(), path[i].control.front()) <= tolerance))
      return fail(ErrorCode::bad_input, "the piece does not start where the one before ends",
                  "close the gap or convert the parts separately", where);
  }
  return {};
}

/// The piece at the given degree, with weights starting at `weight` if rational.
template <class P>
Bezier<P> matched(Bezier<P> piece, int degree_wanted, bool rational, double weight) {
  if (rational && piece.weights.empty()) piece.weights.assign(piece.control.size(), 1.0);
  piece = elevate_degree(piece, degree_wanted - degree(piece));
  if (rational) {
    const double factor = weight / piece.weights.front();
    for (double& w : piece.weights) w *= factor;
  }
  return piece;
}

}  // namespace

template <class P>
core::Result<BSpline<P>> to_bspline(const std::vector<Bezier<P>>& path, double tolerance) {
  if (auto ok = validate_path(path, tolerance); !ok) return std::unexpected(ok.error());
  BSpline<P> c;
  c.degree = 1;
  bool rational = false;
  double total = 0;
  for (const Bezier<P>& piece : path) {
    c.degree = std::max(c.degree, degree(piece));
    rational = rational || is_rational(piece);
    total += core::polygon_length(piece.control);
  }
  double knot = 0;
  c.knots.assign(c.degree + 1, knot);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double weight = c.weights.empty() ? 1.0 : c.weights.back();
    const Bezier<P> piece = matched(path[i], c.degree, rational, weight);
    const int skip = i > 0 ? 1 : 0;
    c.control.insert(c.control.end(), piece.control.begin() + skip, piece.control.end());
    if (rational)
      c.weights.insert(c.weights.end(), piece.weights.begin() + skip, piece.weights.end());
    const double share = total > 0 ? core::polygon_length(path[i].control) / total : 0;
    knot += std::max(share, 1e-6);
    c.knots.insert(c.knots.end(), c.degree, knot);
  }
  c.knots.push_back(knot);
  return c;
}

template <class P>
core::Result<BSpline<P>> to_bspline(const Polyline<P>& c) {
  if (auto ok = validate(c); !ok) return std::unexpected(ok.error());
  BSpline<P> r{1, {0, 0}, {c.points.front()}, {}};
  for (const P& p : c.points) {
    const double knot = r.knots.back() + distance(r.control.back(), p);
    if (!(knot > r.knots.back())) continue;
    r.control.push_back(p);
    r.knots.push_back(knot);
  }
  r.knots.push_back(r.knots.back());
  if (r.control.size() < 2)
    return fail(ErrorCode::bad_input, "all points of the polyline are equal", "", "points");
  return r;
}

template core::Result<BSpline2> to_bspline(const std::vector<Bezier2>&, double);
template core::Result<BSpline3> to_bspline(const std::vector<Bezier3>&, double);
template core::Result<BSpline2> to_bspline(const Polyline2&);
template core::Result<BSpline3> to_bspline(const Polyline3&);

}  // namespace keyline::curve
