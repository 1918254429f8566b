#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "keyline/analysis/lcg.h"
#include "keyline/analysis/lddc.h"
#include "keyline/analysis/rhythm.h"
#include "keyline/analysis/split.h"
#include "keyline/core/progress.h"

namespace keyline::analysis {

/// Whether signed curvature is monotone along the whole curve; for `no`, a parameter where it is
/// not. Only a certificate (curve/monotone.h) may answer `yes`.
struct MonotoneAnswer {
  enum class Value { yes, no, undecided };
  Value value = Value::undecided;
  double witness = 0;
};

struct AnalyzeOptions {
  /// Standard deviation of the curve's positions, in its unit; overrides split.noise and
  /// rhythm.noise where it is larger.
  double noise = 0;
  SplitOptions split;
  RhythmOptions rhythm;
  /// Ends within this share of the length are one place, whose events are told too.
  std::optional<double> one_end;
  int plot_samples = 401;   ///< of the curvature plot, at least 2
  int piece_samples = 201;  ///< points of each logarithmic curvature graph, at least 3
  /// Certifies monotone curvature where the curve's type allows it; without it the answer is `no`
  /// where an extremum was found, else `undecided`.
  std::function<MonotoneAnswer()> certify;
  core::Progress progress;  ///< told and asked before every piece
  int threads = 0;          ///< at work on pieces (0: all of the machine's); all give the same
};

struct CurvaturePlotPoint {
  double t = 0;
  double arc_length = 0;
  double curvature = 0;
};

/// One piece of monotone curvature and all that is said of it.
struct PieceAnalysis {
  MonotonePiece extent;
  double length = 0;
  double volume = 0;
  Lcg lcg;
  Lddc lddc;
  Rhythm rhythm = Rhythm::straight;
  std::vector<double> slopes;  ///< of the best interpretation, along growing radius
  std::string impression;
  std::vector<Interpretation> interpretations;  ///< best first
};

/// All that operation curve.analyze tells of a planar curve.
struct CurveAnalysis {
  double length = 0;
  double volume = 0;
  double curvature_min = 0;
  double curvature_max = 0;
  std::vector<CurvaturePlotPoint> plot;
  Split split;  ///< its pieces are those of `pieces`; with the events of a seam
  std::vector<PieceAnalysis> pieces;
  MonotoneAnswer monotone;
};

/// Measures, splits and reads a curve. Fails with bad_input where the curve has no length or gives
/// numbers that are not finite, with cancelled where that was asked for.
core::Result<CurveAnalysis> analyze(const CurveView& curve, const AnalyzeOptions& options = {});

template <curve::PlanarCurve C>
core::Result<CurveAnalysis> analyze(const C& c, const AnalyzeOptions& options = {}) {
  return analyze(view(c), options);
}

}  // namespace keyline::analysis
