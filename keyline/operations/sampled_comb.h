#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/analysis/comb_figures.h"
#include "keyline/core/describe.h"
#include "keyline/document/planar_curve.h"

/// A planar curve as an eye needs it: places along it with everything a comb, an evolute and the
/// linked graphs of curvature are drawn from, so that who draws works out nothing.
namespace keyline::operations {

struct CombForm {
  int samples = 201;
  bool graphs = true;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CombForm::samples>("places along the whole, more where it has many pieces")
            .within(core::from_to(2, 100'000)),
        core::field<&CombForm::graphs>("also evolute, logarithmic graphs, extrema and measures"));
  }
};

enum class CombEventKind { maximum, minimum, inflection, corner };
constexpr auto choices(const CombEventKind*) {
  return core::words<CombEventKind>({{CombEventKind::maximum, "maximum"},
                                     {CombEventKind::minimum, "minimum"},
                                     {CombEventKind::inflection, "inflection"},
                                     {CombEventKind::corner, "corner"}});
}

struct CombEvent {
  CombEventKind kind = CombEventKind::maximum;
  double arc_length = 0;
  std::optional<double> curvature;
  core::Point2 point;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CombEvent::kind>("of curvature, or a corner"),
        core::field<&CombEvent::arc_length>("from the start").in("length"),
        core::field<&CombEvent::curvature>("there; null at a cusp").in("1/length").null_if_empty(),
        core::field<&CombEvent::point>("where it is"));
  }
};

/// Of the samples that have a finite place in logarithmic graphs, in order.
struct CombGraphs {
  std::vector<int> samples;
  std::vector<std::array<double, 2>> lcg;
  std::vector<std::array<double, 2>> centers;
  std::vector<int> bars;
  std::vector<std::array<double, 2>> lddc;
  std::optional<double> lddc_gradient;
  std::vector<CombEvent> events;
  analysis::CombFigures figures;
  double bending = 0;
  static constexpr auto describe() {
    using Graphs = CombGraphs;
    return core::fields(
        core::field<&Graphs::samples>("those that are neither straight nor of constant radius"),
        core::field<&Graphs::lcg>("[log rho, log(rho ds/drho)] of each of them"),
        core::field<&Graphs::centers>("centre of curvature of each of them: the evolute"),
        core::field<&Graphs::bars>("the item of lddc each of them counts in; -1: none"),
        core::field<&Graphs::lddc>("tops of the distribution diagram of curvature"),
        core::field<&Graphs::lddc_gradient>("of the line through those that are not noise")
            .null_if_empty(),
        core::field<&Graphs::events>("extrema, inflections and corners, in order"),
        core::flattened<&Graphs::figures>(),
        core::field<&Graphs::bending>(
            "length times the integral of the squared curvature; null where it has no bound")
            .null_if_empty());
  }
};

struct SampledComb {
  double length = 0;
  std::vector<core::Point2> points;
  std::vector<core::Point2> normals;
  std::vector<double> arc_length;
  std::vector<double> curvature;
  std::vector<int> joints;
  std::optional<CombGraphs> graphs;
  static constexpr auto describe() {
    using Sampled = SampledComb;
    return core::fields(
        core::field<&Sampled::length>("of the whole").in("length"),
        core::field<&Sampled::points>("along the curve; where pieces meet there are two"),
        core::field<&Sampled::normals>("unit vectors to the left of travel"),
        core::field<&Sampled::arc_length>("from the start").in("length"),
        core::field<&Sampled::curvature>(
            "signed, positive turning left; at a cusp, where it is infinite, that of the nearest "
            "sample")
            .in("1/length"),
        core::field<&Sampled::joints>("samples at which a piece begins"),
        core::field<&Sampled::graphs>("where asked for"));
  }
};

/// Samples evenly spaced in arc length within every piece, both of its ends among them, at least
/// 24 to a piece. Polylines: their vertices, without curvature.
/// Fails: bad_input for a curve without length or whose numbers are not finite.
core::Result<SampledComb> sampled_comb(const document::Path& path, const CombForm& form);

/// The whole comb in figures, of 0 where the curve has no length; energy and jolt infinite where
/// curvature is.
analysis::CombFigures comb_figures_of(const document::Path& path);

}  // namespace keyline::operations
