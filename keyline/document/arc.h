#pragma once

#include <optional>

#include "keyline/document/planar_curve.h"

namespace keyline::document {

/// A circular arc: from `start` (radians, seen from the centre) on by `turn`, counter-clockwise
/// where positive; |turn| <= 2 pi.
struct Arc {
  core::Point2 center;
  double radius = 0;
  double start = 0;
  double turn = 0;
};

/// The circle a curve runs on: a log-aesthetic piece of constant curvature, or a rational quadratic
/// with handles and weight of an arc to within 1e-12. Empty for everything else, straight lines
/// included.
std::optional<Arc> as_arc(const lac::Segment& segment);
std::optional<Arc> as_arc(const curve::Bezier2& c);

/// True for a curve all of whose points lie on the straight line between its ends, in order:
/// Bézier of degree 1, straight log-aesthetic piece.
bool is_line(const lac::Segment& segment);
bool is_line(const curve::Bezier2& c);

/// One log-aesthetic piece.
lac::Chain chain_of(const Arc& arc);

/// Neighbouring arcs of one circle as a single one; empty where they are not, or where the second
/// does not go on from the end of the first.
std::optional<Arc> joined(const Arc& first, const Arc& second);

core::Point2 point_on(const Arc& arc, double angle);

}  // namespace keyline::document
