#include "keyline/acquire/join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"

namespace keyline::acquire {
namespace {

using Line = std::vector<core::Point2>;

struct Part {
  Line points;
  std::vector<double> weights;  // always as many as points
  std::size_t index = 0;
  bool turned = false;
};

void turn_round(Part& part) {
  std::reverse(part.points.begin(), part.points.end());
  std::reverse(part.weights.begin(), part.weights.end());
  part.turned = !part.turned;
}

double length_of(const Line& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += core::distance(line[i - 1], line[i]);
  return sum;
}

/// Nearest place on a polygon: segment, fraction of it, foot and distance.
struct Foot {
  std::size_t segment = 0;
  double fraction = 0;
  core::Point2 point;
  double distance = std::numeric_limits<double>::infinity();
  double place() const { return static_cast<double>(segment) + fraction; }
};

Foot foot_on(const Line& line, core::Point2 p) {
  Foot best;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const core::Vector2 edge = line[k + 1] - line[k];
    const double u = std::clamp(core::dot(p - line[k], edge) / core::dot(edge, edge), 0.0, 1.0);
    const core::Point2 foot = core::mix(line[k], line[k + 1], u);
    const double d = core::distance(p, foot);
    if (d < best.distance) best = {k, u, foot, d};
  }
  return best;
}

/// Where `next` goes on from `line`: the first point of line beside it and the first of next
/// past the end of line.
struct Overlap {
  bool found = false;
  std::size_t line_from = 0;
  std::size_t next_from = 0;
};

/// An overlap needs the start of next beside line and the end of line beside next, both off the
/// other's ends, by no more than a fiftieth of the shorter part.
Overlap overlap_of(const Line& line, const Line& next) {
  const double near = 0.02 * std::min(length_of(line), length_of(next));
  const Foot start = foot_on(line, next.front());
  const Foot end = foot_on(next, line.back());
  const bool inside = start.place() < static_cast<double>(line.size() - 1) - 1e-9 &&
                      end.place() > 1e-9 &&
                      end.place() < static_cast<double>(next.size() - 1) - 1e-9;
  if (!inside || start.distance > near || end.distance > near) return {};
  return {true, start.segment + 1, end.segment + 1};
}

/// How far apart line and next are as consecutive parts; 0 where they overlap.
double gap_of(const Line& line, const Line& next) {
  return overlap_of(line, next).found ? 0 : core::distance(line.back(), next.front());
}

/// Puts next behind line, averaging an overlap with a weight that passes from line to next.
void append(Part& line, const Part& next, const Overlap& overlap) {
  std::size_t from = 0;
  if (overlap.found) {
    const double total = length_of(
        {line.points.begin() + static_cast<std::ptrdiff_t>(overlap.line_from), line.points.end()});
    double along = 0;
    for (std::size_t i = overlap.line_from; i < line.points.size(); ++i) {
      const core::Point2 given = line.points[i];
      const Foot foot = foot_on(next.points, given);
      const double u = total > 0 ? along / total : 0.5;
      if (i + 1 < line.points.size()) along += core::distance(given, line.points[i + 1]);
      line.points[i] = core::mix(given, foot.point, u);
      line.weights[i] += next.weights[foot.segment];
    }
    from = overlap.next_from;
  }
  const auto skip = static_cast<std::ptrdiff_t>(from);
  line.points.insert(line.points.end(), next.points.begin() + skip, next.points.end());
  line.weights.insert(line.weights.end(), next.weights.begin() + skip, next.weights.end());
}

void put_before(Part& line, const Part& next) {
  Part whole = next;
  append(whole, line, overlap_of(next.points, line.points));
  whole.index = line.index;
  whole.turned = line.turned;
  line = std::move(whole);
}

/// Takes up the part nearest to either end, in the direction that fits, and tells.
void take_nearest(Part& line, std::vector<Part>& rest, AcquireReport& report) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  bool turned = false, before = false;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    for (const bool flip : {false, true}) {
      Part trial = rest[k];
      if (flip) turn_round(trial);
      for (const bool ahead : {false, true}) {
        const double gap =
            ahead ? gap_of(trial.points, line.points) : gap_of(line.points, trial.points);
        if (gap >= least) continue;
        least = gap;
        best = k;
        turned = flip;
        before = ahead;
      }
    }
  }
  Part next = std::move(rest[best]);
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  if (turned) turn_round(next);
  report.notes.push_back("part " + std::to_string(next.index + 1) +
                         (before ? " put before" : " put behind") +
                         (turned ? ", turned round, " : ", ") +
                         (least == 0 ? "overlap averaged" : "gap " + core::number_text(least, 3)));
  if (before) {
    put_before(line, next);
  } else {
    append(line, next, overlap_of(line.points, next.points));
  }
}

/// The plane of all parts together.
core::Result<Plane> common_plane(std::span<const RawCurve> parts, const AcquireOptions& options) {
  if (options.plane) return *options.plane;
  std::vector<core::Point3> all;
  bool space = false;
  for (const RawCurve& part : parts) {
    space = space || part.has_z;
    for (const core::Point3& p : part.points) {
      const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (core::is_finite(p) && size <= core::kLargestCoordinate) all.push_back(p);
    }
  }
  if (all.empty()) {
    return core::fail(core::ErrorCode::bad_input, "there are no points", "give some parts");
  }
  return space ? fit_plane(all).plane : Plane{};
}

void add_counts(AcquireReport& sum, const AcquireReport& part) {
  sum.points_read += part.points_read;
  sum.non_finite += part.non_finite;
  sum.duplicates += part.duplicates;
  sum.outliers += part.outliers;
  sum.apart += part.apart;
  sum.averaged += part.averaged;
  sum.reordered = sum.reordered || part.reordered;
  sum.plane_departure = std::max(sum.plane_departure, part.plane_departure);
  sum.plane_departure_rms = std::max(sum.plane_departure_rms, part.plane_departure_rms);
}

RawCurve raw_of(const Part& part, const Plane& plane, const std::string& id) {
  RawCurve raw;
  raw.id = id;
  raw.has_z = true;
  for (const core::Point2& p : part.points) raw.points.push_back(from_plane(plane, p));
  raw.weights = part.weights;
  return raw;
}

/// The parts acquired one by one in the common plane, and what was said of them.
struct Parts {
  std::vector<Part> lines;
  AcquireReport report;
  double rounding = 0;  ///< the finest
  bool weighted = false;
};

core::Result<Parts> acquire_each(std::span<const RawCurve> parts, const Plane& plane,
                                 const AcquireOptions& options) {
  AcquireOptions open = options;
  open.plane = plane;
  open.closed = false;
  Parts all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string name = "part " + std::to_string(i + 1) + ": ";
    auto line = acquire_key_line(parts[i], open);
    if (!line) {
      line.error().message = name + line.error().message;
      return std::unexpected(line.error());
    }
    add_counts(all.report, line->report);
    for (const std::string& note : line->report.notes) all.report.notes.push_back(name + note);
    all.rounding = i == 0 ? line->rounding : std::min(all.rounding, line->rounding);
    all.weighted = all.weighted || !line->weights.empty();
    if (line->weights.empty()) line->weights.assign(line->points.size(), 1.0);
    all.lines.push_back({std::move(line->points), std::move(line->weights), i, false});
  }
  return all;
}

}  // namespace

core::Result<KeyLine> acquire_joined(std::span<const RawCurve> parts,
                                     const AcquireOptions& options) {
  if (parts.size() == 1) return acquire_key_line(parts[0], options);
  const auto plane = common_plane(parts, options);
  if (!plane) return std::unexpected(plane.error());
  auto each = acquire_each(parts, *plane, options);
  if (!each) return std::unexpected(each.error());
  AcquireReport& report = each->report;
  Part whole = std::move(each->lines.front());
  each->lines.erase(each->lines.begin());
  while (!each->lines.empty()) take_nearest(whole, each->lines, report);

  AcquireOptions final_options = options;
  final_options.plane = *plane;
  final_options.ordered = true;
  RawCurve raw = raw_of(whole, *plane, parts[0].id);
  if (!each->weighted) raw.weights.clear();
  auto joined = acquire_key_line(raw, final_options);
  if (!joined) return joined;
  joined->rounding = each->rounding;
  joined->sources.clear();
  report.notes.insert(report.notes.end(), joined->report.notes.begin(), joined->report.notes.end());
  report.outliers += joined->report.outliers;
  report.duplicates += joined->report.duplicates;
  joined->report = std::move(report);
  return joined;
}

}  // namespace keyline::acquire
