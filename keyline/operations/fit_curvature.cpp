#include "keyline/exchange/json_curve.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/fit/curvature_target.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

Result<curve::PiecewiseBezier> chain_of(const document::Path& path) {
  curve::PiecewiseBezier chain;
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto* piece = std::get_if<curve::Bezier2>(&path.curves[i].value);
    if (!piece)
      return core::fail(ErrorCode::bad_input, "is no Bézier curve",
                        "give a path of quintics, or convert it",
                        "curve.curves[" + std::to_string(i) + "]");
    chain.pieces.push_back(*piece);
  }
  return chain;
}

Result<std::vector<fit::CurvatureTarget>> target_of(const json& request,
                                                    const curve::PiecewiseBezier& chain,
                                                    bool closed) {
  const json& target = request.at("target");
  if (target == "smooth") return fit::smooth_target(chain, closed, number_or(request, "cutoff", 0));
  if (target == "rhythm") return fit::rhythm_target(chain, closed);
  const auto bad = [] {
    return core::fail(ErrorCode::bad_input, "is no target",
                      "give \"smooth\", \"rhythm\" or a list of {\"t\", \"curvature\"}", "target");
  };
  if (!target.is_array()) return bad();
  std::vector<fit::CurvatureTarget> list;
  for (std::size_t i = 0; i < target.size(); ++i) {
    const json& item = target[i];
    if (!item.is_object() || !item.contains("t") || !item.contains("curvature")) return bad();
    const std::string where = "target[" + std::to_string(i) + "]";
    const auto t = exchange::number_from_json(item["t"], where + ".t");
    if (!t) return std::unexpected(t.error());
    const auto curvature = exchange::number_from_json(item["curvature"], where + ".curvature");
    if (!curvature) return std::unexpected(curvature.error());
    list.push_back({*t, *curvature});
  }
  return list;
}

Result<json> run(const json& request, const Context&) {
  const document::Path path = path_of(request, "curve");
  const auto chain = chain_of(path);
  if (!chain) return std::unexpected(chain.error());
  const auto target = target_of(request, *chain, path.closed);
  if (!target) return std::unexpected(target.error());
  fit::CurvatureDriveOptions options;
  options.closed = path.closed;
  options.hold_end = boolean_or(request, "hold_end", false);
  options.keep_monotone = boolean_or(request, "keep_monotone", false);
  const auto most = positive_number(request, "max_deviation");
  if (!most) return std::unexpected(most.error());
  options.max_deviation = most->value_or(0);
  const auto driven = fit::drive_curvature(*chain, *target, options);
  if (!driven) return std::unexpected(driven.error());
  document::Path out{{}, path.closed};
  for (const curve::Bezier2& piece : driven->chain.pieces) out.curves.push_back({piece});
  return json{{"curve", exchange::to_json(out)},  {"before", driven->before},
              {"after", driven->after},           {"converged", driven->converged},
              {"iterations", driven->iterations}, {"share", driven->share},
              {"end_moved", driven->end_moved},   {"moved", driven->moved},
              {"report", driven->notes}};
}

json example_curve() {
  const auto piece = [](const std::vector<std::array<double, 2>>& points) {
    return json{{"type", "bezier"}, {"points", points}};
  };
  return {{"type", "path"},
          {"curves",
           {piece({{0, 0}, {1, 0.1}, {2, 0.4}, {3, 0.9}, {4, 1.6}, {5, 2.5}}),
            piece({{5, 2.5}, {6, 3.4}, {6.9, 4.5}, {7.7, 5.8}, {8.3, 7.2}, {8.7, 8.7}})}}};
}

}  // namespace

Operation fit_curvature_operation() {
  using Type = Field::Type;
  return {
      "fit.curvature",
      "Modifies a chain of quintic Beziers so that its curvature follows a target: directions of "
      "the control edges stay, their lengths move, joints stay G2.",
      {{"curve", Type::curve, true, "a path of Beziers of degree 5 or less"},
       {"target", Type::any, true,
        "[{\"t\", \"curvature\"}, ...] with t over the whole path, \"smooth\" or \"rhythm\""},
       {"cutoff", Type::number, false,
        "wavelength that smooth halves; else twice the mean length of a piece"},
       {"hold_end", Type::boolean, false, "the end point stays; else it moves with the lengths"},
       {"max_deviation", Type::number, false,
        "farthest the curve may move; else as far as the lengths take it"},
       {"keep_monotone", Type::boolean, false, "pieces of monotone curvature stay so"}},
      run,
      {{"curve", example_curve()}, {"target", "smooth"}}};
}

}  // namespace keyline::operations
