#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"

/// The curve values of the public interface as JSON, both ways.
///
/// Reading checks everything (types, finiteness, counts, the sense of the curve) and says where
/// in the value a mistake is, for example "curve.pieces[1].length". Numbers are written so that
/// they read back to the same double.
namespace keyline::exchange {

nlohmann::json to_json(core::Point2 p);
nlohmann::json to_json(const document::PlanarCurve& c);
nlohmann::json to_json(const document::Path& path);

/// [x, y]; a third coordinate of zero is let pass.
core::Result<core::Point2> point_from_json(const nlohmann::json& j, const std::string& where);

/// Any planar curve type but "path".
core::Result<document::PlanarCurve> curve_from_json(const nlohmann::json& j,
                                                    const std::string& where);

/// A "path", or any other planar curve as a path of one.
core::Result<document::Path> path_from_json(const nlohmann::json& j, const std::string& where);

/// A finite number.
core::Result<double> number_from_json(const nlohmann::json& j, const std::string& where);

}  // namespace keyline::exchange
