#include "keyline/lac/chain/departure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::Vector2;

constexpr int kStretches = 64;

/// Fractions of the length at which anything happens in either chain, and enough between.
std::vector<double> cuts(const Chain& a, const Chain& b) {
  std::vector<double> at = breakpoints(a);
  const std::vector<double> others = breakpoints(b);
  at.insert(at.end(), others.begin(), others.end());
  for (int i = 1; i < kStretches; ++i) at.push_back(static_cast<double>(i) / kStretches);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

/// Length squared times curvature over [t0, t1], on which it is monotone: from the piece in the
/// middle, so that the value is that of its own side at a joint.
core::Interval bend(const Chain& chain, double length, double t0, double t1) {
  const ChainLocation middle = locate(chain, 0.5 * (t0 + t1));
  const Piece& piece = chain.pieces[middle.piece];
  const double half = 0.5 * (t1 - t0) * length / piece.length;
  const double k0 = length * length * curvature(piece, std::max(middle.t - half, 0.0));
  const double k1 = length * length * curvature(piece, std::min(middle.t + half, 1.0));
  return {std::min(k0, k1), std::max(k0, k1)};
}

double largest(const core::Interval& i) { return std::max(std::abs(i.low), std::abs(i.high)); }

/// Largest difference of a number of the one and a number of the other.
double apart(const core::Interval& a, const core::Interval& b) {
  return std::max(std::abs(a.high - b.low), std::abs(b.high - a.low));
}

struct Spot {
  double t = 0;
  double gap = 0;    ///< |D|
  double angle = 0;  ///< between the tangents
};

/// Two chains and their lengths.
struct Pair {
  const Chain& a;
  const Chain& b;
  double length_a = arc_length(a);
  double length_b = arc_length(b);

  Spot spot(double t) const {
    return {t, distance(evaluate(a, t), evaluate(b, t)),
            std::abs(tangent_angle(a, t) - tangent_angle(b, t))};
  }

  double bound(const Spot& from, const Spot& to) const {
    const double width = to.t - from.t;
    const core::Interval bend_a = bend(a, length_a, from.t, to.t);
    const core::Interval bend_b = bend(b, length_b, from.t, to.t);
    // theta' = bend / length.
    const double swing = apart({bend_a.low / length_a, bend_a.high / length_a},
                               {bend_b.low / length_b, bend_b.high / length_b});
    const double turned = std::max(from.angle, to.angle) + 0.5 * width * swing;
    const double second = apart(bend_a, bend_b) + largest(bend_b) * turned;
    return std::max(from.gap, to.gap) + width * width / 8 * second;
  }

  /// The same, halved where it is above what is wanted.
  double close_bound(const Spot& from, const Spot& to, double wanted, int halvings) const {
    const double rough = bound(from, to);
    if (!std::isfinite(rough)) return std::numeric_limits<double>::infinity();
    if (rough <= wanted || halvings == 0) return rough;
    const Spot middle = spot(0.5 * (from.t + to.t));
    return std::max(close_bound(from, middle, wanted, halvings - 1),
                    close_bound(middle, to, wanted, halvings - 1));
  }
};

}  // namespace

double departure_bound(const Chain& a, const Chain& b) {
  const Pair pair{a, b};
  const double rounding = 1e-14 * std::max(pair.length_a, pair.length_b);
  std::vector<Spot> spots;
  double most = 0;
  for (const double t : cuts(a, b)) {
    spots.push_back(pair.spot(t));
    most = std::max(most, spots.back().gap);
  }
  double bound = 0;
  for (std::size_t i = 1; i < spots.size(); ++i) {
    bound = std::max(bound, pair.close_bound(spots[i - 1], spots[i], 1.005 * most + rounding, 7));
    if (!std::isfinite(bound)) return std::numeric_limits<double>::infinity();
  }
  return bound + rounding;
}

}  // namespace keyline::lac
