#pragma once

#include <array>
#include <vector>

#include "keyline/lac/segment/piece_curvature.h"

namespace keyline::lac {

/// What a piece's geometry depends on, in the order of the derivative arrays below.
inline constexpr int kCurvatureStart = 0;
inline constexpr int kCurvatureEnd = 1;
inline constexpr int kLength = 2;
inline constexpr int kAlpha = 3;
inline constexpr int kPieceVariables = 4;

/// A log-aesthetic piece as a table: local point and tangent angle at any fraction of its length,
/// with derivatives by the four variables. The frame is the piece's own start (origin, x axis
/// along the tangent). Built once, read at many fractions; this is what fitting a chain needs.
///
/// Accuracy: positions and angle to about 1e-11 of the length if built `fine`, for slopes from -3
///           and turning below 3 rad; without, 1e-7 where the curvatures' ratio is below 7, and
///           1e-6 with an inflection at an end or inside. There derivatives hold to 4e-4 (at slope
///           -3, less at -2), fine or not; elsewhere to 1e-6.
/// Source:   [QLAC] Eqs. 2-4: curvature is the power mean of exponent -alpha in arc
///           length; derivatives by differentiation under the integral.
class PieceTable {
 public:
  struct Place {
    double x = 0;
    double y = 0;
    double angle = 0;
  };
  struct Value {
    double x = 0;
    double y = 0;
    double angle = 0;
    std::array<double, kPieceVariables> dx{};
    std::array<double, kPieceVariables> dy{};
  };
  struct End : Value {
    std::array<double, kPieceVariables> dangle{};
  };

  /// curvatures finite; length > 0; alpha finite; alpha < 0 where the curvatures differ in sign
  /// or one of them is zero (not checked: the caller keeps to it).
  /// fine: more panels where curvature changes fast, for the last digits.
  void build(double curvature_start, double curvature_end, double length, double alpha,
             bool fine = false);

  /// v in [0, 1], the fraction of the length.
  Value at(double v) const;
  Place place(double v) const;
  const End& end() const { return end_; }
  double curvature(double v) const { return bend_.curvature(v); }
  double length() const { return length_; }

 private:
  static constexpr int kNodes = 17;
  static constexpr int kColumns = 11;  // x, y, angle, dx[4], dy[4]
  struct Panel {
    double from = 0;
    double to = 1;
    int graded = 0;  // 0 evenly, -1 towards `from`, +1 towards `to`
    std::array<std::array<double, kColumns>, kNodes> node{};
  };
  struct Running;
  struct Turns;
  void plan_panels();
  void add_even_panels(int parts, int grade);
  void plan_around_zero(bool rough);
  void plan_without_zero(bool rough);
  void add_geometric_panels(double from, double to, double least, int grade);
  Turns turns_of(const Panel& panel, const End& at) const;
  void fill(Panel& panel, Running& running) const;
  template <int count>
  std::array<double, count> columns_at(double v) const;

  double curvature_start_ = 0;
  double curvature_end_ = 0;
  double length_ = 1;
  double alpha_ = -1;
  PieceCurvature bend_;
  bool fine_ = false;
  double zero_ = -1;  // fraction where curvature vanishes inside, or -1
  std::vector<Panel> panels_;
  End end_;
};

}  // namespace keyline::lac
