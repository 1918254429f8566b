#include "keyline/fit/curvature_target.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "keyline/core/error.h"
#include "keyline/curve/jet.h"
#include "keyline/fit/standard_way.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::fit {
namespace {

constexpr int kTargets = 24;  ///< targets per piece
constexpr int kPerPiece =
    3 * kTargets;  ///< samples of the profile: a target in the middle of three

/// Curvature at equal steps of t, with the arc length there.
struct Profile {
  std::vector<double> t;
  std::vector<double> length;
  std::vector<double> curvature;
};

Profile profile_of(const curve::PiecewiseBezier& chain) {
  if (chain.pieces.empty()) throw core::InvalidInput("a curvature target needs a piece");
  Profile p;
  const std::size_t n = chain.pieces.size();
  double length = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (int i = 0; i < kPerPiece; ++i) {
      const double u = (i + 0.5) / kPerPiece;
      const auto at = jet(chain.pieces[k], u);
      const double step = speed(at) / kPerPiece;
      p.t.push_back((static_cast<double>(k) + u) / static_cast<double>(n));
      p.length.push_back(length + 0.5 * step);
      const double bend = curvature(at);
      p.curvature.push_back(std::isfinite(bend) ? bend : 0);
      length += step;
    }
  p.length.push_back(length);  // the whole, behind the samples
  return p;
}

/// Sample i of the profile, which goes on beyond its ends: round a closed one, mirrored in the end
/// point of an open one. i from -n to 2 n - 1.
struct Sample {
  double s, curvature, weight;
};

Sample sample(const Profile& p, long i, bool closed) {
  const long m = static_cast<long>(p.curvature.size());
  const double whole = p.length.back();
  const auto at = [](long k) { return static_cast<std::size_t>(k); };
  const auto twice_its_share = [&](long k) {
    const double before = k > 0 ? p.length[at(k - 1)] : -p.length[at(0)];
    const double after = k + 1 < m ? p.length[at(k + 1)] : 2 * whole - p.length[at(k)];
    return after - before;
  };
  if (i >= 0 && i < m) return {p.length[at(i)], p.curvature[at(i)], twice_its_share(i)};
  if (closed) {
    const long k = ((i % m) + m) % m;
    return {p.length[at(k)] + (i < 0 ? -whole : whole), p.curvature[at(k)], twice_its_share(k)};
  }
  const long k = i < 0 ? -1 - i : 2 * m - 1 - i;
  const double end = i < 0 ? p.curvature.front() : p.curvature.back();
  return {i < 0 ? -p.length[at(k)] : 2 * whole - p.length[at(k)], 2 * end - p.curvature[at(k)],
          twice_its_share(k)};
}

/// Gaussian mean along the length.
std::vector<double> low_pass(const Profile& p, double sigma, bool closed) {
  const std::size_t n = p.curvature.size();
  std::vector<double> smooth(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    double total = 0;
    for (const long direction : {-1L, 1L})
      for (long j = direction < 0 ? static_cast<long>(i) - 1 : static_cast<long>(i);
           j > -static_cast<long>(n) && j < 2 * static_cast<long>(n); j += direction) {
        const Sample at = sample(p, j, closed);
        const double d = (at.s - p.length[i]) / sigma;
        if (std::abs(d) > 4) break;
        const double w = at.weight * std::exp(-0.5 * d * d);
        sum += w * at.curvature;
        total += w;
      }
    smooth[i] = sum / total;
  }
  return smooth;
}

double automatic_cutoff(const Profile& p, std::size_t pieces) {
  return std::min(2.0 / static_cast<double>(pieces), 1.0) * p.length.back();
}

/// Standard deviation of the Gaussian that halves waves of that length.
double sigma_of(double cutoff) { return cutoff * std::sqrt(std::log(2.0) / 2) / M_PI; }

std::vector<CurvatureTarget> thinned(const Profile& p, const std::vector<double>& curvature) {
  std::vector<CurvatureTarget> targets;
  for (std::size_t k = 1; k < curvature.size(); k += kPerPiece / kTargets)
    targets.push_back({p.t[k], curvature[k]});
  return targets;
}

/// Indices where a smooth profile turns or changes sign by more than a ripple, ends included.
std::vector<std::size_t> landmarks(const std::vector<double>& k) {
  const double largest = std::abs(*std::max_element(
      k.begin(), k.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double ripple = 0.05 * largest;
  std::vector<std::size_t> marks = {0};
  std::size_t extreme = 0;  // of the current run
  int trend = 0;
  for (std::size_t i = 1; i < k.size(); ++i) {
    if (trend == 0) {
      if (std::abs(k[i] - k[0]) > ripple) trend = k[i] > k[0] ? 1 : -1, extreme = i;
    } else if (trend * (k[i] - k[extreme]) >= 0) {
      extreme = i;
    } else if (trend * (k[extreme] - k[i]) > ripple) {
      marks.push_back(extreme);
      trend = -trend;
      extreme = i;
    }
  }
  for (std::size_t i = 1; i < k.size(); ++i)
    if ((k[i - 1] < 0) != (k[i] < 0)) marks.push_back(i);
  marks.push_back(k.size() - 1);
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end(),
                          [](std::size_t a, std::size_t b) { return b < a + 4; }),
              marks.end());
  if (marks.back() != k.size() - 1) marks.back() = k.size() - 1;
  return marks;
}

/// κ at the share v of a stretch of slope α; where an end is 0 slopes must be negative.
double power_law(double k0, double k1, double alpha, double v) {
  if (alpha < 0) return numeric::signed_power_mean(k0, k1, -alpha, v);
  const double sign = k0 + k1 < 0 ? -1 : 1;
  return sign * numeric::power_mean(std::abs(k0), std::abs(k1), -alpha, v);
}

struct Slopes {
  double low = -6;
  double high = 6;
};

Slopes slopes_of(WantedRhythm wanted) {
  constexpr double kClear = 0.5;
  const Slopes all;
  switch (wanted) {
    case WantedRhythm::own:
      return all;
    case WantedRhythm::accelerating:
      return {all.low, -kClear};
    case WantedRhythm::stable:
      return {0, 0};
    case WantedRhythm::decelerating:
      break;
  }
  return {kClear, all.high};
}

/// Slopes of stretches whose curvature is 0 at an end, or changes sign.
constexpr Slopes kThroughZero{-6, -0.1};

/// The slope that fits best, by a fine look over those allowed.
double best_slope(const Profile& p, const std::vector<double>& k, std::size_t from, std::size_t to,
                  double k0, double k1, Slopes slopes) {
  constexpr double kStep = 0.05;
  const auto steps = static_cast<int>(std::lround((slopes.high - slopes.low) / kStep));
  double best = slopes.low;
  double least = HUGE_VAL;
  for (int step = 0; step <= steps; ++step) {
    const double alpha = slopes.low + kStep * step;
    double sum = 0;
    for (std::size_t i = from; i <= to; ++i) {
      const double v = (p.length[i] - p.length[from]) / (p.length[to] - p.length[from]);
      const double d = power_law(k0, k1, alpha, v) - k[i];
      sum += d * d;
    }
    if (sum < least) least = sum, best = alpha;
  }
  return best;
}

RhythmTarget rhythm_along(const curve::PiecewiseBezier& chain, bool closed, WantedRhythm wanted) {
  const Profile p = profile_of(chain);
  const std::vector<double> smooth =
      low_pass(p, sigma_of(automatic_cutoff(p, chain.pieces.size())), closed);
  const std::vector<std::size_t> marks = landmarks(smooth);
  const Slopes slopes = slopes_of(wanted);
  std::size_t straight_ended = 0;
  std::vector<double> power(smooth.size());
  for (std::size_t m = 0; m + 1 < marks.size(); ++m) {
    const std::size_t from = marks[m];
    const std::size_t to = marks[m + 1];
    // at a change of sign the curvature is zero between two samples
    const auto value = [&](std::size_t i) {
      const bool flips = i > 0 && i + 1 < smooth.size() && (smooth[i - 1] < 0) != (smooth[i] < 0);
      return flips ? 0.0 : smooth[i];
    };
    const bool through_zero = value(from) * value(to) <= 0;
    if (through_zero && slopes.high >= 0) ++straight_ended;
    const double alpha = best_slope(
        p, smooth, from, to, value(from), value(to),
        through_zero ? Slopes{kThroughZero.low, std::min(kThroughZero.high, slopes.high)} : slopes);
    for (std::size_t i = from; i <= to; ++i) {
      const double v = (p.length[i] - p.length[from]) / (p.length[to] - p.length[from]);
      power[i] = power_law(value(from), value(to), alpha, v);
    }
  }
  return {thinned(p, power), wanted == WantedRhythm::own ? 0 : straight_ended};
}

}  // namespace

std::vector<CurvatureTarget> smooth_target(const curve::PiecewiseBezier& chain, bool closed,
                                           double cutoff) {
  const Profile p = profile_of(chain);
  const double wavelength = cutoff > 0 ? cutoff : automatic_cutoff(p, chain.pieces.size());
  return thinned(p, low_pass(p, sigma_of(wavelength), closed));
}

RhythmTarget rhythm_target(const curve::PiecewiseBezier& chain, bool closed, WantedRhythm wanted) {
  // Of two samples beside a change of sign one is the mark: the same whichever way one travels.
  if (!detail::goes_back(chain)) return rhythm_along(chain, closed, wanted);
  RhythmTarget target = rhythm_along(detail::on_the_way_back(chain), closed, wanted);
  target.places = detail::on_the_way_back(std::move(target.places));
  return target;
}

}  // namespace keyline::fit
