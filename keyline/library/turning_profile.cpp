#include "keyline/library/turning_profile.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "keyline/analysis/profile.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::library {
namespace {

/// Gauss's nodes on [0, 1]: their places mirror one another, so that both directions of travel see
/// the same angles.
constexpr const auto& kRule = numeric::gauss_legendre<6>;

/// The tangent angle from node to node, unwrapped, and its mean over each part by arc length.
std::array<double, kTurningParts> mean_angles(const curve::PlanarView& curve) {
  const analysis::ArcLengthTable table(curve);
  std::array<double, kTurningParts> means{};
  std::optional<double> before;
  double turned = 0;
  double from = 0;
  for (int part = 0; part < kTurningParts; ++part) {
    const double to = part + 1 < kTurningParts
                          ? table.parameter_at(table.length() * (part + 1) / kTurningParts)
                          : 1;
    double sum = 0;
    double length = 0;
    for (std::size_t i = 0; i < kRule.nodes.size(); ++i) {
      const curve::Jet2 jet = curve.jet_at(from + kRule.nodes[i] * (to - from));
      const double now = curve::tangent_angle(jet);
      if (before) turned += core::wrap_angle(now - *before);
      before = now;
      const double share = kRule.weights[i] * curve::speed(jet);
      sum += share * turned;
      length += share;
    }
    means[static_cast<std::size_t>(part)] = length > 0 ? sum / length : turned;
    from = to;
  }
  return means;
}

constexpr std::size_t kHalf = kTurningParts / 2;

/// Squared distances of two halves, as they are and with one of them negated; in lanes, so that the
/// compiler uses vectors.
struct Squares {
  double same = 0;
  double negated = 0;
};
Squares squares(const float* a, const float* b) {
  constexpr std::size_t kLanes = 8;
  std::array<float, kLanes> same{};
  std::array<float, kLanes> negated{};
  for (std::size_t i = 0; i < kHalf; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float minus = a[i + k] - b[i + k];
      const float plus = a[i + k] + b[i + k];
      same[k] += minus * minus;
      negated[k] += plus * plus;
    }
  }
  Squares sum;
  for (std::size_t k = 0; k < kLanes; ++k) {
    sum.same += static_cast<double>(same[k]);
    sum.negated += static_cast<double>(negated[k]);
  }
  return sum;
}

}  // namespace

TurningProfile turning_profile(const curve::PlanarView& curve) {
  const auto angle = mean_angles(curve);
  const auto step = [&](std::size_t i) { return angle[i + 1] - angle[i]; };
  constexpr std::size_t kLast = kTurningParts - 2;
  TurningProfile profile{};
  // Halves scaled so that the sum of squares stays that of the steps.
  for (std::size_t i = 0; i + 1 < kHalf; ++i) {
    const double mirror = step(kLast - i);
    profile[i] = static_cast<float>((step(i) + mirror) / std::numbers::sqrt2);
    profile[kHalf + i] = static_cast<float>((step(i) - mirror) / std::numbers::sqrt2);
  }
  profile[kHalf - 1] = static_cast<float>(step(kHalf - 1));
  return profile;
}

TurningMatch compare(const TurningProfile& a, const TurningProfile& b, bool mirror) {
  const Squares even = squares(a.data(), b.data());
  const Squares odd = squares(a.data() + kHalf, b.data() + kHalf);
  // Reversing gives (-even, odd), mirroring (-even, -odd), both (even, -odd).
  const bool flip_odd = mirror && odd.negated < odd.same;
  const bool flip_even = even.negated < even.same;
  const double square =
      (flip_even ? even.negated : even.same) + (flip_odd ? odd.negated : odd.same);
  return {std::sqrt(square), flip_even != flip_odd, flip_odd};
}

}  // namespace keyline::library
