#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

/// Results about surfaces as text for a terminal.
namespace keyline::app {

/// SAV by surface, patch and curve, and curvature.
std::string surface_text(const nlohmann::json& result);

/// What surface.edit made of one surface; joints of them all.
std::string surface_edit_text(const std::string& name, const nlohmann::json& edit);
std::string joints_text(const nlohmann::json& joints);

/// Joints of the patches that something was made of; empty where there are none.
std::string made_joints_text(const nlohmann::json& joints);

/// Says on standard error that the curves of a file of surfaces are not looked at.
void say_curves_left_out(const nlohmann::json& read, bool quiet);

}  // namespace keyline::app
