#include "keyline/analysis/lddc.h"

#include <algorithm>
#include <cmath>

namespace keyline::analysis {
namespace {

// What is noise: the contract in lddc.h gives the reasons.
constexpr int kFewPoints = 4;
constexpr double kSpikeHeight = 0.3;
constexpr double kStrayShare = 0.05;
constexpr double kEdgeSlack = 1e-9;  // keeps a radius on a bar's edge from flickering by rounding

/// Curvature at arc length s by linear interpolation.
double curvature_at(const CurvatureProfile& p, double s) {
  const auto it = std::upper_bound(p.arc_length.begin() + 1, p.arc_length.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(it - p.arc_length.begin());
  const double ds = p.arc_length[i] - p.arc_length[i - 1];
  const double u = ds > 0 ? (s - p.arc_length[i - 1]) / ds : 0;
  return (1 - u) * p.curvature[i - 1] + u * p.curvature[i];
}

struct Range {
  double low;
  double high;
};

/// Fills the bars; returns the range of log10(radius / length) met inside the diagram.
Range count_points(const CurvatureProfile& p, Lddc& diagram) {
  const double first = p.arc_length.front();
  const double length = p.arc_length.back() - first;
  Range met{1e300, -1e300};
  for (int i = 0; i < kLddcPoints; ++i) {
    const double kappa = std::abs(curvature_at(p, first + length * (i + 0.5) / kLddcPoints));
    const double x = kappa > 0 ? -std::log10(kappa * length) : 1e300;
    const double position = (x - kLddcLow) / kLddcBarWidth + kEdgeSlack;
    if (!(position >= 0)) {
      ++diagram.below;
    } else if (!(position < kLddcBars)) {
      ++diagram.above;
    } else {
      ++diagram.bars[static_cast<std::size_t>(position)].count;
      met = {std::min(met.low, x), std::max(met.high, x)};
    }
  }
  return met;
}

void mark_partial_ends(std::vector<LddcTop>& tops, const Range& met) {
  if (tops.size() < 3) return;
  const double half = kLddcBarWidth / 2;
  const double slack = 0.02 * kLddcBarWidth;
  if (met.low > tops.front().x - half + slack) tops.front().noise = LddcNoise::partial_end;
  if (met.high < tops.back().x + half - slack) tops.back().noise = LddcNoise::partial_end;
}

void mark_few_points(std::vector<LddcTop>& tops) {
  for (LddcTop& top : tops) {
    if (top.noise == LddcNoise::none && top.count < kFewPoints) top.noise = LddcNoise::few_points;
  }
}

/// Marks groups between empty bars that hold few of the points.
void mark_strays(std::vector<LddcTop>& tops) {
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const bool joined = i > 0 && tops[i].x - tops[i - 1].x < 1.5 * kLddcBarWidth;
    if (!joined) groups.push_back({i, i});
    groups.back().second = i;
  }
  std::vector<int> sizes;
  for (const auto& [from, to] : groups) {
    sizes.push_back(0);
    for (std::size_t i = from; i <= to; ++i) sizes.back() += tops[i].count;
  }
  const int largest = sizes.empty() ? 0 : *std::ranges::max_element(sizes);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (sizes[g] == largest || sizes[g] >= kStrayShare * kLddcPoints) continue;
    for (std::size_t i = groups[g].first; i <= groups[g].second; ++i) {
      if (tops[i].noise == LddcNoise::none) tops[i].noise = LddcNoise::stray;
    }
  }
}

void mark_spikes(std::vector<LddcTop>& tops) {
  std::vector<LddcTop*> kept;
  for (LddcTop& top : tops) {
    if (top.noise == LddcNoise::none) kept.push_back(&top);
  }
  std::vector<bool> spike(kept.size(), false);
  for (std::size_t i = 1; i + 1 < kept.size(); ++i) {
    const LddcTop& before = *kept[i - 1];
    const LddcTop& after = *kept[i + 1];
    const double u = (kept[i]->x - before.x) / (after.x - before.x);
    const double line = (1 - u) * before.y + u * after.y;
    const bool lone = std::abs(after.y - before.y) < kSpikeHeight;
    spike[i] = lone && std::abs(kept[i]->y - line) > kSpikeHeight;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (spike[i]) kept[i]->noise = LddcNoise::spike;
  }
}

/// If less than two tops are left, gives back the largest.
void keep_two(std::vector<LddcTop>& tops) {
  auto kept = std::ranges::count(tops, LddcNoise::none, &LddcTop::noise);
  while (kept < 2 && kept < static_cast<std::ptrdiff_t>(tops.size())) {
    LddcTop* best = nullptr;
    for (LddcTop& top : tops) {
      if (top.noise != LddcNoise::none && (!best || top.count > best->count)) best = &top;
    }
    best->noise = LddcNoise::none;
    ++kept;
  }
}

void fit_gradient(Lddc& d) {
  if (d.c_curve.size() < 3) return;
  double weight = 0;
  double mean_x = 0;
  double mean_y = 0;
  for (const LddcTop& top : d.c_curve) {
    weight += top.count;
    mean_x += top.count * top.x;
    mean_y += top.count * top.y;
  }
  mean_x /= weight;
  mean_y /= weight;
  double xx = 0;
  double xy = 0;
  for (const LddcTop& top : d.c_curve) {
    xx += top.count * (top.x - mean_x) * (top.x - mean_x);
    xy += top.count * (top.x - mean_x) * (top.y - mean_y);
  }
  d.has_gradient = true;
  d.gradient = xy / xx;
  d.intercept = mean_y - d.gradient * mean_x;
}

}  // namespace

Lddc curvature_distribution_diagram(const CurvatureProfile& profile) {
  Lddc d;
  d.bars.resize(kLddcBars);
  for (int m = 0; m < kLddcBars; ++m) d.bars[m].low = kLddcLow + kLddcBarWidth * m;
  const std::size_t n = profile.arc_length.size();
  if (n < 2 || profile.curvature.size() != n ||
      !(profile.arc_length.back() > profile.arc_length.front()))
    return d;
  const Range met = count_points(profile, d);
  for (LddcBar& bar : d.bars) {
    if (bar.count == 0) continue;
    bar.height = std::log10(static_cast<double>(bar.count) / kLddcPoints);
    d.tops.push_back({bar.low + kLddcBarWidth / 2, bar.height, bar.count, LddcNoise::none});
  }
  mark_partial_ends(d.tops, met);
  mark_few_points(d.tops);
  mark_strays(d.tops);
  mark_spikes(d.tops);
  keep_two(d.tops);
  for (const LddcTop& top : d.tops) {
    if (top.noise == LddcNoise::none) d.c_curve.push_back(top);
  }
  if (!d.c_curve.empty()) {
    d.a = d.c_curve.front();
    d.b = d.c_curve.back();
    d.distance_ab = std::hypot(d.b.x - d.a.x, d.b.y - d.a.y);
  }
  fit_gradient(d);
  return d;
}

}  // namespace keyline::analysis
