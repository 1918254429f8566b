#pragma once

#include <optional>
#include <vector>

#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/lac/quasi/quasi_places.h"

/// Internals: which piece's curve, drawn in a given form, meets three handles.
namespace keyline::lac::detail {

/// The two unknowns: ln(rho1 / rho0) and the turning of the piece.
struct Unknowns {
  double log_ratio = 0;
  double turning = 0;
};
UnitPiece piece_from(double alpha, const Unknowns& x);

/// How far a Bézier misses the wanted turning and chord angle.
struct Miss {
  double turning = 0;
  double chord_angle = 0;
  double size() const;
};

class HandleSearch {
 public:
  /// Settled options of a Taylor or discretised form.
  HandleSearch(const HandleAngles& angles, double alpha, const QuasiOptions& options);

  /// Newton's method with steps halved until they help.
  bool solve(Unknowns& x);

  /// Every solution, each once, unless it is cut short: of polygons in the one unknown that is
  /// left, of the Taylor forms in both (series_places), of pieces that turn by less than a whole
  /// turn.
  std::vector<Unknowns> all();

  int iterations = 0;      ///< of the last solve
  bool cut_short = false;  ///< all() may have missed some

 private:
  std::optional<Miss> at(const Unknowns& x) const;
  SeriesVariable variable() const;
  EndEdges end_edges(const UnitPiece& unit) const;
  std::optional<Unknowns> newton_step(const Unknowns& x, const Miss& miss) const;

  std::vector<Unknowns> polygons() const;
  Unknowns between(double low, double high, double off) const;
  Unknowns turning_rightly(double log_ratio) const;

  std::vector<Unknowns> series();
  Unknowns unknowns_of(const SeriesPlace& place) const;

  double turning_, chord_angle_, alpha_;
  QuasiOptions options_;
};

}  // namespace keyline::lac::detail
