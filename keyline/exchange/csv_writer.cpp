#include "keyline/exchange/csv_writer.h"

#include <cmath>

#include "keyline/analysis/profile.h"
#include "keyline/exchange/points_writer.h"

namespace keyline::exchange {
namespace {

/// A name as one field: quoted where it holds a separator.
std::string field(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + '"';
}

void add_row(std::string& text, const std::string& id, const curve::Jet2& at, double s) {
  const double bend = curvature(at);
  text += id + shortest(at.point.x) + ',' + shortest(at.point.y) + ',' + shortest(s) + ',';
  if (std::isfinite(bend)) text += shortest(bend);
  text += '\n';
}

void add_path(std::string& text, const std::string& id, const document::Path& path, int samples) {
  const analysis::CurveView view = analysis::view(path);
  const analysis::ArcLengthTable table(view);
  for (int i = 0; i < samples; ++i) {
    const double s = table.length() * i / (samples - 1);
    add_row(text, id, jet(view, table.parameter_at(s)), s);
  }
}

bool is_polyline(const document::Path& path) {
  return path.curves.size() == 1 &&
         std::holds_alternative<curve::Polyline2>(path.curves.front().value);
}

void add_polyline(std::string& text, const std::string& id, const curve::Polyline2& line) {
  double s = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const core::Point2 p = line.points[i];
    if (i > 0) s += distance(p, line.points[i - 1]);
    text += id + shortest(p.x) + ',' + shortest(p.y) + ',' + shortest(s) + ",\n";
  }
}

void add_space(std::string& text, const std::string& id, const document::SpaceCurve& c,
               int samples) {
  const auto* line = std::get_if<curve::Polyline3>(&c.value);
  const int count = line ? static_cast<int>(line->points.size()) : samples;
  for (int i = 0; i < count; ++i) {
    const core::Point3 p = line ? line->points[static_cast<std::size_t>(i)]
                                : evaluate(c, static_cast<double>(i) / (count - 1));
    text += id + shortest(p.x) + ',' + shortest(p.y) + ',' + shortest(p.z) + '\n';
  }
}

}  // namespace

core::Result<Written> write_csv(const document::Document& document, int samples) {
  Written written;
  const bool several = document.paths.size() + document.space_curves.size() > 1;
  const auto id = [several](const document::Label& label) {
    return several ? field(label.name) + ',' : std::string();
  };
  if (document.paths.empty() && document.space_curves.empty())
    return core::fail(core::ErrorCode::bad_input, "there is no curve to write as points",
                      "choose a format that holds surfaces");
  if (!document.surfaces.empty())
    written.notes.push_back(std::to_string(document.surfaces.size()) +
                            " surfaces are not in the table");
  std::string& text = written.content;
  if (document.paths.empty()) {
    text = several ? "id,x,y,z\n" : "x,y,z\n";
    for (const auto& named : document.space_curves)
      add_space(text, id(named.label), named.curve, samples);
    return written;
  }
  text = several ? "id,x,y,arc_length,curvature\n" : "x,y,arc_length,curvature\n";
  for (const auto& named : document.paths) {
    if (is_polyline(named.path))
      add_polyline(text, id(named.label),
                   std::get<curve::Polyline2>(named.path.curves.front().value));
    else
      add_path(text, id(named.label), named.path, samples);
  }
  if (!document.space_curves.empty())
    written.notes.push_back(std::to_string(document.space_curves.size()) +
                            " space curves are not in the table: its rows are planar");
  return written;
}

}  // namespace keyline::exchange
