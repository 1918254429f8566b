#include "keyline/exchange/cad/cad_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/curve/conversion.h"
#include "keyline/lac/cad/cad.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using core::Result;
using curve::Bezier2;
using document::Arc;

constexpr double kSmooth = 1e-6;  // rad

bool goes_on(const Bezier2& a, const Bezier2& b) {
  if (a.control.back() != b.control.front()) return false;
  const core::Vector2 out = jet(a, 1).first;
  const core::Vector2 in = jet(b, 0).first;
  return norm(out) > 0 && norm(in) > 0 && std::abs(core::angle_between(out, in)) < kSmooth;
}

class Parts {
 public:
  explicit Parts(double tolerance) : tolerance_(tolerance) {}

  Result<void> add(const document::PlanarCurve& c) {
    if (const auto* bezier = std::get_if<Bezier2>(&c.value)) {
      add(*bezier);
      return {};
    }
    flush();
    if (const auto* chain = std::get_if<lac::Chain>(&c.value)) return add(*chain);
    if (const auto* line = std::get_if<curve::Polyline2>(&c.value)) add(*line);
    if (const auto* spline = std::get_if<curve::BSpline2>(&c.value))
      made_.parts.emplace_back(*spline);
    return {};
  }

  CadParts finish() {
    flush();
    return std::move(made_);
  }

 private:
  void add(const Bezier2& c) {
    if (document::is_line(c)) {
      flush();
      if (c.control[0] != c.control[1])
        made_.parts.emplace_back(CadLine{c.control[0], c.control[1]});
    } else if (const auto arc = document::as_arc(c)) {
      flush();
      add(*arc);
    } else {
      if (!smooth_.empty() && !goes_on(smooth_.back(), c)) flush();
      smooth_.push_back(c);
    }
  }

  void add(const Arc& arc) {
    Arc* last = made_.parts.empty() ? nullptr : std::get_if<Arc>(&made_.parts.back());
    if (last)
      if (const auto whole = document::joined(*last, arc)) {
        *last = *whole;
        return;
      }
    made_.parts.emplace_back(arc);
  }

  void add(const curve::Polyline2& c) {
    curve::Polyline2 line;
    for (const Point2 p : c.points)
      if (line.points.empty() || line.points.back() != p) line.points.push_back(p);
    if (line.points.size() == 2) made_.parts.emplace_back(CadLine{line.points[0], line.points[1]});
    if (line.points.size() > 2) made_.parts.emplace_back(std::move(line));
  }

  Result<void> add(const lac::Chain& chain) {
    lac::Chain run;
    for (const lac::Segment& segment : lac::segments(chain)) {
      const auto arc = document::as_arc(segment);
      const bool line = document::is_line(segment);
      if (!arc && !line) {
        if (run.pieces.empty()) run.start = segment.start;
        run.pieces.push_back(lac::piece_of(segment));
        continue;
      }
      if (auto done = add_run(run); !done) return done;
      if (line)
        made_.parts.emplace_back(CadLine{segment.start.position, lac::end_pose(segment).position});
      else
        add(*arc);
    }
    return add_run(run);
  }

  Result<void> add_run(lac::Chain& run) {
    if (run.pieces.empty()) return {};
    const auto spline = lac::to_bspline(run, {.degree = 3, .tolerance = tolerance_});
    if (!spline) return std::unexpected(spline.error());
    made_.deviation = std::max(made_.deviation, spline->deviation);
    made_.parts.emplace_back(spline->curve);
    run = {};
    return {};
  }

  void flush() {
    if (smooth_.empty()) return;
    made_.parts.emplace_back(curve::to_bspline(smooth_, 0).value());
    smooth_.clear();
  }

  double tolerance_;
  CadParts made_;
  std::vector<Bezier2> smooth_;
};

/// Points of a cubic at even steps, so many that the polygon stays within the tolerance.
void flatten(BulgedPolyline& line, const Bezier2& c, double tolerance) {
  const auto& p = c.control;
  double bend = 0;
  for (std::size_t i = 0; i + 2 < p.size(); ++i)
    bend = std::max(bend, norm((p[i + 2] - p[i + 1]) - (p[i + 1] - p[i])));
  const double n = static_cast<double>(p.size() - 1);
  const double second = n * (n - 1) * bend;
  const double wanted = std::ceil(std::sqrt(second / (8 * tolerance)));
  const int count = static_cast<int>(std::clamp(wanted, 1.0, 1e6));
  line.deviation = std::max(line.deviation, second / (8.0 * count * count));
  for (int i = 1; i <= count; ++i)
    line.vertices.push_back(
        {i == count ? p.back() : evaluate(c, static_cast<double>(i) / count), 0});
}

void start_at(BulgedPolyline& line, Point2 p) {
  if (line.vertices.empty()) line.vertices.push_back({p, 0});
}

void add_part(BulgedPolyline& line, const CadLine& part, double) {
  start_at(line, part.from);
  line.vertices.push_back({part.to, 0});
}

/// In halves: the bulge of a whole turn would be infinite.
void add_part(BulgedPolyline& line, const Arc& arc, double) {
  start_at(line, document::point_on(arc, arc.start));
  const int count = std::abs(arc.turn) > core::kPi ? 2 : 1;
  for (int i = 1; i <= count; ++i) {
    line.vertices.back().bulge = std::tan(arc.turn / count / 4);
    line.vertices.push_back({document::point_on(arc, arc.start + arc.turn * i / count), 0});
  }
}

void add_part(BulgedPolyline& line, const curve::Polyline2& part, double) {
  start_at(line, part.points.front());
  for (std::size_t i = 1; i < part.points.size(); ++i) line.vertices.push_back({part.points[i], 0});
}

void add_part(BulgedPolyline& line, const curve::BSpline2& part, double tolerance) {
  const auto cubics = curve::approximate_by_cubics(part, tolerance / 2);
  start_at(line, cubics.pieces.front().control.front());
  double flat = std::exchange(line.deviation, 0);
  for (const Bezier2& piece : cubics.pieces) flatten(line, piece, tolerance / 2);
  line.deviation = std::max(flat, line.deviation + cubics.deviation);
}

/// Pieces of a chain without weights.
class ChainPieces {
 public:
  explicit ChainPieces(double tolerance) : tolerance_(tolerance) {}

  void add(const CadLine& line) { pieces_.push_back({{line.from, line.to}, {}}); }
  void add(const curve::Polyline2& line) {
    for (std::size_t i = 1; i < line.points.size(); ++i)
      pieces_.push_back({{line.points[i - 1], line.points[i]}, {}});
  }
  void add(const Arc& arc) {
    const lac::Chain chain = document::chain_of(arc);
    take(curve::approximate_by_cubics(chain, tolerance_));
  }
  void add(const curve::BSpline2& spline) {
    if (!spline.weights.empty()) return take(curve::approximate_by_cubics(spline, tolerance_));
    for (Bezier2& piece : curve::to_beziers(spline)) pieces_.push_back(std::move(piece));
  }

  /// Joints that rounding left apart are drawn together.
  ChainSpline finish() {
    for (std::size_t i = 1; i < pieces_.size(); ++i)
      pieces_[i].control.front() = pieces_[i - 1].control.back();
    return {curve::to_bspline(pieces_, 0).value(), deviation_};
  }

 private:
  void take(const curve::PiecewiseBezier& cubics) {
    deviation_ = std::max(deviation_, cubics.deviation);
    pieces_.insert(pieces_.end(), cubics.pieces.begin(), cubics.pieces.end());
  }

  double tolerance_;
  double deviation_ = 0;
  std::vector<Bezier2> pieces_;
};

}  // namespace

Point2 start_of(const CadPart& part) {
  if (const auto* line = std::get_if<CadLine>(&part)) return line->from;
  if (const auto* arc = std::get_if<Arc>(&part)) return document::point_on(*arc, arc->start);
  if (const auto* line = std::get_if<curve::Polyline2>(&part)) return line->points.front();
  return evaluate(std::get<curve::BSpline2>(part), 0);
}

Point2 end_of(const CadPart& part) {
  if (const auto* line = std::get_if<CadLine>(&part)) return line->to;
  if (const auto* arc = std::get_if<Arc>(&part))
    return document::point_on(*arc, arc->start + arc->turn);
  if (const auto* line = std::get_if<curve::Polyline2>(&part)) return line->points.back();
  return evaluate(std::get<curve::BSpline2>(part), 1);
}

bool is_chain(const CadParts& parts) {
  if (parts.parts.size() < 2) return false;
  const Point2 first = start_of(parts.parts.front());
  double size = 0;
  for (const CadPart& part : parts.parts)
    size = std::max({size, distance(first, start_of(part)), distance(first, end_of(part))});
  for (std::size_t i = 1; i < parts.parts.size(); ++i)
    if (distance(end_of(parts.parts[i - 1]), start_of(parts.parts[i])) > 1e-9 * size) return false;
  return true;
}

bool is_bulged(const CadParts& parts) {
  return std::none_of(parts.parts.begin(), parts.parts.end(), [](const CadPart& part) {
    return std::holds_alternative<curve::BSpline2>(part);
  });
}

ChainSpline chain_spline(const CadParts& parts, double tolerance) {
  ChainPieces pieces(tolerance);
  for (const CadPart& part : parts.parts) std::visit([&](const auto& p) { pieces.add(p); }, part);
  ChainSpline spline = pieces.finish();
  spline.deviation += parts.deviation;
  return spline;
}

Result<CadParts> cad_parts(const document::Path& path, double tolerance) {
  Parts parts(tolerance);
  for (const document::PlanarCurve& c : path.curves)
    if (auto done = parts.add(c); !done) return std::unexpected(done.error());
  return parts.finish();
}

BulgedPolyline bulged_polyline(const CadParts& parts, bool closed, double tolerance) {
  BulgedPolyline line;
  for (const CadPart& part : parts.parts)
    std::visit([&](const auto& p) { add_part(line, p, tolerance); }, part);
  line.deviation += parts.deviation;
  auto& v = line.vertices;
  double size = 0;
  for (const auto& vertex : v) size = std::max(size, distance(vertex.point, v.front().point));
  line.closed = closed && v.size() > 2;
  if (line.closed && distance(v.front().point, v.back().point) <= 1e-9 * size) v.pop_back();
  return line;
}

}  // namespace keyline::exchange
