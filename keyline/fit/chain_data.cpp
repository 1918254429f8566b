#include "keyline/fit/chain_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"

namespace keyline::fit {
namespace {

using core::cross;
using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kSplitShare = 0.7;  ///< of the largest deviation: pieces with more are split

}  // namespace

ChainData prepare_chain_data(const std::vector<Point2>& points, bool closed) {
  ChainData data;
  data.points = points;
  if (closed) data.points.push_back(points.front());
  const auto& p = data.points;
  const long n = static_cast<long>(p.size());
  data.length.assign(p.size(), 0);
  for (std::size_t i = 1; i < p.size(); ++i) {
    data.length[i] = data.length[i - 1] + distance(p[i - 1], p[i]);
    if (!(data.length[i] > data.length[i - 1]))
      throw core::InvalidInput("fit_quintic_chain: two neighbouring points are equal");
  }
  const auto at = [&](long i) {
    if (closed) return p[static_cast<std::size_t>(((i % (n - 1)) + n - 1) % (n - 1))];
    return p[static_cast<std::size_t>(std::clamp(i, 0L, n - 1))];
  };
  const long reach = std::clamp(n / 12, 1L, 8L);
  data.direction.resize(p.size());
  data.curvature.assign(p.size(), 0);
  double turned = 0;
  for (long i = 0; i < n; ++i) {
    double angle = core::direction_of(at(i + reach) - at(i - reach));
    if (i > 0) angle = turned + std::remainder(angle - turned, 2 * M_PI);
    data.direction[static_cast<std::size_t>(i)] = turned = angle;
    const Vector2 before = at(i) - at(i - 2 * reach);
    const Vector2 after = at(i + 2 * reach) - at(i);
    const double span = 0.5 * (core::norm(before) + core::norm(after));
    if (closed || (i >= 2 * reach && i + 2 * reach < n))
      data.curvature[static_cast<std::size_t>(i)] = core::angle_between(before, after) / span;
  }
  return data;
}

std::vector<std::size_t> joint_indices(const ChainData& data, int pieces) {
  const std::size_t n = data.points.size();
  std::vector<double> share(n, 0);
  double turning = 0;
  for (std::size_t i = 1; i < n; ++i)
    turning += std::abs(data.direction[i] - data.direction[i - 1]);
  for (std::size_t i = 1; i < n; ++i)
    share[i] =
        share[i - 1] + 0.5 * (data.length[i] - data.length[i - 1]) / data.length.back() +
        (turning > 0 ? 0.5 * std::abs(data.direction[i] - data.direction[i - 1]) / turning : 0);
  std::vector<std::size_t> indices = {0};
  for (int k = 1; k < pieces; ++k) {
    const double wanted = share.back() * k / pieces;
    const auto found = std::lower_bound(share.begin(), share.end(), wanted) - share.begin();
    indices.push_back(
        std::clamp<std::size_t>(static_cast<std::size_t>(found), indices.back() + 1, n - 2));
  }
  indices.push_back(n - 1);
  return indices;
}

bool split_worst(const ChainData& data, const std::vector<double>& deviations, double tolerance,
                 int most, std::vector<std::size_t>& joints) {
  const double worst = *std::max_element(deviations.begin(), deviations.end());
  const double limit = worst > tolerance ? std::max(tolerance, kSplitShare * worst) : 0;
  std::vector<std::size_t> finer = {joints.front()};
  for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
    const bool room = finer.size() + joints.size() - k - 1 <= static_cast<std::size_t>(most);
    if (room && deviations[k] >= limit && joints[k + 1] >= joints[k] + 6) {
      const double middle = 0.5 * (data.length[joints[k]] + data.length[joints[k + 1]]);
      finer.push_back(static_cast<std::size_t>(
          std::lower_bound(data.length.begin(), data.length.end(), middle) - data.length.begin()));
    }
    finer.push_back(joints[k + 1]);
  }
  const bool split = finer.size() > joints.size();
  joints = std::move(finer);
  return split;
}

}  // namespace keyline::fit
