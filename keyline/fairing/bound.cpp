#include "keyline/fairing/bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <string>

#include "keyline/core/text.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::fairing {

core::Result<Bound> Bound::from_text(std::string_view text) {
  Bound bound;
  const auto value = text.size() > 3 ? core::parse_number(text.substr(3)) : std::nullopt;
  const std::string_view relation = text.size() > 3 ? text.substr(1, 2) : "";
  const bool axis = text.starts_with('x') || text.starts_with('y');
  if (!axis || !value || (relation != ">=" && relation != "<="))
    return core::fail(core::ErrorCode::bad_input, "\"" + std::string(text) + "\" is no bound",
                      "give " + std::string(kTextForm));
  bound.axis = text.front() == 'x' ? Axis::x : Axis::y;
  (relation == ">=" ? bound.at_least : bound.at_most) = value;
  return bound;
}

core::Result<void> Bound::check(const Bound& bound) {
  if (!bound.at_least && !bound.at_most)
    return core::fail(core::ErrorCode::bad_input, "a bound without a value",
                      "give \"at_least\" or \"at_most\"", "at_least");
  if (bound.at_least && bound.at_most && !(*bound.at_least < *bound.at_most))
    return core::fail(core::ErrorCode::bad_input, "nothing lies between the bounds",
                      "give \"at_least\" below \"at_most\"", "at_most");
  return {};
}

std::vector<core::HalfPlane> half_planes(std::span<const Bound> bounds) {
  std::vector<core::HalfPlane> halves;
  for (const Bound& b : bounds) {
    const core::Vector2 along = b.axis == Axis::x ? core::Vector2{1, 0} : core::Vector2{0, 1};
    if (b.at_least) halves.push_back({along, *b.at_least});
    if (b.at_most) halves.push_back({-along, -*b.at_most});
  }
  return halves;
}

namespace detail {
namespace {

constexpr double kSquare = 0.2;  // cosine between the curve's normal and the border's
constexpr double kAtEnd = 0.01;  // of the length: the end is held, not merely near
// Shares of the way from an end: what is held on a border must not set out beyond it.
constexpr std::array kBesideEnd{0.001, 0.01, 0.05};
constexpr int kWatchers = 5;  // between neighbours: a bend between them shows at one of these
constexpr int kSamples = 48;  // of a piece, before the deepest is looked for
constexpr double kRounding = 1e-12;  // of the length: so little outside is on the border
// Steps that look for the deepest, each of which leaves two thirds: 3e-11 of where they began.
constexpr int kThirds = 60;

/// The points' left normals, from their neighbours.
std::vector<core::Vector2> normals_of(const std::vector<FitPoint>& points, bool closed) {
  const std::size_t n = points.size();
  std::vector<core::Vector2> normals;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t before = j > 0 ? j - 1 : closed ? n - 1 : 0;
    const std::size_t after = j + 1 < n ? j + 1 : closed ? 0 : n - 1;
    const core::Vector2 chord = points[after].position - points[before].position;
    const double size = core::norm(chord);
    normals.push_back(size > 0 ? core::perpendicular_left(chord) / size : core::Vector2{});
  }
  return normals;
}

}  // namespace

std::vector<FitPoint> with_watchers(const std::vector<FitPoint>& points, bool closed,
                                    std::span<const core::HalfPlane> inside, double tolerance) {
  std::vector<FitPoint> result;
  const std::size_t n = points.size();
  for (std::size_t j = 0; j < n; ++j) {
    result.push_back(points[j]);
    if (!closed && j + 1 == n) break;
    const core::Point2 from = points[j].position;
    const core::Point2 to = points[(j + 1) % n].position;
    const double gap = core::distance(from, to);
    const bool near = std::ranges::any_of(inside, [&](const core::HalfPlane& half) {
      return std::min(core::depth(half, from), core::depth(half, to)) < gap;
    });
    if (!near || !(gap > tolerance)) continue;
    const auto watch = [&](double u) {
      result.push_back({.position = core::mix(from, to, u), .count = 0, .share = tolerance / gap});
    };
    if (!closed && j == 0)
      for (const double u : kBesideEnd) watch(u);
    for (int i = 1; i <= kWatchers; ++i) watch(i / (kWatchers + 1.0));
    if (!closed && j + 2 == n)
      for (const double u : std::views::reverse(kBesideEnd)) watch(1 - u);
  }
  return result;
}

void draw_ends_inside(std::vector<FitPoint>& points, std::span<const core::HalfPlane> inside,
                      double tolerance) {
  for (FitPoint* end : {&points.front(), &points.back()})
    for (const core::HalfPlane& half : inside) {
      const double by = -core::depth(half, end->position);
      if (by > 0 && by <= tolerance) end->position = end->position + by * half.normal;
    }
}

void limit_offsets(std::vector<FitPoint>& points, bool closed,
                   std::span<const core::HalfPlane> inside, std::span<const double> margin,
                   std::span<const core::Point2> held) {
  const std::vector<core::Vector2> normals = normals_of(points, closed);
  for (std::size_t j = 0; j < points.size(); ++j) {
    FitPoint& p = points[j];
    p.lowest = -HUGE_VAL;
    p.highest = HUGE_VAL;
    double away = HUGE_VAL;
    for (const core::Point2 end : held) away = std::min(away, core::distance(end, p.position));
    const bool pinned = !held.empty() && (j == 0 || j + 1 == points.size());
    if (pinned && away < kAtEnd) continue;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const double across = core::dot(inside[i].normal, normals[j]);
      if (std::abs(across) < kSquare) continue;
      const double within = std::min(margin[i], 0.5 * away);
      const double limit = p.share * (core::depth(inside[i], p.position) - within) / across;
      if (across > 0) p.highest = std::min(p.highest, limit);
      if (across < 0) p.lowest = std::max(p.lowest, limit);
    }
  }
}

double outside(const lac::Chain& chain, const core::HalfPlane& half) {
  double least = 0;
  for (const lac::Segment& segment : lac::segments(chain)) {
    const auto depth_at = [&](double share) {
      return core::depth(half, lac::pose_at(segment, share).position);
    };
    int deepest = 0;
    std::vector<double> depth(kSamples + 1);
    for (int i = 0; i <= kSamples; ++i) {
      depth[i] = depth_at(static_cast<double>(i) / kSamples);
      if (depth[i] < depth[deepest]) deepest = i;
    }
    double low = std::max(0.0, (deepest - 1.0) / kSamples);
    double high = std::min(1.0, (deepest + 1.0) / kSamples);
    for (int i = 0; i < kThirds; ++i) {
      const double third = (high - low) / 3;
      if (depth_at(low + third) < depth_at(high - third))
        high -= third;
      else
        low += third;
    }
    least = std::min({least, depth[deepest], depth_at(0.5 * (low + high))});
  }
  return -least > kRounding * lac::arc_length(chain) ? -least : 0;
}

}  // namespace detail
}  // namespace keyline::fairing
