#pragma once

#include <array>
#include <optional>
#include <vector>

#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi_forms.h"

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

  /// Every solution found, each once: of polygons in the one unknown that is left, of the Taylor
  /// forms by the paper's scan for Lambda ([QLAC] §4) in both unknowns, thorough where nothing is
  /// found otherwise (100 ms).
  std::vector<Unknowns> scan(bool thorough);

  int iterations = 0;  ///< of the last solve

 private:
  /// Radii up to e^25 apart, turnings from a fifth of the wanted one to the largest there is.
  struct Grid {
    static constexpr int kRatios = 51, kTurnings = 31;
    std::vector<std::optional<Miss>> at;
    const std::optional<Miss>& operator()(int i, int j) const { return at[i * kTurnings + j]; }
  };
  /// Places low to high in both unknowns.
  struct Cell {
    Unknowns low, high;
    Unknowns at(double x, double y) const;
    std::array<Cell, 4> quarters() const;
  };

  std::optional<Miss> at(const Unknowns& x) const;
  EndEdges end_edges(const UnitPiece& unit) const;
  std::optional<Unknowns> newton_step(const Unknowns& x, const Miss& miss) const;

  std::vector<Unknowns> polygons() const;
  Unknowns between(double low, double high, double off) const;
  Unknowns turning_rightly(double log_ratio) const;

  Unknowns grid_place(int ratio, int turning) const;
  Grid missed() const;
  std::vector<Unknowns> places_of_least_miss(const Grid& grid) const;
  bool straddles(const Cell& cell, bool leaping) const;
  void quarter(const Cell& cell, int depth, std::vector<Unknowns>& starts) const;
  std::vector<Unknowns> where_signs_change() const;
  void solve_from(const std::vector<Unknowns>& starts, std::vector<Unknowns>& found);

  double turning_, chord_angle_, alpha_;
  QuasiOptions options_;
};

}  // namespace keyline::lac::detail
