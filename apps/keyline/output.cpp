#include "output.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/analysis/profile.h"
#include "keyline/curve/conversion.h"
#include "keyline/exchange/atomic_file.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/points_writer.h"
#include "keyline/exchange/svg_writer.h"

#include "input.h"

namespace keyline::app {
namespace {

using core::Result;

constexpr int kSamples = 1001;

nlohmann::json exact_json(const std::vector<OutputCurve>& curves) {
  const auto one = [](const document::Path& path) {
    return path.curves.size() == 1 ? exchange::to_json(path.curves.front())
                                   : exchange::to_json(path);
  };
  if (curves.size() == 1) return one(curves.front().path);
  nlohmann::json list = nlohmann::json::array();
  for (const OutputCurve& curve : curves)
    list.push_back({{"name", curve.name}, {"curve", one(curve.path)}});
  return {{"curves", std::move(list)}};
}

Result<std::string> write_csv(const std::vector<OutputCurve>& curves) {
  std::ostringstream out;
  const bool several = curves.size() > 1;
  out << (several ? "id,x,y,arc_length,curvature\n" : "x,y,arc_length,curvature\n");
  for (const OutputCurve& curve : curves) {
    const analysis::CurveView view = analysis::view(curve.path);
    const analysis::ArcLengthTable table(view);
    for (int i = 0; i < kSamples; ++i) {
      const double s = table.length() * i / (kSamples - 1);
      const curve::Jet2 at = jet(view, table.parameter_at(s));
      const double bend = curvature(at);
      if (several) out << curve.name << ',';
      out << exchange::shortest(at.point.x) << ',' << exchange::shortest(at.point.y) << ','
          << exchange::shortest(s) << ',' << (std::isfinite(bend) ? exchange::shortest(bend) : "")
          << '\n';
    }
  }
  return out.str();
}

Result<std::string> write_svg_of(const std::vector<OutputCurve>& curves, double tolerance,
                                 const std::string& unit) {
  std::vector<exchange::SvgLayer> layers;
  double deviation = 0;
  for (const OutputCurve& curve : curves) {
    exchange::SvgPath path{curve.name, {}, false};
    for (const document::PlanarCurve& c : curve.path.curves) {
      auto pieces = std::visit(
          [&](const auto& v) { return curve::approximate_by_cubics(v, tolerance); }, c.value);
      deviation = std::max(deviation, pieces.deviation);
      path.pieces.insert(path.pieces.end(), pieces.pieces.begin(), pieces.pieces.end());
    }
    exchange::SvgLayer layer;
    layer.name = curve.name.empty() ? "key-line" : curve.name;
    layer.paths.push_back(std::move(path));
    layers.push_back(std::move(layer));
  }
  exchange::SvgWriteOptions options;
  options.unit = unit.empty() ? "mm" : unit;
  options.title = fmt::format("Keyline: cubic Beziers within {:.3g} of the exact curve", deviation);
  options.metadata = exact_json(curves).dump();
  return exchange::write_svg(layers, options);
}

}  // namespace

Result<void> check_outputs(const CommonOptions& common, const std::vector<std::string>& known) {
  for (const std::string& file : common.outputs) {
    const std::string extension = extension_of(file);
    if (std::find(known.begin(), known.end(), extension) != known.end()) continue;
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : " ") + name;
    return core::fail(core::ErrorCode::bad_input,
                      "this command does not write \"" + extension + "\"", "use one of " + list,
                      file);
  }
  return {};
}

Result<void> write_outputs(const CommonOptions& common, const Writers& writers) {
  for (const std::string& file : common.outputs) {
    const auto content = writers.at(extension_of(file))();
    if (!content) {
      core::Failure failure = content.error();
      failure.path = failure.path.empty() ? file : file + ": " + failure.path;
      return std::unexpected(std::move(failure));
    }
    if (auto done = exchange::write_atomically(file, *content); !done) {
      core::Failure failure = done.error();
      if (failure.path.empty()) failure.path = file;
      return std::unexpected(std::move(failure));
    }
  }
  return {};
}

Writers curve_writers(const std::vector<OutputCurve>& curves, double tolerance,
                      const std::string& unit) {
  return {{".json", [=]() -> Result<std::string> { return exact_json(curves).dump(1) + "\n"; }},
          {".csv", [=] { return write_csv(curves); }},
          {".svg", [=] { return write_svg_of(curves, tolerance, unit); }}};
}

}  // namespace keyline::app
