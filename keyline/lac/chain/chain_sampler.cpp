#include "keyline/lac/chain/chain_sampler.h"

#include <algorithm>
#include <cmath>

#include "keyline/numeric/prepared_power_mean.h"

namespace keyline::lac {

ChainSampler::ChainSampler(const Chain& chain) : pieces_(segments(chain)) {
  double s = 0;
  for (const Segment& piece : pieces_) ends_.push_back(s += piece.length);
}

std::size_t ChainSampler::piece_at(double s) const {
  const auto after = std::upper_bound(ends_.begin(), ends_.end() - 1, s);
  return static_cast<std::size_t>(after - ends_.begin());
}

double ChainSampler::fraction(std::size_t piece, double s) const {
  const double start = piece == 0 ? 0 : ends_[piece - 1];
  return std::clamp((s - start) / pieces_[piece].length, 0.0, 1.0);
}

template <class Run>
void ChainSampler::for_runs(std::span<const double> at, const Run& run) const {
  for (std::size_t from = 0; from < at.size();) {
    const std::size_t piece = piece_at(at[from]);
    const double low = piece == 0 ? -HUGE_VAL : ends_[piece - 1];
    const double high = piece + 1 == pieces_.size() ? HUGE_VAL : ends_[piece];
    std::size_t to = from + 1;
    while (to < at.size() && at[to] >= low && at[to] < high) ++to;
    run(piece, from, to);
    from = to;
  }
}

void ChainSampler::curvatures(std::span<const double> at, std::span<double> values) const {
  for_runs(at, [&](std::size_t piece, std::size_t from, std::size_t to) {
    const Segment& p = pieces_[piece];
    const double k0 = p.curvature_start;
    const double k1 = p.curvature_end;
    if (k0 * k1 < 0 || k0 == k1) {
      for (std::size_t i = from; i < to; ++i) values[i] = curvature(p, fraction(piece, at[i]));
      return;
    }
    const double sign = k0 + k1 < 0 ? -1 : 1;
    const numeric::PowerMean mean(std::abs(k0), std::abs(k1), -p.alpha);
    for (std::size_t i = from; i < to; ++i) values[i] = sign * mean(fraction(piece, at[i]));
  });
}

void ChainSampler::curvature_rates(std::span<const double> at, std::span<double> values) const {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::size_t piece = piece_at(at[i]);
    values[i] = curvature_rate(pieces_[piece], fraction(piece, at[i]));
  }
}

void ChainSampler::tangent_angles(std::span<const double> at, std::span<double> values) const {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::size_t piece = piece_at(at[i]);
    values[i] = tangent_angle(pieces_[piece], fraction(piece, at[i]));
  }
}

void ChainSampler::points(std::span<const double> at, std::span<core::Point2> values) const {
  std::vector<double> fractions;
  for_runs(at, [&](std::size_t piece, std::size_t from, std::size_t to) {
    fractions.clear();
    for (std::size_t i = from; i < to; ++i) fractions.push_back(fraction(piece, at[i]));
    sample(pieces_[piece], fractions, values.subspan(from, to - from));
  });
}

}  // namespace keyline::lac
