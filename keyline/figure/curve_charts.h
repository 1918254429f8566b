#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/figure/drawing.h"

namespace keyline::figure {

/// A place of a curve to look at.
struct CurveMark {
  std::size_t sample = 0;
  std::string text = {};  ///< a letter or two
};

/// A curve as figures need it: samples in order along it. All four lists have the same length
/// (InvalidInput otherwise); what is not finite is left out.
struct SampledCurve {
  std::string name = {};
  std::vector<double> arc_length = {};  ///< from the start, in the model's unit
  std::vector<core::Point2> points = {};
  std::vector<double> tangent_angle = {};  ///< radians
  std::vector<double> curvature = {};      ///< signed, positive turning left
  std::vector<std::size_t> joints = {};    ///< samples at which one piece ends and the next starts
  std::vector<std::string> piece_names = {};  ///< written at the pieces; empty: 1, 2, 3 …
  std::vector<CurveMark> marks = {};          ///< ringed in the comb
};

struct ChartOptions {
  std::string title = {};       ///< empty: the figure's own
  std::string unit = {};        ///< of length, for example "mm"; empty: none stated
  double width = 720;           ///< px
  double largest_height = 620;  ///< px; flat curves make flat figures
};

/// Signed curvature against arc length; the first curve sets the range and its joints are marked.
/// A later curve that leaves the range far is cut at the frame. Where a few places are far tighter
/// than the rest (25 times the median) the axis has a square-root scale, and says so.
Drawing curvature_plot(const std::vector<SampledCurve>& curves, const ChartOptions& options = {});

/// The curve with its curvature as teeth on its outer side and a line over their tips. The longest
/// tooth stands for the largest |curvature|, which the subtitle states. Square-root teeth where
/// curvature_plot() has such a scale.
Drawing curvature_comb(const SampledCurve& curve, const ChartOptions& options = {});

/// The curve and the locus of its centres of curvature, cut where that leaves the figure, which
/// reaches at least to where it begins unless that is more than four times the curve's size away.
Drawing evolute_chart(const SampledCurve& curve, const ChartOptions& options = {});

/// What overlay() shows: points before, the curve after, and how far each point lies off.
struct Overlay {
  std::vector<core::Point2> points = {};  ///< given points
  std::vector<core::Point2> feet = {};    ///< nearest point of the curve for each of them
  SampledCurve curve = {};                ///< only name, points and joints are used
  double tolerance = 0;                   ///< deviations beyond it stand out; 0: none stated
  double exaggeration = 0;                ///< of the comb; 0: a round number that shows it well
};

/// Before and after, with a comb of deviations drawn `exaggeration` times too long (stated in the
/// subtitle). points and feet must be equally many (InvalidInput otherwise).
Drawing overlay(const Overlay& overlay, const ChartOptions& options = {});

}  // namespace keyline::figure
