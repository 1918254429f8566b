#include "keyline/acquire/ends.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"

namespace keyline::acquire {
namespace {

constexpr double kAcross = 0.8;      // radians
constexpr double kOften = 4.6;       // -ln(0.01): one loop in a hundred has a wider gap
constexpr double kSeamCorner = 0.9;  // radians; less is no corner at the seam of an outline
constexpr double kClearance = 4;     // and less than so many standard errors of the turn there
constexpr double kByChance = 2;      // the same of the turns beside it, which no corner is beside

/// Largest of the steps near both ends.
double spacing_at_ends(std::span<const core::Point2> points, std::size_t stride) {
  double most = 0;
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < 3 && (k + 1) * stride < n; ++k) {
    most = std::max(most, core::distance(points[k * stride], points[(k + 1) * stride]));
    most = std::max(most,
                    core::distance(points[n - 1 - k * stride], points[n - 1 - (k + 1) * stride]));
  }
  return most;
}

/// Turn of the polygon from step a-b to step c-d.
double turn(core::Point2 a, core::Point2 b, core::Point2 c, core::Point2 d) {
  return core::angle_between(b - a, d - c);
}

/// Direction of the curve near one end, from the end inwards: to the first point at least a quarter
/// of the gap away.
core::Vector2 inwards(std::span<const core::Point2> points, bool at_first, double gap) {
  const std::size_t n = points.size();
  const auto at = [&](std::size_t k) { return at_first ? points[k] : points[n - 1 - k]; };
  std::size_t k = 1;
  while (k + 1 < n / 4 && core::distance(at(0), at(k)) < 0.25 * gap) ++k;
  return at(k) - at(0);
}

/// True where the chord between the ends goes on from the curve before it and into that after it.
bool runs_across(std::span<const core::Point2> points) {
  const core::Vector2 chord = points.front() - points.back();
  const double gap = core::norm(chord);
  return std::abs(core::angle_between(-inwards(points, false, gap), chord)) < kAcross &&
         std::abs(core::angle_between(chord, inwards(points, true, gap))) < kAcross;
}

/// The widest gap that points scattered evenly over a loop leave, as a share of its length: of n it
/// passes (ln n + x) / n in a share 1 - exp(-exp(-x)) of all cases (Lévy 1939; Holst 1980).
double widest_gap_by_chance(std::size_t n) {
  const auto count = static_cast<double>(n);
  return std::min((std::log(count) + kOften) / count, 0.2);
}

}  // namespace

Ends recognise_ends(std::span<const core::Point2> points, std::size_t stride, bool scattered,
                    double noise) {
  const std::size_t n = points.size();
  const std::size_t s = std::max<std::size_t>(stride, 1);
  if (n < 4 || n <= 6 * s) return Ends::apart;
  const double length = core::polygon_length(points);
  const double gap = core::distance(points.front(), points.back());
  const bool repeated = gap <= 1e-9 * length;
  const double spacing = spacing_at_ends(points, s);
  const bool near = n >= 8 && gap <= 1.75 * spacing && gap <= 0.2 * length;
  // A wider gap still belongs to an outline if the curve runs straight across it.
  const double widest = scattered ? std::max(0.05, widest_gap_by_chance(n)) * (length + gap)
                                  : std::min(4 * spacing, 0.05 * length);
  const bool facing = n >= 8 && gap <= widest && runs_across(points);
  if (!repeated && !near && !facing) return Ends::apart;

  const auto at = [&](std::size_t k) { return points[k * s]; };
  const auto back = [&](std::size_t k) { return points[n - 1 - k * s]; };
  const double seam = turn(back(1), back(0), at(0), at(1));
  const double beside = std::max(std::abs(turn(at(0), at(1), at(1), at(2))),
                                 std::abs(turn(back(2), back(1), back(1), back(0))));
  // Of steps without a common end, and of the next ones, which have one that counts twice.
  const double error = 2 * noise / spacing;
  const double sure = beside - kByChance * std::sqrt(1.5) * error;
  const bool corner =
      std::abs(seam) >= std::max(kSeamCorner, kClearance * error) && std::abs(seam) >= 3 * sure;
  if (repeated) return corner ? Ends::corner_repeated : Ends::closed_repeated;
  if (!corner) return Ends::closed;
  const double at_last = std::abs(turn(back(1), back(0), back(0), at(0)));
  const double at_first = std::abs(turn(back(0), at(0), at(0), at(1)));
  if (std::min(at_last, at_first) >= 0.3 * std::max(at_last, at_first)) return Ends::blunt;
  return at_first > at_last ? Ends::corner_at_first : Ends::corner_at_last;
}

}  // namespace keyline::acquire
