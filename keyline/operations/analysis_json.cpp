#include "keyline/operations/analysis_json.h"

#include "keyline/exchange/json_curve.h"

namespace keyline::operations {

using nlohmann::json;

namespace {

json event_json(const analysis::CurvatureEvent& event) {
  json j{{"t", event.t}, {"arc_length", event.arc_length}, {"curvature", event.curvature}};
  if (event.kind == analysis::CurvatureEvent::Kind::maximum) j["kind"] = "maximum";
  if (event.kind == analysis::CurvatureEvent::Kind::minimum) j["kind"] = "minimum";
  return j;
}

json events_json(const std::vector<analysis::CurvatureEvent>& events) {
  json list = json::array();
  for (const auto& event : events) list.push_back(event_json(event));
  return list;
}

json piece_json(const analysis::PieceAnalysis& piece) {
  json readings = json::array();
  for (const auto& reading : piece.interpretations)
    readings.push_back(interpretation_json(reading));
  return {{"interval", interval_json(piece.extent.t)},
          {"arc_length", interval_json(piece.extent.arc_length)},
          {"curvature", {piece.extent.curvature_start, piece.extent.curvature_end}},
          {"length", piece.length},
          {"volume", piece.volume},
          {"rhythm", analysis::rhythm_name(piece.rhythm)},
          {"slopes", piece.slopes},
          {"impression", piece.impression},
          {"lcg", lcg_json(piece.lcg)},
          {"lddc", lddc_json(piece.lddc)},
          {"interpretations", std::move(readings)}};
}

}  // namespace

const char* answer_name(analysis::MonotoneAnswer::Value value) {
  switch (value) {
    case analysis::MonotoneAnswer::Value::yes:
      return "yes";
    case analysis::MonotoneAnswer::Value::no:
      return "no";
    case analysis::MonotoneAnswer::Value::undecided:
      break;
  }
  return "undecided";
}

json interval_json(core::Interval interval) { return {interval.low, interval.high}; }

json interpretation_json(const analysis::Interpretation& reading) {
  return {{"rhythm", analysis::rhythm_name(reading.rhythm)},
          {"impression", analysis::impression(reading.rhythm)},
          {"slopes", reading.slopes},
          {"slope_errors", reading.slope_errors},
          {"breaks", reading.breaks},
          {"curvatures", reading.curvatures},
          {"deviation", reading.deviation},
          {"score", reading.score},
          {"plausibility", reading.plausibility}};
}

json lcg_json(const analysis::Lcg& lcg) {
  json j{{"slope", lcg.defined ? json(lcg.slope) : json()},
         {"intercept", lcg.defined ? json(lcg.intercept) : json()},
         {"variance", lcg.defined ? json(lcg.variance) : json()}};
  json points = json::array();
  for (const auto& p : lcg.points) points.push_back({p.log_radius, p.log_rate});
  j["points"] = std::move(points);
  return j;
}

json lddc_json(const analysis::Lddc& lddc) {
  json bars = json::array();
  for (const auto& bar : lddc.bars)
    if (bar.count > 0)
      bars.push_back({{"low", bar.low}, {"count", bar.count}, {"height", bar.height}});
  json c_curve = json::array();
  for (const auto& top : lddc.c_curve) c_curve.push_back({top.x, top.y});
  json j{{"bars", std::move(bars)},
         {"c_curve", std::move(c_curve)},
         {"gradient", lddc.has_gradient ? json(lddc.gradient) : json()},
         {"noise_tops", lddc.tops.size() - lddc.c_curve.size()}};
  if (!lddc.c_curve.empty()) {
    j["a"] = {lddc.a.x, lddc.a.y};
    j["b"] = {lddc.b.x, lddc.b.y};
    j["distance_ab"] = lddc.distance_ab;
  }
  return j;
}

json joint_json(const analysis::JointContinuity& joint) {
  return {{"position", exchange::to_json(joint.position)},
          {"gap", joint.gap},
          {"angle", joint.angle},
          {"curvature_jump", joint.curvature_jump},
          {"curvature_rate_jump", joint.curvature_rate_jump},
          {"relative_curvature_jump", joint.relative_curvature_jump},
          {"order", joint.order < 0 ? json("none") : json("G" + std::to_string(joint.order))}};
}

json curve_analysis_json(const analysis::CurveAnalysis& analysis) {
  json plot = json::array();
  for (const auto& p : analysis.plot) plot.push_back({p.arc_length, p.curvature});
  json pieces = json::array();
  for (const auto& piece : analysis.pieces) pieces.push_back(piece_json(piece));
  json merged = json::array();
  for (const auto& wave : analysis.split.merged)
    merged.push_back({{"interval", interval_json(wave.t)}, {"displacement", wave.displacement}});
  json j{{"length", analysis.length},
         {"volume", analysis.volume},
         {"curvature",
          {{"min", analysis.curvature_min},
           {"max", analysis.curvature_max},
           {"plot", std::move(plot)}}},
         {"inflections", events_json(analysis.split.inflections)},
         {"extrema", events_json(analysis.split.extrema)},
         {"corners", events_json(analysis.split.corners)},
         {"merged", std::move(merged)},
         {"threshold", analysis.split.threshold},
         {"pieces", std::move(pieces)},
         {"monotone", answer_name(analysis.monotone.value)}};
  if (analysis.monotone.value != analysis::MonotoneAnswer::Value::yes)
    j["witness"] = analysis.monotone.witness;
  return j;
}

}  // namespace keyline::operations
