#include "keyline/operations/amount.h"

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/document_read.h"

namespace keyline::operations {
namespace {

/// A span takes a twentieth of a second to analyse and four times that to fair.
constexpr std::size_t kMostSpans = 10'000;

std::size_t bent_spans(const document::PlanarCurve& curve) {
  if (std::holds_alternative<curve::Polyline2>(curve.value)) return 0;
  if (const auto* chain = std::get_if<lac::Chain>(&curve.value)) return chain->pieces.size();
  if (const auto* bezier = std::get_if<curve::Bezier2>(&curve.value))
    return bezier->control.size() > 2 ? 1 : 0;
  return document::breakpoints(curve).size() - 1;
}

std::size_t bent_spans(const document::Path& path) {
  std::size_t spans = 0;
  for (const document::PlanarCurve& curve : path.curves) spans += bent_spans(curve);
  return spans;
}

core::Failure too_many(const std::string& what, const char* remedy) {
  return {core::ErrorCode::unsupported, fmt::format("{}; at most {} at a time", what, kMostSpans),
          remedy, ""};
}

}  // namespace

core::Result<void> check_amount(const document::Path& path) {
  const std::size_t spans = bent_spans(path);
  if (spans <= kMostSpans) return {};
  return std::unexpected(too_many(fmt::format("a curve of {} spans", spans), "take it in parts"));
}

core::Result<void> check_amount(const ReadAnswer& read) {
  std::size_t spans = 0;
  for (const NamedCurve& named : read.curves)
    if (!named.line && named.curve)
      if (const auto path = planar_path(*named.curve)) spans += bent_spans(*path);
  if (spans <= kMostSpans) return {};
  return std::unexpected(too_many(
      fmt::format("{} of {} spans together", core::counted(read.curves.size(), "curve"), spans),
      "choose some with --select, by name, layer or number"));
}

}  // namespace keyline::operations
