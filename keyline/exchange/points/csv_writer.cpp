#include "keyline/exchange/points/csv_writer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "keyline/analysis/profile.h"
#include "keyline/analysis/split.h"
#include "keyline/core/text.h"
#include "keyline/exchange/points/points_writer.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange {
namespace {

/// A name as one field: quoted where it holds a separator, or where a row that begins with it were
/// read as something else, a comment, a statement ("sep=;"), or without its blanks.
std::string field(const std::string& name) {
  const bool plain = name.find_first_of(",\"=") == std::string::npos && !detail::is_comment(name) &&
                     detail::trimmed(name) == name;
  if (plain) return name;
  std::string quoted = "\"";
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Without a curvature where that has two values, or none.
void add_row(std::string& text, const std::string& id, core::Point2 p, double s, double bend) {
  text += id + shortest(p.x) + ',' + shortest(p.y) + ',' + shortest(s) + ',';
  if (std::isfinite(bend)) text += shortest(bend);
  text += '\n';
}

/// How far the straight line between two samples is from the curve between them, seen at places in
/// between.
template <class Point, class At>
double sagitta(Point a, Point b, double from, double to, At&& at) {
  constexpr int kBetween = 4;
  double most = 0;
  const double length = distance(a, b);
  for (int i = 1; i < kBetween; ++i) {
    const Point p = at(from + (to - from) * i / kBetween);
    const double along =
        length > 0 ? std::clamp(dot(p - a, b - a) / (length * length), 0.0, 1.0) : 0;
    most = std::max(most, distance(p, a + along * (b - a)));
  }
  return most;
}

/// Arc lengths of the corners between the ends.
std::vector<double> corners_of(const analysis::CurveView& view,
                               const analysis::ArcLengthTable& table) {
  std::vector<double> corners;
  for (const double t : view.breaks())
    if (t > 0 && t < 1 && analysis::is_corner(view, t)) corners.push_back(table.length_at(t));
  return corners;
}

/// Arc lengths of that many samples: the corners, and between them equal steps, as nearly as comes
/// out the same for all of them. More where there are more corners.
std::vector<double> places_of(const std::vector<double>& corners, double length, int samples) {
  std::vector<double> places{0};
  double from = 0;
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const double to = i < corners.size() ? corners[i] : length;
    const double done = static_cast<double>(places.size() - 1);
    const double share = from < length ? (to - from) / (length - from) : 1;
    const int steps = std::max(1, static_cast<int>(std::lround(share * (samples - 1 - done))));
    for (int k = 1; k < steps; ++k) places.push_back(from + (to - from) * k / steps);
    places.push_back(to);
    from = to;
  }
  return places;
}

/// Samples along the arc length, corners among them. Returns how far the polygon through them is
/// off.
double add_path(std::string& text, const std::string& id, const document::Path& path, int samples) {
  const analysis::CurveView view = analysis::view(path);
  const analysis::ArcLengthTable table(view);
  const std::vector<double> corners = corners_of(view, table);
  double deviation = 0;
  double last_parameter = 0;
  core::Point2 last;
  for (const double s : places_of(corners, table.length(), samples)) {
    const double parameter = table.parameter_at(s);
    const curve::Jet2 at = jet(view, parameter);
    const bool corner = std::ranges::binary_search(corners, s);
    add_row(text, id, at.point, s, corner ? NAN : curvature(at));
    if (s > 0)
      deviation = std::max(deviation, sagitta(last, at.point, last_parameter, parameter,
                                              [&](double t) { return jet(view, t).point; }));
    last = at.point;
    last_parameter = parameter;
  }
  return deviation;
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
    add_row(text, id, p, s, NAN);
  }
}

void add_row(std::string& text, const std::string& id, core::Point3 p) {
  text += id + shortest(p.x) + ',' + shortest(p.y) + ',' + shortest(p.z) + '\n';
}

/// Samples at equal steps of the parameter, or the points of a polyline. Returns as add_path().
template <class Curve, class At>
double add_space(std::string& text, const std::string& id, const Curve* line, int samples,
                 At&& at) {
  const int count = line ? static_cast<int>(line->points.size()) : samples;
  double deviation = 0;
  core::Point3 last;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    const core::Point3 p = at(t, i);
    add_row(text, id, p);
    if (i > 0 && !line)
      deviation = std::max(deviation, sagitta(last, p, t - 1.0 / (count - 1), t,
                                              [&](double u) { return at(u, 0); }));
    last = p;
  }
  return deviation;
}

double add_space(std::string& text, const std::string& id, const document::SpaceCurve& c,
                 int samples) {
  const auto* line = std::get_if<curve::Polyline3>(&c.value);
  return add_space(text, id, line, samples, [&](double t, int i) {
    return line ? line->points[static_cast<std::size_t>(i)] : evaluate(c, t);
  });
}

/// A planar path among space curves: z = 0.
double add_lifted(std::string& text, const std::string& id, const document::Path& path,
                  int samples) {
  const auto* line =
      is_polyline(path) ? &std::get<curve::Polyline2>(path.curves.front().value) : nullptr;
  const document::PlacedPath placed = prepared(path);
  return add_space(text, id, line, samples, [&](double t, int i) {
    const core::Point2 p = line ? line->points[static_cast<std::size_t>(i)] : evaluate(placed, t);
    return core::Point3{p.x, p.y, 0};
  });
}

/// What tells the curves of a table apart: their names, numbered where one stands twice.
class Ids {
 public:
  std::string next(const std::string& given) {
    const std::string name = core::on_one_line(given);
    parted_ = parted_ || name != given;
    std::string id = name;
    for (int number = 2; !used_.insert(id).second; ++number) {
      again_ = true;
      id = (name.empty() ? "curve" : name) + '#' + std::to_string(number);
    }
    return id;
  }

  void tell(std::vector<std::string>& notes) const {
    if (again_)
      notes.emplace_back(
          "curves of one name are numbered in the table, as in \"wing#2\"; else they were one");
    if (parted_)
      notes.emplace_back("names of curves have blanks in the table for their line breaks and tabs");
  }

 private:
  std::set<std::string> used_;
  bool again_ = false;
  bool parted_ = false;
};

}  // namespace

core::Result<Written> write_csv(const document::Document& document, int samples) {
  Written written;
  const bool several = document.paths.size() + document.space_curves.size() > 1;
  Ids ids;
  const auto id = [&](const document::Label& label) {
    return several ? field(ids.next(label.name)) + ',' : std::string();
  };
  if (document.paths.empty() && document.space_curves.empty())
    return core::fail(core::ErrorCode::bad_input, "there is no curve to write as points",
                      kHoldSurfaces);
  if (!document.surfaces.empty())
    written.notes.push_back(core::counted(document.surfaces.size(), "surface is", "surfaces are") +
                            " not in the table");
  const auto take = [&](double off) { written.deviation = std::max(written.deviation, off); };
  std::string& text = written.content;
  if (!document.space_curves.empty()) {
    text = several ? "id,x,y,z\n" : "x,y,z\n";
    for (const auto& named : document.paths)
      take(add_lifted(text, id(named.label), named.path, samples));
    for (const auto& named : document.space_curves)
      take(add_space(text, id(named.label), named.curve, samples));
    ids.tell(written.notes);
    return written;
  }
  text = several ? "id,x,y,arc_length,curvature\n" : "x,y,arc_length,curvature\n";
  for (const auto& named : document.paths) {
    if (is_polyline(named.path))
      add_polyline(text, id(named.label),
                   std::get<curve::Polyline2>(named.path.curves.front().value));
    else
      take(add_path(text, id(named.label), named.path, samples));
  }
  ids.tell(written.notes);
  return written;
}

}  // namespace keyline::exchange
