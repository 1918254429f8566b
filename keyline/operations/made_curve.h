#pragma once

#include <optional>

#include "keyline/core/describe.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/operations/sampled_comb.h"
#include "keyline/operations/values.h"

/// Curves in results, and the further forms of them that a request may want.
namespace keyline::operations {

/// A form that a request wants a curve in.
struct Form {
  int degree = 3;
  double tolerance = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&Form::degree>("of its pieces").within(core::from_to(3, 30)),
                        core::field<&Form::tolerance>("largest distance from the curve")
                            .in("length")
                            .within(core::kPositive)
                            .needed());
  }
};

/// What every operation takes whose result holds a MadeCurve.
struct Forms {
  std::optional<int> samples;
  std::optional<Form> bezier;
  std::optional<Form> nurbs;
  std::optional<CombForm> comb;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Forms::samples>("adds the curve as a polyline of so many points")
            .within(core::from_to(2, 10'000'000)),
        core::field<&Forms::bezier>("adds the curve as Beziers, with a bound of their deviation"),
        core::field<&Forms::nurbs>("adds the curve as a B-spline, with a bound of its deviation"),
        core::field<&Forms::comb>("adds the data for drawing a comb and the graphs of curvature"));
  }
};

/// A curve of a result, at any depth; the wanted forms are added beside it. Use it as a flattened
/// member, so that its fields stand beside those of the result.
struct MadeCurve {
  AnyCurve curve;
  std::optional<AnyCurve> polyline;
  std::optional<BoundedCurve> bezier;
  std::optional<BoundedCurve> nurbs;
  std::optional<SampledComb> comb;
  static constexpr auto describe() {
    return core::fields(
        core::field<&MadeCurve::curve>("the curve, exact").needed(),
        core::field<&MadeCurve::polyline>("points evenly spaced along it, where asked for"),
        core::field<&MadeCurve::bezier>("Beziers within the tolerance, where asked for"),
        core::field<&MadeCurve::nurbs>("a B-spline within the tolerance, where asked for"),
        core::field<&MadeCurve::comb>("places along it with their curvature, where asked for"));
  }
};

MadeCurve made(document::PlanarCurve curve);

/// Whether a MadeCurve may stand anywhere in the type.
bool holds_made_curve(const core::Type& type);

/// Adds the forms to every MadeCurve of the value.
/// Degree 3 unless given; polynomials of that degree or less come exactly, log-aesthetic chains as
/// quintics from degree 5 on, all else as cubics, raised to the degree.
/// Fails: not_converged where the tolerance is below what doubles can do.
core::Result<void> add_forms(const core::Type& type, void* value, const Forms& forms);

/// The path as polynomial Béziers end to end whose `deviation` bounds their distance from it: what
/// is polynomial exactly, log-aesthetic chains as quintics, all else as cubics.
/// Fails: not_converged where the tolerance is below what doubles can do.
core::Result<curve::PiecewiseBezier> bounded_pieces(const document::Path& path, double tolerance);

}  // namespace keyline::operations
