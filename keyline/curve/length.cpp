#include "keyline/curve/length.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline::curve {
namespace detail {
namespace {

// Ten-point Gauss-Legendre rule on [-1, 1] (positive half).
constexpr std::array<double, 5> kNodes{0.14887433898163121, 0.43339539412924719,
                                       0.67940956829902441, 0.86506336668898451,
                                       0.97390652851717172};
constexpr std::array<double, 5> kWeights{0.29552422471475287, 0.26926671930999636,
                                         0.21908636251598204, 0.14945134915058059,
                                         0.066671344308688138};
constexpr int kMaxDepth = 50;

double gauss(const SpeedView& v, double low, double high) {
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  double sum = 0;
  for (std::size_t i = 0; i < kNodes.size(); ++i)
    sum += kWeights[i] * (v(middle - half * kNodes[i]) + v(middle + half * kNodes[i]));
  return half * sum;
}

struct ShortRule {
  double widest;  ///< of a panel
  double middle;  ///< weight of the middle, then nodes on (0, 1] with theirs
  std::array<std::array<double, 2>, 2> pairs;
};
// On a share x of a panel n points miss x (x / 4)^2n of its length where ten points meet 1e-12 on
// the whole: a quarter is what such a series falls by from term to term. Up to a share of `widest`
// that is below 1e-17.
constexpr ShortRule kShortRules[]{
    {5e-6, 2, {}},
    {1e-3, 0, {{{0.57735026918962576, 1}}}},
    {1e-2, 0.88888888888888889, {{{0.77459666924148338, 0.55555555555555556}}}},
    {0.1,
     0.56888888888888889,
     {{{0.53846931010568309, 0.47862867049936647}, {0.90617984593866399, 0.23692688505618909}}}}};

/// The length of a part of a panel of that width; negative where high < low.
double gauss_of_part(const SpeedView& v, double low, double high, double width) {
  const double half = 0.5 * (high - low);
  for (const ShortRule& rule : kShortRules) {
    if (!(2 * std::abs(half) <= rule.widest * width)) continue;
    const double middle = low + half;
    double sum = rule.middle > 0 ? rule.middle * v(middle) : 0;
    for (const auto& [node, weight] : rule.pairs)
      if (weight > 0) sum += weight * (v(middle - half * node) + v(middle + half * node));
    return half * sum;
  }
  return gauss(v, low, high);
}

/// Calls accept(low, high, length) for panels from low to high in order; `whole` is their rule.
/// No more than `halvings` are made: a curve far from the origin for its size has a speed of
/// rounded numbers, which no panel is narrow enough for.
template <class F>
void refine(const SpeedView& v, double low, double high, double whole, double allowed, int depth,
            int& halvings, F&& accept) {
  const double middle = 0.5 * (low + high);
  const double left = gauss(v, low, middle);
  const double right = gauss(v, middle, high);
  const double difference = std::abs(left + right - whole);
  if (!(difference > std::max(allowed, 4e-16 * whole)) || depth >= kMaxDepth || --halvings < 0 ||
      !(low < middle && middle < high)) {
    accept(low, middle, left);
    accept(middle, high, right);
    return;
  }
  refine(v, low, middle, left, 0.5 * allowed, depth + 1, halvings, accept);
  refine(v, middle, high, right, 0.5 * allowed, depth + 1, halvings, accept);
}

std::vector<double> cut(const std::vector<double>& breaks, double t0, double t1) {
  std::vector<double> ends{t0};
  for (const double b : breaks)
    if (b > t0 && b < t1) ends.push_back(b);
  ends.push_back(t1);
  return ends;
}

template <class F>
void integrate(const SpeedView& v, const std::vector<double>& ends, double tolerance, F&& accept) {
  std::vector<double> whole;
  double total = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    whole.push_back(gauss(v, ends[i], ends[i + 1]));
    total += whole.back();
  }
  int halvings = 10'000 + 50 * static_cast<int>(whole.size());
  const double allowed = tolerance * total / static_cast<double>(whole.size());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    refine(v, ends[i], ends[i + 1], whole[i], allowed, 0, halvings, accept);
}

/// Whether the speed of a panel of that length is the same to rounding at all nodes of the rule
/// that tells its length: lines, arcs and log-aesthetic pieces run so.
bool is_even(const SpeedView& v, double low, double high, double length) {
  constexpr double kRounding = 1e-14;
  const double mean = length / (high - low);
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  const auto same = [&](double t) { return std::abs(v(t) - mean) <= kRounding * mean; };
  return std::ranges::all_of(kNodes, [&](double node) {
    return same(middle - half * node) && same(middle + half * node);
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
  integrate(v, cut(breaks, t0, t1), tolerance, [&](double, double, double s) { sum += s; });
  return sum;
}

ArcLengthMap map_lengths(const SpeedView& v, const std::vector<double>& breaks, double tolerance) {
  ArcLengthMap map{{0.0}, {0.0}, {}};
  integrate(v, cut(breaks, 0, 1), tolerance, [&](double low, double high, double s) {
    map.even.push_back(is_even(v, low, high, s));
    map.t.push_back(high);
    map.s.push_back(map.s.back() + s);
  });
  return map;
}

double length_at(const SpeedView& v, const ArcLengthMap& map, double t) {
  t = std::clamp(t, 0.0, 1.0);
  const auto after = std::upper_bound(map.t.begin() + 1, map.t.end() - 1, t);
  const std::size_t i = static_cast<std::size_t>(after - map.t.begin()) - 1;
  if (map.even[i])
    return std::lerp(map.s[i], map.s[i + 1], (t - map.t[i]) / (map.t[i + 1] - map.t[i]));
  return map.s[i] + (t > map.t[i] ? gauss(v, map.t[i], t) : 0.0);
}

/// Newton's method inside a panel, kept between bounds that shrink.
double invert_length(const SpeedView& v, const ArcLengthMap& map, double s) {
  if (!(s > 0)) return 0;
  if (s >= map.s.back()) return 1;
  const auto after = std::upper_bound(map.s.begin() + 1, map.s.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(after - map.s.begin()) - 1;
  double low = map.t[i];
  double high = map.t[i + 1];
  const double panel = map.s[i + 1] - map.s[i];
  double t = panel > 0 ? low + (high - low) * (s - map.s[i]) / panel : low;
  if (map.even[i]) return t;
  const double width = high - low;
  double excess = map.s[i] + gauss(v, map.t[i], t) - s;
  for (int step = 0; step < 60 && std::abs(excess) > 2e-16 * map.s.back(); ++step) {
    (excess > 0 ? high : low) = t;
    const double rate = v(t);
    double next = rate > 0 ? t - excess / rate : low - 1;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
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
