#include "keyline/sketch/pass_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>

namespace keyline::sketch {
namespace {

using core::cross;
using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kAgainst = 0.8;   ///< most that a place speaks against: hands slip
constexpr double kSeen = 2.5;      ///< distances at most: what is farther away is not compared
constexpr double kShadowed = 0.5;  ///< of what speaks against is left across a stroke in between
constexpr double kGoesOn = 0.7;    ///< of what speaks for it, where one ends and the other goes on
constexpr double kFork = 2;        ///< distances on from where strokes part that two ways are seen
constexpr double kGap = 3;         ///< widths: a line across a longer gap would be off its strokes

/// The place of another stroke that is nearest to a sample.
struct Beside {
  std::size_t stroke = 0;
  std::size_t sample = 0;
  double distance = 0;
  double across = 0;  ///< signed, along the normal of the sample
  double angle = 0;   ///< between the directions, at most a right one
};

class Witness {
 public:
  Witness(const std::vector<SampledStroke>& strokes, const PassReach& reach)
      : strokes_(strokes),
        model_(reach.seen),
        reach_(reach),
        seen_(kSeen * pass_distance(reach.at_most, longest(strokes))),
        grid_(strokes, seen_),
        place_(strokes.size(), 0) {}

  PassEvidence evidence() {
    PassEvidence all(strokes_.size());
    for (std::size_t a = 0; a < strokes_.size(); ++a) {
      const double step = step_of(a);
      for (auto& [b, said] : said_by(a)) {
        weigh_forks(a, b, said);
        double sum = 0;
        for (const Said& one : said) sum += 0.5 * step * one.says;
        if (sum == 0) continue;
        all[a][b] += sum;
        all[b][a] += sum;
      }
    }
    return all;
  }

 private:
  /// What a sample says of another stroke, per length.
  struct Said {
    std::size_t sample = 0;
    std::size_t beside = 0;  ///< sample of the other stroke
    double says = 0;
  };

  double step_of(std::size_t s) const {
    return strokes_[s].length / static_cast<double>(strokes_[s].points.size());
  }

  /// What a stroke's samples say of others, by the other one, along the stroke.
  std::map<std::size_t, std::vector<Said>> said_by(std::size_t a) {
    std::map<std::size_t, std::vector<Said>> all;
    for (std::size_t k = 0; k < strokes_[a].points.size(); ++k) {
      look(a, k);
      for (std::size_t i = 0; i < beside_.size(); ++i)
        if (const double says = speaks(a, k, i); says != 0)
          all[beside_[i].stroke].push_back({k, beside_[i].sample, says});
    }
    return all;
  }

  /// The sample so many steps on; nothing beyond an end.
  static std::optional<std::size_t> onward(const SampledStroke& s, std::size_t from, double steps) {
    const auto n = static_cast<long>(s.points.size());
    const long to = static_cast<long>(from) + std::lround(steps);
    if (s.closed) return static_cast<std::size_t>((to % n + n) % n);
    if (to < 0 || to >= n) return {};
    return static_cast<std::size_t>(to);
  }

  /// Where two strokes that ran beside each other both go on, in two directions, how far the one of
  /// them does that goes less far; 0 elsewhere: passes of one line run beside each other until one
  /// of them ends. `way`: along the samples of a or back.
  double fork_at(std::size_t a, std::size_t b, const Said& at, int way) const {
    const SampledStroke& s = strokes_[a];
    const SampledStroke& o = strokes_[b];
    const double apart = apart_of(a, b);
    const int other_way = dot(s.tangents[at.sample], o.tangents[at.beside]) < 0 ? -way : way;
    const auto p = onward(s, at.sample, way * kFork * apart / step_of(a));
    const auto q = onward(o, at.beside, other_way * kFork * apart / step_of(b));
    if (!p || !q || distance(s.points[*p], o.points[*q]) < apart) return 0;
    if (way * other_way * dot(s.tangents[*p], o.tangents[*q]) >= std::cos(model_.angle)) return 0;
    return std::min(left_of(a, at.sample, way), left_of(b, at.beside, other_way));
  }

  /// Length of a stroke from a sample on.
  double left_of(std::size_t s, std::size_t sample, int way) const {
    const SampledStroke& stroke = strokes_[s];
    if (stroke.closed) return stroke.length;
    const std::size_t steps = way < 0 ? sample : stroke.points.size() - 1 - sample;
    return step_of(s) * static_cast<double>(steps);
  }

  /// A stretch beside each other that ends at a fork says so much less for two strokes as they go
  /// on alone: a band nestles against a bottle's side, a spoke against the rim.
  void weigh_forks(std::size_t a, std::size_t b, std::vector<Said>& said) const {
    for (std::size_t i = 0; i < said.size();) {
      std::size_t j = i;
      while (j < said.size() && said[j].says > 0 && said[j].sample - said[i].sample == j - i) ++j;
      if (j == i) {
        ++i;
        continue;
      }
      const double alone = fork_at(a, b, said[i], -1) + fork_at(a, b, said[j - 1], 1);
      const double share = 1 - alone / (step_of(a) * static_cast<double>(j - i));
      for (std::size_t k = i; k < j; ++k) said[k].says *= std::max(0.0, share);
      i = j;
    }
  }

  static double longest(const std::vector<SampledStroke>& strokes) {
    double length = 0;
    for (const SampledStroke& s : strokes) length = std::max(length, s.length);
    return length;
  }

  /// Nearest places of all other strokes in sight of a sample, nearest first.
  void look(std::size_t a, std::size_t k) {
    for (const Beside& b : beside_) place_[b.stroke] = 0;
    beside_.clear();
    const Point2 p = strokes_[a].points[k];
    const Vector2 t = strokes_[a].tangents[k];
    grid_.visit_others(p, seen_, a, [&](std::size_t b, std::size_t m) {
      const double d = distance(strokes_[b].points[m], p);
      if (place_[b] == 0) {
        beside_.push_back({b, m, d});
        place_[b] = beside_.size();
      } else if (Beside& known = beside_[place_[b] - 1]; d < known.distance) {
        known.sample = m;
        known.distance = d;
      }
    });
    for (Beside& b : beside_) {
      const SampledStroke& s = strokes_[b.stroke];
      b.across = cross(t, s.points[b.sample] - p);
      b.angle = std::acos(std::min(1.0, std::abs(dot(t, s.tangents[b.sample]))));
    }
    std::sort(beside_.begin(), beside_.end(), [](const Beside& x, const Beside& y) {
      return std::tie(x.distance, x.stroke) < std::tie(y.distance, y.stroke);
    });
  }

  /// How far passes of a line lie apart that both strokes are of.
  double apart_of(std::size_t a, std::size_t b) const {
    const double shorter = std::min(strokes_[a].length, strokes_[b].length);
    return std::min(pass_distance(model_, shorter),
                    std::max(reach_.of_stroke[a], reach_.of_stroke[b]));
  }

  /// What sample k of stroke a says of the i-th stroke beside it, per length.
  double speaks(std::size_t a, std::size_t k, std::size_t i) const {
    const Beside& b = beside_[i];
    const SampledStroke& other = strokes_[b.stroke];
    const double shorter = std::min(strokes_[a].length, other.length);
    if (b.distance > kSeen * pass_distance(reach_.at_most, shorter)) return 0;
    const double apart = apart_of(a, b.stroke);
    const double turn = b.angle / model_.angle;
    const Vector2 tangent = other.tangents[b.sample];
    const Vector2 from = strokes_[a].points[k] - other.points[b.sample];
    if (!other.closed && (b.sample == 0 || b.sample + 1 == other.points.size())) {
      const double beyond = dot(from, b.sample == 0 ? -tangent : tangent);
      const double step = other.length / static_cast<double>(other.points.size());
      if (beyond > 0.5 * step) {
        const double gap = kGap * model_.width;
        const double aside = cross(tangent, from) / apart;
        return std::max(0.0, kGoesOn * (1 - aside * aside - turn * turn - beyond / gap)) / apart;
      }
    }
    const double far = b.distance / apart;
    double says = std::max(1 - far * far - turn * turn, -kAgainst);
    if (says < 0) says *= std::cos(b.angle) * (is_shadowed(i) ? kShadowed : 1);
    return says / apart;
  }

  /// True where a nearer stroke runs between a sample and the i-th stroke beside it.
  bool is_shadowed(std::size_t i) const {
    return std::any_of(
        beside_.begin(), beside_.begin() + static_cast<long>(i), [&](const Beside& nearer) {
          return nearer.across * beside_[i].across > 0 && nearer.angle < model_.angle;
        });
  }

  const std::vector<SampledStroke>& strokes_;
  const PassModel& model_;
  const PassReach& reach_;
  double seen_;
  StrokeGrid grid_;
  std::vector<Beside> beside_;
  std::vector<std::size_t> place_;  ///< of a stroke in beside_, from 1; 0: none
};

}  // namespace

double pass_distance(const PassModel& model, double length) {
  return std::hypot(model.apart * model.width, model.hand * length);
}

PassEvidence pass_evidence(const std::vector<SampledStroke>& strokes, const PassReach& reach) {
  return Witness(strokes, reach).evidence();
}

std::vector<std::vector<std::size_t>> group_by_evidence(const PassEvidence& evidence) {
  PassEvidence between = evidence;
  std::vector<std::size_t> group(evidence.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  using Pair = std::tuple<double, std::size_t, std::size_t>;
  const auto later = [](const Pair& p, const Pair& q) {
    if (std::get<0>(p) != std::get<0>(q)) return std::get<0>(p) < std::get<0>(q);
    return std::tie(std::get<1>(p), std::get<2>(p)) > std::tie(std::get<1>(q), std::get<2>(q));
  };
  std::priority_queue<Pair, std::vector<Pair>, decltype(later)> open(later);
  const auto offer = [&](std::size_t a, std::size_t b, double says) {
    if (says > 0) open.emplace(says, std::min(a, b), std::max(a, b));
  };
  for (std::size_t a = 0; a < between.size(); ++a)
    for (const auto& [b, says] : between[a])
      if (a < b) offer(a, b, says);
  while (!open.empty()) {
    const auto [says, a, b] = open.top();
    open.pop();
    const auto found = between[a].find(b);
    if (found == between[a].end() || found->second != says) continue;  // no longer so
    for (const auto& [c, more] : between[b]) {
      between[c].erase(b);
      if (c == a) continue;
      const double sum = between[a][c] += more;
      between[c][a] = sum;
      offer(a, c, sum);
    }
    between[b].clear();
    for (std::size_t& g : group)
      if (g == b) g = a;
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < group.size(); ++i) members[group[i]].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [name, list] : members) groups.push_back(std::move(list));
  return groups;
}

}  // namespace keyline::sketch
