#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/verdict.h"

/// Request and answer of the operation curve.edit_pieces, in the plane and in space.
namespace keyline::operations {

inline constexpr int kLowestPieceDegree = 3;
inline constexpr int kHighestPieceDegree = 8;  ///< as of the approximation by one Bezier

/// Of the chord, first and last control edge of a target: at coordinates of a thousand chords
/// rounding still leaves their direction to 2e-9, far below what a joint shows.
inline constexpr double kLeastEdge = 1e-4;

struct PiecesRequest {
  AnyCurve curve;
  double amount = 1;
  std::optional<double> limit;
  double alpha_max = classa::kDefaultAlphaMax;
  std::optional<double> fit_tolerance;
  static constexpr auto describe() {
    using Request = PiecesRequest;
    return core::fields(
        core::field<&Request::curve>("any curve or path, closed or with corners; in space what is "
                                     "polynomial or log-aesthetic")
            .needed(),
        core::field<&Request::amount>("0 the given curve to 1 the target")
            .within(core::from_to(0, 1)),
        core::field<&Request::limit>("largest departure of a piece; those farther off stay")
            .in("length")
            .within(core::at_least(0)),
        core::field<&Request::alpha_max>("largest rotation, of Tab. 2 and of the plane")
            .in("radian")
            .within(core::between(0, core::kPi / 2)),
        core::field<&Request::fit_tolerance>(
            "of pieces for what is no polynomial bezier; 0.001 of the size unless given")
            .in("length")
            .within(core::kPositive));
  }
};

enum class Became { edited, straight, kept };
constexpr auto choices(const Became*) {
  return core::words<Became>(
      {{Became::edited, "edited"}, {Became::straight, "straight"}, {Became::kept, "kept"}});
}

struct PieceValue {
  std::optional<int> type;
  std::optional<double> cav;
  std::optional<Verdict> monotone;
  static constexpr auto describe() {
    return core::fields(
        core::field<&PieceValue::type>("1 at the minimum to 5 none; null where it has no value")
            .null_if_empty(),
        core::field<&PieceValue::cav>("curve aesthetic value").null_if_empty(),
        core::field<&PieceValue::monotone>("in space: whether curvature is, certified"));
  }
};

struct EditedPiece {
  Became became = Became::kept;
  int degree = 0;
  PieceValue before;
  PieceValue after;
  double departure = 0;
  std::optional<std::string> why;
  static constexpr auto describe() {
    using Piece = EditedPiece;
    return core::fields(core::field<&Piece::became>("of the piece"),
                        core::field<&Piece::degree>("of the Bezier it is now"),
                        core::field<&Piece::before>("as given"), core::field<&Piece::after>("now"),
                        core::field<&Piece::departure>("from the given piece").in("length"),
                        core::field<&Piece::why>("it was kept"));
  }
};

/// Joints of an order or more.
struct JointCount {
  std::size_t g0 = 0;
  std::size_t g1 = 0;
  std::size_t g2 = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&JointCount::g0>("that meet"),
                        core::field<&JointCount::g1>("with one direction"),
                        core::field<&JointCount::g2>("with one curvature"));
  }
};

struct PiecesAnswer {
  MadeCurve curve;
  std::vector<EditedPiece> pieces;
  std::size_t edited = 0;
  double cav_before = 0;
  double cav_after = 0;
  double approximated = 0;
  double departure = 0;
  JointCount joints_before;
  JointCount joints_after;
  static constexpr auto describe() {
    using Answer = PiecesAnswer;
    return core::fields(core::flattened<&Answer::curve>(),
                        core::field<&Answer::pieces>("in order along the curve"),
                        core::field<&Answer::edited>("pieces that were"),
                        core::field<&Answer::cav_before>("sum over the pieces that have a value"),
                        core::field<&Answer::cav_after>("the same, now"),
                        core::field<&Answer::approximated>(
                            "how far the pieces lay from the given curve at most, where that is "
                            "no row of polynomial Beziers")
                            .in("length"),
                        core::field<&Answer::departure>(
                            "from the given curve at most: that, and the largest of the pieces")
                            .in("length"),
                        core::field<&Answer::joints_before>("between the pieces, as given"),
                        core::field<&Answer::joints_after>("now"));
  }
};

/// The sums and the largest departure of all pieces.
void add(PiecesAnswer& answer, EditedPiece piece);

/// Of Beziers in space end to end.
core::Result<PiecesAnswer> edit_pieces_in_space(const PiecesRequest& request);

}  // namespace keyline::operations
