#include "keyline/fairing/straights.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr std::size_t kLeastPoints = 5;  // a line has two freedoms: three are left to tell it by
constexpr double kErrors = 2;     // standard errors of a mean square that a line's may be above
constexpr double kLeastBow = 60;  // in noise, see straight_stretches
constexpr double kBeyond = 0.25;  // of a stretch's length: where the curve around it is looked at

/// Sums over points, to have the line of least squares of any stretch at once.
class Moments {
 public:
  Moments(const std::vector<core::Point2>& points) : sum_(points.size() + 1) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [x, y] = points[i] - points.front();
      const Sums& last = sum_[i];
      sum_[i + 1] = {last.x + x, last.y + y, last.xx + x * x, last.xy + x * y, last.yy + y * y};
    }
  }

  /// Mean square of the distances of points [first, last) from their line.
  double mean_square(std::size_t first, std::size_t last) const {
    const double n = static_cast<double>(last - first);
    const Sums& a = sum_[first];
    const Sums& b = sum_[last];
    const double x = (b.x - a.x) / n;
    const double y = (b.y - a.y) / n;
    const double xx = (b.xx - a.xx) / n - x * x;
    const double xy = (b.xy - a.xy) / n - x * y;
    const double yy = (b.yy - a.yy) / n - y * y;
    const double least = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
    return std::max(0.0, least) * n / std::max(1.0, n - 2);
  }

 private:
  struct Sums {
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  std::vector<Sums> sum_;
};

class Search {
 public:
  Search(const DenseCurve& curve, const std::vector<FitPoint>& points, double noise)
      : curve_(curve), noise_(noise) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[j].count == 0) continue;
      point_.push_back(points[j].position);
      at_.push_back(place_along(curve, curve.feet[j]));
    }
  }

  std::vector<Straight> run() {
    if (point_.size() >= kLeastPoints) part(Moments(point_), 0, point_.size());
    std::sort(found_.begin(), found_.end(),
              [](const Straight& a, const Straight& b) { return a.first < b.first; });
    return found_;
  }

 private:
  bool straight(const Moments& moments, std::size_t first, std::size_t last) const {
    const double most = 1 + kErrors * std::sqrt(2.0 / static_cast<double>(last - first));
    return moments.mean_square(first, last) <= most * noise_ * noise_;
  }

  /// The longest line among points [first, last), then those before and after it.
  void part(const Moments& moments, std::size_t first, std::size_t last) {
    std::size_t best = first;
    std::size_t end = first;
    std::size_t j = first + kLeastPoints;
    for (std::size_t i = first; i + kLeastPoints <= last; ++i) {
      j = std::max(j, i + kLeastPoints);
      while (j < last && straight(moments, i, j + 1)) ++j;
      if (!straight(moments, i, j) || length(i, j) <= length(best, end)) continue;
      best = i;
      end = j;
    }
    if (end < best + kLeastPoints || !told(best, end)) return;
    add(best, end);
    if (best >= first + kLeastPoints) part(moments, first, best);
    if (last >= end + kLeastPoints) part(moments, end, last);
  }

  double length(std::size_t i, std::size_t j) const { return j > i ? at_[j - 1] - at_[i] : 0; }

  /// Whether the curve around is bent so much that the stretch stands out against it; the whole of
  /// an open curve does by itself.
  bool told(std::size_t i, std::size_t j) const {
    if (!curve_.closed && i == 0 && j == point_.size()) return true;
    const double size = length(i, j);
    const double around =
        std::max(most_bend(at_[i], -kBeyond * size), most_bend(at_[j - 1], kBeyond * size));
    return around * size * size / 8 * curve_.length >= kLeastBow * noise_;
  }

  /// Curvature, times the length, at the end of the way from `t` by `by`, or what the curve has
  /// turned by up to some place of the way, over all of it, if that is more: a fillet may be short.
  double most_bend(double t, double by) const {
    constexpr int kSteps = 64;
    double most = std::abs(bend(t + by));
    double turned = 0;
    for (int i = 0; i < kSteps; ++i) {
      turned += bend(t + by * (i + 0.5) / kSteps) / kSteps;
      most = std::max(most, std::abs(turned));
    }
    return most;
  }

  /// Curvature, times the length, at a share of the length; beyond the ends of an open curve none.
  double bend(double t) const {
    if (curve_.closed) t -= std::floor(t);
    if (t < 0 || t > 1) return 0;
    const auto next = std::upper_bound(curve_.at.begin(), curve_.at.end() - 1, t);
    return curve_.joints[next - curve_.at.begin()].curvature;
  }

  void add(std::size_t i, std::size_t j) {
    const auto node = [&](double t) {
      return static_cast<int>(std::lower_bound(curve_.at.begin(), curve_.at.end(), t) -
                              curve_.at.begin());
    };
    const Straight line{node(at_[i]), std::min(node(at_[j - 1]), nodes() - 1)};
    if (line.last > line.first + 1) found_.push_back(line);
  }

  int nodes() const { return static_cast<int>(curve_.at.size()); }

  const DenseCurve& curve_;
  double noise_;
  std::vector<core::Point2> point_;
  std::vector<double> at_;
  std::vector<Straight> found_;
};

/// The same with its ends moved inwards, but for the ends of an open curve whose curvature nothing
/// holds.
Straight shortened(const DenseCurve& curve, Straight line, double share) {
  const double by = share * (curve.at[line.last] - curve.at[line.first]);
  const double from = curve.at[line.first] + by;
  const double to = curve.at[line.last] - by;
  const int end = static_cast<int>(curve.at.size()) - 1;
  if (line.first > 0 || curve.closed || curve.hold_start == Hold::curvature)
    while (line.first + 2 < line.last && curve.at[line.first] < from) ++line.first;
  if (line.last < end || curve.closed || curve.hold_end == Hold::curvature)
    while (line.last - 2 > line.first && curve.at[line.last] > to) --line.last;
  return line;
}

}  // namespace

std::vector<Straight> straight_stretches(const DenseCurve& curve,
                                         const std::vector<FitPoint>& points, double noise) {
  return Search(curve, points, noise).run();
}

DenseCurve with_lines(const DenseCurve& curve, const std::vector<Straight>& lines, double share) {
  DenseCurve out = curve;
  out.sense.clear();
  out.side.clear();
  out.cut = {0};
  out.alpha.clear();
  out.kind.clear();
  const int end = static_cast<int>(curve.at.size()) - 1;
  std::vector<char> straight(curve.at.size(), 0);
  auto line = lines.begin();
  while (out.cut.back() < end) {
    const int at = out.cut.back();
    const Straight now = line == lines.end() ? Straight{end, end} : shortened(curve, *line, share);
    const bool here = at == now.first && now.first < now.last;
    out.cut.push_back(here ? now.last : at + 1);
    out.alpha.push_back(-1);
    out.kind.push_back(here ? PieceKind::line : PieceKind::curve);
    if (!curve.sense.empty()) out.sense.push_back(here ? 0 : curve.sense[at]);
    if (!here) continue;
    straight[now.first] = straight[now.last] = 1;
    ++line;
  }
  out.value.clear();
  const std::vector<signed char> side = sides_of_nodes(curve);
  for (const int node : out.cut) {
    out.value.push_back(straight[node] ? 0 : curve.joints[node].curvature);
    if (!side.empty()) out.side.push_back(straight[node] ? 0 : side[node]);
  }
  if (curve.closed && (straight.front() || straight.back())) {
    out.value.front() = out.value.back() = 0;
    if (!out.side.empty()) out.side.front() = out.side.back() = 0;
  }
  return out;
}

}  // namespace keyline::fairing::detail
