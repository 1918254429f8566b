#include "keyline/operations/fair_request.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "keyline/acquire/acquire.h"
#include "keyline/analysis/profile.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/spline_search.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

constexpr int kCurveSamples = 801;

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<fairing::Clamp> clamp_named(std::string_view text) {
  if (text == "G0") return fairing::Clamp::g0;
  if (text == "G1") return fairing::Clamp::g1;
  if (text == "G2") return fairing::Clamp::g2;
  if (text == "none") return fairing::Clamp::none;
  return std::nullopt;
}

Result<void> read_texts(const json& request, fairing::FairOptions& options) {
  if (request.contains("clamp"))
    if (auto done = parse_clamp(string_or(request, "clamp", ""), options); !done) return done;
  if (request.contains("region")) {
    const json& region = request["region"];
    if (region.is_array() && region.size() == 2 && region[0].is_number() && region[1].is_number())
      options.region = core::Interval{region[0].get<double>(), region[1].get<double>()};
    else if (region.is_string()) {
      const auto parsed = parse_region(region.get<std::string>());
      if (!parsed) return std::unexpected(parsed.error());
      options.region = *parsed;
    } else
      return fail(ErrorCode::bad_input, "a part of the length is wanted here",
                  "give [a, b] with 0 <= a < b <= 1", "region");
  }
  if (!request.contains("interpretation")) return {};
  json list = request["interpretation"];
  if (list.is_string()) list = json::array({list});
  if (!list.is_array())
    return fail(ErrorCode::bad_input, "a list of readings is wanted here",
                "give for example [\"2:arc\"]", "interpretation");
  for (const json& item : list) {
    if (!item.is_string())
      return fail(ErrorCode::bad_input, "a reading is not a string", "give for example \"2:arc\"",
                  "interpretation");
    auto parsed = parse_interpretation(item.get<std::string>());
    if (!parsed) return std::unexpected(parsed.error());
    options.interpretations.push_back(*parsed);
  }
  return {};
}

}  // namespace

Result<void> parse_clamp(const std::string& text, fairing::FairOptions& options) {
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::string part = text.substr(from, to - from);
    const std::size_t colon = part.find(':');
    const auto clamp = clamp_named(
        colon == std::string::npos ? std::string_view{} : std::string_view(part).substr(colon + 1));
    const std::string end = part.substr(0, colon);
    if (!clamp || (end != "start" && end != "end"))
      return fail(ErrorCode::bad_input, "\"" + part + "\" is no clamp",
                  "give start:G0, start:G1, start:G2, end:G0, end:G1 or end:G2", "clamp");
    (end == "start" ? options.clamp_start : options.clamp_end) = *clamp;
    from = to + 1;
  }
  return {};
}

Result<core::Interval> parse_region(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto low = number_in(std::string_view(text).substr(0, colon));
  const auto high = colon == std::string::npos
                        ? std::nullopt
                        : number_in(std::string_view(text).substr(colon + 1));
  if (!low || !high || !(0 <= *low && *low < *high && *high <= 1))
    return fail(ErrorCode::bad_input, "\"" + text + "\" is no part of the length",
                "give a:b with 0 <= a < b <= 1", "region");
  return core::Interval{*low, *high};
}

Result<fairing::InterpretationOverride> parse_interpretation(const std::string& text) {
  const auto wrong = [&] {
    return fail(ErrorCode::bad_input, "\"" + text + "\" is no reading of a piece",
                "give PIECE:RHYTHM with straight, arc, minus, zero, plus, plus+minus or "
                "minus+plus, or PIECE:slope=NUMBER",
                "interpretation");
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return wrong();
  const auto piece = number_in(std::string_view(text).substr(0, colon));
  if (!piece || *piece != std::floor(*piece) || *piece < 0 || *piece > 1e6) return wrong();
  fairing::InterpretationOverride asked;
  asked.piece = static_cast<int>(*piece);
  const std::string what = text.substr(colon + 1);
  if (what.starts_with("slope=")) {
    asked.slope = number_in(std::string_view(what).substr(6));
    if (!asked.slope) return wrong();
    return asked;
  }
  asked.rhythm = analysis::parse_rhythm(what);
  if (!asked.rhythm) return wrong();
  return asked;
}

Result<fairing::FairOptions> fair_options(const json& request, const Context& context) {
  fairing::FairOptions options;
  const auto tolerance = positive_number(request, "tolerance");
  if (!tolerance) return std::unexpected(tolerance.error());
  options.tolerance = tolerance->value_or(0);
  const auto pieces = integer_between(request, "pieces", 0, 0, 400);
  if (!pieces) return std::unexpected(pieces.error());
  options.pieces = *pieces;
  if (auto done = read_spline_search(request, {4, 6}, options.spline); !done)
    return std::unexpected(done.error());
  options.keep_corners = boolean_or(request, "keep_corners", true);
  options.seed = static_cast<std::uint64_t>(integer_or(request, "seed", 1));
  for (const double index : numbers_of(request, "must_pass")) {
    if (index < 0 || index != std::floor(index))
      return fail(ErrorCode::bad_input, "an index is not a whole number",
                  "give indices of points, from 0", "must_pass");
    options.must_pass.push_back(static_cast<std::size_t>(index));
  }
  if (auto done = read_texts(request, options); !done) return std::unexpected(done.error());
  options.threads = context.threads;
  options.progress = context.progress;
  return options;
}

Result<acquire::KeyLine> key_line_of(const document::Path& path) {
  const analysis::CurveView view = analysis::view(path);
  const analysis::ArcLengthTable table(view);
  const double length = table.length();
  if (!(length > 0) || !std::isfinite(length))
    return fail(ErrorCode::bad_input, "the curve has no length", "give a curve with extent",
                "curve");
  acquire::KeyLine line;
  line.length = length;
  line.closed = path.closed && core::distance(evaluate(path, 0), evaluate(path, 1)) < 1e-6 * length;
  const int n = std::max<int>(kCurveSamples, 40 * static_cast<int>(path.curves.size()) + 1);
  std::vector<double> corners;
  const analysis::ContinuityTolerance smooth{1e-6 * length, 0.02, 1e-3, 1e-2};
  if (line.closed && analysis::continuity({view}, true, smooth).back().order == 0)
    corners.push_back(0);
  const auto joints = analysis::inner_continuity(view, smooth);
  const auto breaks = breakpoints(path);
  for (std::size_t k = 0; k < joints.size() && k + 2 < breaks.size() + 1; ++k)
    if (joints[k].order == 0) corners.push_back(table.length_at(breaks[k + 1]));
  std::vector<double> at;
  for (int i = 0; i < n; ++i) at.push_back(length * i / (n - 1));
  at.insert(at.end(), corners.begin(), corners.end());
  std::sort(at.begin(), at.end());
  for (const double s : at) {
    const core::Point2 p = evaluate(path, table.parameter_at(s));
    if (!line.points.empty() && core::distance(line.points.back(), p) < 1e-9 * length) continue;
    line.points.push_back(p);
    const bool corner = std::any_of(corners.begin(), corners.end(),
                                    [&](double c) { return std::abs(c - s) < 1e-9 * length; });
    if (corner) line.corners.push_back(line.points.size() - 1);
  }
  if (line.closed) line.points.pop_back();
  return line;
}

Result<acquire::KeyLine> key_line_of(const json& request) {
  const bool by_points = request.contains("points");
  if (by_points == request.contains("curve"))
    return fail(ErrorCode::bad_input, "either \"points\" or \"curve\" is wanted",
                "give one of the two", "points");
  if (!by_points) return key_line_of(path_of(request, "curve"));
  acquire::RawCurve raw;
  for (const core::Point2 p : points_of(request, "points")) raw.points.push_back({p.x, p.y, 0});
  raw.weights = numbers_of(request, "weights");
  acquire::AcquireOptions options;
  if (request.contains("closed")) options.closed = boolean_or(request, "closed", false);
  if (const auto noise = optional_number(request, "noise")) options.noise = noise;
  if (request.contains("must_pass")) {
    // Indices must keep their meaning: nothing is dropped or put in another order.
    options.ordered = true;
    options.remove_outliers = false;
  }
  return acquire::acquire_key_line(raw, options);
}

document::Path fair_curve(const fairing::FairResult& result) {
  document::Path path{{}, result.closed};
  for (const auto& c : result.curves)
    path.curves.push_back(std::visit([](const auto& v) { return document::PlanarCurve{v}; }, c));
  return path;
}

}  // namespace keyline::operations
