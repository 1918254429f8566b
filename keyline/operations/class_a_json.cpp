#include "keyline/operations/class_a_json.h"

#include <cmath>

#include "keyline/exchange/json_curve.h"

namespace keyline::operations {

using nlohmann::json;

namespace {

json finite_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json bezier_json(const curve::Bezier2& c) { return exchange::to_json(document::PlanarCurve{c}); }

json minimum_json(const classa::EnergyMinimum& m) {
  return {{"alpha", m.alpha},
          {"s", m.s},
          {"beta", m.beta},
          {"energy", m.energy},
          {"chord", {m.chord.x, m.chord.y}}};
}

}  // namespace

const char* answer_name(curve::MonotoneVerdict::Answer answer) {
  switch (answer) {
    case curve::MonotoneVerdict::yes:
      return "yes";
    case curve::MonotoneVerdict::no:
      return "no";
    case curve::MonotoneVerdict::undecided:
      break;
  }
  return "undecided";
}

json curve_value_json(const classa::CurveValue& value) {
  json j{{"type", value.type},
         {"cav", value.cav},
         {"alpha", value.matrix ? json(value.matrix->alpha) : json(nullptr)},
         {"s", value.matrix ? json(value.matrix->s) : json(nullptr)},
         {"degree", value.degree},
         {"reversed", value.reversed},
         {"turn", value.left ? "left" : "right"},
         {"energy", finite_or_null(value.energy)},
         {"minimum", value.minimum ? minimum_json(*value.minimum) : json(nullptr)},
         {"monotone", answer_name(value.monotone.answer)}};
  if (value.monotone.answer != curve::MonotoneVerdict::yes) j["witness"] = value.monotone.witness;
  if (!value.no_minimum.empty()) j["no_minimum"] = value.no_minimum;
  return j;
}

json evaluation_json(const classa::Evaluation& e) {
  json j = curve_value_json(e.value);
  if (e.value.type > 3) {
    j["nearest"] = nullptr;
    if (e.nearest) {
      j["nearest"] = {{"distance", e.nearest->distance},
                      {"rms", e.nearest->rms},
                      {"alpha", std::abs(e.nearest->matrix.alpha)},
                      {"s", e.nearest->matrix.s},
                      {"cav", nullptr},
                      {"curve", bezier_json(e.nearest->curve)}};
      if (e.nearest_value) {
        // In the direction the nearest curve is read in, like every place in the plane.
        if (e.nearest_value->matrix) {
          j["nearest"]["alpha"] = e.nearest_value->matrix->alpha;
          j["nearest"]["s"] = e.nearest_value->matrix->s;
        }
        j["nearest"]["cav"] = e.nearest_value->cav;
        j["nearest"]["type"] = e.nearest_value->type;
      }
    }
  }
  if (!e.approximation.exact)
    j["approximation"] = {{"degree", curve::degree(e.approximation.curve)},
                          {"deviation", e.approximation.deviation},
                          {"tolerance", e.approximation.tolerance},
                          {"curve", bezier_json(e.approximation.curve)}};
  return j;
}

core::Result<json> class_a_edit_json(const classa::EditResult& edited,
                                     const classa::Approximation& given,
                                     const classa::EditOptions& options) {
  const auto before = classa::evaluate_curve(given, options.cav);
  if (!before) return std::unexpected(before.error());
  classa::CavOptions again = options.cav;
  again.minimum = edited.before.minimum;
  const auto after = classa::evaluate_curve({edited.curve, true}, again);
  if (!after) return std::unexpected(after.error());
  json path = json::array();
  for (const core::Point2& p : edited.path) path.push_back({p.x, p.y});
  return json{{"curve", bezier_json(edited.curve)},
              {"before", evaluation_json(*before)},
              {"after", evaluation_json(*after)},
              {"target", {{"alpha", edited.target.alpha}, {"s", edited.target.s}}},
              {"path", std::move(path)}};
}

}  // namespace keyline::operations
