#include "keyline/document/closest_point.h"

#include <cmath>

#include "keyline/lac/chain/closest_point.h"

namespace keyline::document {

using core::Point2;
using curve::Box2;
using curve::ClosestPoint;

/// The spans of the path's members, member after member.
struct ClosestSearch::Gather {
  std::vector<Span>& spans;
  double low;  ///< of the member, of the path's parameter
  double size;

  void add(auto value, double from, double to) const {
    spans.push_back({std::move(value), low + size * from, low + size * to});
  }
  void operator()(const curve::Polyline2& c) const {
    const auto edges = static_cast<double>(c.points.size() - 1);
    for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
      const auto at = static_cast<double>(i);
      add(Edge{c.points[i], c.points[i + 1]}, at / edges, (at + 1) / edges);
    }
  }
  void operator()(const curve::Bezier2& c) const { add(c, 0, 1); }
  void operator()(const curve::BSpline2& c) const {
    const auto pieces = to_beziers(c);
    const auto breaks = curve::breakpoints(c);
    if (breaks.size() != pieces.size() + 1) {  // knots too close for the parameter to tell apart
      add(c, 0, 1);
      return;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) add(pieces[i], breaks[i], breaks[i + 1]);
  }
  void operator()(const lac::Chain& c) const {
    const double whole = lac::arc_length(c);
    double before = 0;
    for (const lac::Segment& s : lac::segments(c)) {
      add(s, before / whole, (before + s.length) / whole);
      before += s.length;
    }
  }
};

namespace {

struct BoxOf {
  template <class C>
  Box2 operator()(const C& c) const {
    if constexpr (requires { c.from; })
      return curve::united(Box2{c.from, c.from}, c.to);
    else
      return curve::bounding_box(c);
  }
  /// Around the ellipse of those places whose distances from both ends make the length.
  Box2 operator()(const lac::Segment& s) const {
    const Point2 a = s.start.position;
    const Point2 b = evaluate(s, 1);
    const core::Vector2 half = 0.5 * (b - a);
    const double across = std::max(0.25 * s.length * s.length - dot(half, half), 0.0);
    const core::Vector2 reach{std::sqrt(half.x * half.x + across),
                              std::sqrt(half.y * half.y + across)};
    const double rounding = 1e-12 * s.length;
    const core::Vector2 room = reach + core::Vector2{rounding, rounding};
    return {mix(a, b, 0.5) - room, mix(a, b, 0.5) + room};
  }
};

}  // namespace

/// Of one span, in its own parameter.
struct ClosestSearch::Nearest {
  Point2 p;
  template <class C>
  ClosestPoint operator()(const C& c) const {
    return closest_point(c, p);
  }
  ClosestPoint operator()(const Edge& e) const {
    return closest_point(curve::Polyline2{{e.from, e.to}}, p);
  }
};

std::vector<Box2> ClosestSearch::boxes_of(const std::vector<Span>& spans) {
  std::vector<Box2> boxes;
  for (const Span& span : spans) boxes.push_back(std::visit(BoxOf{}, span.value));
  return boxes;
}

ClosestSearch::ClosestSearch(const Path& path)
    : spans_([&] {
        std::vector<Span> spans;
        const auto n = static_cast<double>(path.curves.size());
        for (std::size_t i = 0; i < path.curves.size(); ++i)
          std::visit(Gather{spans, static_cast<double>(i) / n, 1 / n}, path.curves[i].value);
        return spans;
      }()),
      tree_(boxes_of(spans_)) {}

ClosestPoint ClosestSearch::operator()(Point2 p) const {
  ClosestPoint best{0, {}, std::numeric_limits<double>::infinity()};
  tree_.visit(p, best.distance, [&](std::size_t i) {
    const Span& span = spans_[i];
    ClosestPoint found = std::visit(Nearest{p}, span.value);
    found.t = std::min((1 - found.t) * span.low + found.t * span.high, 1.0);
    if (found.distance < best.distance || (found.distance == best.distance && found.t < best.t))
      best = found;
  });
  return best;
}

}  // namespace keyline::document
