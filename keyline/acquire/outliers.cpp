#include "keyline/acquire/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "keyline/acquire/local_fit.h"
#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"

namespace keyline::acquire {
namespace {

constexpr std::size_t kSide = 3;  // neighbours used on each side
constexpr double kFar = 10;   // stray: this many times the noise, and the misfit of its neighbours
constexpr double kUsual = 8;  // and this many times the upper quartile of such residuals

constexpr double kAside = 0.2;     // and this share of the gap a single stray leaves
constexpr double kRunAside = 0.6;  // or a run of strays
constexpr double kBridge = 1.5;  // longest such gap, in steps: across a wider one nothing is known
constexpr double kBend = 0.9;    // largest turn at the ends of the gap, radians

constexpr double kJump = 12;           // far away: this many times the steps around
constexpr std::ptrdiff_t kAround = 5;  // of which there are so many on each side

struct Neighbours {
  std::array<core::Point2, 2 * kSide> points;
  double spacing = 0;  // largest step between neighbours on one side
};

/// Neighbours of the run [first, last], `stride` apart; false near the ends of open curves. Where
/// the points come back from a single one to where they left, that place is a neighbour once.
bool collect(std::span<const core::Point2> points, bool closed, std::size_t first, std::size_t last,
             std::size_t stride, Neighbours& out) {
  const std::size_t n = points.size();
  const std::size_t reach = kSide * stride;
  const bool back = first == last && points[(first + n - 1) % n] == points[(last + 1) % n];
  const std::size_t next = back ? last + 1 : last;
  if (!closed && (first < reach || next + reach >= n)) return false;
  for (std::size_t k = 1; k <= kSide; ++k) {
    out.points[kSide - k] = points[(first + n - k * stride) % n];
    out.points[kSide - 1 + k] = points[(next + k * stride) % n];
  }
  out.spacing = 0;
  for (std::size_t k = 1; k < kSide; ++k) {
    out.spacing = std::max({out.spacing, core::distance(out.points[k - 1], out.points[k]),
                            core::distance(out.points[kSide + k - 1], out.points[kSide + k])});
  }
  return true;
}

/// True where leaving the run out turns no corner: the tip of a fin is no stray.
bool bridge_is_smooth(const Neighbours& around) {
  const auto& p = around.points;
  const core::Vector2 before = p[kSide - 1] - p[kSide - 2];
  const core::Vector2 bridge = p[kSide] - p[kSide - 1];
  const core::Vector2 after = p[kSide + 1] - p[kSide];
  return std::abs(core::angle_between(before, bridge)) < kBend &&
         std::abs(core::angle_between(bridge, after)) < kBend;
}

/// The curve through the neighbours of a run: the fit and the least residual that makes a stray.
struct Expected {
  detail::LocalFit fit;
  double far = 0;
};

std::optional<Expected> expected_at(std::span<const core::Point2> points, bool closed,
                                    std::size_t first, std::size_t count, double noise,
                                    std::size_t stride) {
  Neighbours around;
  if (!collect(points, closed, first, first + count - 1, stride, around)) return std::nullopt;
  const auto fit = detail::LocalFit::make(around.points, 3);
  if (!fit) return std::nullopt;
  const double freedom = 2 * kSide - 4;
  const double misfit = std::sqrt(fit->squared_residuals() / freedom);
  const double bridge = core::distance(around.points[kSide - 1], around.points[kSide]);
  if (bridge > kBridge * static_cast<double>(count + 1) * around.spacing) return std::nullopt;
  if (!bridge_is_smooth(around)) return std::nullopt;
  const double aside = (count == 1 ? kAside : kRunAside) * bridge;
  return Expected{*fit, std::max({kFar * std::max(noise, misfit), 0.25 * around.spacing, aside})};
}

bool is_stray_run(std::span<const core::Point2> points, std::size_t first, std::size_t count,
                  const Expected& expected, double usual) {
  const double far = std::max(expected.far, kUsual * usual);
  for (std::size_t k = 0; k < count; ++k) {
    if (std::abs(expected.fit.residual(points[(first + k) % points.size()])) < far) return false;
  }
  return true;
}

/// Upper quartile of the residuals of points against their neighbours: large where the data are
/// full of sharp features, so that one more is no surprise.
double usual_residual(std::span<const core::Point2> points, bool closed, double noise,
                      std::size_t stride) {
  std::vector<double> residuals;
  const std::size_t skip = std::max<std::size_t>(1, points.size() / 4000);
  for (std::size_t i = 0; i < points.size(); i += skip) {
    const auto expected = expected_at(points, closed, i, 1, noise, stride);
    if (expected) residuals.push_back(std::abs(expected->fit.residual(points[i])));
  }
  return core::quantile(std::move(residuals), 3, 4);
}

/// Steps between up to kAround + 1 points in a row, from `from` on by `by`, added to `steps`.
void add_steps(std::span<const core::Point2> points, bool closed, std::size_t from, int by,
               std::vector<double>& steps) {
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  for (std::ptrdiff_t k = 0; k < kAround; ++k) {
    std::ptrdiff_t a = static_cast<std::ptrdiff_t>(from) + k * by, b = a + by;
    if (closed) {
      a = (a + 2 * n) % n;
      b = (b + 2 * n) % n;
    }
    if (std::min(a, b) < 0 || std::max(a, b) >= n) break;
    steps.push_back(core::distance(points[a], points[b]));
  }
}

/// Whether an end of an open curve lies many times its largest step away.
bool is_far_end(std::span<const core::Point2> points, bool first) {
  const std::size_t end = first ? 0 : points.size() - 1;
  const std::size_t next = first ? 1 : end - 1;
  std::vector<double> steps;
  add_steps(points, false, next, first ? 1 : -1, steps);
  return core::distance(points[end], points[next]) > kJump * *std::ranges::max_element(steps);
}

/// Single points many steps away from the rest: an end of an open curve, and what lies between two
/// neighbours that are not much farther from each other than others are.
void add_far_strays(std::span<const core::Point2> points, bool closed,
                    std::vector<std::size_t>& strays) {
  const std::size_t n = points.size();
  if (n < 10) return;
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) {
      if (is_far_end(points, i == 0)) strays.push_back(i);
      continue;
    }
    const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
    const double jump = std::min(core::distance(points[before], points[i]),
                                 core::distance(points[i], points[after]));
    const double bridge = core::distance(points[before], points[after]);
    if (2 * kBridge * jump <= kJump * bridge) continue;
    std::vector<double> steps;
    add_steps(points, closed, before, -1, steps);
    add_steps(points, closed, after, 1, steps);
    const double usual = core::quantile(std::move(steps));
    if (bridge <= 2 * kBridge * usual && jump > kJump * usual) strays.push_back(i);
  }
}

}  // namespace

std::vector<std::size_t> find_outliers(std::span<const core::Point2> points, bool closed,
                                       double noise, std::size_t stride) {
  std::vector<std::size_t> strays;
  const std::size_t n = points.size();
  if (n < 2 * kSide * stride + 4) return strays;
  const double usual = usual_residual(points, closed, noise, stride);
  std::size_t i = 0;
  while (i < n) {
    std::size_t run = 0;
    for (std::size_t count = 1; count <= 3 && run == 0; ++count) {
      const auto expected = expected_at(points, closed, i, count, noise, stride);
      if (expected && is_stray_run(points, i, count, *expected, usual)) run = count;
    }
    for (std::size_t k = 0; k < run; ++k) strays.push_back(i + k);
    i += std::max<std::size_t>(run, 1);
  }
  add_far_strays(points, closed, strays);
  std::sort(strays.begin(), strays.end());
  strays.erase(std::unique(strays.begin(), strays.end()), strays.end());
  return strays;
}

}  // namespace keyline::acquire
