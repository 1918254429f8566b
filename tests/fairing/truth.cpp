#include "truth.h"

#include <algorithm>
#include <cmath>

#include "keyline/acquire/acquire.h"
#include "keyline/curve/closest_point.h"
#include "keyline/numeric/random.h"

namespace keyline::fairing::testing {
namespace {

/// Curvature after a piece that starts with curvature k; run: pieces of the monotone run so far,
/// with the direction of its curvature.
double next_curvature(numeric::Random& random, double k) {
  const double factor = random.uniform(2, 5);
  if (k == 0) return (random.uniform() < 0.5 ? -1 : 1) * random.uniform(0.5, 2);
  const double pick = random.uniform();
  if (pick < 0.2 && std::abs(k) < 3) return 0;
  const bool grow = std::abs(k) < 0.3 || (std::abs(k) < 3 && pick < 0.6);
  return grow ? k * factor : k / factor;
}

double slope_for(numeric::Random& random, double k0, double k1, const lac::Piece* before) {
  const bool inflects = k0 * k1 <= 0;
  const bool goes_on = before && (before->curvature_end - before->curvature_start) * (k1 - k0) > 0;
  while (true) {
    const double alpha = inflects ? random.uniform(-3, -0.3) : random.uniform(-3, 3);
    if (!goes_on || std::abs(alpha - before->alpha) >= 0.5) return alpha;
  }
}

/// How many of the last pieces belong to the monotone run that a piece to k1 would continue.
int run_length(const std::vector<lac::Piece>& pieces, double k0, double k1) {
  int count = 0;
  for (auto p = pieces.rbegin(); p != pieces.rend(); ++p, ++count)
    if ((p->curvature_end - p->curvature_start) * (k1 - k0) <= 0) break;
  return count;
}

}  // namespace

lac::Chain random_chain(std::uint64_t seed) {
  numeric::Random random(seed);
  lac::Chain chain;
  chain.start = {{random.uniform(-5, 5), random.uniform(-5, 5)}, random.uniform(-3, 3)};
  const int count = 1 + static_cast<int>(random.index(5));
  double k0 = random.uniform(0.3, 2) * (random.uniform() < 0.5 ? -1 : 1);
  while (static_cast<int>(chain.pieces.size()) < count) {
    const double k1 = next_curvature(random, k0);
    if (run_length(chain.pieces, k0, k1) >= 2) continue;
    const auto* before = chain.pieces.empty() ? nullptr : &chain.pieces.back();
    lac::Piece piece{slope_for(random, k0, k1, before), 1, k0, k1};
    piece.length = random.uniform(0.4, 1.3) / std::abs(lac::total_turning(piece));
    chain.pieces.push_back(piece);
    k0 = k1;
  }
  return chain;
}

std::vector<core::Point2> measure(const lac::Chain& chain, int count, double noise,
                                  std::uint64_t seed, int decimals) {
  numeric::Random random(seed);
  const double length = lac::arc_length(chain);
  std::vector<core::Point2> points = lac::sample(chain, count);
  const double step = length * std::pow(10.0, -decimals);
  for (core::Point2& p : points) {
    p.x += noise * length * random.normal();
    p.y += noise * length * random.normal();
    if (decimals > 0) p = {step * std::round(p.x / step), step * std::round(p.y / step)};
  }
  return points;
}

acquire::KeyLine line_through(const std::vector<core::Point2>& points) {
  acquire::RawCurve raw;
  for (const core::Point2 p : points) raw.points.push_back({p.x, p.y, 0});
  return acquire::acquire_key_line(raw).value();
}

Difference compare(const lac::Chain& truth, const FairResult& result) {
  Difference d;
  const double length = lac::arc_length(truth);
  std::vector<core::Point2> joints;
  std::vector<double> slopes;
  for (const FairCurve& curve : result.curves) {
    for (const lac::Segment& s : lac::segments(std::get<lac::Chain>(curve))) {
      joints.push_back(s.start.position);
      slopes.push_back(s.alpha);
    }
  }
  const auto segments = lac::segments(truth);
  d.surplus = static_cast<int>(joints.size()) - static_cast<int>(segments.size());
  d.same_count = joints.size() == segments.size() && result.curves.size() == 1;
  for (std::size_t i = 0; d.same_count && i < segments.size(); ++i) {
    if (i > 0)
      d.joints = std::max(d.joints, core::distance(joints[i], segments[i].start.position) / length);
    d.slopes = std::max(d.slopes, std::abs(slopes[i] - segments[i].alpha));
  }
  const auto points = lac::sample(truth, 200);
  double square = 0;
  for (const core::Point2 p : points) {
    double least = HUGE_VAL;
    for (const FairCurve& curve : result.curves)
      least =
          std::min(least, curve::closest_point(std::get<lac::Chain>(curve), p).distance / length);
    d.largest = std::max(d.largest, least);
    square += least * least;
  }
  d.rms = std::sqrt(square / static_cast<double>(points.size()));
  return d;
}

}  // namespace keyline::fairing::testing
