#include "keyline/fit/quintic_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/fit/quintic_rate.h"
#include "keyline/fit/quintic_room.h"
#include "keyline/numeric/damped_descent.h"

namespace keyline::fit {
namespace {

using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr std::size_t kAhead = 8;  ///< points that the nearest one is looked for among
constexpr double kArc = 0.125;     ///< rise of an arc of one radian over its chord
constexpr double kSlowest = 0.1;   ///< of a piece's mean speed: slower is nearly a cusp

constexpr double kCalmRim = 0.8;     ///< of the tolerance, if the chain is within that
constexpr double kFirstPrice = 0.1;  ///< of room beside variation, as shares of what there is
constexpr double kPriceStep = 0.1;   ///< down, each time a chain has settled
constexpr double kSettled = 0.1;     ///< share of the cost that a whole step gains yet
constexpr double kLastSettled = 0.05;
constexpr double kCalmEnough = 0.1;    ///< share of variation that could be gained yet
constexpr double kNoVariation = 1e-3;  ///< curvature times length changes by 0.03: an arc's
constexpr int kCalmSteps = 60;
constexpr int kParts = 8;         ///< of a step that are tried, …
constexpr double kPart = 0.4;     ///< … each so much of the one before
constexpr double kFirmest = 1e3;  ///< damping from which on no step is short enough

struct Nearest {
  Vector2 way;
  double square = 0;  ///< of the way's length
  double edge = 0;    ///< square of the length of the edge it leads to
};

/// Of the two edges at a point of the line.
Nearest nearest_on_line(const std::vector<Point2>& line, std::size_t at, Point2 p) {
  const Vector2 to = line[at] - p;
  Nearest best{to, dot(to, to), 0};
  for (const std::size_t from : {at > 0 ? at - 1 : at, at}) {
    if (from + 1 >= line.size()) continue;
    const Vector2 edge = line[from + 1] - line[from];
    const double length = dot(edge, edge);
    const double share = std::clamp(dot(p - line[from], edge) / length, 0.0, 1.0);
    const Vector2 way = line[from] + share * edge - p;
    if (const double square = dot(way, way); square <= best.square) best = {way, square, length};
  }
  return best;
}

std::vector<QuinticPowers> powers_of(const std::vector<JointedQuintic>& pieces) {
  std::vector<QuinticPowers> powers;
  powers.reserve(pieces.size());
  for (const JointedQuintic& piece : pieces) powers.emplace_back(piece.control);
  return powers;
}

}  // namespace

QuinticSolver::QuinticSolver(const ChainData& data, bool closed, const std::vector<std::size_t>& at,
                             const QuinticChainOptions& options)
    : data_(data),
      tolerance_(options.tolerance),
      free_start_(options.free_start),
      free_end_(options.free_end) {
  now_.chain.closed = closed;
  for (std::size_t k = 0; k + (closed ? 1 : 0) < at.size(); ++k)
    now_.chain.joints.push_back({data.points[at[k]], data.direction[at[k]], data.curvature[at[k]]});
  now_.feet.resize(data.points.size());
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    const double length = data.length[at[k + 1]] - data.length[at[k]];
    now_.chain.lengths.push_back({length / 5, length / 5, length / 5, length / 5});
    rest_.push_back(length / 5);
    for (std::size_t i = at[k]; i <= at[k + 1]; ++i)
      now_.feet[i] = {k, (data.length[i] - data.length[at[k]]) / length};
  }
}

void QuinticSolver::run(int most) {
  double least = cost().points;
  numeric::FactorDamping rule{.raise = 100, .least = 1e-9, .most = kFirmest};
  numeric::damped_descent(rule, most, [&](double damping) -> numeric::StepOutcome {
    const State before = now_;
    take(step(damping));
    const double now = cost().points;
    if (!(now <= least * (1 + 1e-9))) {
      now_ = before;
      return {};
    }
    const bool settled = least - now < 1e-5 * least;
    least = now;
    return {settled ? numeric::StepEnd::settled : numeric::StepEnd::taken};
  });
}

void QuinticSolver::calm() {
  double room = 1e-6;
  double most = 0;
  for (const double d : distances()) {
    room += (d / tolerance_) * (d / tolerance_);
    most = std::max(most, d);
  }
  rim_ = std::max(kCalmRim * tolerance_, 0.5 * (most + tolerance_));
  price_ = kFirstPrice * variation() / room;
  Cost now = price_ > 0 ? cost() : Cost{};
  numeric::FactorDamping rule{.raise = 100, .least = 1e-9, .most = kFirmest};
  bool done = !(price_ > 0) || !std::isfinite(now.variation);
  for (int k = 0; k < kCalmSteps && !done; ++k) {
    const Progress made = try_step(step(rule.value), now);
    if (made.taken == 1) rule.on_taken(1);
    if (made.taken < 0.1) done = !rule.on_refused();
    const bool last =
        now.variation <= kNoVariation || price_ * now.gap <= kCalmEnough * now.variation;
    if (made.taken == 0 || made.gained > (last ? kLastSettled : kSettled) * made.taken) continue;
    done = done || last;
    price_ *= kPriceStep;
  }
  price_ = 0;
}

QuinticSolver::Progress QuinticSolver::try_step(const Eigen::VectorXd& x, Cost& now) {
  const State before = now_;
  double part = 1;
  for (int k = 0; k < kParts; ++k, part *= kPart) {
    now_ = before;
    take(part * x);
    const Cost then = cost();
    if (!(then.at(price_) < now.at(price_))) continue;
    const double gained = 1 - then.at(price_) / now.at(price_);
    now = then;
    return {part, gained};
  }
  now_ = before;
  return {};
}

std::vector<double> QuinticSolver::distances() const {
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  std::vector<double> off;
  off.reserve(now_.feet.size());
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    const QuinticFoot& f = now_.feet[i];
    off.push_back(distance(place(pieces[f.piece].control, f.t), data_.points[i]));
  }
  return off;
}

QuinticChain QuinticSolver::result() const {
  QuinticChain out;
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  for (const JointedQuintic& piece : pieces)
    out.pieces.push_back({{piece.control.begin(), piece.control.end()}, {}});
  double sum = 0;
  for (const double d : distances()) {
    out.max_deviation = std::max(out.max_deviation, d);
    sum += d * d;
  }
  out.rms_deviation = std::sqrt(sum / static_cast<double>(data_.points.size()));
  out.within_tolerance =
      out.max_deviation <= tolerance_ && is_lively(pieces) && strays(pieces).empty();
  return out;
}

std::vector<double> QuinticSolver::deviations() const {
  const std::vector<double> off = distances();
  std::vector<double> worst(now_.chain.lengths.size(), 0);
  for (std::size_t i = 0; i < off.size(); ++i)
    worst[now_.feet[i].piece] = std::max(worst[now_.feet[i].piece], off[i]);
  return worst;
}

double QuinticSolver::variation() const {
  double sum = 0;
  for (const JointedQuintic& piece : pieces_of(now_.chain))
    for (const RatePlace& node : rate_nodes()) {
      const double rate = rate_at(piece, node).value;
      sum += node.weight * rate * rate;
    }
  return std::pow(data_.length.back(), 3) * sum;
}

std::vector<QuinticSolver::Beside> QuinticSolver::beside(const std::vector<JointedQuintic>& pieces,
                                                         double from) const {
  std::vector<Beside> found;
  std::size_t at = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (std::size_t j = 0; j < kRateNodes; ++j) {
      const Point2 p = Point2{} + weighted(pieces[k].control, rate_nodes()[j].place);
      const auto far = [&](std::size_t i) {
        const Vector2 off = data_.points[i] - p;
        return dot(off, off);
      };
      double least = far(at);
      for (std::size_t i = at; i < data_.points.size() && i <= at + kAhead; ++i)
        if (const double next = far(i); next < least) at = i, least = next;
      if (least <= from * from) continue;
      const Nearest nearest = nearest_on_line(data_.points, at, p);
      found.push_back({k, j, nearest.way, tolerance_ + kArc * std::sqrt(nearest.edge)});
    }
  }
  return found;
}

/// Places too far from the line of the points.
std::vector<QuinticSolver::Beside> QuinticSolver::strays(
    const std::vector<JointedQuintic>& pieces) const {
  std::vector<Beside> found = beside(pieces, tolerance_);
  std::erase_if(found, [](const Beside& b) { return dot(b.way, b.way) <= b.most * b.most; });
  return found;
}

/// End edges that point forwards, and nowhere nearly a halt: no hidden cusp.
bool QuinticSolver::is_lively(const std::vector<JointedQuintic>& pieces) const {
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!(pieces[k].lengths.a > 0 && pieces[k].lengths.b > 0)) return false;
    const double slowest = kSlowest * 5 * rest_[k];
    for (const RatePlace& node : rate_nodes()) {
      const Vector2 v = weighted(pieces[k].control, node.first);
      if (dot(v, v) < slowest * slowest) return false;
    }
  }
  return true;
}

QuinticSolver::Cost QuinticSolver::cost() {
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  now_.asked.assign(pieces.size(), {});
  return price_ > 0 ? calm_cost(pieces) : far_cost(pieces);
}

/// Feet at the ends of an open chain stay.
QuinticPowers::Passing QuinticSolver::move_foot(std::size_t i,
                                                const std::vector<QuinticPowers>& pieces,
                                                int rounds) {
  const bool closed = now_.chain.closed;
  const bool end = !closed && (i == 0 || i + 1 == now_.feet.size());
  return follow(pieces, closed, data_.points[i], end ? 0 : rounds, now_.feet[i]);
}

/// Across the curve; the ends of the line, whose feet are the chain's ends, along it too.
void QuinticSolver::ask(std::size_t i, const QuinticPowers::Passing& at, double weight,
                        double pull) {
  const double square = dot(at.first, at.first);
  if (!(square > 0)) return;
  const QuinticFoot& f = now_.feet[i];
  const auto along = [&](Vector2 way) {
    now_.asked[f.piece].add_place(f.t, way, weight / square, pull * dot(at.off, way) / square);
  };
  along(core::perpendicular_left(at.first));
  if (!now_.chain.closed && (i == 0 || i + 1 == now_.feet.size())) along(at.first);
}

/// Squares of the distances and of how far places stray.
QuinticSolver::Cost QuinticSolver::far_cost(const std::vector<JointedQuintic>& pieces) {
  const std::vector<QuinticPowers> powers = powers_of(pieces);
  double sum = off_rest();
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    const QuinticPowers::Passing at = move_foot(i, powers, 2);
    sum += dot(at.off, at.off);
    ask(i, at, 1, 1);
  }
  for (const Beside& stray : strays(pieces)) {
    const Vector2 way = (1 - stray.most / core::norm(stray.way)) * stray.way;
    std::array<Vector2, 6> x, y;
    for (std::size_t k = 0; k < 6; ++k) {
      x[k] = {rate_nodes()[stray.node].place[k], 0};
      y[k] = {0, rate_nodes()[stray.node].place[k]};
    }
    now_.asked[stray.piece].add_row(x, way.x);
    now_.asked[stray.piece].add_row(y, way.y);
    sum += dot(way, way);
  }
  return {sum, 0, 0};
}

/// Room that points and places take of their tolerances, and variation.
QuinticSolver::Cost QuinticSolver::calm_cost(const std::vector<JointedQuintic>& pieces) {
  constexpr Cost kOutside = {HUGE_VAL, HUGE_VAL, 0};
  if (!is_lively(pieces)) return kOutside;
  const std::vector<QuinticPowers> powers = powers_of(pieces);
  const double unit = 1 / (rim_ * rim_);
  ToleranceRoom room;
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    // one round: the next step goes on from there
    const QuinticPowers::Passing at = move_foot(i, powers, 1);
    if (!room.add(unit * dot(at.off, at.off))) return kOutside;
    ask(i, at, unit * room.stiffness(), unit * room.pull());
  }
  for (const Beside& place : beside(pieces, 0)) {
    const double square = dot(place.way, place.way);
    const double own = 1 / (place.most * place.most);
    if (!room.add(own * square)) return kOutside;
    if (!(square > 0)) continue;
    now_.asked[place.piece].add_place((static_cast<double>(place.node) + 0.5) / kRateNodes,
                                      place.way, own * room.stiffness() / square,
                                      own * room.pull());
  }
  return {room.cost() + unit * off_rest(), ask_variation(pieces), room.gap()};
}

double QuinticSolver::ask_variation(const std::vector<JointedQuintic>& pieces) {
  const double scale = std::pow(data_.length.back(), 3);
  double sum = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const RatePlace& node : rate_nodes()) {
      const RateNode rate = rate_at(pieces[k], node);
      const double root = std::sqrt(scale * node.weight);
      std::array<Vector2, 6> by;
      for (std::size_t c = 0; c < 6; ++c)
        by[c] = root * (node.first[c] * rate.by_first + node.second[c] * rate.by_second +
                        node.third[c] * rate.by_third);
      now_.asked[k].add_row(by, -root * rate.value);
      sum += scale * node.weight * rate.value * rate.value;
    }
  return sum;
}

/// What the stiffness of the lengths costs.
double QuinticSolver::off_rest() const {
  double sum = 0;
  for (std::size_t k = 0; k < now_.chain.lengths.size(); ++k) {
    const QuinticLengths& l = now_.chain.lengths[k];
    for (const double x : {l.a, l.b, l.c, l.d}) sum += (x - rest_[k]) * (x - rest_[k]);
  }
  return kStiffness * sum;
}

}  // namespace keyline::fit
