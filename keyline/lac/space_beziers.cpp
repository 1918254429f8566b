#include <algorithm>
#include <cmath>

#include "keyline/lac/space.h"

namespace keyline::lac {
namespace {

using core::Point3;

constexpr int kPlaces = 13;

/// The quintic through both ends with first and second derivatives in arc length; h: the length.
curve::Bezier3 quintic(const SpaceFrame& a, double bend_a, const SpaceFrame& b, double bend_b,
                       double h) {
  const auto handle = [h](const SpaceFrame& f, double bend, double sense, double i) {
    // Points 1 and 2 from either end: i h/5 along the tangent, and h^2/20 kappa n for the second.
    const Point3 p = f.position + sense * i * h / 5 * f.tangent;
    return i < 2 ? p : p + h * h / 20 * bend * f.normal;
  };
  return {{a.position, handle(a, bend_a, 1, 1), handle(a, bend_a, 1, 2), handle(b, bend_b, -1, 2),
           handle(b, bend_b, -1, 1), b.position},
          {}};
}

/// Largest distance at equal arc length; frames holds kPlaces + 1 equal steps of the piece.
double departure(const curve::Bezier3& c, std::span<const SpaceFrame> frames) {
  double most = 0;
  for (int i = 1; i < kPlaces; ++i)
    most = std::max(most, distance(evaluate(c, i / double(kPlaces)), frames[i].position));
  return most;
}

struct Fit {
  SpaceBeziers beziers;
  std::vector<double> deviations;  ///< of each piece
};

/// One quintic from each parameter to the next.
Fit fit_between(const SpaceChain& chain, const std::vector<double>& at) {
  std::vector<double> places;
  for (std::size_t i = 1; i < at.size(); ++i)
    for (int k = 0; k < kPlaces; ++k)
      places.push_back(at[i - 1] + (at[i] - at[i - 1]) * k / double(kPlaces));
  places.push_back(1);
  const std::vector<SpaceFrame> where = frames(chain, places);
  const double length = arc_length(chain);
  Fit fit;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const SpaceFrame* const first = &where[(i - 1) * kPlaces];
    fit.beziers.pieces.push_back(quintic(first[0], curvature(chain, at[i - 1]), first[kPlaces],
                                         curvature(chain, std::nextafter(at[i], 0.0)),
                                         length * (at[i] - at[i - 1])));
    fit.deviations.push_back(1.5 * departure(fit.beziers.pieces.back(), {first, kPlaces + 1}));
    fit.beziers.deviation = std::max(fit.beziers.deviation, fit.deviations.back());
  }
  return fit;
}

/// The parameters with the middle of every piece that misses the tolerance.
std::vector<double> halved(const std::vector<double>& at, const Fit& fit, double tolerance) {
  std::vector<double> finer{0};
  for (std::size_t i = 1; i < at.size(); ++i) {
    if (fit.deviations[i - 1] > tolerance) finer.push_back((at[i - 1] + at[i]) / 2);
    finer.push_back(at[i]);
  }
  return finer;
}

}  // namespace

SpaceBeziers approximate_by_quintics(const SpaceChain& chain, double tolerance) {
  if (!(tolerance > 0)) throw core::InvalidInput("approximate_by_quintics: tolerance not > 0");
  std::vector<double> at = breakpoints(chain);
  Fit fit = fit_between(chain, at);
  // The error of a smooth stretch falls 64-fold each time; in the end only rounding is left.
  for (int round = 0; fit.beziers.deviation > tolerance && round < 24; ++round) {
    at = halved(at, fit, tolerance);
    fit = fit_between(chain, at);
  }
  return fit.beziers;
}

}  // namespace keyline::lac
