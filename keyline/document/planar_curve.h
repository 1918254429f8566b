#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/jet.h"
#include "keyline/curve/polyline.h"
#include "keyline/curve/shares.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::document {

/// Any one planar curve of the public interface. Models curve::PlanarCurve.
struct PlanarCurve {
  std::variant<curve::Polyline2, curve::Bezier2, curve::BSpline2, lac::Chain> value;
};

/// Curves end to end; corners lie between its members. Models curve::PlanarCurve: the parameter
/// gives every member an equal share of [0, 1].
struct Path {
  std::vector<PlanarCurve> curves;
  bool closed = false;
};

core::Point2 evaluate(const PlanarCurve& c, double t);
curve::Jet2 jet(const PlanarCurve& c, double t);
std::vector<double> breakpoints(const PlanarCurve& c);
PlanarCurve reverse(const PlanarCurve& c);
PlanarCurve transform(const PlanarCurve& c, const core::Similarity2& map);
/// Finite numbers, knots in order, lengths positive…: what each type states of itself.
core::Result<void> validate(const PlanarCurve& c);

core::Point2 evaluate(const Path& path, double t);
curve::Jet2 jet(const Path& path, double t);
std::vector<double> breakpoints(const Path& path);
Path reverse(const Path& path);
Path transform(const Path& path, const core::Similarity2& map);
/// Not empty, members valid.
core::Result<void> validate(const Path& path);

/// A curve that, where it is a chain, has its pieces in their places. Refers to the curve, which
/// must outlive it. Models curve::PlanarCurve.
class PlacedCurve {
 public:
  /// Precondition: the curve is valid.
  explicit PlacedCurve(const PlanarCurve& curve);

  const PlanarCurve& curve() const { return *curve_; }
  const std::optional<lac::PlacedChain>& chain() const { return chain_; }

 private:
  const PlanarCurve* curve_;
  std::optional<lac::PlacedChain> chain_;
};

core::Point2 evaluate(const PlacedCurve& placed, double t);
curve::Jet2 jet(const PlacedCurve& placed, double t);
inline std::vector<double> breakpoints(const PlacedCurve& placed) {
  return breakpoints(placed.curve());
}
/// What curve::PlanarView looks at in the curve's stead.
inline PlacedCurve prepared(const PlanarCurve& curve) { return PlacedCurve(curve); }

/// A path whose members are placed so. Refers to the path, which must outlive it. Models
/// curve::PlanarCurve.
class PlacedPath {
 public:
  /// Precondition: the path is valid.
  explicit PlacedPath(const Path& path);

  const Path& path() const { return *path_; }
  const std::vector<PlacedCurve>& members() const { return members_; }
  const std::vector<double>& breakpoints() const { return breaks_; }
  /// The member at t and its own parameter; what is before a breakpoint, by however little, is
  /// before the member's, too.
  curve::Share locate(double t) const;

 private:
  /// Of a member between two of its breakpoints.
  struct Stretch {
    std::size_t member;
    double from, to;
  };
  const Path* path_;
  std::vector<PlacedCurve> members_;
  std::vector<double> breaks_;
  std::vector<Stretch> stretches_;
};

core::Point2 evaluate(const PlacedPath& placed, double t);
curve::Jet2 jet(const PlacedPath& placed, double t);
inline std::vector<double> breakpoints(const PlacedPath& placed) { return placed.breakpoints(); }
/// What curve::PlanarView looks at in the path's stead.
inline PlacedPath prepared(const Path& path) { return PlacedPath(path); }

}  // namespace keyline::document
