#include "keyline/analysis/profile.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::analysis {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

void fill_rate(CurvatureProfile& p) {
  const std::size_t n = p.arc_length.size();
  p.curvature_rate.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1;
    const std::size_t b = std::min(i + 1, n - 1);
    const double ds = p.arc_length[b] - p.arc_length[a];
    p.curvature_rate[i] = ds > 0 ? (p.curvature[b] - p.curvature[a]) / ds : 0;
  }
}

void fill_turning(CurvatureProfile& p) {
  const std::size_t n = p.arc_length.size();
  p.turning.assign(n, 0);
  for (std::size_t i = 1; i < n; ++i) {
    const double ds = p.arc_length[i] - p.arc_length[i - 1];
    p.turning[i] = p.turning[i - 1] + ds * (p.curvature[i - 1] + p.curvature[i]) / 2;
  }
}

/// Replaces each value that is not finite by the nearest one that is (0 if there is none).
void heal(std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<std::size_t> before(n, n), after(n, n);
  for (std::size_t i = 0; i < n; ++i)
    before[i] = std::isfinite(values[i]) ? i : (i > 0 ? before[i - 1] : n);
  for (std::size_t i = n; i-- > 0;)
    after[i] = std::isfinite(values[i]) ? i : (i + 1 < n ? after[i + 1] : n);
  const std::vector<double> original = values;
  for (std::size_t i = 0; i < n; ++i) {
    if (before[i] == i) continue;
    const bool left = before[i] < n && (after[i] >= n || i - before[i] <= after[i] - i);
    const std::size_t source = left ? before[i] : after[i];
    values[i] = source < n ? original[source] : 0;
  }
}

}  // namespace

core::Result<CurvatureProfile> complete(CurvatureProfile p) {
  using core::ErrorCode;
  const std::size_t n = p.arc_length.size();
  const auto fits = [n](const std::vector<double>& c) { return c.empty() || c.size() == n; };
  if (n < 2)
    return core::fail(ErrorCode::bad_input, "a curvature profile needs at least two samples");
  if (p.curvature.size() != n || !fits(p.curvature_rate) || !fits(p.turning))
    return core::fail(ErrorCode::bad_input, "the columns of a curvature profile differ in size");
  if (!all_finite(p.arc_length) || !all_finite(p.curvature) || !all_finite(p.curvature_rate) ||
      !all_finite(p.turning))
    return core::fail(ErrorCode::bad_input,
                      "a curvature profile holds a number that is not finite");
  if (!std::ranges::is_sorted(p.arc_length) || !(p.arc_length.back() > p.arc_length.front()))
    return core::fail(ErrorCode::bad_input, "arc length must grow along a curvature profile");
  if (p.curvature_rate.empty()) fill_rate(p);
  if (p.turning.empty()) fill_turning(p);
  return p;
}

CurvatureProfile reversed(const CurvatureProfile& p) {
  CurvatureProfile r = p;
  const std::size_t n = p.arc_length.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = n - 1 - i;
    r.arc_length[i] = p.arc_length.back() - p.arc_length[j];
    r.curvature[i] = -p.curvature[j];
    r.curvature_rate[i] = p.curvature_rate[j];
    r.turning[i] = p.turning[j] - p.turning.back();
  }
  return r;
}

CurvatureProfile sample_profile(const CurveView& curve, const ArcLengthTable& table,
                                core::Interval t, int n) {
  CurvatureProfile p;
  const double s0 = table.length_at(t.low);
  const double s1 = table.length_at(t.high);
  double angle = 0;
  double turned = 0;
  for (int i = 0; i < n; ++i) {
    const double s = i == n - 1 ? s1 : s0 + (s1 - s0) * i / (n - 1);
    double at = i == 0 ? t.low : i == n - 1 ? std::nextafter(t.high, 0.0) : table.parameter_at(s);
    at = std::clamp(at, t.low, t.high);
    const curve::Jet2 jet = curve.jet_at(at);
    const double now = curve::tangent_angle(jet);
    if (i > 0) turned += core::wrap_angle(now - angle);
    angle = now;
    p.arc_length.push_back(s - s0);
    p.curvature.push_back(curve::curvature(jet));
    p.curvature_rate.push_back(curve::curvature_rate(jet));
    p.turning.push_back(turned);
  }
  heal(p.curvature);
  heal(p.curvature_rate);
  heal(p.turning);
  return p;
}

}  // namespace keyline::analysis
