#include "keyline/lac/space/compound_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <boost/math/tools/minima.hpp>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac::detail::space {
namespace {

constexpr double kMet = 1e-13;           // radians
constexpr double kMost = 3 * core::kPi;  // turning to either side
constexpr double kNext = 1.2;            // turning of a place over that of the one before, at most
constexpr int kHalvings = 14;            // of a step of the rate, until that is so

/// A curve that turns as wanted in all.
struct Place {
  Member curve;
  double start = 0;    ///< its direction at the start, less what is wanted
  double turning = 0;  ///< to either side
};

/// Places one after another along a smooth run of curves. Between two of them the rate leads and
/// the size follows from the turning, or, next to a balanced curve, the other way round.
struct Run {
  std::vector<Place> places;
  bool by_size = false;
};

class Search {
 public:
  explicit Search(const Family& family) : family_(family) {}
  void everywhere();
  PlaneSearch result() &&;

 private:
  std::optional<Place> place(const Member& m) const;
  std::optional<Place> place_of_rate(double rate) const;
  std::optional<Place> place_of_size(double size, double one, double other) const;
  std::optional<Place> place_at(const Run& run, double x) const;
  void go_on(double low, double high, int halvings);
  void about_balance(double low, double high);
  void from_edge(double edge, double balanced, double side);
  void add(double rate);
  void end_run();
  void look_through(const Run& run);
  void look_between(const Run& run, double low, double high);
  void look_about(const Run& run, std::size_t i);
  bool settle(Member& m);
  void take(const Place& near);

  const Family& family_;
  Run run_;  ///< led by the rate, as far as it has come
  std::optional<Chain> best_;
  double least_ = HUGE_VAL;  ///< turning of the best
  core::Interval starts_{1, -1};
  bool inflects_ = false;
  int iterations_ = 0;
};

std::optional<Place> Search::place(const Member& m) const {
  const auto off = family_.off(m);
  const auto bends = family_.bends(m.rate);
  if (!off || !bends) return std::nullopt;
  return Place{m, off->start, std::abs(m.size) * bends->both};
}

std::optional<Place> Search::place_of_rate(double rate) const {
  const auto bends = family_.bends(rate);
  return bends ? place({rate, family_.turning() / bends->net}) : std::nullopt;
}

/// Of the rates between two the one whose curve of this size turns as wanted.
std::optional<Place> Search::place_of_size(double size, double one, double other) const {
  const auto missing = [&](double rate) {
    const auto bends = family_.bends(rate);
    return bends ? bends->net - family_.turning() / size : std::nan("");
  };
  const auto [low, high] = std::minmax(one, other);
  const auto rate = numeric::bracketed_root(missing, low, high, 0);
  if (rate) return place({*rate, size});
  const bool nearer = std::abs(missing(one)) < std::abs(missing(other));
  return place({nearer ? one : other, size});  // rounding
}

/// Between places, x counting them.
std::optional<Place> Search::place_at(const Run& run, double x) const {
  const auto i = std::min(static_cast<std::size_t>(x), run.places.size() - 2);
  const Member &a = run.places[i].curve, &b = run.places[i + 1].curve;
  const double share = x - static_cast<double>(i);
  if (share == 0) return run.places[i];
  if (share == 1) return run.places[i + 1];
  if (!run.by_size) return place_of_rate(std::lerp(a.rate, b.rate, share));
  return place_of_size(a.size * std::pow(b.size / a.size, share), a.rate, b.rate);
}

/// Newton's method by differences in the rate and the logarithm of the size.
bool Search::settle(Member& m) {
  auto at = family_.off(m);
  const auto moved = [&m](double rate, double log_size) {
    return Member{m.rate + rate, m.size * std::exp(log_size)};
  };
  for (int i = 0; at && i < 40 && at->largest() > 1e-15; ++i) {
    const double h = 1e-7 * std::max(std::abs(m.rate), 1e-3), k = 1e-7;
    const auto r0 = family_.off(moved(-h, 0)), r1 = family_.off(moved(h, 0));
    const auto s0 = family_.off(moved(0, -k)), s1 = family_.off(moved(0, k));
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
      next = family_.off(moved(-share * step[0], -share * step[1]));
      if (next && next->largest() < at->largest()) break;
    }
    if (!(share > 1e-4)) break;  // as good as rounding lets it be, or stuck
    m = moved(-share * step[0], -share * step[1]);
    at = next;
  }
  return at && at->largest() <= kMet;
}

/// The solution next to a place, unless one that turns less is known.
void Search::take(const Place& near) {
  if (near.turning > 1.001 * least_) return;
  Member m = near.curve;
  if (!settle(m)) return;
  auto c = family_.chain(m);
  const double turning = absolute_turning(c->pieces[0]) + absolute_turning(c->pieces[1]);
  if (!(turning < least_)) return;
  least_ = turning;
  best_ = std::move(c);
}

void Search::look_between(const Run& run, double low, double high) {
  const auto start = [&](double x) {
    const auto p = place_at(run, x);
    return p ? p->start : std::nan("");
  };
  const auto root = numeric::bracketed_root(start, low, high, 0);
  const auto found = root ? place_at(run, *root) : std::nullopt;
  if (found && std::abs(found->start) < 1e-3) take(*found);  // no jump where the chord is nothing
}

/// Where directions come near what is wanted and turn back, two curves may lie between places.
void Search::look_about(const Run& run, std::size_t i) {
  const double sign = run.places[i].start < 0 ? -1 : 1;
  const auto at = [&](std::size_t k) { return sign * run.places[k].start; };
  const double here = at(i), before = at(i - 1), after = at(i + 1);
  const bool low = here < before && here < after && before < 1 && after < 1;
  if (!low || here > before + after - 2 * here) return;  // a parabola dips by an eighth of that
  const auto start = [&](double x) {
    const auto p = place_at(run, x);
    return p ? sign * p->start : HUGE_VAL;
  };
  const auto x = static_cast<double>(i);
  std::uintmax_t most = 40;
  const auto [bottom, least] = boost::math::tools::brent_find_minima(start, x - 1, x + 1, 26, most);
  if (least > 1e-9) return;
  if (const auto p = place_at(run, bottom)) take(*p);
  look_between(run, x - 1, bottom);
  look_between(run, bottom, x + 1);
}

void Search::look_through(const Run& run) {
  for (std::size_t i = 0; i + 1 < run.places.size(); ++i) {
    const double here = run.places[i].start, next = run.places[i + 1].start;
    const auto x = static_cast<double>(i);
    if (here * next <= 0 && std::abs(here - next) < core::kPi) look_between(run, x, x + 1);
    if (i > 0) look_about(run, i);
  }
}

void Search::end_run() {
  look_through(run_);
  run_.places.clear();
}

void Search::add(double rate) {
  auto p = place_of_rate(rate);
  if (!p) return end_run();
  const auto bends = family_.bends(rate);
  if (!bends->inflects) {
    const double start = family_.from() + p->start;
    const bool first = starts_.low > starts_.high;
    starts_.low = first ? start : std::min(starts_.low, start);
    starts_.high = first ? start : std::max(starts_.high, start);
  }
  run_.places.push_back(*std::move(p));
}

/// From one rate to the next, in steps in which the turning changes little.
void Search::go_on(double low, double high, int halvings) {
  const auto a = family_.bends(low), b = family_.bends(high);
  if (!a || !b) return end_run();
  inflects_ = inflects_ || a->inflects || b->inflects;
  if (a->net == 0 || (a->net < 0) != (b->net < 0)) {
    end_run();
    return about_balance(low, high);
  }
  const double whole = std::abs(family_.turning());
  const double turns_low = whole * a->both / std::abs(a->net);
  const double turns_high = whole * b->both / std::abs(b->net);
  const auto [least, most] = std::minmax(turns_low, turns_high);
  if (whole == 0 || least > kMost) return end_run();
  if (most > kNext * least && halvings > 0) {
    const double middle = std::midpoint(low, high);
    go_on(low, middle, halvings - 1);
    return go_on(middle, high, halvings - 1);
  }
  if (run_.places.empty()) add(low);
  add(high);
}

/// Between these rates lies a curve that turns as much to one side as to the other.
void Search::about_balance(double low, double high) {
  const auto net = [&](double rate) { return family_.bends(rate)->net; };
  const auto balanced = numeric::bracketed_root(net, low, high, 0);
  if (!balanced) return;
  from_edge(low, *balanced, 1);
  from_edge(high, *balanced, -1);
}

/// side: the sign of the size where nothing is turned by in all; of each one takes one.
void Search::from_edge(double edge, double balanced, double side) {
  const auto from = family_.bends(edge), to = family_.bends(balanced);
  if (!from || !to) return;
  const double whole = family_.turning();
  const double sign = whole == 0 ? side : std::copysign(1, whole * from->net);
  const double at_edge = whole == 0 ? 0 : std::abs(whole / from->net);
  const double most = kMost / std::min(from->both, to->both);
  Run run{{}, true};
  double size = std::max(at_edge, 0.9 * family_.least_turning() / std::max(from->both, to->both));
  for (; size < most; size *= kNext) {
    auto p =
        size == at_edge ? place({edge, sign * size}) : place_of_size(sign * size, edge, balanced);
    if (!p) continue;
    run.places.push_back(*std::move(p));
  }
  look_through(run);
}

void Search::everywhere() {
  const std::vector<double> rates = family_.rates();
  for (std::size_t i = 0; i + 1 < rates.size(); ++i) go_on(rates[i], rates[i + 1], kHalvings);
  end_run();
}

PlaneSearch Search::result() && {
  const double from = family_.from();
  const bool one_signed = from * (from + family_.turning()) < 0;
  PlaneSearch r{{}, one_signed ? starts_ : core::Interval{1, -1}, inflects_, iterations_};
  if (!best_) return r;
  const core::Vector2 chord = end_pose(*best_).position - core::Point2{};
  const double scale = 1 / norm(chord);
  for (Piece& p : best_->pieces) {
    p.length *= scale;
    p.curvature_start /= scale;
    p.curvature_end /= scale;
  }
  best_->start.direction = from;
  r.found = std::move(best_);
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
  Search search(family);
  search.everywhere();
  return std::move(search).result();
}

}  // namespace keyline::lac::detail::space
