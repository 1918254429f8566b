#include "keyline/exchange/json_curve.h"
#include "keyline/operations/analysis_json.h"
#include "keyline/operations/fair_request.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {

using nlohmann::json;

namespace {

json piece_json(const fairing::FairPiece& piece) {
  json readings = json::array();
  for (const auto& reading : piece.interpretations)
    readings.push_back(interpretation_json(reading));
  return {{"curve", piece.curve},
          {"piece", piece.piece},
          {"start", piece.start},
          {"length", piece.length},
          {"rhythm", analysis::rhythm_name(piece.rhythm)},
          {"slopes", piece.slopes},
          {"volume", piece.volume},
          {"impression", analysis::impression(piece.rhythm)},
          {"deviation", piece.deviation},
          {"interpretations", std::move(readings)}};
}

json curve_of(const fairing::FairResult& result) {
  const document::Path path = fair_curve(result);
  return path.curves.size() == 1 ? exchange::to_json(path.curves.front()) : exchange::to_json(path);
}

json splines_of(const fairing::FairResult& result) {
  if (result.splines.size() == 1)
    return exchange::to_json(document::PlanarCurve{result.splines.front()});
  document::Path path{{}, result.closed};
  for (const auto& spline : result.splines) path.curves.push_back({spline});
  return exchange::to_json(path);
}

core::Result<json> run(const json& request, const Context& context) {
  const auto options = fair_options(request, context);
  if (!options) return std::unexpected(options.error());
  const auto line = key_line_of(request);
  if (!line) return std::unexpected(line.error());
  const auto result = fairing::fair(*line, *options);
  if (!result) return std::unexpected(result.error());
  return fair_json(*result);
}

}  // namespace

json fair_json(const fairing::FairResult& result) {
  json pieces = json::array();
  for (const auto& piece : result.pieces) pieces.push_back(piece_json(piece));
  json joints = json::array();
  for (const auto& joint : result.joints) joints.push_back(joint_json(joint));
  json monotone = json::array();
  for (std::size_t i = 0; i < result.monotone.size(); ++i)
    monotone.push_back(
        {{"spline", result.monotone_spline[i]},
         {"interval", interval_json(result.monotone[i].t)},
         {"arc_length", interval_json(result.monotone[i].arc_length)},
         {"curvature", {result.monotone[i].curvature_start, result.monotone[i].curvature_end}}});
  return {{"curve", curve_of(result)},
          {"spline", splines_of(result)},
          {"spline_bic", result.spline_bic},
          {"monotone_pieces", std::move(monotone)},
          {"pieces", std::move(pieces)},
          {"length", result.length},
          {"noise", result.noise},
          {"tolerance", result.tolerance},
          {"deviation",
           {{"max", result.max_deviation},
            {"rms", result.rms_deviation},
            {"worst_point", result.worst_point}}},
          {"within_tolerance", result.within_tolerance},
          {"cancelled", result.cancelled},
          {"continuity", std::move(joints)},
          {"report", result.notes}};
}

Operation fair_operation() {
  using Type = Field::Type;
  json points = json::array();
  for (int i = 0; i <= 20; ++i) {
    const double x = 0.1 * i;
    points.push_back({x, 0.4 * x * x});
  }
  return {
      "fair",
      "The main job: a key-line's points (or a curve) in, a faired chain of log-aesthetic "
      "pieces out, G2 at its joints, as few pieces as the tolerance allows.",
      {{"points", Type::points, false, "measured points; or \"curve\""},
       {"curve", Type::curve, false, "any planar curve or path; or \"points\""},
       {"weights", Type::numbers, false, "one positive weight per point"},
       {"must_pass", Type::numbers, false, "indices of points the curve must pass"},
       {"tolerance", Type::number, false,
        "largest distance of a point; by default three times the noise or 0.05 % of the length"},
       {"noise", Type::number, false, "standard deviation of the points; else estimated"},
       {"closed", Type::boolean, false, "else recognised"},
       {"pieces", Type::integer, false, "wanted number of pieces; 0: as few as possible"},
       {"clamp", Type::string, false, "\"start:G1,end:G2\": what is held at the ends"},
       {"region", Type::any, false, "[a, b]: fair only this part of the length"},
       {"interpretation", Type::any, false,
        "[\"2:arc\", \"0:slope=0.667\"]: readings of pieces that replace those found"},
       {"keep_corners", Type::boolean, false, "corners end chains; true unless given"},
       {"order", Type::integer, false, "of the spline, 4 to 6; 5 unless given"},
       {"population", Type::integer, false, "of the knots' search; 30 unless given"},
       {"generations", Type::integer, false, "30 unless given"},
       {"trials", Type::integer, false, "1 unless given"},
       {"knots", Type::string, false, "\"polished\" (default) or \"ga\""},
       {"parameter", Type::string, false,
        "\"smooth-chord\" (default), \"chord\" or \"centripetal\""},
       {"seed", Type::integer, false, "of the knots' search; 1 unless given"}},
      run,
      {{"points", std::move(points)}}};
}

}  // namespace keyline::operations
