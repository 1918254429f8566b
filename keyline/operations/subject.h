#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/key_line.h"
#include "keyline/core/progress.h"
#include "keyline/operations/uses.h"
#include "keyline/operations/values.h"

/// What `fair` and `curve.analyze` work on: one place decides what counts as measured points.
namespace keyline::operations {

/// Facts about measured points that are recognised unless they are given.
struct Acquiring {
  std::optional<bool> closed;
  std::optional<double> noise;
  std::optional<double> detail;
  bool keep_order = false;
  bool keep_strays = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Acquiring::closed>(
            "whether measured points are a closed outline; recognised unless given"),
        core::field<&Acquiring::noise>(
            "of measured points: standard deviation of the positions; estimated unless given")
            .in("length")
            .within(core::from_to(0, 1e100)),
        core::field<&Acquiring::detail>(
            "of measured points: noise is measured on waves shorter than this; found where texture "
            "shows unless given")
            .in("length"),
        core::field<&Acquiring::keep_order>("never put measured points in another order"),
        core::field<&Acquiring::keep_strays>("never drop a measured point as stray"));
  }
};

/// bad_input for a curve that is one point, with "curve" as path, and for one whose weights are too
/// far apart for its length to be measured, with the largest of them.
core::Result<void> check_extent(const document::Path& path);

acquire::AcquireOptions acquire_options(const Acquiring& told,
                                        const core::CancellationToken& cancellation);

struct Subject {
  std::optional<std::vector<core::Point2>> points;
  std::optional<document::Path> curve;
  std::optional<acquire::KeyLine> line;
  std::vector<double> weights;
  Acquiring acquiring;
  /// Points put in order and cleaned here, or curves and key-lines taken as they are.
  static constexpr unsigned kAcquired = 1;
  static constexpr unsigned kAsGiven = 2;
  static constexpr auto uses() {
    return std::array{use<&Subject::weights>(kAcquired), use<&Subject::acquiring>(kAcquired)};
  }
  static constexpr auto describe() {
    return core::fields(
        core::field<&Subject::points>("measured points; or curve, or line").count(1),
        core::field<&Subject::curve>(
            "any planar curve or path; or points. The vertices of a polyline are points in their "
            "order"),
        core::field<&Subject::line>("a key-line as document.read gives it; or points"),
        core::field<&Subject::weights>("one positive weight per point"),
        core::flattened<&Subject::acquiring>());
  }
};

/// Whether vertices are points of a curve (a hull's offsets, a digitised outline) and not corners
/// of a polygon: enough for a spline, and turning on average no more than an octagon's.
bool are_points_of_a_curve(const std::vector<core::Point2>& vertices);

/// The subject's points as a key-line, where it is made of points: those given (put in order and
/// cleaned), those of a line as they are, the vertices of a polyline in their order. Empty where it
/// is another curve. bad_input unless it is one of the three; cancelled.
core::Result<std::optional<acquire::KeyLine>> measured_line(
    const Subject& subject, const core::CancellationToken& cancellation);

/// What was given with a subject and has no use for it; measured: that measured_line() has one.
inline std::vector<std::string> unused_of(const Subject& subject, bool measured) {
  return unused_fields(subject, measured && !subject.line ? Subject::kAcquired : Subject::kAsGiven);
}

/// A curve as a key-line: samples evenly spaced in arc length, no noise, the curve's own corners:
/// kinks that within the tolerance neither a step of curvature beside them hides nor a bend too
/// slight for a wave. Not above 0: fairing's default tolerance.
core::Result<acquire::KeyLine> sampled_line(const document::Path& path, double tolerance = 0);

}  // namespace keyline::operations
