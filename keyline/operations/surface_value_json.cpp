#include "keyline/operations/surface_value_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json_space.h"
#include "keyline/operations/class_a_json.h"

namespace keyline::operations {

using nlohmann::json;

namespace {

/// As curve.cav gives it, the curve in space.
json nearest_json(const classa::NearestValue& n) {
  json j{{"distance", n.nearest.distance},
         {"alpha", std::abs(n.nearest.flat.matrix.alpha)},
         {"s", n.nearest.flat.matrix.s},
         {"cav", nullptr},
         {"curve", exchange::to_json(n.nearest.curve)}};
  if (!n.value) return j;
  j["cav"] = n.value->cav;
  j["type"] = n.value->type;
  if (n.value->matrix) {  // in the direction it is read in, like every place in the plane
    j["alpha"] = n.value->matrix->alpha;
    j["s"] = n.value->matrix->s;
  }
  return j;
}

}  // namespace

json surface_value_json(const surface::SurfaceValue& value) {
  json curves = json::array();
  double nearest = 0;  // sum with the nearest curves in place of types 4 and 5
  for (const surface::NetworkValue& c : value.curves) {
    json one = curve_value_json(c.value);
    one["name"] = c.name;
    if (c.nearest) one["nearest"] = nearest_json(*c.nearest);
    nearest += c.value.type <= 3               ? c.value.cav
               : c.nearest && c.nearest->value ? c.nearest->value->cav
                                               : HUGE_VAL;
    curves.push_back(std::move(one));
  }
  json result{
      {"sav", value.sav}, {"curves", std::move(curves)}, {"worst", value.curves[value.worst].name}};
  if (std::isfinite(nearest)) result["nearest_sav"] = nearest;
  return result;
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
    if (one.contains("nearest_sav")) result["patches"].back()["nearest_sav"] = one["nearest_sav"];
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
