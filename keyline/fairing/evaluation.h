#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"
#include "keyline/fairing/riccati.h"
#include "keyline/lac/segment/sensitivity.h"

namespace keyline::fairing::detail {

/// Positions of a stage's seven variables.
inline constexpr int kX = 0;
inline constexpr int kY = 1;
inline constexpr int kDirection = 2;
inline constexpr int kCurvature = 3;
inline constexpr int kLengthAt = 4;
inline constexpr int kAlphaAt = 5;
inline constexpr int kNextCurvature = 6;

/// The quadratic model of the fit about a chain, and what the chain reaches.
struct Model {
  std::vector<Stage> stages;
  double cost = 0;
  double merit = 0;  ///< cost and gaps together
  double max_offset = 0;
  double max_gap = 0;
};

/// A chain evaluated once: tables of its pieces. The chain's feet may be moved; nothing else of it
/// may change meanwhile.
class Evaluation {
 public:
  Evaluation(FitChain& chain, const std::vector<FitPoint>& points, const ChainFitOptions& options);

  Model model();

  /// One Newton step of every foot along the chain. Feet of points pinned to an end stay there.
  void move_feet();
  /// The same of one; returns how much of a piece it moved.
  double move_foot(std::size_t j);

  double offset(std::size_t j) const;

  /// How far the place of a point's foot lies from the point, across and along the chain, and both
  /// by the seven variables of the foot's stage.
  struct PointRow {
    int piece = 0;
    double across = 0;  ///< positive where the chain passes left of the point
    double along = 0;
    Vector7 by_across;
    Vector7 by_along;
  };
  PointRow row(std::size_t j) const;

 private:
  struct Frame {
    double c;
    double s;
  };
  /// A point's foot: place, tangent and normal there, and the table's local values.
  struct Stand {
    Frame frame;
    lac::PieceTable::Value value;
    core::Point2 at;
    core::Vector2 tangent;
  };

  bool beyond_end(const Foot& foot) const;
  bool pinned(std::size_t j) const;
  core::Point2 place(int piece, Frame f, double x, double y) const;
  Stand stand(const Foot& foot) const;
  Vector7 derivative(const Foot& foot, const Stand& s, core::Vector2 along) const;
  void add_dynamics(Model& m, int i);
  void fix_controls(Stage& stage, int i) const;
  void add_residual(Model& m, int i, double r, const Vector7& d, double weight);
  void add_point(Model& m, std::size_t j);
  void add_prior(Model& m, int i);
  void add_seam(Model& m);
  void keep_still(Model& m) const;

  FitChain& chain_;
  const std::vector<FitPoint>& points_;
  const ChainFitOptions& options_;
  std::vector<lac::PieceTable> tables_;
  std::vector<Frame> frames_;  ///< of the pieces' starts
  double gap_square_ = 0;
};

}  // namespace keyline::fairing::detail
