#include "keyline/sketch/hold_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "keyline/sketch/align_strokes.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kChange = 1000;  ///< price of changing strokes, of the square of the way between
constexpr double kWithin = 0.8;   ///< of `most`, aimed at, so that smoothing may use the rest
constexpr int kRounds = 12;       ///< of moving and smoothing; weights have grown past 1e5 by then
constexpr double kFirmer = 3;     ///< weight per round of places that are still too far off

using Offsets = std::vector<std::optional<double>>;  ///< of a stroke across the line, by sample

/// Offsets of a stroke beside a line; samples stepped over lie between their neighbours'. Where it
/// passes twice the nearer pass counts.
Offsets offsets_of(const SampledStroke& s, const SampledStroke& line, double reach) {
  const Alignment a = align(s, line, reach);
  const std::size_t m = line.points.size();
  Offsets offsets(m);
  const auto pass = [&offsets](std::size_t k, double off) {
    if (!offsets[k] || std::abs(off) < std::abs(*offsets[k])) offsets[k] = off;
  };
  int last = -1;
  double before = 0;
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    if (a.at[i] < 0) {
      last = -1;
      continue;
    }
    const auto j = static_cast<std::size_t>(a.at[i]);
    const Point2 p = s.points[a.reversed ? a.at.size() - 1 - i : i];
    const double off = dot(p - line.points[j], core::perpendicular_left(line.tangents[j]));
    if (distance(p, line.points[j]) < 2 * reach) pass(j, off);
    if (last >= 0)
      for (std::size_t k = (static_cast<std::size_t>(last) + 1) % m; k != j; k = (k + 1) % m) {
        if ((j + m - k) % m > 3) break;
        pass(k, 0.5 * (before + off));
      }
    last = a.at[i];
    before = off;
  }
  return offsets;
}

/// The stroke that the line goes with at a sample.
struct Companion {
  std::size_t stroke = 0;
  double offset = 0;
};
using Companions = std::vector<std::optional<Companion>>;

/// The stroke, one of `all`, that a line goes with at the sample before; as many as there are:
/// none.
struct Before {
  std::size_t stroke = 0;
  double cost = 0;
};

/// The one from which going on with stroke b at sample k costs least.
Before best_before(const std::vector<Offsets>& all, const std::vector<double>& cost, std::size_t k,
                   std::size_t b) {
  Before best{all.size(), std::numeric_limits<double>::infinity()};
  for (std::size_t a = 0; a < all.size(); ++a) {
    if (!std::isfinite(cost[a])) continue;
    const double way = a == b ? 0 : *all[a][k - 1] - *all[b][k];
    if (const double sum = cost[a] + kChange * way * way; sum < best.cost) best = {a, sum};
  }
  return best;
}

/// By sample the stroke the line goes with: least squares of the offsets and, at a price, of the
/// ways from one stroke to another.
Companions choose(const std::vector<Offsets>& all, std::size_t m) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const std::size_t n = all.size();
  std::vector<std::vector<double>> cost(m, std::vector<double>(n, kNone));
  std::vector<std::vector<std::size_t>> from(m, std::vector<std::size_t>(n, n));
  double free_cost = 0;  // of a way that has no stroke beside it just before
  std::size_t free_from = n;
  std::vector<std::size_t> through(m, n);  // by sample without strokes: the stroke before
  for (std::size_t k = 0; k < m; ++k) {
    double least = kNone;
    std::size_t best = n;
    for (std::size_t b = 0; b < n; ++b) {
      if (!all[b][k]) continue;
      const Before before = k > 0 ? best_before(all, cost[k - 1], k, b) : Before{n, kNone};
      cost[k][b] = (before.stroke < n ? before.cost : free_cost) + *all[b][k] * *all[b][k];
      from[k][b] = before.stroke;
      if (cost[k][b] < least) least = cost[k][b], best = b;
    }
    if (best < n) {
      free_cost = least;
      free_from = best;
    }
    through[k] = free_from;
  }
  Companions chosen(m);
  std::size_t at = n;
  for (std::size_t k = m; k-- > 0;) {
    if (at == n) at = through[k];
    if (at == n) break;
    if (!all[at][k]) continue;  // no stroke here: wait for the one before
    chosen[k] = {at, *all[at][k]};
    at = from[k][at];
  }
  return chosen;
}

/// Where strokes that lie too far apart to be kept to both are changed, the line may leave them: it
/// goes over at that angle, as passes of one line do.
void let_change(double spacing, bool closed, double most, double angle, Companions& chosen) {
  const Companions all = chosen;
  const auto m = static_cast<long>(all.size());
  const auto at = [m](long k) { return static_cast<std::size_t>((k % m + m) % m); };
  long before = -1;                                  // the last sample that goes with a stroke
  for (long k = 0; k < (closed ? 2 * m : m); ++k) {  // twice around a closed line: over its seam
    if (!all[at(k)]) continue;
    const long last = std::exchange(before, k);
    if (last < 0 || all[at(last)]->stroke == all[at(k)]->stroke) continue;
    const double way = std::abs(all[at(last)]->offset - all[at(k)]->offset) - 2 * kWithin * most;
    const double middle = 0.5 * static_cast<double>(last + k);
    const double half = 0.5 * way / std::tan(angle) / spacing;
    for (long i = std::lround(std::ceil(middle - half)); i <= std::lround(middle + half); ++i)
      if (closed || (i >= 0 && i < m)) chosen[at(i)].reset();
  }
}

}  // namespace

std::vector<Point2> hold_to_strokes(const SampledStroke& line,
                                    const std::vector<SampledStroke>& strokes, double most,
                                    double reach, const Going& going) {
  const std::size_t m = line.points.size();
  std::vector<Offsets> all;
  for (const SampledStroke& s : strokes) all.push_back(offsets_of(s, line, reach));
  const double spacing = line.length / static_cast<double>(m);
  Companions chosen = choose(all, m);
  let_change(spacing, line.closed, most, going.angle, chosen);
  const auto too_far = [&](std::size_t k, double shift) {
    return chosen[k] && std::abs(shift - chosen[k]->offset) > most;
  };
  std::vector<Point2> shift(m);
  std::vector<Point2> aim(m);
  std::vector<double> weight(m, 1e-2);
  bool any = false;
  for (int round = 0; round < kRounds; ++round) {
    bool done = true;
    for (std::size_t k = 0; k < m; ++k) {
      if (!too_far(k, shift[k].x)) continue;
      done = false;
      const double goal = chosen[k]->offset;
      aim[k].x = std::clamp(shift[k].x, goal - kWithin * most, goal + kWithin * most);
      weight[k] = weight[k] < 1 ? 1 : kFirmer * weight[k];
    }
    if (done) break;
    any = true;
    shift = smooth_points(aim, weight, lambda_of_wavelength(std::max(8.0, going.calm / spacing)),
                          line.closed);
  }
  std::vector<Point2> moved = line.points;
  if (any)
    for (std::size_t k = 0; k < m; ++k)
      moved[k] = moved[k] + shift[k].x * core::perpendicular_left(line.tangents[k]);
  return moved;
}

double share_off(const std::vector<Point2>& points, bool closed,
                 const std::vector<SampledStroke>& strokes, double most) {
  double coarse = most;
  for (const SampledStroke& s : strokes)
    coarse = std::max(coarse, s.length / static_cast<double>(s.points.size()) + most);
  const StrokeGrid grid(strokes, coarse);
  double off = 0;
  double all = 0;
  const std::size_t n = points.size();
  for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
    const Point2 p = core::mix(points[k], points[(k + 1) % n], 0.5);
    const double length = distance(points[k], points[(k + 1) % n]);
    double least = std::numeric_limits<double>::infinity();
    grid.visit(p, coarse, [&](std::size_t s, std::size_t i) {
      const std::vector<Point2>& q = strokes[s].points;
      for (const std::size_t other : {i > 0 ? i - 1 : i, i + 1 < q.size() ? i + 1 : 0}) {
        const Vector2 edge = q[other] - q[i];
        const double along =
            other == i || dot(edge, edge) == 0 ? 0 : dot(p - q[i], edge) / dot(edge, edge);
        if (other == 0 && i + 1 == q.size() && !strokes[s].closed) continue;
        least = std::min(least, distance(p, q[i] + std::clamp(along, 0.0, 1.0) * edge));
      }
      least = std::min(least, distance(p, q[i]));
    });
    all += length;
    if (least > most) off += length;
  }
  return all > 0 ? off / all : 0;
}

}  // namespace keyline::sketch
