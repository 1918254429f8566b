#include "keyline/fairing/sense_barrier.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kBoundary = 0.995;  // share of the way to zero that a rise or multiplier may go
constexpr double kCentred = 1e4;     // products of rise and multiplier stay this near the barrier
constexpr double kTilt = 1e-2;       // of the curvature's range, over the whole length

/// Weighted means of neighbours until they rise: pooling adjacent violators.
///
/// Source: [Barlow 1972], section 1.2 (pooling adjacent violators).
std::vector<double> rising(const std::vector<double>& value) {
  struct Block {
    double mean;
    int count;
  };
  std::vector<Block> blocks;
  for (const double v : value) {
    blocks.push_back({v, 1});
    while (blocks.size() > 1 && blocks.end()[-2].mean > blocks.back().mean) {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& one = blocks.back();
      one.mean = (one.mean * one.count + last.mean * last.count) / (one.count + last.count);
      one.count += last.count;
    }
  }
  std::vector<double> out;
  for (const Block& b : blocks) out.insert(out.end(), b.count, b.mean);
  return out;
}

/// The values of one stretch of pieces of the same sense, and how they are to run.
struct Stretch {
  std::vector<std::size_t> node;
  std::vector<double> value;
  int sense = 0;
};

std::vector<Stretch> stretches_of(const DenseCurve& curve) {
  const std::size_t pieces = curve.alpha.size();
  const auto sense = [&](std::size_t p) { return flat(curve, p) ? 0 : int{curve.sense[p]}; };
  std::size_t first = 0;
  if (curve.closed)
    while (first < pieces && sense(first) == sense((first + pieces - 1) % pieces)) ++first;
  first %= pieces;
  std::vector<Stretch> all;
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t p = (first + i) % pieces;
    if (all.empty() || all.back().sense != sense(p)) {
      all.emplace_back();
      all.back().sense = sense(p);
      all.back().node.push_back(p);
    }
    all.back().node.push_back(p + 1);
  }
  for (Stretch& s : all)
    for (const std::size_t node : s.node) s.value.push_back(curve.value[node]);
  return all;
}

double along(const DenseCurve& curve, std::size_t node) { return curve.at[curve.cut[node]]; }

/// The stretch's values, strictly running as they should.
void straighten(const DenseCurve& curve, Stretch& stretch, double tilt) {
  for (double& v : stretch.value) v *= stretch.sense;
  const auto falls = std::adjacent_find(stretch.value.begin(), stretch.value.end(),
                                        [](double a, double b) { return !(a < b); });
  if (falls == stretch.value.end()) tilt = 0;
  stretch.value = rising(stretch.value);
  double way = 0;
  for (std::size_t i = 0; i < stretch.value.size(); ++i) {
    if (i > 0) {
      const double step = along(curve, stretch.node[i]) - along(curve, stretch.node[i - 1]);
      way += step - std::floor(step);
    }
    stretch.value[i] = stretch.sense * (stretch.value[i] + tilt * way);
  }
}

}  // namespace

void keep_senses(DenseCurve& curve) {
  if (curve.sense.empty()) return;
  const auto [low, high] = std::minmax_element(curve.value.begin(), curve.value.end());
  const double tilt = kTilt * std::max(*high - *low, 1e-6);
  const std::vector<double> before = curve.value;
  const std::size_t last = curve.value.size() - 1;
  std::vector<double> top(curve.value.size(), -HUGE_VAL);
  std::vector<double> bottom(curve.value.size(), HUGE_VAL);
  for (Stretch& s : stretches_of(curve)) {
    if (s.sense == 0) continue;
    straighten(curve, s, tilt);
    for (std::size_t i = 0; i < s.node.size(); ++i) {
      const bool ends_high = i == 0 ? s.sense < 0 : s.sense > 0;
      const bool end = i == 0 || i + 1 == s.node.size();
      const auto keep = [&](std::size_t node) {
        if (end && !ends_high) bottom[node] = std::min(bottom[node], s.value[i]);
        if (end && ends_high) top[node] = std::max(top[node], s.value[i]);
        if (!end) curve.value[node] = s.value[i];
      };
      keep(s.node[i]);
      if (curve.closed && s.node[i] % last == 0) keep(s.node[i] == 0 ? last : 0);
    }
  }
  for (std::size_t i = 0; i <= last; ++i) {
    if (std::isfinite(top[i])) curve.value[i] = top[i];
    if (std::isfinite(bottom[i])) curve.value[i] = bottom[i];
  }
  // What is held stays as it is.
  for (std::size_t p = 0; p < last; ++p)
    if (flat(curve, p))
      for (const std::size_t node : {p, p + 1}) curve.value[node] = before[node];
  if (curve.hold_start >= Hold::curvature) curve.value.front() = before.front();
  if (curve.hold_end >= Hold::curvature) curve.value.back() = before.back();
}

SenseBarrier::SenseBarrier(const DenseCurve& curve, double barrier) : barrier_(barrier) {
  if (curve.sense.empty()) return;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    sense_.push_back(flat(curve, p) ? 0 : curve.sense[p]);
    const double r = rise(curve, p);
    if (sense_[p] != 0 && !(r > 0)) sense_[p] = 0;
    count_ += sense_[p] != 0;
    first_.push_back(r);
    rise_.push_back(r);
    multiplier_.push_back(sense_[p] != 0 ? barrier / r : 0);
  }
}

double SenseBarrier::rise(const DenseCurve& curve, std::size_t p) const {
  return sense_[p] * (curve.value[p + 1] - curve.value[p]);
}

Pull SenseBarrier::pull(std::size_t p) const {
  if (sense_.empty() || sense_[p] == 0) return {};
  return {multiplier_[p] / rise_[p], -sense_[p] * barrier_ / rise_[p]};
}

double SenseBarrier::longest(const std::vector<double>& meant) const {
  double share = 1;
  for (std::size_t p = 0; p < sense_.size(); ++p) {
    const double by = sense_[p] * meant[p];
    if (by < 0) share = std::min(share, -kBoundary * rise_[p] / by);
  }
  return share;
}

double SenseBarrier::merit(const DenseCurve& curve) const {
  double logs = 0;
  for (std::size_t p = 0; p < sense_.size(); ++p)
    if (sense_[p] != 0) logs += std::log(rise(curve, p) / first_[p]);
  return -barrier_ * logs;
}

void SenseBarrier::move(const DenseCurve& curve, const std::vector<double>& meant) {
  double dual = 1;
  std::vector<double> by(sense_.size());
  for (std::size_t p = 0; p < sense_.size(); ++p) {
    if (sense_[p] == 0) continue;
    by[p] = (barrier_ - multiplier_[p] * sense_[p] * meant[p]) / rise_[p] - multiplier_[p];
    if (by[p] < 0) dual = std::min(dual, -kBoundary * multiplier_[p] / by[p]);
  }
  for (std::size_t p = 0; p < sense_.size(); ++p) {
    if (sense_[p] == 0) continue;
    rise_[p] = rise(curve, p);
    const double centre = barrier_ / rise_[p];
    multiplier_[p] =
        std::clamp(multiplier_[p] + dual * by[p], centre / kCentred, centre * kCentred);
  }
}

void SenseBarrier::rescale(double by) {
  for (double& m : multiplier_) m *= by;
}

}  // namespace keyline::fairing::detail
