#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/analysis/profile.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/operations/operation.h"

#include "commands.h"
#include "output.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

Result<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return core::fail(ErrorCode::bad_input, "\"" + std::string(text) + "\" is no number",
                      "give points as x,y", "--points");
  return value;
}

Result<json> points_of(const std::vector<std::string>& texts) {
  json points = json::array();
  for (const std::string& text : texts) {
    json point = json::array();
    std::size_t from = 0;
    while (from <= text.size()) {
      const std::size_t to = std::min(text.find(',', from), text.size());
      const auto value = number(std::string_view(text).substr(from, to - from));
      if (!value) return std::unexpected(value.error());
      point.push_back(*value);
      from = to + 1;
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace

int run_draw(const DrawCommand& command) {
  if (auto known = check_outputs(command.common, {".svg", ".json", ".csv"}); !known)
    return report_failure(known.error());
  const auto points = points_of(command.points);
  if (!points) return report_failure(points.error());
  if (command.alpha.size() != 1)
    return report_failure({ErrorCode::bad_input, "one slope is wanted", "give one --alpha", ""});
  const json request{{"points", *points}, {"alpha", command.alpha[0]}};
  const auto result = operations::perform("lac.segment", request, {command.common.threads, {}});
  if (!result) return report_failure(result.error());
  auto path = exchange::path_from_json((*result)["curve"], "curve");
  if (!path) return report_failure(path.error());
  const double length = analysis::ArcLengthTable(analysis::view(*path)).length();
  const Writers writers =
      curve_writers({{"", std::move(*path)}}, command.common.tolerance.value_or(1e-5 * length), "");
  if (auto done = write_outputs(command.common, writers); !done)
    return report_failure(done.error());
  if (command.common.json) {
    fmt::print("{}\n", result->dump());
    return kDone;
  }
  if (command.common.quiet) return kDone;
  const json& piece = (*result)["curve"]["pieces"][0];
  fmt::print("alpha {}  length {:.10g}  lambda {:.10g}  turning {:.10g}{}\n", piece["alpha"].dump(),
             piece["length"].get<double>(), (*result)["lambda"].get<double>(),
             (*result)["theta"].get<double>(),
             (*result)["reversed"].get<bool>() ? "  (radius falls from P0 to P2)" : "");
  return kDone;
}

}  // namespace keyline::app
