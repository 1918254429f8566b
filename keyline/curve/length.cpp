#include "keyline/curve/length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "keyline/numeric/newton_bracket.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::curve {
namespace detail {
namespace {

constexpr std::size_t kNodes = 10;  ///< of a panel
constexpr int kMaxDepth = 50;

/// Gauss's rule by pairs of nodes from the outside in: the same from either end.
template <std::size_t N>
double gauss(const SpeedView& v, double low, double high) {
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  constexpr const auto& rule = numeric::gauss_legendre<N>;
  double sum = N % 2 == 1 ? rule.weights[N / 2] * v(middle) : 0;
  for (std::size_t i = 0; i < N / 2; ++i) {
    const double off = half * (1 - 2 * rule.nodes[i]);
    sum += rule.weights[i] * (v(middle - off) + v(middle + off));
  }
  return 2 * half * sum;
}

double panel_length(const SpeedView& v, double low, double high) {
  return gauss<kNodes>(v, low, high);
}

/// The length of a part of a panel of that width; negative where high < low. On a share x of a
/// panel n points miss x (x / 4)^2n of its length where ten points meet 1e-12 on the whole: a
/// quarter is what such a series falls by from term to term. Each rule is taken up to a share where
/// that is below 1e-17.
double gauss_of_part(const SpeedView& v, double low, double high, double width) {
  const double part = std::abs(high - low);
  if (part <= 5e-6 * width) return (high - low) * v(0.5 * (low + high));
  if (part <= 1e-3 * width) return gauss<2>(v, low, high);
  if (part <= 1e-2 * width) return gauss<3>(v, low, high);
  if (part <= 0.1 * width) return gauss<5>(v, low, high);
  return panel_length(v, low, high);
}

struct Panel {
  double low, high;
  double length;   ///< by its rule
  double allowed;  ///< by which its halves may differ from it
  bool settled = false;
};

/// A panel's halves; settled where they agree with it or it cannot be halved again.
std::array<Panel, 2> halves(const SpeedView& v, const Panel& p) {
  const double middle = 0.5 * (p.low + p.high);
  const double left = panel_length(v, p.low, middle);
  const double right = panel_length(v, middle, p.high);
  const double difference = std::abs(left + right - p.length);
  const bool settled =
      !(difference > std::max(p.allowed, 4e-16 * p.length)) || !(p.low < middle && middle < p.high);
  return {{{p.low, middle, left, 0.5 * p.allowed, settled},
           {middle, p.high, right, 0.5 * p.allowed, settled}}};
}

/// Halves panels until they are settled, the widest first and no more than `halvings` of those that
/// are not: a curve far from the origin for its size has a speed of rounded numbers, which no panel
/// is narrow enough for. All its panels are narrow then, and none is left as wide as it was.
std::vector<Panel> refined(const SpeedView& v, std::vector<Panel> panels, int halvings) {
  const auto open = [](const Panel& p) { return !p.settled; };
  for (int depth = 0; depth <= kMaxDepth && halvings >= 0 && std::ranges::any_of(panels, open);
       ++depth) {
    std::vector<Panel> narrower;
    narrower.reserve(panels.size() + 2);
    for (const Panel& p : panels) {
      if (p.settled) {
        narrower.push_back(p);
        continue;
      }
      const auto both = halves(v, p);
      if (!both[0].settled) --halvings;
      narrower.insert(narrower.end(), both.begin(), both.end());
    }
    panels = std::move(narrower);
  }
  return panels;
}

std::vector<double> cut(const std::vector<double>& breaks, double t0, double t1) {
  std::vector<double> ends{t0};
  for (const double b : breaks)
    if (b > t0 && b < t1) ends.push_back(b);
  ends.push_back(t1);
  return ends;
}

/// The panels of the curve between the ends, in order.
std::vector<Panel> panels_between(const SpeedView& v, const std::vector<double>& ends,
                                  double tolerance) {
  std::vector<Panel> panels;
  double total = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    panels.push_back({ends[i], ends[i + 1], panel_length(v, ends[i], ends[i + 1]), 0});
    total += panels.back().length;
  }
  for (Panel& p : panels) p.allowed = tolerance * total / static_cast<double>(panels.size());
  const int halvings = 10'000 + 50 * static_cast<int>(panels.size());
  return refined(v, std::move(panels), halvings);
}

/// Whether the speed of a panel of that length is the same to rounding at all nodes of the rule
/// that tells its length: lines, arcs and log-aesthetic pieces run so.
bool is_even(const SpeedView& v, double low, double high, double length) {
  constexpr double kRounding = 1e-14;
  const double mean = length / (high - low);
  return std::ranges::all_of(numeric::gauss_legendre<kNodes>.nodes, [&](double node) {
    return std::abs(v(low + node * (high - low)) - mean) <= kRounding * mean;
  });
}

}  // namespace

double integrate_speed(const SpeedView& v, const std::vector<double>& breaks, double t0, double t1,
                       double tolerance) {
  if (t1 < t0) return -integrate_speed(v, breaks, t1, t0, tolerance);
  t0 = std::clamp(t0, 0.0, 1.0);
  t1 = std::clamp(t1, 0.0, 1.0);
  if (!(t0 < t1)) return 0;
  double sum = 0;
  for (const Panel& p : panels_between(v, cut(breaks, t0, t1), tolerance)) sum += p.length;
  return sum;
}

ArcLengthMap map_lengths(const SpeedView& v, const std::vector<double>& breaks, double tolerance) {
  ArcLengthMap map{{0.0}, {0.0}, {}};
  for (const Panel& p : panels_between(v, cut(breaks, 0, 1), tolerance)) {
    map.even.push_back(is_even(v, p.low, p.high, p.length));
    map.t.push_back(p.high);
    map.s.push_back(map.s.back() + p.length);
  }
  return map;
}

double length_at(const SpeedView& v, const ArcLengthMap& map, double t) {
  t = std::clamp(t, 0.0, 1.0);
  const auto after = std::upper_bound(map.t.begin() + 1, map.t.end() - 1, t);
  const std::size_t i = static_cast<std::size_t>(after - map.t.begin()) - 1;
  if (map.even[i])
    return std::lerp(map.s[i], map.s[i + 1], (t - map.t[i]) / (map.t[i + 1] - map.t[i]));
  return map.s[i] + (t > map.t[i] ? panel_length(v, map.t[i], t) : 0.0);
}

/// Newton's method inside a panel, kept between bounds that shrink.
double invert_length(const SpeedView& v, const ArcLengthMap& map, double s) {
  if (!(s > 0)) return 0;
  if (s >= map.s.back()) return 1;
  const auto after = std::upper_bound(map.s.begin() + 1, map.s.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(after - map.s.begin()) - 1;
  numeric::NewtonBracket between{map.t[i], map.t[i + 1]};
  const double width = between.high - between.low;
  const double panel = map.s[i + 1] - map.s[i];
  double t = between.low + (panel > 0 ? width * (s - map.s[i]) / panel : 0);
  if (map.even[i]) return t;
  double excess = map.s[i] + panel_length(v, map.t[i], t) - s;
  for (int step = 0; step < 60 && std::abs(excess) > 2e-16 * map.s.back(); ++step) {
    const double next = between.next(t, excess, v(t));
    if (next == t) break;
    excess += gauss_of_part(v, t, next, width);
    t = next;
  }
  return t;
}

}  // namespace detail

namespace {

template <class P>
double length_up_to(const Polyline<P>& c, double t) {
  const Polyline<P> part = subcurve(c, 0, t);
  double sum = 0;
  for (std::size_t i = 1; i < part.points.size(); ++i)
    sum += distance(part.points[i - 1], part.points[i]);
  return sum;
}

}  // namespace

template <class P>
double arc_length(const Polyline<P>& c, double t0, double t1, double) {
  if (t1 < t0) return -arc_length(c, t1, t0);
  return length_up_to(subcurve(c, t0, t1), 1);
}

template <class P>
double parameter_at_length(const Polyline<P>& c, double s, double) {
  if (c.points.size() < 2) throw core::InvalidInput("Polyline: fewer than two points");
  const double edges = static_cast<double>(c.points.size() - 1);
  double before = 0;
  for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
    const double edge = distance(c.points[i], c.points[i + 1]);
    if (s <= before + edge && edge > 0)
      return (static_cast<double>(i) + std::clamp((s - before) / edge, 0.0, 1.0)) / edges;
    before += edge;
  }
  return s > 0 ? 1 : 0;
}

template double arc_length(const Polyline2&, double, double, double);
template double arc_length(const Polyline3&, double, double, double);
template double parameter_at_length(const Polyline2&, double, double);
template double parameter_at_length(const Polyline3&, double, double);

}  // namespace keyline::curve
