#include "keyline/operations/surface_value_json.h"

#include <nlohmann/json.hpp>

#include "keyline/operations/class_a_json.h"

namespace keyline::operations {

using nlohmann::json;

json surface_value_json(const surface::SurfaceValue& value) {
  json curves = json::array();
  for (const surface::NetworkValue& c : value.curves) {
    json one = curve_value_json(c.value);
    one["name"] = c.name;
    curves.push_back(std::move(one));
  }
  return {
      {"sav", value.sav}, {"curves", std::move(curves)}, {"worst", value.curves[value.worst].name}};
}

json patch_values_json(const std::vector<surface::PatchValue>& patches) {
  if (patches.size() == 1) return surface_value_json(patches.front().value);
  json result{{"sav", 0.0}, {"curves", json::array()}, {"patches", json::array()}};
  double sum = 0;
  double worst = -1;
  for (const surface::PatchValue& p : patches) {
    json one = surface_value_json(p.value);
    const json place{p.row, p.column};
    for (json& curve : one["curves"]) {
      curve["patch"] = place;
      result["curves"].push_back(std::move(curve));
    }
    result["patches"].push_back({{"patch", place}, {"sav", p.value.sav}, {"worst", one["worst"]}});
    sum += p.value.sav;
    if (p.value.sav > worst) {
      worst = p.value.sav;
      result["worst"] = one["worst"];
      result["worst_patch"] = place;
    }
  }
  result["sav"] = sum;
  return result;
}

}  // namespace keyline::operations
