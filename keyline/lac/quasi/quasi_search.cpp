#include "keyline/lac/quasi/quasi_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_hermite.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail {

namespace {

constexpr std::size_t kTried = 16;  // places of least miss, of each kind
constexpr double kMostSeriesTurning = 6.2;
constexpr int kDepth = 5;       // of quarters; the first is taken unseen, a miss may dip inside
constexpr int kLeaping = 1;     // down to this depth cells in which a miss leaps are quartered too
constexpr double kMet = 1e-11;  // radians
constexpr double kMostTurning = 1e30;  // of a polygon's piece
constexpr double kFarthest = 350;      // log of the ratio of polygons' radii

bool is_discrete(QuasiForm f) {
  return f == QuasiForm::discrete_angle || f == QuasiForm::discrete_arc;
}

}  // namespace

UnitPiece piece_from(double alpha, const Unknowns& x) {
  const double end = std::exp(-x.log_ratio);
  const double start_curvature = x.turning / numeric::power_mean_integral(1, end, -alpha, 1);
  return unit_piece({alpha, 1, start_curvature, start_curvature * end});
}

double Miss::size() const { return std::max(std::abs(turning), std::abs(chord_angle)); }

HandleSearch::HandleSearch(const HandleAngles& angles, double alpha, const QuasiOptions& options)
    : turning_(std::abs(angles.turning)),
      chord_angle_(std::abs(angles.chord_angle)),
      alpha_(alpha),
      options_(options) {}

bool HandleSearch::solve(Unknowns& x) {
  std::optional<Miss> miss = at(x);
  if (!miss) return false;
  for (iterations = 0; iterations < 60 && miss->size() > 2e-16 * (1 + turning_); ++iterations) {
    const std::optional<Unknowns> step = newton_step(x, *miss);
    if (!step) return false;
    double factor = 1;
    std::optional<Miss> next;
    for (; factor > 1e-3; factor /= 2) {
      next = at({x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning});
      if (next && next->size() < miss->size()) break;
    }
    if (!(factor > 1e-3)) break;  // as good as rounding lets it be, or stuck
    x = {x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning};
    miss = next;
  }
  return miss->size() < kMet;
}

std::optional<Miss> HandleSearch::at(const Unknowns& x) const {
  const bool discrete = is_discrete(options_.form);
  if (!(x.turning > 1e-3 * turning_ &&
        x.turning <= (discrete ? kMostTurning : kMostSeriesTurning)) ||
      !(std::abs(x.log_ratio) <= kFarthest))
    return std::nullopt;
  const EndEdges edges = end_edges(piece_from(alpha_, x));
  const double turned = core::angle_between(edges.first, edges.last) - turning_;
  const double chord = core::angle_between(edges.first, edges.chord) - chord_angle_;
  if (!std::isfinite(turned) || !std::isfinite(chord)) return std::nullopt;
  return Miss{core::wrap_angle(turned), chord};
}

EndEdges HandleSearch::end_edges(const UnitPiece& unit) const {
  const int n = options_.degree;
  if (!is_discrete(options_.form)) {
    const SeriesVariable variable = options_.form == QuasiForm::taylor_angle
                                        ? SeriesVariable::tangent_angle
                                        : SeriesVariable::arc_length;
    return taylor_end_edges(taylor_series(unit, variable, *options_.about, n));
  }
  const ControlPolygon b = draw_form(unit, options_).polygon;
  return {b[1] - b[0], b[n] - b[n - 1], b[n] - b[0]};
}

/// By central differences of the two angles: the step's accuracy is no matter of the result's.
std::optional<Unknowns> HandleSearch::newton_step(const Unknowns& x, const Miss& miss) const {
  const double h = 1e-5;
  const double k = 1e-5 * x.turning;
  const auto a0 = at({x.log_ratio - h, x.turning});
  const auto a1 = at({x.log_ratio + h, x.turning});
  const auto b0 = at({x.log_ratio, x.turning - k});
  const auto b1 = at({x.log_ratio, x.turning + k});
  if (!a0 || !a1 || !b0 || !b1) return std::nullopt;
  const double tq = (a1->turning - a0->turning) / (2 * h);
  const double cq = (a1->chord_angle - a0->chord_angle) / (2 * h);
  const double tt = (b1->turning - b0->turning) / (2 * k);
  const double ct = (b1->chord_angle - b0->chord_angle) / (2 * k);
  const double determinant = tq * ct - cq * tt;
  if (!(std::abs(determinant) > 0)) return std::nullopt;
  const double dq = -(ct * miss.turning - tt * miss.chord_angle) / determinant;
  const double dt = -(tq * miss.chord_angle - cq * miss.turning) / determinant;
  return Unknowns{std::clamp(dq, -1.5, 1.5), std::clamp(dt, -0.5 * x.turning, 0.5 * x.turning)};
}

std::vector<Unknowns> HandleSearch::scan(bool thorough) {
  if (is_discrete(options_.form)) return polygons();
  std::vector<Unknowns> found;
  solve_from(places_of_least_miss(missed()), found);
  if (thorough && found.empty()) solve_from(where_signs_change(), found);
  return found;
}

void HandleSearch::solve_from(const std::vector<Unknowns>& starts, std::vector<Unknowns>& found) {
  for (Unknowns x : starts) {
    if (!solve(x)) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const Unknowns& y) {
      return std::abs(y.log_ratio - x.log_ratio) + std::abs(y.turning - x.turning) < 1e-7;
    });
    if (!known) found.push_back(x);
  }
}

// ---- Polygons -----------------------------------------------------------------------------

/// Of a polygon the turning of its edges is in proportion to that of the piece, so only the ratio
/// of the radii is looked for, by sign: the piece itself may turn many times round within half an
/// edge.
std::vector<Unknowns> HandleSearch::polygons() const {
  std::vector<Unknowns> found;
  std::optional<Miss> before;
  double last = 0;
  for (double log_ratio = -kFarthest; log_ratio <= kFarthest;
       log_ratio += std::max(1.0, 0.1 * std::abs(log_ratio))) {
    const auto now = at(turning_rightly(log_ratio));
    if (before && now && before->chord_angle * now->chord_angle <= 0) {
      const Unknowns x = between(last, log_ratio, before->chord_angle);
      const auto miss = at(x);
      if (miss && miss->size() < kMet) found.push_back(x);
    }
    before = now;
    last = log_ratio;
  }
  return found;
}

/// Where the chord angle is met between two ratios, halved down; `off` is the miss at the first.
Unknowns HandleSearch::between(double low, double high, double off) const {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const auto miss = at(turning_rightly(middle));
    if (!miss) break;
    (miss->chord_angle * off > 0 ? low : high) = middle;
  }
  return turning_rightly(0.5 * (low + high));
}

/// The piece of a ratio whose polygon turns as wanted from its first edge to its last.
Unknowns HandleSearch::turning_rightly(double log_ratio) const {
  const double n = options_.degree;
  if (options_.form == QuasiForm::discrete_angle) return {log_ratio, turning_ * n / (n - 1)};
  const Piece whole = piece_from(alpha_, {log_ratio, 1}).piece;
  return {log_ratio, turning_ / total_turning(part(whole, 0.5 / n, 1 - 0.5 / n))};
}

// ---- Taylor forms -------------------------------------------------------------------------

Unknowns HandleSearch::grid_place(int ratio, int turning) const {
  const double least = 0.2 * turning_;
  const double share = turning / (Grid::kTurnings - 1.0);
  return {1.0 * (ratio - Grid::kRatios / 2),
          std::min(least * std::pow(kMostSeriesTurning / least, share), kMostSeriesTurning)};
}

HandleSearch::Grid HandleSearch::missed() const {
  Grid grid;
  for (int i = 0; i < Grid::kRatios; ++i)
    for (int j = 0; j < Grid::kTurnings; ++j) grid.at.push_back(at(grid_place(i, j)));
  return grid;
}

/// Those of the grid that miss less than those around them, and of all the least.
std::vector<Unknowns> HandleSearch::places_of_least_miss(const Grid& grid) const {
  const auto is_low = [&](int i, int j) {
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, Grid::kRatios - 1); ++a)
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, Grid::kTurnings - 1); ++b)
        if (grid(a, b) && grid(a, b)->size() < grid(i, j)->size()) return false;
    return true;
  };
  std::vector<std::pair<double, Unknowns>> lows, all;
  for (int i = 0; i < Grid::kRatios; ++i)
    for (int j = 0; j < Grid::kTurnings; ++j) {
      if (!grid(i, j)) continue;
      all.push_back({grid(i, j)->size(), grid_place(i, j)});
      if (is_low(i, j)) lows.push_back(all.back());
    }
  std::vector<Unknowns> starts;
  for (auto* places : {&lows, &all}) {
    std::ranges::sort(*places, {}, [](const auto& p) { return p.first; });
    if (places->size() > kTried) places->resize(kTried);
    for (const auto& [miss, x] : *places) starts.push_back(x);
  }
  return starts;
}

Unknowns HandleSearch::Cell::at(double x, double y) const {
  return {std::lerp(low.log_ratio, high.log_ratio, x), std::lerp(low.turning, high.turning, y)};
}

std::array<HandleSearch::Cell, 4> HandleSearch::Cell::quarters() const {
  return {{{at(0, 0), at(0.5, 0.5)},
           {at(0.5, 0), at(1, 0.5)},
           {at(0, 0.5), at(0.5, 1)},
           {at(0.5, 0.5), at(1, 1)}}};
}

/// Whether both misses have either sign in a cell; where one leaps round only if it may.
bool HandleSearch::straddles(const Cell& cell, bool leaping) const {
  Miss least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j) {
      const std::optional<Miss> m = at(cell.at(0.5 * i, 0.5 * j));
      if (!m) return false;
      least = {std::min(least.turning, m->turning), std::min(least.chord_angle, m->chord_angle)};
      most = {std::max(most.turning, m->turning), std::max(most.chord_angle, m->chord_angle)};
    }
  if (!(least.turning <= 0 && most.turning >= 0 && least.chord_angle <= 0 && most.chord_angle >= 0))
    return false;
  return leaping ||
         std::max(most.turning - least.turning, most.chord_angle - least.chord_angle) < core::kPi;
}

void HandleSearch::quarter(const Cell& cell, int depth, std::vector<Unknowns>& starts) const {
  if (depth < kDepth && !straddles(cell, depth >= kLeaping)) return;
  if (depth == 0) {
    starts.push_back(cell.at(0.5, 0.5));
    return;
  }
  for (const Cell& q : cell.quarters()) quarter(q, depth - 1, starts);
}

/// What no start near by is led to: quarters of quarters in which both misses change their sign.
std::vector<Unknowns> HandleSearch::where_signs_change() const {
  std::vector<Unknowns> starts;
  for (int i = 0; i + 1 < Grid::kRatios; ++i)
    for (int j = 0; j + 1 < Grid::kTurnings; ++j)
      quarter({grid_place(i, j), grid_place(i + 1, j + 1)}, kDepth, starts);
  return starts;
}

}  // namespace keyline::lac::detail
