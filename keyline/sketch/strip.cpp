#include "keyline/sketch/strip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/SparseCore>

#include "keyline/core/quantile.h"
#include "keyline/numeric/solve.h"
#include "keyline/sketch/align_strokes.h"

namespace keyline::sketch {
namespace {

using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kLargestTurn = 0.9;  ///< radians between samples beside each other
constexpr double kAcross = 1;         ///< weight of samples beside each other, 1 along a stroke
constexpr double kUsualSpread = 0.9;  ///< rank
constexpr double kOutOfOrder = 3;     ///< reaches along the line: samples so far off are not beside

/// Sample j of stroke b lies beside sample i of stroke a.
struct Link {
  std::size_t a = 0, i = 0;
  std::size_t b = 0, j = 0;
};

/// Two strokes side by side.
struct Side {
  std::size_t a = 0;
  std::size_t b = 0;
  bool against = false;  ///< b runs against a
  double along = 0;      ///< how much they do, in samples
  std::vector<Link> links;
};

bool boxes_meet(const SampledStroke& a, const SampledStroke& b, double reach) {
  const auto box = [](const SampledStroke& s) {
    std::pair<Point2, Point2> rims{s.points[0], s.points[0]};
    for (const Point2 p : s.points) {
      rims.first = {std::min(rims.first.x, p.x), std::min(rims.first.y, p.y)};
      rims.second = {std::max(rims.second.x, p.x), std::max(rims.second.y, p.y)};
    }
    return rims;
  };
  const auto [low_a, high_a] = box(a);
  const auto [low_b, high_b] = box(b);
  return low_a.x - reach < high_b.x && low_b.x - reach < high_a.x && low_a.y - reach < high_b.y &&
         low_b.y - reach < high_a.y;
}

class Layer {
 public:
  Layer(const std::vector<SampledStroke>& strokes, double reach, double step)
      : strokes_(strokes), reach_(reach), step_(step) {}

  Strip lay() {
    for (std::size_t a = 0; a < strokes_.size(); ++a)
      for (std::size_t b = a + 1; b < strokes_.size(); ++b)
        if (boxes_meet(strokes_[a], strokes_[b], reach_)) compare(a, b);
    strip_.at.resize(strokes_.size());
    strip_.turned.assign(strokes_.size(), false);
    strip_.placed.assign(strokes_.size(), false);
    place_all();
    settle();
    bound();
    return std::move(strip_);
  }

 private:
  void compare(std::size_t a, std::size_t b) {
    if (strokes_[a].length < strokes_[b].length) std::swap(a, b);  // b is laid along a
    const SampledStroke& s = strokes_[b];
    const SampledStroke& line = strokes_[a];
    const Alignment found = align(s, line, reach_);
    Side side{a, b, found.reversed, 0, {}};
    for (std::size_t k = 0; k < found.at.size(); ++k) {
      if (found.at[k] < 0) continue;
      const std::size_t j = found.reversed ? found.at.size() - 1 - k : k;
      const auto i = static_cast<std::size_t>(found.at[k]);
      const double far = core::distance(s.points[j], line.points[i]) / reach_;
      const double turn = std::abs(dot(s.tangents[j], line.tangents[i]));
      if (far > 1 || turn < std::cos(kLargestTurn)) continue;
      side.along += 1 - far * far;
      side.links.push_back({a, i, b, j});
    }
    if (!side.links.empty()) sides_.push_back(std::move(side));
  }

  double sense(std::size_t stroke) const { return strip_.turned[stroke] ? -1 : 1; }

  /// What the place of j is more than that of i.
  double ahead(const Link& l) const {
    const SampledStroke& s = strokes_[l.a];
    return sense(l.a) * dot(s.tangents[l.i], strokes_[l.b].points[l.j] - s.points[l.i]);
  }

  /// Lays a stroke whose sample `zero` has that place.
  void place(std::size_t stroke, std::size_t zero, double at) {
    std::vector<double>& places = strip_.at[stroke];
    for (std::size_t k = 0; k < strokes_[stroke].points.size(); ++k)
      places.push_back(at + sense(stroke) * step_of(stroke) *
                                (static_cast<double>(k) - static_cast<double>(zero)));
    strip_.placed[stroke] = true;
  }

  double step_of(std::size_t stroke) const {
    return strokes_[stroke].length /
           static_cast<double>(std::max<std::size_t>(1, strokes_[stroke].points.size() - 1));
  }

  void place_all() {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < strokes_.size(); ++i)
      if (strokes_[i].length > strokes_[longest].length) longest = i;
    place(longest, 0, 0);
    while (const Side* best = next()) {
      const bool forward = strip_.placed[best->a];
      const std::size_t fresh = forward ? best->b : best->a;
      const std::size_t known = forward ? best->a : best->b;
      strip_.turned[fresh] = strip_.turned[known] != best->against;
      std::vector<double> starts;  // place of the fresh stroke's first sample
      for (const Link& l : best->links) {
        const double from = forward ? strip_.at[known][l.i] + ahead_of_known(l, true)
                                    : strip_.at[known][l.j] + ahead_of_known(l, false);
        starts.push_back(from -
                         sense(fresh) * step_of(fresh) * static_cast<double>(forward ? l.j : l.i));
      }
      place(fresh, 0, core::quantile(std::move(starts)));
    }
  }

  double ahead_of_known(const Link& l, bool forward) const {
    if (forward) return ahead(l);
    const SampledStroke& s = strokes_[l.b];
    return sense(l.b) * dot(s.tangents[l.j], strokes_[l.a].points[l.i] - s.points[l.j]);
  }

  /// The pair that runs longest beside each other of which one is laid.
  const Side* next() const {
    const Side* best = nullptr;
    for (const Side& s : sides_)
      if (strip_.placed[s.a] != strip_.placed[s.b] && (!best || s.along > best->along)) best = &s;
    return best;
  }

  /// All places together: least squares over steps along strokes and links between them.
  void settle() {
    std::vector<std::size_t> base(strokes_.size() + 1, 0);
    for (std::size_t i = 0; i < strokes_.size(); ++i) base[i + 1] = base[i] + strip_.at[i].size();
    const auto n = static_cast<Eigen::Index>(base.back());
    std::vector<Eigen::Triplet<double>> matrix;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    const auto add = [&](std::size_t p, std::size_t q, double weight, double ahead) {
      const auto i = static_cast<Eigen::Index>(p);
      const auto j = static_cast<Eigen::Index>(q);
      matrix.emplace_back(i, i, weight);
      matrix.emplace_back(j, j, weight);
      matrix.emplace_back(std::max(i, j), std::min(i, j), -weight);
      right[j] += weight * ahead;
      right[i] -= weight * ahead;
    };
    for (std::size_t s = 0; s < strokes_.size(); ++s)
      for (std::size_t k = 1; k < strip_.at[s].size(); ++k)
        add(base[s] + k - 1, base[s] + k, 1, sense(s) * step_of(s));
    for (const Side& side : sides_)
      for (const Link& l : side.links) {
        if (!strip_.placed[l.a] || strip_.turned[l.b] != (strip_.turned[l.a] != side.against))
          continue;
        const double off = strip_.at[l.b][l.j] - strip_.at[l.a][l.i] - ahead(l);
        if (std::abs(off) < kOutOfOrder * reach_)
          add(base[l.a] + l.i, base[l.b] + l.j, kAcross, ahead(l));
      }
    for (Eigen::Index i = 0; i < n; ++i) matrix.emplace_back(i, i, 1e-9);
    Eigen::SparseMatrix<double> normal(n, n);
    normal.setFromTriplets(matrix.begin(), matrix.end());
    const numeric::SparseSymmetric solver(normal);
    if (!solver) return;
    const Eigen::VectorXd places = solver.solve(right);
    for (std::size_t s = 0; s < strokes_.size(); ++s)
      for (std::size_t k = 0; k < strip_.at[s].size(); ++k)
        strip_.at[s][k] = places[static_cast<Eigen::Index>(base[s] + k)];
  }

  /// Places in order along every stroke, and between which places they all lie.
  void bound() {
    strip_.first = std::numeric_limits<double>::infinity();
    strip_.last = -strip_.first;
    for (std::size_t s = 0; s < strokes_.size(); ++s) {
      std::vector<double>& at = strip_.at[s];
      for (std::size_t k = 1; k < at.size(); ++k)
        at[k] = strip_.turned[s] ? std::min(at[k], at[k - 1] - 1e-6 * step_)
                                 : std::max(at[k], at[k - 1] + 1e-6 * step_);
      for (const double place : at) {
        strip_.first = std::min(strip_.first, place);
        strip_.last = std::max(strip_.last, place);
      }
    }
  }

  const std::vector<SampledStroke>& strokes_;
  double reach_;
  double step_;
  std::vector<Side> sides_;
  Strip strip_;
};

/// A stroke read by place.
class Reader {
 public:
  Reader(std::vector<double> at, std::vector<Point2> points, bool turned)
      : at_(std::move(at)), points_(std::move(points)) {
    if (!turned) return;
    std::reverse(at_.begin(), at_.end());
    std::reverse(points_.begin(), points_.end());
  }
  bool covers(double place) const { return place >= at_.front() && place <= at_.back(); }
  double inside(double place) const { return std::min(place - at_.front(), at_.back() - place); }
  double start() const { return at_.front(); }
  double end() const { return at_.back(); }
  Point2 position(double place) const {
    const auto next = std::upper_bound(at_.begin(), at_.end(), place) - at_.begin();
    const auto k = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(next, 1, static_cast<std::ptrdiff_t>(at_.size()) - 1));
    const double u = (place - at_[k - 1]) / (at_[k] - at_[k - 1]);
    return core::mix(points_[k - 1], points_[k], std::clamp(u, 0.0, 1.0));
  }

 private:
  std::vector<double> at_;
  std::vector<Point2> points_;
};

std::vector<Reader> readers_of(const Strip& strip, const std::vector<SampledStroke>& strokes) {
  std::vector<Reader> readers;
  for (std::size_t s = 0; s < strokes.size(); ++s)
    if (strip.placed[s]) readers.emplace_back(strip.at[s], strokes[s].points, strip.turned[s]);
  return readers;
}

/// How far inside a stroke a place lies; its ends at the strip's, which are no ends within the
/// line, do not count.
double weighty_inside(const Reader& r, const Strip& strip, double place, double ramp) {
  const bool from_start = r.start() < strip.first + ramp;
  if (r.end() > strip.last - ramp) return from_start ? ramp : place - r.start();
  return from_start ? r.end() - place : r.inside(place);
}

/// Weighted sums of the strokes at a place, and of where those go that reach to the next one, too.
struct MeanStep {
  std::size_t strokes = 0;
  Vector2 sum{};
  Vector2 going{};
  double all = 0;   ///< weights of sum
  double both = 0;  ///< weights of going
};

template <class Weight>
MeanStep mean_step(const std::vector<Reader>& readers, double place, double next,
                   const Weight& weight) {
  MeanStep found;
  for (const Reader& r : readers) {
    if (!r.covers(place)) continue;
    ++found.strokes;
    const double w = weight(r);
    const Point2 here = r.position(place);
    found.sum = found.sum + w * (here - Point2{});
    found.all += w;
    if (!r.covers(next)) continue;
    found.going = found.going + w * (r.position(next) - here);
    found.both += w;
  }
  return found;
}

/// The points l of least Σ |l_{k+1} − l_k − way_k|² + Σ hold_k |l_k − mean_k|².
std::vector<Point2> follow(const std::vector<Vector2>& way, const std::vector<double>& sure,
                           const std::vector<Point2>& mean, const std::vector<double>& hold) {
  const std::size_t n = mean.size();
  std::vector<double> d(n);
  std::vector<Vector2> b(n);
  for (std::size_t k = 0; k < n; ++k) {
    d[k] = hold[k] + 1e-12;
    b[k] = d[k] * (mean[k] - Point2{});
  }
  for (std::size_t k = 0; k + 1 < n; ++k) {
    d[k] += sure[k];
    d[k + 1] += sure[k];
    b[k] = b[k] - sure[k] * way[k];
    b[k + 1] = b[k + 1] + sure[k] * way[k];
  }
  for (std::size_t k = 1; k < n; ++k) {  // off the diagonal stands −sure
    const double share = sure[k - 1] / d[k - 1];
    d[k] -= share * sure[k - 1];
    b[k] = b[k] + share * b[k - 1];
  }
  std::vector<Point2> line(n);
  for (std::size_t k = n; k-- > 0;) {
    Vector2 v = b[k];
    if (k + 1 < n) v = v + sure[k] * (line[k + 1] - Point2{});
    line[k] = Point2{} + v / d[k];
  }
  return line;
}

/// Near the ends, where less than half of the strokes are left, the line goes on as these go
/// instead of moving over to them.
void let_ends_run(const std::vector<std::size_t>& count, std::size_t near,
                  std::vector<double>& hold) {
  const std::size_t zone = std::min(near, count.size() / 4);
  if (zone == 0) return;
  const auto last = static_cast<long>(zone);
  const std::size_t at_start = *std::max_element(count.begin(), count.begin() + last);
  const std::size_t at_end = *std::max_element(count.end() - last, count.end());
  for (std::size_t k = 0; k < zone; ++k) {
    if (2 * count[k] < at_start) hold[k] = 0;
    if (2 * count[count.size() - 1 - k] < at_end) hold[count.size() - 1 - k] = 0;
  }
}

}  // namespace

Strip lay_strip(const std::vector<SampledStroke>& strokes, double reach, double step) {
  return Layer(strokes, reach, step).lay();
}

double spread_of(const Strip& strip, const std::vector<SampledStroke>& strokes, double step) {
  const std::vector<Reader> readers = readers_of(strip, strokes);
  std::vector<double> far;
  for (double place = strip.first; place <= strip.last; place += step) {
    std::vector<Point2> here;
    Vector2 sum{};
    for (const Reader& r : readers)
      if (r.covers(place)) {
        here.push_back(r.position(place));
        sum = sum + (here.back() - Point2{});
      }
    if (here.size() < 2) continue;
    const Point2 middle = Point2{} + sum / static_cast<double>(here.size());
    double most = 0;
    for (const Point2 p : here) most = std::max(most, core::distance(p, middle));
    far.push_back(most);
  }
  if (far.empty()) return 0;
  return core::value_at(far, kUsualSpread);
}

void cut_ends(Strip& strip, double near) {
  std::vector<double> starts;
  std::vector<double> ends;
  for (std::size_t s = 0; s < strip.at.size(); ++s) {
    if (!strip.placed[s]) continue;
    const auto [low, high] = std::minmax(strip.at[s].front(), strip.at[s].back());
    if (low <= strip.first + near) starts.push_back(low);
    if (high >= strip.last - near) ends.push_back(high);
  }
  const double first = core::quantile(std::move(starts));
  const double last = core::quantile(std::move(ends));
  if (last - first < 0.5 * (strip.last - strip.first)) return;
  strip.first = first;
  strip.last = last;
}

std::vector<Point2> middle_of(const Strip& strip, const std::vector<SampledStroke>& strokes,
                              double step, double ramp) {
  const std::vector<Reader> readers = readers_of(strip, strokes);
  const double length = strip.last - strip.first;
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::round(length / step)));
  const double h = length / static_cast<double>(steps);
  std::vector<Point2> mean(steps + 1);
  std::vector<std::size_t> count(steps + 1, 0);
  std::vector<double> hold(steps + 1, 0);
  std::vector<Vector2> way(steps);
  std::vector<double> sure(steps, 1e-3);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double place = k == steps ? strip.last : strip.first + static_cast<double>(k) * h;
    const double next = k + 1 >= steps ? strip.last : place + h;
    const MeanStep found = mean_step(readers, place, next, [&](const Reader& r) {
      return std::min(1.0, (weighty_inside(r, strip, place, ramp) + 0.5 * h) / ramp);
    });
    count[k] = found.strokes;
    if (found.all > 0) mean[k] = Point2{} + found.sum / found.all;
    hold[k] = found.all > 0 ? (h / ramp) * (h / ramp) : 0;
    if (k < steps && found.both > 0) {
      way[k] = found.going / found.both;
      sure[k] = 1;
    }
  }
  let_ends_run(count, static_cast<std::size_t>(2 * ramp / h), hold);
  return follow(way, sure, mean, hold);
}

}  // namespace keyline::sketch
