#pragma once

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/document/planar_curve.h"

namespace keyline::operations {

/// Adds to a result that holds "curve", and to each of its "strokes" that do, what the request asks
/// for beside it: "polyline" ("samples": n points) and the "bezier" or "nurbs" form of {"degree",
/// "tolerance"} with its "deviation". No effect where the request asks for none.
/// Degree 3 unless given; polynomials of that degree or less come exactly, log-aesthetic chains as
/// quintics from degree 5 on, all else as cubics, raised to the degree.
/// Fails: bad_input; unsupported where there is no curve; not_converged where the tolerance is
/// below what doubles can do.
core::Result<void> add_derived_forms(const nlohmann::json& request, nlohmann::json& result);

/// The path as polynomial Béziers end to end whose `deviation` bounds their distance from it: what
/// is polynomial exactly, log-aesthetic chains as quintics, all else as cubics.
/// Fails: not_converged where the tolerance is below what doubles can do.
core::Result<curve::PiecewiseBezier> bounded_pieces(const document::Path& path, double tolerance);

}  // namespace keyline::operations
