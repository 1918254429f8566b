#include "keyline/fairing/band.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kBoundary = 0.995;  // share of the way to zero that a multiplier may go
constexpr double kKept = 0.001;      // least share of its slack that a point keeps in a step
constexpr double kFirstRoom = 0.5;   // of the tolerance: least slack at the start
constexpr double kCentred = 1e4;     // products of slack and multiplier stay this near the barrier

/// Whether the point is passed, or need not be.
bool is_passed(const FitPoint& point, double offset, double tolerance) {
  return !point.must_pass || std::abs(offset) <= kPassed * tolerance * point.share;
}

}  // namespace

Springs::Springs(const std::vector<FitPoint>& points, std::vector<double> offsets, double weight)
    : weight_(points.size()), offset_(std::move(offsets)) {
  double sum = 0;
  double count = 0;
  for (const FitPoint& p : points) {
    if (p.count == 0) continue;
    sum += p.weight;
    ++count;
  }
  for (std::size_t j = 0; j < points.size(); ++j)
    weight_[j] =
        weight * (points[j].count > 0 ? points[j].pull * points[j].weight / sum : 1 / count);
}

Pull Springs::pull(std::size_t j) const { return {weight_[j], weight_[j] * offset_[j]}; }

double Springs::merit(const std::vector<double>& offsets, double) const {
  double sum = 0;
  for (std::size_t j = 0; j < offsets.size(); ++j) sum += weight_[j] * offsets[j] * offsets[j];
  return 0.5 * sum;
}

void Springs::move(const std::vector<double>& offsets, const std::vector<double>&, double) {
  offset_ = offsets;
}

std::vector<double> mean_weights(const std::vector<FitPoint>& points) {
  std::vector<double> weight;
  double sum = 0;
  for (const FitPoint& p : points) {
    const double own = p.count > 0 ? p.weight : 0;
    sum += own;
    weight.push_back(own / (p.share * p.share));
  }
  for (double& w : weight) w /= sum;
  return weight;
}

double root_mean_square(const std::vector<double>& mean_weights,
                        const std::vector<double>& offsets) {
  double sum = 0;
  for (std::size_t j = 0; j < offsets.size(); ++j) sum += mean_weights[j] * offsets[j] * offsets[j];
  return std::sqrt(sum);
}

double largest_of(const std::vector<FitPoint>& points, const std::vector<double>& offsets) {
  double most = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    most = std::max(most, offsets[j] + points[j].share * points[j].high);
    most = std::max(most, -offsets[j] - points[j].share * points[j].low);
  }
  return most;
}

bool limits_kept(const std::vector<FitPoint>& points, const std::vector<double>& offsets,
                 double slack) {
  for (std::size_t j = 0; j < points.size(); ++j)
    if (offsets[j] > points[j].highest + slack || offsets[j] < points[j].lowest - slack)
      return false;
  return true;
}

bool all_passed(const std::vector<FitPoint>& points, const std::vector<double>& offsets,
                double tolerance) {
  for (std::size_t j = 0; j < points.size(); ++j)
    if (!is_passed(points[j], offsets[j], tolerance)) return false;
  return true;
}

Band::Band(const std::vector<FitPoint>& points, double tolerance, double spring)
    : points_(points),
      tolerance_(tolerance),
      spring_(mean_weights(points)),
      pair_(points.size()),
      force_(points.size()) {
  for (std::size_t j = 0; j < points.size(); ++j) spring_[j] *= points[j].pull * spring;
}

double Band::room_high(std::size_t j, double offset) const {
  const FitPoint& p = points_[j];
  return std::min(tolerance_ - p.share * p.high, p.highest) - offset;
}

double Band::room_low(std::size_t j, double offset) const {
  const FitPoint& p = points_[j];
  return std::min(tolerance_ + p.share * p.low, -p.lowest) + offset;
}

Pull Band::pull(std::size_t j) const {
  if (points_[j].must_pass) {
    const double share = points_[j].share;
    return {stiffness() / (share * share),
            (stiffness() * missed(j, offset_[j]) + force_[j]) / share};
  }
  const auto& [high, low] = pair_[j];
  const double up = room_high(j, offset_[j]) + high.extra;
  const double down = room_low(j, offset_[j]) + low.extra;
  return {high.multiplier / up + low.multiplier / down + spring_[j],
          (barrier_ + high.multiplier * high.extra) / up -
              (barrier_ + low.multiplier * low.extra) / down + spring_[j] * offset_[j]};
}

void Band::start(const std::vector<double>& offsets, double barrier) {
  offset_ = offsets;
  barrier_ = barrier;
  const double least = kFirstRoom * tolerance_;
  force_.assign(points_.size(), 0);
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) continue;
    auto& [high, low] = pair_[j];
    const double up = room_high(j, offsets[j]);
    const double down = room_low(j, offsets[j]);
    high.extra = std::max(0.0, least - up);
    low.extra = std::max(0.0, least - down);
    high.multiplier = barrier / (up + high.extra);
    low.multiplier = barrier / (down + low.extra);
  }
  price_ = 0;
  set_price();
}

bool Band::allows(const std::vector<double>& offsets, double share) const {
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) continue;
    const auto& [high, low] = pair_[j];
    const double up = room_high(j, offsets[j]) + (1 - share) * high.extra;
    const double down = room_low(j, offsets[j]) + (1 - share) * low.extra;
    if (!(up > kKept * (room_high(j, offset_[j]) + high.extra))) return false;
    if (!(down > kKept * (room_low(j, offset_[j]) + low.extra))) return false;
  }
  return true;
}

double Band::longest(const std::vector<double>& meant) const {
  double share = 1;
  for (std::size_t j = 0; j < meant.size(); ++j) {
    if (points_[j].must_pass) continue;
    const auto& [high, low] = pair_[j];
    const double up = room_high(j, offset_[j]) + high.extra;
    const double down = room_low(j, offset_[j]) + low.extra;
    const double by_up = -meant[j] - high.extra;
    const double by_down = meant[j] - low.extra;
    if (by_up < 0) share = std::min(share, -kBoundary * up / by_up);
    if (by_down < 0) share = std::min(share, -kBoundary * down / by_down);
  }
  return share;
}

double Band::merit(const std::vector<double>& offsets, double share) const {
  double logs = 0;
  double extra = 0;
  double springs = 0;
  double held = 0;
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) {
      const double off = missed(j, offsets[j]);
      held += (0.5 * stiffness() * off + force_[j]) * off;
      continue;
    }
    const auto& [high, low] = pair_[j];
    const double up = room_high(j, offsets[j]) + (1 - share) * high.extra;
    const double down = room_low(j, offsets[j]) + (1 - share) * low.extra;
    springs += spring_[j] * offsets[j] * offsets[j];
    logs += std::log(up / tolerance_ * down / tolerance_);
    extra += high.extra + low.extra;
  }
  return price_ * (1 - share) * extra - barrier_ * logs + 0.5 * springs + held;
}

void Band::move(const std::vector<double>& offsets, const std::vector<double>& meant,
                double share) {
  std::vector<double> by_high(offsets.size());
  std::vector<double> by_low(offsets.size());
  double dual = 1;
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) {
      force_[j] += share * stiffness() * missed(j, offset_[j] + meant[j]);
      continue;
    }
    const auto& [high, low] = pair_[j];
    const double up = room_high(j, offset_[j]) + high.extra;
    const double down = room_low(j, offset_[j]) + low.extra;
    by_high[j] = (barrier_ + high.multiplier * (meant[j] + high.extra)) / up - high.multiplier;
    by_low[j] = (barrier_ + low.multiplier * (low.extra - meant[j])) / down - low.multiplier;
    if (by_high[j] < 0) dual = std::min(dual, -kBoundary * high.multiplier / by_high[j]);
    if (by_low[j] < 0) dual = std::min(dual, -kBoundary * low.multiplier / by_low[j]);
  }
  offset_ = offsets;
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) continue;
    auto& [high, low] = pair_[j];
    high.extra *= 1 - share;
    low.extra *= 1 - share;
    const double up = barrier_ / (room_high(j, offsets[j]) + high.extra);
    const double down = barrier_ / (room_low(j, offsets[j]) + low.extra);
    high.multiplier = std::clamp(high.multiplier + dual * by_high[j], up / kCentred, up * kCentred);
    low.multiplier =
        std::clamp(low.multiplier + dual * by_low[j], down / kCentred, down * kCentred);
  }
  set_price();
}

void Band::rest(const std::vector<double>& offsets) {
  const double enough = kFirstRoom * tolerance_;
  const auto widen = [enough](Side& side, double before, double room) {
    if (room >= before)
      side.extra = std::max(0.0, side.extra + before - room);
    else
      side.extra = std::max(side.extra, std::min(before + side.extra, enough) - room);
  };
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    if (points_[j].must_pass) continue;
    auto& [high, low] = pair_[j];
    widen(high, room_high(j, offset_[j]), room_high(j, offsets[j]));
    widen(low, room_low(j, offset_[j]), room_low(j, offsets[j]));
  }
  offset_ = offsets;
}

void Band::rescale(double by) {
  price_ *= by;
  for (double& w : spring_) w *= by;
  for (double& f : force_) f *= by;
  for (auto& [high, low] : pair_) {
    high.multiplier *= by;
    low.multiplier *= by;
  }
}

void Band::set_price() {
  double most = 0;
  for (const auto& [high, low] : pair_) most = std::max({most, high.multiplier, low.multiplier});
  price_ = std::max(price_, 2 * most);
}

double Band::extra() const {
  double most = 0;
  for (const auto& [high, low] : pair_) most = std::max({most, high.extra, low.extra});
  for (std::size_t j = 0; j < points_.size(); ++j)
    if (!is_passed(points_[j], offset_[j], tolerance_))
      most = std::max(most, std::abs(missed(j, offset_[j])));
  return most;
}

}  // namespace keyline::fairing::detail
