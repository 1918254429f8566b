#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/fairing/fair.h"
#include "keyline/operations/joint.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/operation.h"
#include "keyline/operations/reading.h"
#include "keyline/operations/subject.h"

/// The main job as an operation: `fair`.
namespace keyline::operations {

struct FairRequest {
  Subject subject;
  fairing::FairOptions options;
  static constexpr auto describe() {
    return core::fields(core::flattened<&FairRequest::subject>(),
                        core::flattened<&FairRequest::options>());
  }
};

struct FairedPiece {
  fairing::FairPiece piece;
  std::string impression;
  std::vector<Reading> interpretations;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&FairedPiece::piece>(),
        core::field<&FairedPiece::impression>("what it says, in [Fairing]'s words"),
        core::field<&FairedPiece::interpretations>("ways to read the points there, best first"));
  }
};

/// A piece of monotone curvature of the spline through the points.
struct SplinePiece {
  int spline = 0;
  core::Interval interval;
  core::Interval arc_length;
  std::array<double, 2> curvature{};
  static constexpr auto describe() {
    return core::fields(core::field<&SplinePiece::spline>("which spline, from 0"),
                        core::field<&SplinePiece::interval>("of its parameter"),
                        core::field<&SplinePiece::arc_length>("of its length").in("length"),
                        core::field<&SplinePiece::curvature>("at both ends").in("1/length"));
  }
};

struct FairDeviation {
  double max = 0;
  double rms = 0;
  std::size_t worst_point = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&FairDeviation::max>("largest distance").in("length"),
                        core::field<&FairDeviation::rms>("root mean square").in("length"),
                        core::field<&FairDeviation::worst_point>("its index, from 0"));
  }
};

struct FairAnswer {
  MadeCurve curve;
  document::Path spline;
  double spline_bic = 0;
  std::vector<SplinePiece> monotone_pieces;
  std::vector<FairedPiece> pieces;
  double length = 0;
  double noise = 0;
  double tolerance = 0;
  FairDeviation deviation;
  bool within_tolerance = false;
  std::optional<double> rate;
  double outside = 0;
  std::optional<fairing::FoundSymmetry> symmetry;
  double smoothness = 0;
  fairing::FairFigures fairness;
  bool cancelled = false;
  fairing::JointRates joints;
  std::vector<Joint> continuity;
  std::vector<std::string> report;
  std::vector<std::string> unused;

  acquire::KeyLine line;       ///< what was faired; not part of the answer's public form
  fairing::FairResult faired;  ///< likewise: for pictures

  static constexpr auto describe() {
    return core::fields(
        core::flattened<&FairAnswer::curve>(),
        core::field<&FairAnswer::spline>("the spline through the points, one per corner's run"),
        core::field<&FairAnswer::spline_bic>("its Bayes information criterion"),
        core::field<&FairAnswer::monotone_pieces>("where its curvature is monotone"),
        core::field<&FairAnswer::pieces>("the log-aesthetic pieces, in order"),
        core::field<&FairAnswer::length>("of the curve").in("length"),
        core::field<&FairAnswer::noise>("standard deviation of the points").in("length"),
        core::field<&FairAnswer::tolerance>("that was kept").in("length"),
        core::field<&FairAnswer::deviation>("of the points from the curve"),
        core::field<&FairAnswer::within_tolerance>("whether every point is"),
        core::field<&FairAnswer::rate>(
            "fastest that curvature changes; none where a piece begins or ends so steeply that it "
            "has no bound")
            .in("1/length^2"),
        core::field<&FairAnswer::outside>("by how much a bound is passed; 0: all are kept")
            .in("length"),
        core::field<&FairAnswer::symmetry>("line in which the points mirror within their noise"),
        core::field<&FairAnswer::smoothness>("that was taken"),
        core::field<&FairAnswer::fairness>("how calm its comb is, beside others'"),
        core::field<&FairAnswer::cancelled>("stopped: the best found until then"),
        core::field<&FairAnswer::joints>(
            "inside the chains, by the rate at which curvature changes: G3, at turns, jumps"),
        core::field<&FairAnswer::continuity>("at the joints, inside chains and between curves"),
        core::field<&FairAnswer::report>("everything dropped, merged or overridden, in words"),
        core::field<&FairAnswer::unused>(kUnusedText));
  }
};

/// The answer as one curve (log-aesthetic) or a path of several.
document::Path fair_curve(const fairing::FairResult& result);

FairAnswer fair_answer(acquire::KeyLine line, fairing::FairResult result);

}  // namespace keyline::operations
