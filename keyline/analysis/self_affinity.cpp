#include "keyline/analysis/self_affinity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keyline/numeric/golden_section.h"

namespace keyline::analysis {
namespace {

/// log radius over the share of the length, along growing radius: cubic between samples.
struct LogRadius {
  std::vector<double> share;
  std::vector<double> value;
  std::vector<double> rate;  ///< of value, by share

  double at(double u) const {
    const auto right = std::ranges::upper_bound(share, u);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(right - share.begin(), 1, std::ssize(share) - 1));
    const double h = share[i] - share[i - 1];
    const double w = (u - share[i - 1]) / h;
    const double v = 1 - w;
    return v * v * (1 + 2 * w) * value[i - 1] + w * w * (1 + 2 * v) * value[i] +
           h * w * v * (v * rate[i - 1] - w * rate[i]);
  }
};

/// Curvature below this share of the largest is an inflection: log radius runs to infinity there.
constexpr double kFlat = 1e-6;

std::optional<LogRadius> log_radius_of(const CurvatureProfile& given) {
  const bool grows = std::abs(given.curvature.front()) >= std::abs(given.curvature.back());
  const CurvatureProfile p = grows ? given : reversed(given);
  double largest = 0;
  for (const double k : p.curvature) largest = std::max(largest, std::abs(k));
  LogRadius r;
  for (std::size_t i = 0; i < p.curvature.size(); ++i) {
    const double k = std::abs(p.curvature[i]);
    const bool again = !r.share.empty() && !(p.arc_length[i] > r.share.back());
    if (!(k > kFlat * largest) || again) continue;
    r.share.push_back(p.arc_length[i]);
    r.value.push_back(-std::log(k));
    r.rate.push_back(-p.curvature_rate[i] / p.curvature[i]);
  }
  constexpr std::size_t kFewest = 8;  // samples that carry a curve of log radius
  if (r.share.size() < kFewest) return std::nullopt;
  const double start = r.share.front();
  const double length = r.share.back() - start;
  for (double& s : r.share) s = (s - start) / length;
  for (double& rate : r.rate) rate *= length;
  // The same rounding that makes an arc's radius waver.
  constexpr double kSameRadius = 1e-9;
  if (r.value.back() - r.value.front() < kSameRadius) return std::nullopt;
  return r;
}

constexpr double kCut = 0.5;   // of the length: what lies before is cut off
constexpr int kSamples = 101;  // of the rest

/// The rest of the curve after the cut, laid over its parent.
class Overlay {
 public:
  explicit Overlay(const LogRadius& parent) : parent_(parent) {
    for (int i = 0; i < kSamples; ++i) rest_[i] = parent.at(kCut + share(i));
  }

  /// With the length scaled by a: the best shift of log radius, and what remains then.
  std::pair<double, double> compare(double a) const {
    double mean = 0;
    double square = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double difference = parent_.at(a * share(i)) - rest_[i];
      const double step = difference - mean;
      mean += step / (i + 1);
      square += step * (difference - mean);
    }
    return {mean, std::sqrt(std::max(square, 0.0) / kSamples)};
  }

  /// Up to 1 / (1 - cut) the scaled rest still ends on the parent. Coarse steps, then golden
  /// section around the best of them, to rounding.
  double best_scale() const {
    constexpr int kSteps = 32;  // coarse ones
    constexpr double kMost = 1 / (1 - kCut);
    int best = 1;
    for (int i = 2; i <= kSteps; ++i)
      if (remains(kMost * i / kSteps) < remains(kMost * best / kSteps)) best = i;
    return numeric::golden_section([this](double a) { return remains(a); },
                                   kMost * (best - 1) / kSteps,
                                   kMost * std::min(best + 1, kSteps) / kSteps, 1e-9);
  }

 private:
  static double share(int i) { return (1 - kCut) * i / (kSamples - 1); }
  double remains(double a) const { return compare(a).second; }

  const LogRadius& parent_;
  std::array<double, kSamples> rest_{};
};

}  // namespace

std::optional<SelfAffinity> self_affinity(const CurvatureProfile& piece) {
  const auto radius = log_radius_of(piece);
  if (!radius) return std::nullopt;
  const Overlay overlay(*radius);
  const double scale = overlay.best_scale();
  const auto [shift, deviation] = overlay.compare(scale);
  return SelfAffinity{deviation, scale, std::exp(shift)};
}

}  // namespace keyline::analysis
