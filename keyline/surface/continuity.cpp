#include "keyline/surface/continuity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "keyline/core/axis.h"
#include "keyline/surface/border.h"
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

/// Raises what the sample has by what the sides differ in.
void compare(EdgeSample& sample, const SideState& a, SideState b, double size) {
  if (dot(a.frame.along, b.frame.along) < 0) b = turned(b);
  const auto take = [](double& most, double value) { most = std::max(most, value); };
  take(sample.angle, core::angle_between(a.frame.normal, b.frame.normal));  // edges may run apart
  const CurvatureForm jump{b.form.xx - a.form.xx, b.form.xy - a.form.xy, b.form.yy - a.form.yy};
  const double curvature_jump = largest_curvature(jump);
  const double rate_jump = std::abs(b.rate - a.rate);
  const double bend = std::max({largest_curvature(a.form), largest_curvature(b.form), 1 / size});
  const double rate = std::max({std::abs(a.rate), std::abs(b.rate), 1 / (size * size)});
  take(sample.curvature_jump, curvature_jump);
  take(sample.rate_jump, rate_jump);
  take(sample.relative_curvature_jump, curvature_jump / bend);
  take(sample.relative_rate_jump, rate_jump / rate);
  take(sample.stripe_turn, stripe_turn(a.form, b.form));
  take(sample.stripe_density, stripe_density(a.form, b.form));
}

double worst_gap(const Border& from, const Border& to) {
  double worst = 0;
  for (int i = 0; i <= 16; ++i) {
    const Point3 p = from.point(i / 16.0);
    worst = std::max(worst, core::distance(p, to.point(to.nearest(p))));
  }
  return worst;
}

/// Edges that can be a joint: not those collapsed into a point, or no longer than a gap, unless all
/// are.
std::vector<Border> candidates(const Surface& s) {
  std::vector<Border> all;
  for (const Edge e : kEdges) all.emplace_back(s, e);
  const double least = kUsualGap * extent(net_of(s));
  auto drawn_out = all;
  std::erase_if(drawn_out, [least](const Border& b) { return b.length() <= least; });
  return drawn_out.empty() ? all : drawn_out;
}

/// The edges of which one lies along the other with the least gap.
std::array<Edge, 2> nearest_edges(const Surface& first, const Surface& second) {
  const auto of_first = candidates(first);
  std::array<Edge, 2> best{};
  double least = std::numeric_limits<double>::infinity();
  for (const Border& b : candidates(second))
    for (const Border& a : of_first) {
      const double gap =
          std::min(worst_gap(a, b), worst_gap(b, a)) + 1e-12 * std::abs(a.length() - b.length());
      if (gap < least) {
        least = gap;
        best = {a.edge(), b.edge()};
      }
    }
  return best;
}

/// A place of both edges, found from one of them. At a knot derivatives are those of growing
/// parameters, which are not the same side where edges run against each other: there the surfaces
/// are compared `beside` it, on both sides.
struct Place {
  std::array<double, 2> along{};
  int from = 0;
  std::array<double, 2> beside{};
};

/// The two edges, and which of them is compared whole: the second where it lies nearer along the
/// first than the first along it; where both do, to rounding, the first.
class BorderPair {
 public:
  BorderPair(const Surface& first, const Surface& second, std::array<Edge, 2> edges, double extent)
      : borders_{Border(first, edges[0]), Border(second, edges[1])} {
    constexpr double kRounding = 1e-9;
    const double most = worst_gap(borders_[0], borders_[1]) - kRounding * extent;
    whole_ = most > 0 && worst_gap(borders_[1], borders_[0]) < most ? 1 : 0;
  }

  double length() const { return borders_[whole_].length(); }

  /// `count` places of the edge compared whole, and what there is in the common part of stations
  /// of either, along the first.
  std::vector<Place> places(int count) const {
    std::vector<Place> all;
    for (int i = 0; i < count; ++i) all.push_back(place(whole_, i / (count - 1.0)));
    for (const double at : borders_[whole_].stations()) all.push_back(place(whole_, at));
    const auto common = common_part();
    for (const double at : borders_[1 - whole_].stations())
      if (common(at)) all.push_back(place(1 - whole_, at));
    std::ranges::stable_sort(all, {}, [](const Place& p) { return p.along; });
    const auto same = [](const Place& p, const Place& q) {
      return std::abs(p.along[0] - q.along[0]) < kSame && std::abs(p.along[1] - q.along[1]) < kSame;
    };
    const auto again = std::ranges::unique(all, same);
    all.erase(again.begin(), again.end());
    return all;
  }

  EdgeSample sample(const Place& p, double size) const {
    EdgeSample sample;
    sample.along = p.along[0];
    sample.position = borders_[0].point(p.along[0]);
    sample.gap = core::distance(sample.position, borders_[1].point(p.along[1]));
    measure(sample, p.beside[0] == 0 ? p.along : both(p.from, p.along[p.from] + p.beside[0]), size);
    if (p.beside[1] != p.beside[0])
      measure(sample, both(p.from, p.along[p.from] + p.beside[1]), size);
    return sample;
  }

 private:
  static constexpr double kSame = 1e-9;
  static constexpr double kBeside = 1e-6;

  std::array<double, 2> both(int from, double at) const {
    const double other = borders_[1 - from].nearest(borders_[from].point(at));
    return from == 0 ? std::array{at, other} : std::array{other, at};
  }

  Place place(int from, double at) const {
    Place p{both(from, at), from, {}};
    if (!borders_[0].has_knot(p.along[0], kSame) && !borders_[1].has_knot(p.along[1], kSame))
      return p;
    p.beside = {at > 0 ? -kBeside : kBeside, at < 1 ? kBeside : -kBeside};
    return p;
  }

  /// Whether a place of the other edge lies beside the one compared whole: between where that one's
  /// ends are, or, of a closed edge, outside of that.
  std::function<bool(double)> common_part() const {
    const auto [low, high] =
        std::minmax({both(whole_, 0)[1 - whole_], both(whole_, 1)[1 - whole_]});
    const double middle = both(whole_, 0.5)[1 - whole_];
    const bool between = middle > low - kSame && middle < high + kSame;
    return [=](double at) {
      return between ? at > low + 2 * kBeside && at < high - 2 * kBeside
                     : at < low - 2 * kBeside || at > high + 2 * kBeside;
    };
  }

  void measure(EdgeSample& sample, std::array<double, 2> along, double size) const {
    const auto out = side_of(borders_[0].jet_at(along[0]), borders_[0].edge(), true);
    const auto in = side_of(borders_[1].jet_at(along[1]), borders_[1].edge(), false);
    if (out && in)
      compare(sample, *out, *in, size);
    else
      sample.defined = false;
  }

  std::array<Border, 2> borders_;
  int whole_ = 0;
};

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
  if (!s.defined) ++e.without_normal;
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
  const double extent_of_both = std::max(extent(net_of(first)), extent(net_of(second)));
  EdgeContinuity result;
  result.tolerance = with_gap(tolerance, extent_of_both);
  result.edges = edges ? *edges : nearest_edges(first, second);
  const BorderPair pair(first, second, result.edges, extent_of_both);

  result.length = pair.length();
  const double size = std::max(result.length, 1e-300);
  for (const Place& place : pair.places(count)) {
    result.samples.push_back(pair.sample(place, size));
    take_largest(result, result.samples.back());
  }
  sum_stripes(result);
  result.order = order_of(result);
  return result;
}

}  // namespace keyline::surface
