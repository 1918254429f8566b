#include "report.h"

#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace keyline::studio {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using presentation::Shown;

namespace {

constexpr const char* kFair = "fair";
constexpr const char* kAnalyze = "curve.analyze";

core::Failure no_report() {
  return {ErrorCode::bad_input, "this is no report",
          R"(give [{"op": "fair", "name": ..., "request": {...}}, ...], or all of curve.analyze)",
          "report"};
}

Result<Shown> shown_of(const json& one, const Folder& folder, const operations::Context& context) {
  json request = one.value("request", json::object());
  const std::string name = one["op"].get<std::string>();
  const operations::Operation* operation = operations::find_operation(name);
  if (!operation) return std::unexpected(no_report());
  if (auto inside = folder.confine(*operation, request); !inside)
    return std::unexpected(inside.error());
  auto outcome = operations::carry_out(name, request, context);
  if (!outcome) return std::unexpected(outcome.error());
  const auto called = one.find("name");
  return Shown{called != one.end() && called->is_string() ? called->get<std::string>() : "",
               std::move(*outcome)};
}

bool is_of(const json& one, const json& op) {
  return one.is_object() && one.value("op", json()) == op;
}

}  // namespace

Result<presentation::Pages> report_pages(const json& asked, const Folder& folder,
                                         const presentation::ReportOptions& options,
                                         const operations::Context& context) {
  if (!asked.is_array() || asked.empty()) return std::unexpected(no_report());
  const json op = asked[0].is_object() ? asked[0].value("op", json()) : json();
  if (op != kFair && op != kAnalyze) return std::unexpected(no_report());
  std::vector<Shown> all;
  for (const json& one : asked) {
    if (!is_of(one, op)) return std::unexpected(no_report());
    auto shown = shown_of(one, folder, context);
    if (!shown) return std::unexpected(shown.error());
    all.push_back(std::move(*shown));
  }
  if (op == kFair) return presentation::fair_pages(all, options);
  std::vector<presentation::ShownAnalysis> analysed;
  for (Shown& one : all) analysed.push_back({std::move(one), {}});
  return presentation::analysis_pages(analysed, options);
}

}  // namespace keyline::studio
