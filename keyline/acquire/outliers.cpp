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

/// Points that may be strays together, ahead of the first of them. Those between them count as
/// neighbours.
struct Suspects {
  std::array<std::size_t, 3> ahead;
  std::size_t count;
};

constexpr std::array<Suspects, 3> kRuns{{{{0}, 1}, {{0, 1}, 2}, {{0, 1, 2}, 3}}};
/// Such as hide one another: each would be among the neighbours of the other.
constexpr std::array<Suspects, 8> kApart{{{{0, 2}, 2},
                                          {{0, 3}, 2},
                                          {{0, 1, 3}, 3},
                                          {{0, 2, 3}, 3},
                                          {{0, 1, 4}, 3},
                                          {{0, 2, 4}, 3},
                                          {{0, 3, 4}, 3},
                                          {{0, 2, 5}, 3}}};

std::size_t last_ahead(const Suspects& suspects) { return suspects.ahead[suspects.count - 1]; }

/// Unsuspected points on both sides of the suspects and between them, in order.
struct Neighbours {
  std::array<core::Point2, 2 * kSide + 3> list;
  std::size_t count = 0;
  double spacing = 0;  // largest step between neighbours on one side

  std::span<const core::Point2> points() const { return {list.data(), count}; }
  void add(core::Point2 p) { list[count++] = p; }
};

/// Neighbours of the suspects from `first` on, `stride` apart; false near the ends of open curves.
/// Where the points come back from a single one to where they left, that place is a neighbour once.
bool collect(std::span<const core::Point2> points, bool closed, std::size_t first,
             const Suspects& suspects, std::size_t stride, Neighbours& out) {
  const std::size_t n = points.size();
  const std::size_t reach = kSide * stride, last = first + last_ahead(suspects);
  const bool back = suspects.count == 1 && points[(first + n - 1) % n] == points[(last + 1) % n];
  const std::size_t next = back ? last + 1 : last;
  if (!closed && (first < reach || next + reach >= n)) return false;
  for (std::size_t k = kSide; k >= 1; --k) out.add(points[(first + n - k * stride) % n]);
  for (std::size_t k = 1; k < last_ahead(suspects); ++k)
    if (std::ranges::find(suspects.ahead, k) == suspects.ahead.end())
      out.add(points[(first + k) % n]);
  for (std::size_t k = 1; k <= kSide; ++k) out.add(points[(next + k * stride) % n]);
  for (std::size_t k = 1; k < kSide; ++k) {
    const std::size_t after = out.count - kSide + k;
    out.spacing = std::max({out.spacing, core::distance(out.list[k - 1], out.list[k]),
                            core::distance(out.list[after - 1], out.list[after])});
  }
  return true;
}

/// True where leaving the suspects out turns no corner: the tip of a fin is no stray.
bool bridges_are_smooth(const Neighbours& around) {
  for (std::size_t k = kSide - 1; k + kSide <= around.count; ++k) {
    const core::Vector2 before = around.list[k] - around.list[k - 1];
    const core::Vector2 after = around.list[k + 1] - around.list[k];
    if (std::abs(core::angle_between(before, after)) >= kBend) return false;
  }
  return true;
}

/// The curve through the neighbours of suspects: the fit, and the least residual that makes each of
/// them a stray.
struct Expected {
  detail::LocalFit fit;
  std::array<double, 3> far;
};

/// Sets the least residuals of the suspects beside the gaps they leave; false where one is too wide
/// to know what runs there.
bool far_for_gaps(const Suspects& suspects, const Neighbours& around, std::array<double, 3>& far) {
  for (std::size_t k = 0; k < suspects.count;) {
    std::size_t run = 1;
    while (k + run < suspects.count && suspects.ahead[k + run] == suspects.ahead[k] + run) ++run;
    const std::size_t before = kSide - 1 + suspects.ahead[k] - k;  // the neighbour ahead of the gap
    const double bridge = core::distance(around.list[before], around.list[before + 1]);
    if (bridge > kBridge * static_cast<double>(run + 1) * around.spacing) return false;
    const double aside = (run == 1 ? kAside : kRunAside) * bridge;
    for (std::size_t j = 0; j < run; ++j) far[k + j] = std::max(far[k + j], aside);
    k += run;
  }
  return true;
}

std::optional<Expected> expected_at(std::span<const core::Point2> points, bool closed,
                                    std::size_t first, const Suspects& suspects, double noise,
                                    std::size_t stride) {
  Neighbours around;
  if (!collect(points, closed, first, suspects, stride, around)) return std::nullopt;
  const auto fit = detail::LocalFit::make(around.points(), 3);
  if (!fit) return std::nullopt;
  const double freedom = static_cast<double>(around.count) - 4;
  const double misfit = std::sqrt(fit->squared_residuals() / freedom);
  Expected expected{*fit, {}};
  expected.far.fill(std::max(kFar * std::max(noise, misfit), 0.25 * around.spacing));
  if (!far_for_gaps(suspects, around, expected.far) || !bridges_are_smooth(around))
    return std::nullopt;
  return expected;
}

bool are_strays(std::span<const core::Point2> points, std::size_t first, const Suspects& suspects,
                const Expected& expected, double usual) {
  for (std::size_t k = 0; k < suspects.count; ++k) {
    const core::Point2 p = points[(first + suspects.ahead[k]) % points.size()];
    if (std::abs(expected.fit.residual(p)) < std::max(expected.far[k], kUsual * usual))
      return false;
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
    const auto expected = expected_at(points, closed, i, kRuns.front(), noise, stride);
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
  // Those that start at i; null where none do.
  const auto starting_at = [&](std::size_t i) -> const Suspects* {
    const auto found = [&](const Suspects& suspects) {
      const auto expected = expected_at(points, closed, i, suspects, noise, stride);
      return expected && are_strays(points, i, suspects, *expected, usual);
    };
    const auto run = std::ranges::find_if(kRuns, found);
    if (run != kRuns.end()) return &*run;
    if (stride > 1) return nullptr;
    const auto apart = std::ranges::find_if(kApart, found);
    return apart != kApart.end() ? &*apart : nullptr;
  };
  for (std::size_t i = 0; i < n;) {
    const Suspects* suspects = starting_at(i);
    if (suspects == nullptr) {
      ++i;
      continue;
    }
    for (std::size_t k = 0; k < suspects->count; ++k)
      strays.push_back((i + suspects->ahead[k]) % n);
    i += last_ahead(*suspects) + 1;
  }
  add_far_strays(points, closed, strays);
  std::sort(strays.begin(), strays.end());
  strays.erase(std::unique(strays.begin(), strays.end()), strays.end());
  return strays;
}

}  // namespace keyline::acquire
