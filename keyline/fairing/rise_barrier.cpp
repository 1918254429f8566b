#include "keyline/fairing/rise_barrier.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "keyline/fairing/pooled.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kBoundary = 0.995;  // share of the way to zero that room or multiplier may go
constexpr double kCentred = 1e4;     // products of room and multiplier stay this near the barrier
constexpr double kTilt = 1e-2;       // of the curvature's range: how far level values are tilted
constexpr double kClear = 0.25;      // of the way to the neighbours that a tilt may take
constexpr double kAside = 1e-3;      // of the range: where a curvature on one side of zero starts
constexpr double kSlower = 0.9;      // of the fastest rate: where the solver starts

/// How far the values of a pool may rise about their mean: as far apart as they were (`most`,
/// where they were equal), and clear of the neighbours.
double tilt_of(const std::vector<Pool>& pools, std::size_t b, std::span<const double> value,
               double most) {
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  double tilt = *high > *low ? std::min(*high - *low, most) : most;
  const double mean = pools[b].mean;
  if (b > 0) tilt = std::min(tilt, kClear * (mean - pools[b - 1].mean));
  if (b + 1 < pools.size()) tilt = std::min(tilt, kClear * (pools[b + 1].mean - mean));
  return tilt;
}

/// The values of one stretch of pieces of the same sense, and how they are to run.
struct Stretch {
  std::vector<std::size_t> node;
  std::vector<double> value;
  int sense = 0;
  bool starts_held = false;  ///< the first value stays as it is
  bool ends_held = false;    ///< the last one does
};

/// Whether a node's curvature is that of a line or an arc, or of an end that is held.
bool held(const DenseCurve& curve, std::size_t node) {
  const std::size_t n = curve.alpha.size();
  if ((node > 0 || curve.closed) && flat(curve, (node + n - 1) % n)) return true;
  if ((node < n || curve.closed) && flat(curve, node % n)) return true;
  return (node == 0 && curve.hold_start >= Hold::curvature) ||
         (node == n && curve.hold_end >= Hold::curvature);
}

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
  for (Stretch& s : all) {
    for (const std::size_t node : s.node) s.value.push_back(curve.value[node]);
    s.starts_held = held(curve, s.node.front());
    s.ends_held = held(curve, s.node.back());
  }
  return all;
}

double along(const DenseCurve& curve, std::size_t node) { return curve.at[curve.cut[node]]; }

/// The stretch's values, strictly running as they should: on from a held one, and up to one.
void straighten(const DenseCurve& curve, Stretch& stretch, double most_tilt) {
  for (double& v : stretch.value) v *= stretch.sense;
  const double least = stretch.starts_held ? stretch.value.front() : -HUGE_VAL;
  const double most = stretch.ends_held ? stretch.value.back() : HUGE_VAL;
  for (double& v : stretch.value) v = std::min(std::max(v, least), most);
  std::vector<double> way{0};
  for (std::size_t i = 1; i < stretch.node.size(); ++i) {
    const double step = along(curve, stretch.node[i]) - along(curve, stretch.node[i - 1]);
    way.push_back(way.back() + step - std::floor(step));
  }
  const std::vector<Pool> pools = pooled(
      stretch.value.size(), [&](std::size_t i) { return stretch.value[i]; },
      [](std::size_t) { return 1.0; });
  std::size_t first = 0;
  for (std::size_t b = 0; b < pools.size(); ++b) {
    const std::size_t last = first + pools[b].count - 1;
    const double tilt =
        first == last ? 0 : tilt_of(pools, b, {&stretch.value[first], pools[b].count}, most_tilt);
    const double length = first == last ? 1 : way[last] - way[first];
    const bool upwards = b == 0 && stretch.starts_held;
    const bool downwards = b + 1 == pools.size() && stretch.ends_held;
    const double mean = pools[b].mean + (upwards ? tilt : downwards ? -tilt : 0);
    for (std::size_t i = first; i <= last; ++i) {
      const double share = 2 * (way[i] - way[first]) / length - 1;
      stretch.value[i] = stretch.sense * (mean + tilt * share);
    }
    first = last + 1;
  }
}

/// Rate of curvature times the square of the length: where the piece runs fastest, one of its ends.
double fastest(const DenseCurve& curve, std::size_t p) {
  if (flat(curve, p)) return 0;
  const double a = curve.value[p];
  const double b = curve.value[p + 1];
  const double width = along(curve, p + 1) - along(curve, p);
  const double power = -curve.alpha[p];
  if (a == b || std::abs(power - 1) < 1e-9) return std::abs(b - a) / width;
  const double big = std::max(std::abs(a), std::abs(b));
  const double small = a * b <= 0 ? 0.0 : std::min(std::abs(a), std::abs(b));
  if (std::abs(power) < 1e-9) return small > 0 ? std::abs(std::log(b / a)) * big / width : HUGE_VAL;
  const auto raised = [&](double v) { return std::copysign(std::pow(std::abs(v), power), v); };
  const double reach = std::abs((raised(b) - raised(a)) / power);
  return reach * std::pow(power < 1 ? big : small, 1 - power) / width;
}

/// The fastest rate that is allowed, times the square of the length.
double steepest(const DenseCurve& curve) { return curve.most_rate * curve.length * curve.length; }

/// The largest rise that a piece may have for its fastest rate to be the one allowed, from what
/// its rate and rise are now.
double most_rise(const DenseCurve& curve, std::size_t p) {
  const double width = along(curve, p + 1) - along(curve, p);
  const double rise = std::abs(curve.value[p + 1] - curve.value[p]);
  const double rate = fastest(curve, p);
  const double share = rise > 0 && rate > 0 && std::isfinite(rate) ? rise / (rate * width) : 1;
  return steepest(curve) * width * share;
}

/// Means of the greatest curvatures below and the least above that run no faster than their
/// neighbours allow.
void slow_down(DenseCurve& curve) {
  const std::size_t pieces = curve.alpha.size();
  std::vector<double> low = curve.value;
  std::vector<double> high = curve.value;
  const auto pass = [&](std::size_t from, std::size_t to, std::size_t p) {
    const double most = kSlower * most_rise(curve, p);
    low[to] = std::min(low[to], low[from] + most);
    high[to] = std::max(high[to], high[from] - most);
  };
  for (int lap = 0; lap < (curve.closed ? 2 : 1); ++lap) {
    for (std::size_t p = 0; p < pieces; ++p) pass(p, p + 1, p);
    for (std::size_t p = pieces; p-- > 0;) pass(p + 1, p, p);
    if (!curve.closed) continue;
    low.front() = low.back() = std::min(low.front(), low.back());
    high.front() = high.back() = std::max(high.front(), high.back());
  }
  for (std::size_t i = 0; i <= pieces; ++i) curve.value[i] = 0.5 * (low[i] + high[i]);
}

/// What is held stays as it was.
void put_back(DenseCurve& curve, const std::vector<double>& before) {
  for (std::size_t p = 0; p < curve.alpha.size(); ++p)
    if (flat(curve, p))
      for (const std::size_t node : {p, p + 1}) curve.value[node] = before[node];
  if (curve.hold_start >= Hold::curvature) curve.value.front() = before.front();
  if (curve.hold_end >= Hold::curvature) curve.value.back() = before.back();
}

/// Curvatures moved to the nearest ones that keep the senses strictly.
void keep_senses(DenseCurve& curve) {
  if (curve.sense.empty()) return;
  const auto [low, high] = std::minmax_element(curve.value.begin(), curve.value.end());
  const double tilt = kTilt * std::max(*high - *low, 1e-6);
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
}

/// Curvatures on the wrong side of zero, or hardly on the right one, moved over in their order.
void keep_sides(DenseCurve& curve) {
  if (curve.side.empty()) return;
  const auto [low, high] = std::minmax_element(curve.value.begin(), curve.value.end());
  const double least = kAside * std::max(*high - *low, 1e-6);
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    const double v = curve.side[i] * curve.value[i];
    if (curve.side[i] != 0 && v < least) curve.value[i] = curve.side[i] * least / (2 - v / least);
  }
}

/// Pieces that were moved across zero get a slope that passes an inflection.
void let_pass(DenseCurve& curve) {
  for (std::size_t p = 0; p < curve.alpha.size(); ++p)
    if (curve.value[p] * curve.value[p + 1] <= 0 && !passes_inflection(curve.alpha[p]))
      curve.alpha[p] = -1;
}

}  // namespace

void keep_rises(DenseCurve& curve) {
  const std::vector<double> before = curve.value;
  if (std::isfinite(curve.most_rate) && too_fast(curve) > kSlower) slow_down(curve);
  keep_senses(curve);
  keep_sides(curve);
  put_back(curve, before);
  if (curve.value != before) let_pass(curve);
}

void ease(DenseCurve& curve) {
  for (std::size_t p = 0; p < curve.alpha.size(); ++p)
    if (fastest(curve, p) > steepest(curve)) curve.alpha[p] = -1;
}

double too_fast(const DenseCurve& curve) {
  if (!std::isfinite(curve.most_rate)) return 0;
  double most = 0;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) most = std::max(most, fastest(curve, p));
  return most / steepest(curve);
}

RiseBarrier::RiseBarrier(const DenseCurve& curve, double barrier) : barrier_(barrier) {
  const bool rates = std::isfinite(curve.most_rate);
  if (curve.sense.empty() && curve.side.empty() && !rates) return;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    begins_.push_back(limits_.size());
    if (!curve.side.empty()) add_sides(curve, p);
    if (flat(curve, p)) continue;
    const int sense = curve.sense.empty() ? 0 : curve.sense[p];
    const auto rise = [&](double way, double most) {
      add(curve, {.piece = p, .start = -way, .end = way, .most = most});
    };
    if (sense != 0) rise(sense, 0);
    for (const int way : {-1, 1})
      if (rates && sense != way) rise(way, most_rise(curve, p));
  }
  begins_.push_back(limits_.size());
}

void RiseBarrier::add_sides(const DenseCurve& curve, std::size_t p) {
  int start = int{curve.side[p]};
  const int end = int{curve.side[p + 1]};
  const bool arc = flat(curve, p);  // its end is as its start
  if (arc && start == 0) start = end;
  if (start != 0) add(curve, {.piece = p, .start = static_cast<double>(start)});
  const bool last = !curve.closed && p + 1 == curve.alpha.size();
  if (last && !arc && end != 0) add(curve, {.piece = p, .end = static_cast<double>(end)});
}

void RiseBarrier::add(const DenseCurve& curve, Limit limit) {
  limit.first = limit.room = room(curve, limit);
  if (!(limit.room > 0)) return;
  limit.multiplier = barrier_ / limit.room;
  limits_.push_back(limit);
}

double RiseBarrier::room(const DenseCurve& curve, const Limit& limit) {
  return limit.most + limit.start * curve.value[limit.piece] +
         limit.end * curve.value[limit.piece + 1];
}

double RiseBarrier::longest(const Ends& meant) const {
  double share = 1;
  for (const Limit& limit : limits_) {
    const double by = change(meant, limit);
    if (by < 0) share = std::min(share, -kBoundary * limit.room / by);
  }
  return share;
}

double RiseBarrier::merit(const DenseCurve& curve) const {
  double logs = 0;
  for (const Limit& limit : limits_) logs += std::log(room(curve, limit) / limit.first);
  return -barrier_ * logs;
}

void RiseBarrier::move(const DenseCurve& curve, const Ends& meant) {
  double dual = 1;
  std::vector<double> by;
  for (const Limit& limit : limits_) {
    by.push_back((barrier_ - limit.multiplier * change(meant, limit)) / limit.room -
                 limit.multiplier);
    if (by.back() < 0) dual = std::min(dual, -kBoundary * limit.multiplier / by.back());
  }
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    Limit& limit = limits_[i];
    limit.room = room(curve, limit);
    const double centre = barrier_ / limit.room;
    limit.multiplier =
        std::clamp(limit.multiplier + dual * by[i], centre / kCentred, centre * kCentred);
  }
}

void RiseBarrier::rescale(double by) {
  for (Limit& limit : limits_) limit.multiplier *= by;
}

}  // namespace keyline::fairing::detail
