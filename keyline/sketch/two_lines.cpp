#include "keyline/sketch/two_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

constexpr double kTwo = 3.2;        ///< times as far apart as within: two lines
constexpr double kFarther = 0.75;   ///< of the common way, on which distances are judged
constexpr double kRoom = 2;         ///< widths: nearer, no stroke has room between them
constexpr std::size_t kEnough = 8;  ///< unions: fewer do not say what is usual
constexpr double kGoesOn = 0.3;   ///< of the shorter stroke at least is beside its line's next pass
constexpr double kWhole = 0.9;    ///< of a line's extent: a pass of all of it
constexpr std::size_t kBack = 3;  ///< samples: so near a place its nearest's nearest is the same

/// The square of a distance between strokes, and the way along them that it stands for.
using Place = std::pair<double, double>;

/// How far apart strokes lie where they run beside each other, place by place.
class Spread {
 public:
  Spread() = default;
  explicit Spread(std::vector<Place> places) : places_(std::move(places)) {
    std::sort(places_.begin(), places_.end(), std::greater<>());
    for (const Place& place : places_) length_ += place.second;
  }

  double length() const { return length_; }

  /// Of the distances on the farther part of the way: two lines may lie on each other on the rest.
  double mean_square() const {
    if (!(length_ > 0)) return std::numeric_limits<double>::infinity();
    double sum = 0;
    double left = kFarther * length_;
    for (const auto& [square, length] : places_) {
      const double way = std::min(left, length);
      sum += way * square;
      left -= way;
    }
    return sum / (kFarther * length_);
  }

  void add(const Spread& more) {
    const auto middle = static_cast<std::ptrdiff_t>(places_.size());
    places_.insert(places_.end(), more.places_.begin(), more.places_.end());
    std::inplace_merge(places_.begin(), places_.begin() + middle, places_.end(), std::greater<>());
    length_ += more.length_;
  }

 private:
  std::vector<Place> places_;  ///< farthest first
  double length_ = 0;
};

/// Of two parts of a group. Opposite sides of a thin ring run beside each other too, but not in the
/// direction in which strokes of one side do.
struct Between {
  Spread same;      ///< where they run in the same direction
  Spread opposite;  ///< where they do not
  bool two_lines = false;

  bool reversed() const { return opposite.mean_square() < same.mean_square(); }
  const Spread& nearer() const { return reversed() ? opposite : same; }
};

using AllBetween = std::vector<std::map<std::size_t, Between>>;  ///< by part; symmetric

/// The sample of another stroke that is nearest to one.
struct Nearest {
  std::size_t sample = 0;
  double distance = std::numeric_limits<double>::infinity();
};

/// By stroke and other stroke, the nearest of the other's samples to all of the stroke's.
using AllNearest = std::vector<std::map<std::size_t, std::vector<Nearest>>>;

AllNearest nearest_samples(const std::vector<SampledStroke>& strokes, const PassModel& at_most) {
  double longest = 0;
  for (const SampledStroke& s : strokes) longest = std::max(longest, s.length);
  const double reach = pass_distance(at_most, longest);
  const StrokeGrid grid(strokes, reach);
  AllNearest all(strokes.size());
  for (std::size_t a = 0; a < strokes.size(); ++a)
    for (std::size_t k = 0; k < strokes[a].points.size(); ++k) {
      const core::Point2 p = strokes[a].points[k];
      grid.visit_others(p, reach, a, [&](std::size_t b, std::size_t m) {
        auto& along = all[a][b];
        along.resize(strokes[a].points.size());
        if (const double d = core::distance(strokes[b].points[m], p); d < along[k].distance)
          along[k] = {m, d};
      });
    }
  return all;
}

/// Adds what the samples of stroke a say of how far b lies, in the same direction and the opposite
/// one: those whose nearest place lies within `reach`, is no end, and has its own nearest place
/// there.
void add_samples(const SampledStroke& a, const SampledStroke& b, const std::vector<Nearest>& to,
                 const std::vector<Nearest>& back, double reach, Between& sum) {
  const std::size_t n = a.points.size();
  const double step = a.length / static_cast<double>(n);
  std::vector<Place> same;
  std::vector<Place> opposite;
  for (std::size_t k = 0; k < n; ++k) {
    const auto [m, d] = to[k];
    if (d > reach || (!b.closed && (m == 0 || m + 1 == b.points.size()))) continue;
    std::size_t away = std::max(k, back[m].sample) - std::min(k, back[m].sample);
    if (a.closed) away = std::min(away, n - away);
    if (away > kBack && step * static_cast<double>(away) > d) continue;
    const double cosine = dot(a.tangents[k], b.tangents[m]);
    (cosine < 0 ? opposite : same).emplace_back(d * d, 0.5 * step * std::abs(cosine));
  }
  sum.same.add(Spread(std::move(same)));
  sum.opposite.add(Spread(std::move(opposite)));
}

AllBetween all_between(const std::vector<SampledStroke>& strokes, const PassModel& at_most) {
  const AllNearest nearest = nearest_samples(strokes, at_most);
  AllBetween all(strokes.size());
  for (std::size_t a = 0; a < strokes.size(); ++a)
    for (const auto& [b, to] : nearest[a]) {
      if (b < a) continue;
      const std::vector<Nearest>& back = nearest[b].at(a);
      const double reach = pass_distance(at_most, std::min(strokes[a].length, strokes[b].length));
      Between sum;
      add_samples(strokes[a], strokes[b], to, back, reach, sum);
      add_samples(strokes[b], strokes[a], back, to, reach, sum);
      if (sum.nearer().length() > 0) all[a][b] = all[b][a] = sum;
    }
  return all;
}

/// Puts the strokes of a group together, part by part, as long as they are passes of one line.
class Parts {
 public:
  Parts(AllBetween between, double usual_square)
      : between_(std::move(between)),
        usual_square_(usual_square),
        within_(between_.size()),
        members_(between_.size()) {
    for (std::size_t a = 0; a < between_.size(); ++a) members_[a] = {a};
  }

  void unite(double room) {
    for (std::size_t a = 0; a < between_.size(); ++a)
      for (const auto& [b, spread] : between_[a])
        if (a < b) offer(a, b);
    while (!open_.empty()) {
      const auto [square, a, b] = open_.top();
      open_.pop();
      const auto found = between_[a].find(b);
      if (found == between_[a].end() || found->second.two_lines ||
          found->second.nearer().mean_square() != square)
        continue;  // no longer so
      if (square > room * room && square > kTwo * kTwo * expected(a, b))
        found->second.two_lines = between_[b].at(a).two_lines = true;
      else
        unite(a, b, square);
    }
  }

  /// Mean squares of the distances of what was put together.
  const std::vector<double>& united() const { return united_; }

  /// Adds the parts told apart; `numbers` of the group's strokes.
  void tell(const std::vector<std::size_t>& numbers, std::vector<TwoLines>& found) const {
    const auto numbered = [&](std::vector<std::size_t> strokes) {
      for (std::size_t& s : strokes) s = numbers[s];
      return strokes;
    };
    for (std::size_t a = 0; a < between_.size(); ++a)
      for (const auto& [b, spread] : between_[a])
        if (a < b && spread.two_lines)
          found.push_back({numbered(members_[a]), numbered(members_[b])});
  }

 private:
  void offer(std::size_t a, std::size_t b) {
    const Between& spread = between_[a].at(b);
    if (!spread.two_lines)
      open_.emplace(spread.nearer().mean_square(), std::min(a, b), std::max(a, b));
  }

  /// Mean square of the distances of passes of one line that is both parts.
  double expected(std::size_t a, std::size_t b) const {
    const double length = between_[a].at(b).nearer().length();
    Spread passes({{usual_square_, length}});
    passes.add(within_[a]);
    passes.add(within_[b]);
    return passes.mean_square();
  }

  void unite(std::size_t a, std::size_t b, double square) {
    united_.push_back(square);
    const bool reversed = between_[a].at(b).reversed();
    within_[a].add(within_[b]);
    within_[a].add(between_[a].at(b).nearer());
    members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
    for (auto& [c, more] : between_[b]) {
      between_[c].erase(b);
      if (c == a) continue;
      Between& sum = between_[a][c];
      sum.same.add(reversed ? more.opposite : more.same);
      sum.opposite.add(reversed ? more.same : more.opposite);
      sum.two_lines |= more.two_lines;
      between_[c][a] = sum;
      offer(a, c);
    }
    between_[b].clear();
  }

  using Pair = std::tuple<double, std::size_t, std::size_t>;

  AllBetween between_;
  double usual_square_;
  std::vector<double> united_;
  std::vector<Spread> within_;                     ///< by part
  std::vector<std::vector<std::size_t>> members_;  ///< by part
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> open_;
};

/// From the point farthest from the middle to the one farthest from that.
double extent(const std::vector<SampledStroke>& some, const std::vector<std::size_t>& which) {
  core::Vector2 sum{};
  double count = 0;
  for (const std::size_t s : which)
    for (const core::Point2 p : some[s].points) {
      sum = sum + (p - core::Point2{});
      ++count;
    }
  core::Point2 from = core::Point2{} + (1 / count) * sum;
  double far = 0;
  for (int sweep = 0; sweep < 2; ++sweep) {
    far = 0;
    core::Point2 end = from;
    for (const std::size_t s : which)
      for (const core::Point2 p : some[s].points)
        if (const double d = core::distance(from, p); d > far) {
          far = d;
          end = p;
        }
    from = end;
  }
  return far;
}

/// Strokes of a group, put together where they run beside each other for long enough.
std::vector<std::vector<std::size_t>> parts_beside(const AllBetween& between,
                                                   const std::vector<SampledStroke>& some) {
  std::vector<std::size_t> part(some.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (std::size_t a = 0; a < some.size(); ++a)
    for (const auto& [b, spread] : between[a]) {
      const double shorter = std::min(some[a].length, some[b].length);
      if (part[a] == part[b] || spread.nearer().length() < kGoesOn * shorter) continue;
      const auto [low, high] = std::minmax({part[a], part[b]});
      std::replace(part.begin(), part.end(), high, low);
    }
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (std::size_t a = 0; a < some.size(); ++a) parts[part[a]].push_back(a);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [name, members] : parts) all.push_back(std::move(members));
  return all;
}

bool is_drawn_whole_twice(const std::vector<SampledStroke>& some,
                          const std::vector<std::size_t>& part) {
  if (part.size() < 2) return false;
  const double whole = kWhole * extent(some, part);
  return std::count_if(part.begin(), part.end(),
                       [&](std::size_t s) { return extent(some, {s}) >= whole; }) >= 2;
}

/// Adds the parts of a group that go on in each other, each drawn whole more than once.
void tell_ends(const AllBetween& between, const std::vector<SampledStroke>& some,
               const std::vector<std::size_t>& numbers, std::vector<TwoLines>& found) {
  auto parts = parts_beside(between, some);
  if (parts.size() < 2) return;
  std::erase_if(parts, [&](const auto& part) { return !is_drawn_whole_twice(some, part); });
  for (auto& part : parts)
    for (std::size_t& s : part) s = numbers[s];
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j) found.push_back({parts[i], parts[j]});
}

}  // namespace

std::vector<TwoLines> two_lines(const std::vector<SampledStroke>& strokes,
                                const std::vector<std::vector<std::size_t>>& groups,
                                const PassModel& at_most) {
  constexpr double kAnything = std::numeric_limits<double>::infinity();
  std::vector<AllBetween> between;  // by group
  std::vector<double> squares;
  std::vector<TwoLines> found;
  for (const auto& group : groups) {
    std::vector<SampledStroke> some;
    for (const std::size_t s : group) some.push_back(strokes[s]);
    between.push_back(all_between(some, at_most));
    tell_ends(between.back(), some, group, found);
    Parts all(between.back(), kAnything);  // as if it were one line
    all.unite(kAnything);
    squares.insert(squares.end(), all.united().begin(), all.united().end());
  }
  if (squares.size() < kEnough) return found;
  const double usual = core::quantile(squares);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Parts parts(std::move(between[g]), usual);
    parts.unite(kRoom * at_most.width);
    parts.tell(groups[g], found);
  }
  return found;
}

}  // namespace keyline::sketch
