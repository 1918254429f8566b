#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/analysis/analyze.h"
#include "keyline/analysis/comb_figures.h"
#include "keyline/operations/reading.h"
#include "keyline/operations/subject.h"
#include "keyline/operations/verdict.h"

/// What is said of a curve: the operation curve.analyze.
namespace keyline::operations {

struct AnalyzeRequest {
  Subject subject;
  int plot_samples = 401;
  std::uint64_t seed = 1;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&AnalyzeRequest::subject>(),
        core::field<&AnalyzeRequest::plot_samples>("points of the curvature plot")
            .within(core::from_to(2, 1'000'000)),
        core::field<&AnalyzeRequest::seed>("of the knots of the spline through points"));
  }
};

enum class EventKind { maximum, minimum };
constexpr auto choices(const EventKind*) {
  return core::words<EventKind>({{EventKind::maximum, "maximum"}, {EventKind::minimum, "minimum"}});
}

struct Event {
  double t = 0;
  double arc_length = 0;
  std::optional<double> curvature;
  std::optional<EventKind> kind;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Event::t>("parameter"),
        core::field<&Event::arc_length>("from the start").in("length"),
        core::field<&Event::curvature>("there; null at a cusp").in("1/length").null_if_empty(),
        core::field<&Event::kind>("of an extremum"));
  }
};

struct LcgGraph {
  std::optional<double> slope;
  std::optional<double> intercept;
  std::optional<double> variance;
  std::vector<std::array<double, 2>> points;
  static constexpr auto describe() {
    return core::fields(
        core::field<&LcgGraph::slope>("alpha; null where the radius does not change")
            .null_if_empty(),
        core::field<&LcgGraph::intercept>("height at log rho = 0").null_if_empty(),
        core::field<&LcgGraph::variance>("mean square of the vertical residuals").null_if_empty(),
        core::field<&LcgGraph::points>("[log rho, log(rho ds/drho)]"));
  }
};

struct LddcBarShown {
  double low = 0;
  int count = 0;
  double height = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&LddcBarShown::low>("where its interval begins"),
                        core::field<&LddcBarShown::count>("points in it"),
                        core::field<&LddcBarShown::height>("logarithm of their share"));
  }
};

struct LddcGraph {
  std::vector<LddcBarShown> bars;
  std::vector<std::array<double, 2>> c_curve;
  std::optional<double> gradient;
  std::size_t noise_tops = 0;
  std::optional<std::array<double, 2>> a;
  std::optional<std::array<double, 2>> b;
  std::optional<double> distance_ab;
  static constexpr auto describe() {
    return core::fields(
        core::field<&LddcGraph::bars>("that are not empty"),
        core::field<&LddcGraph::c_curve>("tops that are not noise"),
        core::field<&LddcGraph::gradient>("of the line through them; null for fewer than three")
            .null_if_empty(),
        core::field<&LddcGraph::noise_tops>("tops that are"),
        core::field<&LddcGraph::a>("end at the smallest radius"),
        core::field<&LddcGraph::b>("end at the largest"),
        core::field<&LddcGraph::distance_ab>("the paper's index of volume"));
  }
};

struct AnalyzedPiece {
  core::Interval interval;
  core::Interval arc_length;
  std::array<std::optional<double>, 2> curvature{};
  double length = 0;
  double volume = 0;
  analysis::Rhythm rhythm = analysis::Rhythm::straight;
  std::vector<double> slopes;
  std::string impression;
  LcgGraph lcg;
  LddcGraph lddc;
  std::vector<Reading> interpretations;
  static constexpr auto describe() {
    using Piece = AnalyzedPiece;
    return core::fields(
        core::field<&Piece::interval>("of the parameter"),
        core::field<&Piece::arc_length>("from the start").in("length"),
        core::field<&Piece::curvature>("at both ends; null at a cusp").in("1/length"),
        core::field<&Piece::length>("of the piece").in("length"),
        core::field<&Piece::volume>("area over its chord").in("length^2"),
        core::field<&Piece::rhythm>("what it reads as"),
        core::field<&Piece::slopes>("along growing radius"),
        core::field<&Piece::impression>("what it says, in [Fairing]'s words"),
        core::field<&Piece::lcg>("logarithmic curvature graph"),
        core::field<&Piece::lddc>("logarithmic distribution diagram of curvature"),
        core::field<&Piece::interpretations>("ways to read it, best first"));
  }
};

struct CurvatureSummary {
  std::optional<double> min;
  std::optional<double> max;
  std::vector<std::array<double, 2>> plot;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CurvatureSummary::min>("least; null where it has no bound, at a cusp")
            .in("1/length")
            .null_if_empty(),
        core::field<&CurvatureSummary::max>("largest; null where it has no bound, at a cusp")
            .in("1/length")
            .null_if_empty(),
        core::field<&CurvatureSummary::plot>("[arc length, curvature]; cusps left out"));
  }
};

struct MergedWaveShown {
  core::Interval interval;
  double displacement = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&MergedWaveShown::interval>("of the parameter"),
        core::field<&MergedWaveShown::displacement>("sideways movement it amounts to")
            .in("length"));
  }
};

struct AnalyzeAnswer {
  double length = 0;
  double volume = 0;
  CurvatureSummary curvature;
  std::vector<Event> inflections;
  std::vector<Event> extrema;
  std::vector<Event> corners;
  std::vector<MergedWaveShown> merged;
  double threshold = 0;
  std::vector<AnalyzedPiece> pieces;
  Verdict monotone = Verdict::undecided;
  std::optional<double> witness;
  analysis::CombFigures comb;
  std::optional<double> noise;
  std::optional<document::Path> spline;
  std::vector<std::string> unused;

  analysis::CurveAnalysis analysis;  ///< not part of the public form, like `path`: for pictures
  document::Path path;

  static constexpr auto describe() {
    using Answer = AnalyzeAnswer;
    return core::fields(
        core::field<&Answer::length>("of the curve").in("length"),
        core::field<&Answer::volume>("area over its chord").in("length^2"),
        core::field<&Answer::curvature>("signed, positive turning left"),
        core::field<&Answer::inflections>("where curvature changes sign"),
        core::field<&Answer::extrema>("of curvature"),
        core::field<&Answer::corners>("where the direction jumps"),
        core::field<&Answer::merged>("waves taken for noise"),
        core::field<&Answer::threshold>("movement below which a wave was merged").in("length"),
        core::field<&Answer::pieces>("of monotone curvature, in order"),
        core::field<&Answer::monotone>("whether curvature is along the whole, certified"),
        core::field<&Answer::witness>("a parameter where it is not, or not certainly"),
        core::field<&Answer::comb>("its comb in figures; energy is the variation"),
        core::field<&Answer::noise>("of points: their standard deviation").in("length"),
        core::field<&Answer::spline>(
            "of points: the splines through them, one between two corners, which were analysed"),
        core::field<&Answer::unused>(kUnusedText));
  }
};

AnalyzeAnswer analyze_answer(analysis::CurveAnalysis analysis);

/// Steps 3 and 4 of [Fairing] for any curve, with monotone curvature certified where the curve's
/// type allows it. Pieces are those of the curve's split; noise is the standard deviation of the
/// curve's positions, in its unit.
core::Result<analysis::CurveAnalysis> analyze_path(const document::Path& path, double noise = 0,
                                                   int plot_samples = 401,
                                                   const core::Progress& progress = {});

/// Whether curvature is monotone, by the certificate of the curve's own type; undecided where there
/// is none (paths of several curves, polylines).
analysis::MonotoneAnswer certified_monotone(const document::Path& path);

}  // namespace keyline::operations
