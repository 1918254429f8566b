#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/analysis/profile.h"
#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"
#include "keyline/document/closest_point.h"
#include "keyline/document/cusped.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/values.h"

namespace keyline::operations {
namespace {

using core::Result;

struct CompareRequest {
  std::vector<document::Path> curves;
  int places = 401;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CompareRequest::curves>("the curve that is judged, and the one it is held "
                                             "against")
            .count(2, 2)
            .needed(),
        core::field<&CompareRequest::places>("of each curve that are looked at")
            .within(core::from_to(2, 100'000)));
  }
};

struct CompareDeviation {
  double max = 0;
  double rms = 0;
  core::Point2 at;
  double place = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CompareDeviation::max>("largest distance to the other curve").in("length"),
        core::field<&CompareDeviation::rms>("root mean square").in("length"),
        core::field<&CompareDeviation::at>("where the largest is"),
        core::field<&CompareDeviation::place>("there, as a fraction of the length"));
  }
};

struct Comb {
  double length = 0;
  double curvature_min = 0;  ///< infinite at a cusp, as curvature_max
  double curvature_max = 0;
  std::vector<std::array<double, 2>> plot;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Comb::length>("of the curve").in("length"),
        core::field<&Comb::curvature_min>("least, signed; null where it has no bound")
            .in("1/length")
            .null_if_empty(),
        core::field<&Comb::curvature_max>("largest, signed; null where it has no bound")
            .in("1/length")
            .null_if_empty(),
        core::field<&Comb::plot>("[arc length, curvature]"));
  }
};

struct CompareResult {
  std::vector<CompareDeviation> deviation;
  double largest = 0;
  std::array<double, 2> ends{};
  std::array<double, 2> end_angles{};
  std::vector<Comb> combs;
  static constexpr auto describe() {
    using Answer = CompareResult;
    return core::fields(
        core::field<&Answer::deviation>("of the first from the second, and the other way round"),
        core::field<&Answer::largest>("of both").in("length"),
        core::field<&Answer::ends>("distance of start from start and of end from end").in("length"),
        core::field<&Answer::end_angles>("between the tangents there").in("radian"),
        core::field<&Answer::combs>("curvature along each"));
  }
};

CompareDeviation deviation_of(const document::Path& judged, const document::Path& held, int n) {
  const analysis::CurveView view = analysis::view(judged);
  const analysis::ArcLengthTable table(view);
  const document::ClosestSearch nearest(held);
  CompareDeviation d;
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const double place = static_cast<double>(i) / (n - 1);
    const core::Point2 p = evaluate(view, table.parameter_at(place * table.length()));
    const double away = nearest(p).distance;
    squares += away * away;
    if (away > d.max || i == 0) d = {away, 0, p, place};
  }
  d.rms = std::sqrt(squares / n);
  return d;
}

Comb comb_of(const document::Path& path, int n) {
  const document::CuspedPath cusped(path);
  const analysis::CurveView view(cusped);
  const analysis::ArcLengthTable table(view);
  Comb comb;
  comb.length = table.length();
  for (int i = 0; i < n; ++i) {
    const double s = table.length() * i / (n - 1);
    const double bend = curve::curvature(jet(view, table.parameter_at(s)));
    if (std::isfinite(bend)) comb.plot.push_back({s, bend});  // not at a cusp
  }
  if (comb.plot.empty()) return comb;
  const auto [least, most] = std::minmax_element(
      comb.plot.begin(), comb.plot.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  comb.curvature_min = (*least)[1];
  comb.curvature_max = (*most)[1];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (document::has_cusp(cusped.stops(), 1)) comb.curvature_max = kInfinity;
  if (document::has_cusp(cusped.stops(), -1)) comb.curvature_min = -kInfinity;
  return comb;
}

Result<CompareResult> run(const CompareRequest& request, const Context&) {
  const document::Path& a = request.curves[0];
  const document::Path& b = request.curves[1];
  CompareResult result;
  result.deviation = {deviation_of(a, b, request.places), deviation_of(b, a, request.places)};
  result.largest = std::max(result.deviation[0].max, result.deviation[1].max);
  for (const std::size_t i : {0, 1}) {
    const auto t = static_cast<double>(i);
    result.ends[i] = core::distance(evaluate(a, t), evaluate(b, t));
    result.end_angles[i] = core::wrap_angle(curve::travel_angle(b, t) - curve::travel_angle(a, t));
  }
  result.combs = {comb_of(a, request.places), comb_of(b, request.places)};
  return result;
}

}  // namespace

Operation curve_compare_operation() {
  return declare<run>(
      {.name = "curve.compare",
       .summary = "How far two curves lie apart, both ways, and the curvature along each.",
       .examples = {R"({"curves":[{"type":"bezier","points":[[0,0],[1,2],[3,2],[4,0]]},
                                  {"type":"polyline","points":[[0,0],[2,1.5],[4,0]]}]})"}});
}

}  // namespace keyline::operations
