#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/document/space_curve.h"
#include "keyline/lac/space/space.h"

/// The space curve values of the public interface as JSON; see json_curve.h for the rules.
namespace keyline::exchange {

nlohmann::json to_json(core::Point3 p);
/// {"type":"log-aesthetic-space", …}.
nlohmann::json to_json(const lac::SpaceChain& c);
/// "bezier", "bspline" and "polyline" with points [x, y, z].
nlohmann::json to_json(const curve::Bezier3& c);
nlohmann::json to_json(const curve::BSpline3& c);
nlohmann::json to_json(const document::SpaceCurve& c);

/// [x, y, z]; z may be left out and is 0 then.
core::Result<core::Point3> point3_from_json(const nlohmann::json& j, const std::string& where);

/// A "log-aesthetic-space" value, checked as lac::validate does.
core::Result<lac::SpaceChain> space_chain_from_json(const nlohmann::json& j,
                                                    const std::string& where);

/// True for a value that only space can hold: "log-aesthetic-space", or points of which one has a
/// third coordinate other than 0.
bool is_space_curve(const nlohmann::json& j);

/// True for a "path" of which a member is such a value.
bool is_space_path(const nlohmann::json& j);

/// The members of a path in space, end to end. Fails: bad_input at a gap.
core::Result<std::vector<document::SpaceCurve>> space_path_from_json(const nlohmann::json& j,
                                                                     const std::string& where);

/// Any space curve type, checked as its validate() does.
core::Result<document::SpaceCurve> space_curve_from_json(const nlohmann::json& j,
                                                         const std::string& where);

}  // namespace keyline::exchange
