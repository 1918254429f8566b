#include "keyline/lac/space/compound_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/chain/extend.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac::detail::space {
namespace {

constexpr double kMet = 1e-13;           // radians
constexpr double kMost = 3 * core::kPi;  // turning to either side
constexpr int kSizes = 24;               // of that, tried with an inflection
constexpr int kSteps = 16;               // of the rate, from one power of ten to the next
constexpr double kLeast = 1e-4;          // rate times length over curvature
constexpr double kGreatest = 1e4;

/// Directions at both ends, less what is wanted; the same of the reversed curve.
struct Off {
  double start = 0, end = 0;
  double size() const { return std::max(std::abs(start), std::abs(end)); }
};

/// The curves of a rhythm, of length 1. `rate` is that of curvature at the joint over curvature
/// there, `size` the curvature itself.
class Family {
 public:
  Family(const PlaneRhythm& r, double from, double to) : r_(r), from_(from), turning_(to - from) {}

  double turning() const { return turning_; }

  /// To either side: the tangent is along the chord somewhere.
  double least_turning() const {
    const auto to_chord = [](double x) { return std::min(std::abs(x), core::kPi - std::abs(x)); };
    return std::max({0.001, std::abs(turning_), to_chord(from_) + to_chord(from_ + turning_)});
  }

  /// Empty where a piece ends before its share of the length.
  std::optional<Chain> chain(double rate, double size) const {
    const auto first = curvature_continued(r_.alpha0, 1, -rate, r_.length_share);
    const auto last = curvature_continued(r_.alpha1, 1, rate, 1 - r_.length_share);
    if (!first || !last) return std::nullopt;
    Chain c{{},
            {{r_.alpha0, r_.length_share, size * *first, size},
             {r_.alpha1, 1 - r_.length_share, size, size * *last}}};
    return validate(c) ? std::optional(std::move(c)) : std::nullopt;
  }

  std::optional<Off> off(double rate, double size) const {
    const auto c = chain(rate, size);
    if (!c) return std::nullopt;
    const core::Pose2 end = end_pose(*c);
    const core::Vector2 chord = end.position - core::Point2{};
    if (!(norm(chord) > 1e-6)) return std::nullopt;
    const double start = core::wrap_angle(-core::direction_of(chord) - from_);
    return Off{start, start + end.direction - turning_};
  }

  /// Curvature at the joint with which a curve turns as wanted in all.
  std::optional<double> size_of_turning(double rate) const {
    const auto c = chain(rate, 1);
    if (!c || inflects(*c)) return std::nullopt;
    return turning_ / total_turning(*c);
  }

  static bool inflects(const Chain& c) {
    const double joint = c.pieces[0].curvature_end;
    return c.pieces[0].curvature_start * joint < 0 || c.pieces[1].curvature_end * joint < 0;
  }

  /// Rates from the least to the greatest a piece bears, close to these and to 0.
  std::vector<double> rates() const {
    const double falls = r_.alpha0 > 0 ? 1 / (r_.alpha0 * r_.length_share) : kGreatest;
    const double rises = r_.alpha1 > 0 ? 1 / (r_.alpha1 * (1 - r_.length_share)) : kGreatest;
    std::vector<double> all{0};
    for (const auto& [way, bound] : {std::pair{-1.0, falls}, {1.0, rises}}) {
      for (int i = 0; i <= 8 * kSteps; ++i) {
        const double rate = kLeast * std::pow(10.0, static_cast<double>(i) / kSteps);
        if (rate < 0.5 * bound) all.push_back(way * rate);
      }
      for (int i = 0; i <= 12 * kSteps && bound < kGreatest; ++i)
        all.push_back(way * bound * (1 - 0.5 * std::pow(10.0, -static_cast<double>(i) / kSteps)));
    }
    std::ranges::sort(all);
    return all;
  }

 private:
  PlaneRhythm r_;
  double from_, turning_;
};

struct Found {
  Chain chain;
  double turning = 0;  ///< to either side
};

double turned(const Chain& c) {
  return absolute_turning(c.pieces[0]) + absolute_turning(c.pieces[1]);
}

/// The curves with an inflection of one rate, by size.
struct Column {
  std::array<double, kSizes> sizes{};
  std::array<Off, kSizes> offs{};  ///< infinite where there is none
};

bool is_low(const std::vector<Column>& columns, std::size_t i, int j) {
  const double here = columns[i].offs[j].size();
  for (std::size_t a = i == 0 ? 0 : i - 1; a <= std::min(i + 1, columns.size() - 1); ++a)
    for (int b = std::max(j - 1, 0); b <= std::min(j + 1, kSizes - 1); ++b)
      if (columns[a].offs[b].size() < here) return false;
  return here < 2;
}

/// Whether both directions pass through what is wanted between two columns and from j to j + 1.
bool passes(const Column& a, const Column& b, int j) {
  const std::array<Off, 4> corners{a.offs[j], a.offs[j + 1], b.offs[j], b.offs[j + 1]};
  const auto wanted_between = [&](double Off::* angle) {
    const auto [low, high] = std::ranges::minmax(corners, {}, angle);
    return low.*angle <= 0 && high.*angle >= 0 && high.*angle - low.*angle < core::kPi;
  };
  return wanted_between(&Off::start) && wanted_between(&Off::end);
}

class Search {
 public:
  Search(const Family& family, double from) : family_(family), from_(from) {}

  void without_inflection(const std::vector<double>& rates);
  void with_inflection(const std::vector<double>& rates);
  PlaneSearch result() &&;

 private:
  std::vector<Column> columns_of(const std::vector<double>& rates, double side);
  void take(double rate, double size);
  bool settle(double& rate, double& size);

  const Family& family_;
  double from_;
  std::optional<Found> best_;
  core::Interval starts_{1, -1};
  bool inflects_ = false;
  int iterations_ = 0;
};

/// The solution nearest to what was found, unless another one turns less.
void Search::take(double rate, double size) {
  if (!settle(rate, size)) return;
  auto c = family_.chain(rate, size);
  if (!c) return;
  const double turning = turned(*c);
  if (best_ && best_->turning <= turning) return;
  best_ = Found{std::move(*c), turning};
}

/// Newton's method by differences in the rate and the logarithm of the size.
bool Search::settle(double& rate, double& size) {
  auto at = family_.off(rate, size);
  for (int i = 0; at && i < 40 && at->size() > 1e-15; ++i) {
    const double h = 1e-7 * std::max(std::abs(rate), 1e-3), k = 1e-7;
    const auto r0 = family_.off(rate - h, size), r1 = family_.off(rate + h, size);
    const auto s0 = family_.off(rate, size * (1 - k)), s1 = family_.off(rate, size * (1 + k));
    if (!r0 || !r1 || !s0 || !s1) break;
    std::array<std::array<double, 2>, 2> slope{
        {{(r1->start - r0->start) / (2 * h), (s1->start - s0->start) / (2 * k)},
         {(r1->end - r0->end) / (2 * h), (s1->end - s0->end) / (2 * k)}}};
    std::array<double, 2> step{at->start, at->end};
    if (!solve_small(slope, step)) break;
    ++iterations_;
    std::optional<Off> next;
    double share = 1;
    for (; share > 1e-4; share /= 2) {
      next = family_.off(rate - share * step[0], size * std::exp(-share * step[1]));
      if (next && next->size() < at->size()) break;
    }
    if (!(share > 1e-4)) break;  // as good as rounding lets it be, or stuck
    rate -= share * step[0];
    size *= std::exp(-share * step[1]);
    at = next;
  }
  return at && at->size() <= kMet;
}

/// One sign of curvature: the rate gives the size, and where the curve sets out changes its sign.
void Search::without_inflection(const std::vector<double>& rates) {
  if (family_.turning() == 0) return;
  const auto miss = [&](double rate) {
    const auto size = family_.size_of_turning(rate);
    const auto off = size ? family_.off(rate, *size) : std::nullopt;
    return off ? off->start : std::nan("");
  };
  double before = std::nan(""), last = 0;
  for (const double rate : rates) {
    const double now = miss(rate);
    if (!std::isnan(now)) {
      const double start = from_ + now;
      starts_ = starts_.low > starts_.high
                    ? core::Interval{start, start}
                    : core::Interval{std::min(starts_.low, start), std::max(starts_.high, start)};
    }
    const bool crosses = before * now <= 0 && std::abs(before - now) < core::kPi;
    if (crosses) {
      const auto root = numeric::bracketed_root(miss, last, rate, 0);
      if (root) take(*root, *family_.size_of_turning(*root));
    }
    before = now;
    last = rate;
  }
}

std::vector<Column> Search::columns_of(const std::vector<double>& rates, double side) {
  const double least = family_.least_turning();
  std::vector<Column> columns;
  for (const double rate : rates) {
    Column& column = columns.emplace_back();
    const auto c = family_.chain(rate, 1);
    const double whole = c && Family::inflects(*c) ? turned(*c) : 0;
    inflects_ = inflects_ || whole > 0;
    for (int j = 0; j < kSizes; ++j) {
      const double size = side / whole * least * std::pow(kMost / least, j / (kSizes - 1.0));
      const auto off = whole > 0 ? family_.off(rate, size) : std::nullopt;
      column.sizes[j] = size;
      column.offs[j] = off.value_or(Off{HUGE_VAL, HUGE_VAL});
    }
  }
  return columns;
}

/// Rates and sizes all over, Newton's method from those that miss less than their neighbours and
/// from where both directions pass through what is wanted.
void Search::with_inflection(const std::vector<double>& rates) {
  for (const double side : {1.0, -1.0}) {
    const std::vector<Column> columns = columns_of(rates, side);
    for (std::size_t i = 0; i < rates.size(); ++i)
      for (int j = 0; j < kSizes; ++j)
        if (is_low(columns, i, j)) take(rates[i], columns[i].sizes[j]);
    for (std::size_t i = 0; i + 1 < rates.size(); ++i)
      for (int j = 0; j + 1 < kSizes; ++j) {
        if (!passes(columns[i], columns[i + 1], j)) continue;
        const bool nearer = columns[i].offs[j].size() < columns[i + 1].offs[j + 1].size();
        take(rates[nearer ? i : i + 1], nearer ? columns[i].sizes[j] : columns[i + 1].sizes[j + 1]);
      }
  }
}

PlaneSearch Search::result() && {
  PlaneSearch r{{}, starts_, inflects_, iterations_};
  if (!best_) return r;
  Chain& c = best_->chain;
  const core::Vector2 chord = end_pose(c).position - core::Point2{};
  const double scale = 1 / norm(chord);
  for (Piece& p : c.pieces) {
    p.length *= scale;
    p.curvature_start /= scale;
    p.curvature_end /= scale;
  }
  c.start.direction = from_;
  r.found = std::move(c);
  return r;
}

}  // namespace

PlaneSearch solve_compound_plane(double from, double to, const PlaneRhythm& rhythm) {
  if (from == 0 && to == 0) {
    PlaneSearch line;
    const double share = rhythm.length_share;
    line.found = Chain{{}, {{rhythm.alpha0, share, 0, 0}, {rhythm.alpha1, 1 - share, 0, 0}}};
    return line;
  }
  const Family family(rhythm, from, to);
  const std::vector<double> rates = family.rates();
  Search search(family, from);
  if (from * to < 0) search.without_inflection(rates);
  if (rhythm.alpha0 < 0 || rhythm.alpha1 < 0) search.with_inflection(rates);
  return std::move(search).result();
}

}  // namespace keyline::lac::detail::space
