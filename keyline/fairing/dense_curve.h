#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "keyline/fairing/chain_fit.h"
#include "keyline/fairing/piece_energy.h"

/// A curve of log-aesthetic pieces, followed in many cells.
namespace keyline::fairing::detail {

/// Nodes stand at fixed shares `at` of the length, pieces between some of them; curvature is times
/// the length, so that the scale-free energy L^3 * integral of (d curvature / ds)^2 is the sum of
/// the pieces' (see piece_energy) over their shares of the length, whatever the length. A curve
/// that is free has a piece of slope -1 (curvature linear in arc length) for each cell.
struct DenseCurve {
  std::vector<double> at;        ///< 0 … 1, increasing
  std::vector<FitJoint> joints;  ///< as many; a closed curve repeats its first
  std::vector<int> cut;          ///< nodes where pieces meet, the first and the last among them
  std::vector<double> value;     ///< curvature (times length) there
  std::vector<double> alpha;     ///< of the pieces, one fewer
  double length = 1;
  std::vector<Foot> feet;  ///< one per point: cell and fraction
  bool closed = false;
  double turning = 0;  ///< of the whole closed curve
  Hold hold_start = Hold::free;
  Hold hold_end = Hold::free;
  bool slides_start = false;  ///< a held end's x is free
  bool slides_end = false;
  FitJoint held_start;  ///< where a held end is held
  FitJoint held_end;
  /// Pieces that are circular arcs or straight lines; the curvatures of a line's ends stay 0.
  std::vector<PieceKind> kind;  ///< empty: all are curves
  /// Which way curvature may run in each piece: +1 up, -1 down, 0 either. Empty: either everywhere.
  std::vector<signed char> sense;
  /// On which side of zero curvature stays at each of `value`: +1 above, -1 below, 0 either. Empty:
  /// either everywhere.
  std::vector<signed char> side;
  double most_rate = HUGE_VAL;  ///< fastest that curvature may change with arc length
};

/// Curvature of a cell at its start, middle and end, and by the curvatures at its piece's ends.
struct CellShape {
  std::array<double, 3> curvature{};
  std::array<double, 3> by_start{};
  std::array<double, 3> by_end{};
  core::Vector2 tangent;  ///< at its start
};

/// Of all cells; also sets the joints' curvatures.
std::vector<CellShape> shapes_of(DenseCurve& curve);

/// Piece of every cell.
std::vector<int> pieces_of(const DenseCurve& curve);

/// DenseCurve::side of every node, 0 between pieces' ends; empty where the curve has none.
std::vector<signed char> sides_of_nodes(const DenseCurve& curve);

/// The curve with a piece of slope -1 for each of its cells.
void set_free(DenseCurve& curve);

/// The closed curve begun at another node.
DenseCurve begun_at(const DenseCurve& curve, int node);

/// Whether the piece is an arc or a line.
bool flat(const DenseCurve& curve, std::size_t piece);

/// A place in a cell, and how it depends on its piece's end curvatures (times length).
struct CellPlace {
  core::Point2 at;
  double angle = 0;
  core::Vector2 tangent;
  core::Vector2 by_start;
  core::Vector2 by_end;
  double angle_by_start = 0;
  double angle_by_end = 0;
};
CellPlace place_in_cell(const DenseCurve& curve, const CellShape& shape, int cell, double fraction);

CellPlace place_of(const DenseCurve& curve, const std::vector<CellShape>& shapes, const Foot& foot);

/// Signed distance of the point left of the place of its foot, times its share.
double offset_of(const FitPoint& point, const CellPlace& place);

/// Whether the curve wanders off between points: its way from one to the next is far longer than
/// theirs, longer than a half circle.
bool wanders(const DenseCurve& curve, const std::vector<FitPoint>& points, double tolerance);

/// Where a foot stands, as a share of the length.
double place_along(const DenseCurve& curve, const Foot& foot);

/// One Newton step of the foot along the curve.
void move_foot(const DenseCurve& curve, const std::vector<CellShape>& shapes, const FitPoint& point,
               Foot& foot);

/// Share of the variation that a piece has (see piece_energy), none where it is flat.
PieceEnergy energy_of(const DenseCurve& curve, std::size_t piece);

/// Sum over the pieces.
double variation(const DenseCurve& curve);

/// Cells of pieces whose curvature a parabola does not follow are parted, until what they turn is
/// right to 1e-8: what is solved for in cells then closes as pieces too.
void refine_cells(DenseCurve& curve);

/// A first curve along the points: nodes at the points and evenly between them so that there are
/// at least `least` cells; poses and curvatures from local parabolas over `reach` of the length
/// either way.
DenseCurve dense_curve(const std::vector<FitPoint>& points, bool closed, int least);

}  // namespace keyline::fairing::detail
