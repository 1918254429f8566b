#include "keyline/surface/continuity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "keyline/core/axis.h"
#include "keyline/numeric/newton_bracket.h"
#include "keyline/surface/curvature.h"
#include "keyline/surface/stripe_turn.h"

namespace keyline::surface {

using core::cross;
using core::dot;
using core::ErrorCode;
using core::fail;
using core::norm;
using core::Point3;
using core::Result;
using core::Vector3;

namespace {

constexpr std::array<Edge, 4> kEdges{Edge::u0, Edge::u1, Edge::v0, Edge::v1};
constexpr int kCoarse = 64;

bool is_u_edge(Edge e) { return e == Edge::u0 || e == Edge::u1; }

SurfaceJet jet_at(const Surface& s, Edge e, double along) {
  const auto [u, v] = edge_parameters(e, along);
  return jet(s, u, v);
}

struct EdgeJet {
  Point3 point;
  Vector3 first, second;  ///< by `along`
};

EdgeJet edge_jet(const Surface& s, Edge e, double along) {
  const SurfaceJet j = jet_at(s, e, along);
  return is_u_edge(e) ? EdgeJet{j.point, j.v, j.vv} : EdgeJet{j.point, j.u, j.uu};
}

/// Nearest place of an edge, from samples and Newton's method on the squared distance.
class EdgeProjection {
 public:
  EdgeProjection(const Surface& s, Edge e) : surface_(s), edge_(e) {
    for (int i = 0; i <= kCoarse; ++i)
      points_.push_back(edge_jet(s, e, static_cast<double>(i) / kCoarse).point);
  }

  double nearest(const Point3& p) const {
    int best = 0;
    for (int i = 1; i <= kCoarse; ++i)
      if (core::distance(points_[i], p) < core::distance(points_[best], p)) best = i;
    numeric::NewtonBracket between{std::max(best - 1, 0) / static_cast<double>(kCoarse),
                                   std::min(best + 1, kCoarse) / static_cast<double>(kCoarse)};
    double t = best / static_cast<double>(kCoarse);
    for (int step = 0; step < 60 && between.high - between.low > 1e-15; ++step) {
      const EdgeJet j = edge_jet(surface_, edge_, t);
      const Vector3 d = j.point - p;
      const double bend = dot(j.first, j.first) + dot(d, j.second);
      const double next = between.next(t, dot(d, j.first), bend);
      if (std::abs(next - t) < 1e-15) break;
      t = next;
    }
    return t;
  }

 private:
  const Surface& surface_;
  Edge edge_;
  std::vector<Point3> points_;
};

/// Frame at an edge: along it, out of the surface (or into it), and the normal of the two.
struct EdgeFrame {
  Vector3 along, across, normal;
};

/// `out`: across points out of the surface, else into it.
std::optional<EdgeFrame> edge_frame(const SurfaceJet& j, Edge e, bool out) {
  if (!frame_of(j)) return std::nullopt;
  const Vector3 t = is_u_edge(e) ? j.v : j.u;
  Vector3 inwards = is_u_edge(e) ? j.u : j.v;
  if (e == Edge::u1 || e == Edge::v1) inwards = -inwards;
  const Vector3 along = t / norm(t);
  const Vector3 w = inwards - dot(inwards, along) * along;
  const Vector3 across = (out ? -1.0 : 1.0) * w / norm(w);
  return EdgeFrame{along, across, cross(along, across)};
}

/// d(curvature)/ds of the normal section along f.across: third derivative of the height over the
/// tangent plane, in parameters for which the two tangential coordinates are linear.
double section_rate(const SurfaceJet& j, const EdgeFrame& f) {
  const double a = dot(j.u, f.across);
  const double b = dot(j.u, f.along);
  const double c = dot(j.v, f.across);
  const double d = dot(j.v, f.along);
  const double det = a * d - b * c;
  const auto parameters = [&](double x, double y) {  // J [du, dv] = (x across + y along)
    return std::array{(d * x - c * y) / det, (a * y - b * x) / det};
  };
  const auto [u1, v1] = parameters(1, 0);
  const Vector3 bend = u1 * u1 * j.uu + 2 * u1 * v1 * j.uv + v1 * v1 * j.vv;
  const auto [u2, v2] = parameters(-dot(bend, f.across), -dot(bend, f.along));
  const Vector3 third = u1 * u1 * u1 * j.uuu + 3 * u1 * u1 * v1 * j.uuv + 3 * u1 * v1 * v1 * j.uvv +
                        v1 * v1 * v1 * j.vvv +
                        3 * (u1 * u2 * j.uu + (u1 * v2 + v1 * u2) * j.uv + v1 * v2 * j.vv);
  return dot(third, f.normal);
}

struct SideState {
  EdgeFrame frame;
  CurvatureForm form;  ///< in (across, along)
  double rate;
};

std::optional<SideState> side_of(const SurfaceJet& j, Edge e, bool out) {
  const auto frame = edge_frame(j, e, out);
  if (!frame) return std::nullopt;
  return SideState{*frame, curvature_form(j, {frame->across, frame->along, frame->normal}),
                   section_rate(j, *frame)};
}

double largest_curvature(const CurvatureForm& f) {
  const double mean = 0.5 * (f.xx + f.yy);
  return std::abs(mean) + std::hypot(0.5 * (f.xx - f.yy), f.xy);
}

/// The second side's edge may run the other way: its frame is turned to the first one's.
SideState turned(SideState s) {
  s.frame.along = -s.frame.along;
  s.frame.normal = -s.frame.normal;
  s.form = {-s.form.xx, s.form.xy, -s.form.yy};
  s.rate = -s.rate;
  return s;
}

void compare(EdgeSample& sample, const SideState& a, SideState b, double size) {
  if (dot(a.frame.along, b.frame.along) < 0) b = turned(b);
  sample.angle = core::angle_between(a.frame.normal, b.frame.normal);  // edges may run apart
  const CurvatureForm jump{b.form.xx - a.form.xx, b.form.xy - a.form.xy, b.form.yy - a.form.yy};
  sample.curvature_jump = largest_curvature(jump);
  sample.rate_jump = std::abs(b.rate - a.rate);
  const double bend = std::max({largest_curvature(a.form), largest_curvature(b.form), 1 / size});
  const double rate = std::max({std::abs(a.rate), std::abs(b.rate), 1 / (size * size)});
  sample.relative_curvature_jump = sample.curvature_jump / bend;
  sample.relative_rate_jump = sample.rate_jump / rate;
  sample.stripe_turn = stripe_turn(a.form, b.form);
  sample.stripe_density = stripe_density(a.form, b.form);
}

double edge_length(const Surface& s, Edge e) {
  double length = 0;
  Point3 before = edge_jet(s, e, 0).point;
  for (int i = 1; i <= kCoarse; ++i) {
    const Point3 here = edge_jet(s, e, static_cast<double>(i) / kCoarse).point;
    length += core::distance(before, here);
    before = here;
  }
  return length;
}

double worst_gap(const Surface& first, Edge a, const EdgeProjection& onto, const Surface& second,
                 Edge b) {
  double worst = 0;
  for (int i = 0; i <= 16; ++i) {
    const Point3 p = edge_jet(first, a, i / 16.0).point;
    worst = std::max(worst, core::distance(p, edge_jet(second, b, onto.nearest(p)).point));
  }
  return worst;
}

struct Candidate {
  Edge edge;
  double length;
};

/// Edges that can be a joint: not those collapsed into a point, unless all are.
std::vector<Candidate> candidates(const Surface& s) {
  std::vector<Candidate> all;
  for (const Edge e : kEdges) all.push_back({e, edge_length(s, e)});
  const double least = kCollapsed * extent(net_of(s));
  auto drawn_out = all;
  std::erase_if(drawn_out, [least](const Candidate& c) { return c.length <= least; });
  return drawn_out.empty() ? all : drawn_out;
}

std::array<Edge, 2> nearest_edges(const Surface& first, const Surface& second) {
  const auto of_first = candidates(first);
  std::array<Edge, 2> best{};
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& b : candidates(second)) {
    const EdgeProjection onto(second, b.edge);
    for (const Candidate& a : of_first) {
      const double gap =
          worst_gap(first, a.edge, onto, second, b.edge) + 1e-12 * std::abs(a.length - b.length);
      if (gap < least) {
        least = gap;
        best = {a.edge, b.edge};
      }
    }
  }
  return best;
}

/// Whether there is a stretch along which nothing but the gap was compared.
bool has_unmeasured_stretch(const EdgeContinuity& e) {
  const auto undefined = [](const EdgeSample& a, const EdgeSample& b) {
    return !a.defined && !b.defined;
  };
  return std::ranges::adjacent_find(e.samples, undefined) != e.samples.end();
}

int order_of(const EdgeContinuity& e) {
  if (!(e.gap <= *e.tolerance.gap)) return -1;
  if (!(e.angle <= e.tolerance.angle) || has_unmeasured_stretch(e)) return 0;
  if (!(e.relative_curvature_jump <= e.tolerance.curvature)) return 1;
  return e.relative_rate_jump <= e.tolerance.curvature_rate ? 3 : 2;
}

Result<void> check(const EdgeTolerance& t, int count) {
  if (count < 2 || count > 100'000)
    return fail(ErrorCode::bad_input, "the number of places is out of range",
                "give a whole number from 2 to 100000", "samples");
  for (const auto& [name, value] : {std::pair{"gap", t.gap.value_or(0)},
                                    {"angle", t.angle},
                                    {"curvature", t.curvature},
                                    {"curvature_rate", t.curvature_rate}})
    if (!(value >= 0 && std::isfinite(value)))
      return fail(ErrorCode::bad_input, "the tolerance is negative or not finite", "give 0 or more",
                  name);
  return {};
}

void take_largest(EdgeContinuity& e, const EdgeSample& s) {
  e.gap = std::max(e.gap, s.gap);
  e.angle = std::max(e.angle, s.angle);
  e.curvature_jump = std::max(e.curvature_jump, s.curvature_jump);
  e.rate_jump = std::max(e.rate_jump, s.rate_jump);
  e.relative_curvature_jump = std::max(e.relative_curvature_jump, s.relative_curvature_jump);
  e.relative_rate_jump = std::max(e.relative_rate_jump, s.relative_rate_jump);
}

/// Mean of the stripes and turning of the normal, by trapezoids along the edge.
void sum_stripes(EdgeContinuity& e) {
  double turned = 0;
  for (std::size_t i = 1; i < e.samples.size(); ++i) {
    const EdgeSample& a = e.samples[i - 1];
    const EdgeSample& b = e.samples[i];
    const double half = 0.5 * core::distance(a.position, b.position);
    e.turning += half * (a.stripe_density + b.stripe_density);
    turned += half * (a.stripe_density * a.stripe_turn + b.stripe_density * b.stripe_turn);
  }
  if (e.turning > 0) e.stripe_turn = turned / e.turning;
}

}  // namespace

EdgeTolerance with_gap(EdgeTolerance tolerance, double size) {
  if (!tolerance.gap) tolerance.gap = kUsualGap * size;
  return tolerance;
}

std::array<double, 2> edge_parameters(Edge edge, double along) {
  switch (edge) {
    case Edge::u0:
      return {0, along};
    case Edge::u1:
      return {1, along};
    case Edge::v0:
      return {along, 0};
    case Edge::v1:
      break;
  }
  return {along, 1};
}

Result<EdgeContinuity> edge_continuity(const Surface& first, const Surface& second,
                                       const std::optional<std::array<Edge, 2>>& edges,
                                       const EdgeTolerance& tolerance, int count) {
  if (auto sound = check(tolerance, count); !sound) return std::unexpected(sound.error());
  EdgeContinuity result;
  result.tolerance = with_gap(tolerance, std::max(extent(net_of(first)), extent(net_of(second))));
  result.edges = edges ? *edges : nearest_edges(first, second);
  const auto [a, b] = result.edges;
  const EdgeProjection onto(second, b);

  result.length = edge_length(first, a);
  const double size = std::max(result.length, 1e-300);
  for (int i = 0; i < count; ++i) {
    EdgeSample sample;
    sample.along = i / (count - 1.0);
    const SurfaceJet here = jet_at(first, a, sample.along);
    const SurfaceJet there = jet_at(second, b, onto.nearest(here.point));
    sample.position = here.point;
    sample.gap = core::distance(here.point, there.point);
    const auto out = side_of(here, a, true);
    const auto in = side_of(there, b, false);
    sample.defined = out && in;
    if (sample.defined)
      compare(sample, *out, *in, size);
    else
      ++result.without_normal;
    take_largest(result, sample);
    result.samples.push_back(sample);
  }
  sum_stripes(result);
  result.order = order_of(result);
  return result;
}

}  // namespace keyline::surface
