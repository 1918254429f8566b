#include "keyline/curve/chain_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/part_bound.h"

namespace keyline::curve {
namespace {

using core::Point2;

/// Parameters of both chains that belong together.
struct Pair {
  double a = 0, b = 0;
};

void check(const PiecewiseBezier& c) {
  if (c.pieces.empty()) throw core::InvalidInput("deviation_bound: a chain without pieces");
  for (const Bezier2& piece : c.pieces)
    if (is_rational(piece)) throw core::InvalidInput("deviation_bound: a rational piece");
}

double foot_on(const PiecewiseBezier& c, Point2 p) { return closest_point(c, p).t; }

/// The pair at one end, t = 0 or 1.
Pair end_pair(const PiecewiseBezier& a, const PiecewiseBezier& b, double t, ChainEnds ends) {
  if (ends == ChainEnds::matched) return {t, t};
  const double on_a = foot_on(a, evaluate(b, t));
  return on_a == t ? Pair{t, foot_on(b, evaluate(a, t))} : Pair{on_a, t};
}

/// Both ends and every joint of either with its foot on the other, growing in both.
std::vector<Pair> pairs_of(const PiecewiseBezier& a, const PiecewiseBezier& b, ChainEnds ends) {
  const Pair first = end_pair(a, b, 0, ends);
  const Pair last = end_pair(a, b, 1, ends);
  std::vector<Pair> inner;
  const auto joint = [](const PiecewiseBezier& c, std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(c.pieces.size());
  };
  for (std::size_t i = 1; i < a.pieces.size(); ++i)
    inner.push_back({joint(a, i), foot_on(b, a.pieces[i].control.front())});
  for (std::size_t i = 1; i < b.pieces.size(); ++i)
    inner.push_back({foot_on(a, b.pieces[i].control.front()), joint(b, i)});
  std::sort(inner.begin(), inner.end(), [](const Pair& x, const Pair& y) { return x.a < y.a; });
  std::vector<Pair> pairs{first};
  for (const Pair& p : inner)
    if (p.a > pairs.back().a && p.b > pairs.back().b && p.a < last.a && p.b < last.b)
      pairs.push_back(p);
  pairs.push_back(last);
  return pairs;
}

/// The part of a chain between two parameters, cut at its joints: pieces and where they end.
struct Part {
  Bezier2 piece;
  double from = 0, to = 0;  ///< share of the parameters asked for
};
std::vector<Part> parts_of(const PiecewiseBezier& c, double t0, double t1) {
  const auto n = static_cast<double>(c.pieces.size());
  std::vector<Part> parts;
  double at = t0;
  while (at < t1) {
    const auto piece = std::min(static_cast<std::size_t>(at * n + 1e-12), c.pieces.size() - 1);
    const double end = std::min(t1, (static_cast<double>(piece) + 1) / n);
    const double low = std::clamp(at * n - static_cast<double>(piece), 0.0, 1.0);
    const double high = std::clamp(end * n - static_cast<double>(piece), 0.0, 1.0);
    if (high > low)
      parts.push_back(
          {subcurve(c.pieces[piece], low, high), (at - t0) / (t1 - t0), (end - t0) / (t1 - t0)});
    if (!(end > at)) break;
    at = end;
  }
  return parts;
}

/// A stretch of both whose joints did not all find their foot in order: cut at equal shares.
double stretch_bound(const PiecewiseBezier& a, const PiecewiseBezier& b, const Pair& from,
                     const Pair& to, double wanted) {
  const auto pa = parts_of(a, from.a, to.a);
  const auto pb = parts_of(b, from.b, to.b);
  if (pa.empty() || pb.empty()) {  // one has no length there
    const Point2 p = evaluate(pa.empty() ? a : b, pa.empty() ? from.a : from.b);
    double largest = 0;
    for (const Part& part : pa.empty() ? pb : pa)
      for (const Point2& c : part.piece.control) largest = std::max(largest, distance(c, p));
    return largest;
  }
  double largest = 0;
  std::size_t i = 0, j = 0;
  double at = 0;
  while (i < pa.size() && j < pb.size()) {
    const double end = std::min(pa[i].to, pb[j].to);
    const auto local = [](const Part& p, double s) {
      return std::clamp((s - p.from) / (p.to - p.from), 0.0, 1.0);
    };
    const double a0 = local(pa[i], at), a1 = local(pa[i], end);
    if (a1 > a0)
      largest = std::max(largest, part_bound(subcurve(pa[i].piece, a0, a1), pb[j].piece,
                                             local(pb[j], at), local(pb[j], end), wanted));
    if (pa[i].to <= end) ++i;
    if (j < pb.size() && pb[j].to <= end) ++j;
    at = end;
  }
  return largest;
}

/// The largest distance of one chain from the other, each place taken to where it is nearest. At
/// corners that is less than for one change of parameter for both: places before and behind a
/// corner may be nearest to the same leg of the other chain, in any order.
class OneWay {
 public:
  OneWay(const PiecewiseBezier& from, const PiecewiseBezier& to) : from_(from), to_(to) {}

  /// Over the parameters [low, high] of the first, no sharper than a hundredth, or than `enough`.
  double bound(double low, double high, double enough) {
    const auto n = static_cast<double>(from_.pieces.size());
    double at = low;
    double foot = nearest(low);
    while (at < high) {
      const double end = std::min(high, (std::floor(at * n + 1e-12) + 1) / n);
      if (!(end > at)) break;
      const double next = nearest(end);
      add({at, end, foot, next});
      at = end;
      foot = next;
    }
    for (int i = 0; i < kMostHalvings && !stretches_.empty(); ++i) {
      if (stretches_.front().bound <= std::max(enough, 1.01 * reached_)) break;
      halve_worst();
    }
    return stretches_.empty() ? reached_ : stretches_.front().bound;
  }

 private:
  static constexpr int kMostHalvings = 400;

  /// A part of one piece, and the feet of its ends.
  struct Part {
    double low = 0, high = 0;
    double foot_low = 0, foot_high = 0;
    double bound = 0;
    friend bool operator<(const Part& a, const Part& b) { return a.bound < b.bound; }
  };

  double nearest(double t) {
    const auto found = closest_point(to_, evaluate(from_, t));
    reached_ = std::max(reached_, found.distance);
    return found.t;
  }

  /// Along the other chain between the feet, or all of it taken to either foot.
  double bound_of(const Part& p) const {
    double least = std::numeric_limits<double>::infinity();
    if (p.foot_low < p.foot_high)
      least = stretch_bound(from_, to_, {p.low, p.foot_low}, {p.high, p.foot_high}, least);
    const auto own = parts_of(from_, p.low, p.high);
    for (const double foot : {p.foot_low, p.foot_high}) {
      const Point2 there = evaluate(to_, foot);
      double largest = 0;
      for (const auto& part : own)
        for (const Point2& c : part.piece.control) largest = std::max(largest, distance(c, there));
      least = std::min(least, largest);
    }
    return least;
  }

  void add(Part p) {
    p.bound = bound_of(p);
    stretches_.push_back(p);
    std::push_heap(stretches_.begin(), stretches_.end());
  }

  void halve_worst() {
    std::pop_heap(stretches_.begin(), stretches_.end());
    const Part worst = stretches_.back();
    stretches_.pop_back();
    const double middle = 0.5 * (worst.low + worst.high);
    const double foot = nearest(middle);
    add({worst.low, middle, worst.foot_low, foot});
    add({middle, worst.high, foot, worst.foot_high});
  }

  const PiecewiseBezier& from_;
  const PiecewiseBezier& to_;
  std::vector<Part> stretches_;  ///< a heap, the worst first
  double reached_ = 0;           ///< a distance that there is
};

}  // namespace

double deviation_bound(const PiecewiseBezier& a, const PiecewiseBezier& b, double wanted,
                       ChainEnds ends) {
  check(a);
  check(b);
  const std::vector<Pair> pairs = pairs_of(a, b, ends);
  double largest = 0;
  for (std::size_t k = 0; k + 1 < pairs.size(); ++k)
    largest = std::max(largest, stretch_bound(a, b, pairs[k], pairs[k + 1], wanted));
  if (largest <= wanted) return largest;
  const auto& [first, last] = std::pair(pairs.front(), pairs.back());
  const double there = OneWay(a, b).bound(first.a, last.a, wanted);
  if (there >= largest) return largest;
  return std::min(largest, std::max(there, OneWay(b, a).bound(first.b, last.b, wanted)));
}

}  // namespace keyline::curve
