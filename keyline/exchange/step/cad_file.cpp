#include "keyline/exchange/step/cad_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/curve/conversion.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/cad/cad_parts.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/json/json_document.h"
#include "keyline/lac/space/space.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::fail;
using core::Result;
using document::Document;

const char* name_of(CadFormat format) { return format == CadFormat::step ? "step" : "iges"; }
const char* title_of(CadFormat format) { return format == CadFormat::step ? "STEP" : "IGES"; }

bool is_program(const fs::path& path) {
  std::error_code error;
  return !path.empty() && fs::is_regular_file(path, error);
}

/// What the helper printed as its failure: "message" or "message; remedy".
core::Failure failure_of(const ChildResult& child, CadFormat format) {
  const std::string title = title_of(format);
  if (child.out_of_time)
    return {ErrorCode::bad_input,
            "the " + title + " file takes too long and was given up",
            "split the file or simplify it",
            {}};
  if (child.signal != 0)
    return {ErrorCode::bad_input,
            "the reader of " + title + " files broke down on it (" +
                std::string(::strsignal(child.signal)) + ")",
            "check the file, or save it anew from its program",
            {}};
  std::string text = child.errors.substr(0, child.errors.find('\n'));
  if (text.empty()) text = "the reader of " + title + " files gave up";
  std::string place;
  if (const std::size_t colon = text.find(": "); text.starts_with("line ") && colon < 20) {
    place = text.substr(0, colon);
    text.erase(0, colon + 2);
  }
  const std::size_t cut = text.find("; ");
  if (cut == std::string::npos) return {ErrorCode::bad_input, text, "check the file", place};
  return {ErrorCode::bad_input, text.substr(0, cut), text.substr(cut + 2), place};
}

Result<ChildResult> run(const std::vector<std::string>& arguments, std::string_view input,
                        CadFormat format, const ChildLimits& limits,
                        const core::CancellationToken& cancellation) {
  const fs::path program = cad_program();
  if (program.empty())
    return fail(ErrorCode::unsupported,
                std::string(title_of(format)) + " files need the program keyline-cad",
                "build with KEYLINE_OCCT, or name the program in KEYLINE_CAD");
  auto child = run_child(program, arguments, input, limits, cancellation);
  if (!child) return child;
  if (child->cancelled) return fail(ErrorCode::cancelled, "cancelled");
  if (child->status != 0 || child->out_of_time) return std::unexpected(failure_of(*child, format));
  return child;
}

/// Parts as curves the helper knows: lines, arcs, polylines, splines.
document::PlanarCurve curve_of(const CadPart& part) {
  if (const auto* line = std::get_if<CadLine>(&part))
    return {curve::Bezier2{{line->from, line->to}, {}}};
  if (const auto* arc = std::get_if<document::Arc>(&part)) return {document::chain_of(*arc)};
  if (const auto* polyline = std::get_if<curve::Polyline2>(&part)) return {*polyline};
  return {std::get<curve::BSpline2>(part)};
}

Result<Document> simplified(const Document& document, double tolerance, double& deviation,
                            const core::CancellationToken& cancellation) {
  Document result;
  result.unit = document.unit;
  result.surfaces = document.surfaces;
  for (auto& named : result.surfaces) named.trim_loops.clear();
  for (const auto& named : document.paths) {
    if (cancellation.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
    const auto parts = cad_parts(named.path, tolerance);
    if (!parts) return std::unexpected(parts.error());
    deviation = std::max(deviation, parts->deviation);
    // The helper makes one thing of every path: parts that do not meet are paths of their own.
    const bool whole = is_chain(*parts);
    for (const CadPart& part : parts->parts) {
      if (!whole || &part == &parts->parts.front())
        result.paths.push_back({named.label, {{}, named.path.closed}});
      result.paths.back().path.curves.push_back(curve_of(part));
    }
  }
  for (const auto& named : document.space_curves) {
    const auto* chain = std::get_if<lac::SpaceChain>(&named.curve.value);
    if (!chain) {
      result.space_curves.push_back(named);
      continue;
    }
    const auto quintics = lac::approximate_by_quintics(*chain, tolerance);
    deviation = std::max(deviation, quintics.deviation);
    result.space_curves.push_back({named.label, {curve::to_bspline(quintics.pieces).value()}});
  }
  return result;
}

}  // namespace

fs::path cad_program() {
  if (const char* named = std::getenv("KEYLINE_CAD"))
    return is_program(named) ? fs::path(named) : fs::path();
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& candidate :
       {here / "keyline-cad", here.parent_path() / "libexec/keyline/keyline-cad",
        fs::path(KEYLINE_CAD_INSTALLED)})
    if (is_program(candidate)) return candidate;
  return {};
}

ChildLimits cad_limits(std::uintmax_t bytes) {
  ChildLimits limits;
  limits.seconds = 60 + 4e-6 * static_cast<double>(bytes);
  limits.memory = (std::size_t{1} << 30) + 30 * bytes;
  return limits;
}

Result<Document> read_cad(const fs::path& file, CadFormat format,
                          const core::CancellationToken& cancellation) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error)
    return fail(ErrorCode::io, "cannot be read: " + error.message(),
                "check the name and the rights");
  if (bytes > kLargestFile)
    return fail(ErrorCode::bad_input,
                "the file is larger than " + std::to_string(kLargestFile >> 20) + " MB",
                "split it");
  return read_cad(file, format, cad_limits(bytes), cancellation);
}

Result<Document> read_cad(const fs::path& file, CadFormat format, const ChildLimits& limits,
                          const core::CancellationToken& cancellation) {
  const auto child =
      run({"read", name_of(format), fs::absolute(file).string()}, {}, format, limits, cancellation);
  if (!child) return std::unexpected(child.error());
  return read_json(child->output);
}

Result<Written> write_cad(const Document& document, CadFormat format, double tolerance,
                          const core::CancellationToken& cancellation) {
  Written written;
  const auto simple = simplified(document, tolerance, written.deviation, cancellation);
  if (!simple) return std::unexpected(simple.error());
  const std::string text = json_text(*simple, -1);
  auto child = run({"write", name_of(format)}, text, format, cad_limits(text.size()), cancellation);
  if (!child) return std::unexpected(child.error());
  written.content = std::move(child->output);
  return written;
}

}  // namespace keyline::exchange
