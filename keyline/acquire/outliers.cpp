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

/// Single end points of an open curve that lie many steps away from the rest.
void add_end_strays(std::span<const core::Point2> points, std::vector<std::size_t>& strays) {
  const std::size_t n = points.size();
  if (n < 10) return;
  const auto jump = [&](std::size_t a, std::size_t b) {
    return core::distance(points[a], points[b]);
  };
  double first = 0, last = 0;
  for (std::size_t k = 1; k <= 5; ++k) {
    first = std::max(first, jump(k, k + 1));
    last = std::max(last, jump(n - 1 - k, n - 2 - k));
  }
  if (jump(0, 1) > 12 * first) strays.push_back(0);
  if (jump(n - 1, n - 2) > 12 * last) strays.push_back(n - 1);
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
  if (!closed) add_end_strays(points, strays);
  std::sort(strays.begin(), strays.end());
  strays.erase(std::unique(strays.begin(), strays.end()), strays.end());
  return strays;
}

}  // namespace keyline::acquire
