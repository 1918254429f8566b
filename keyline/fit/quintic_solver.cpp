#include "keyline/fit/quintic_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/fit/quintic_rate.h"
#include "keyline/numeric/damped_descent.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit {
namespace {

using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr int kJointSize = 4;  ///< x, y, direction, curvature
constexpr int kPieceSize = 4;  ///< a, b (end edges), c, d (tangential part of the second edges)
constexpr int kCalmIterations = 8;     ///< for a weight: the next one goes on from there
constexpr double kStiffness = 1e-3;    ///< pull of the four lengths to a fifth of the piece
constexpr double kLeastEdge = 0.5;     ///< of that fifth; shorter end edges hide a cusp behind them
constexpr std::size_t kAhead = 8;      ///< points that the nearest one is looked for among
constexpr double kArc = 0.125;         ///< rise of an arc of one radian over its chord
constexpr double kSlowest = 0.1;       ///< of a piece's mean speed: slower is nearly a cusp
constexpr double kFirstWeight = 1e-2;  ///< of variation beside the distances, as shares
constexpr double kWeightStep = 10;     ///< up …
constexpr int kWeightSteps = 12;       ///< … so often at most
constexpr int kReweighted = 3;         ///< rounds in which points beyond the tolerance pull harder
constexpr double kAimed = 0.9;         ///< of the tolerance: from there on they do
constexpr int kWeightHalvings = 2;     ///< of the last step, in logarithms

struct Nearest {
  Point2 place;
  double edge = 0;  ///< length of the edge it lies on
};

/// Of the two edges at a point of the line.
Nearest nearest_on_line(const std::vector<Point2>& line, std::size_t at, Point2 p) {
  Nearest best{line[at], 0};
  for (const std::size_t from : {at > 0 ? at - 1 : at, at}) {
    if (from + 1 >= line.size()) continue;
    const Vector2 edge = line[from + 1] - line[from];
    const double share = std::clamp(dot(p - line[from], edge) / dot(edge, edge), 0.0, 1.0);
    const Point2 q = line[from] + share * edge;
    if (distance(p, q) <= distance(p, best.place)) best = {q, core::norm(edge)};
  }
  return best;
}

}  // namespace

QuinticSolver::QuinticSolver(const ChainData& data, bool closed, const std::vector<std::size_t>& at,
                             double tolerance)
    : data_(data), tolerance_(tolerance) {
  now_.chain.closed = closed;
  for (std::size_t k = 0; k + (closed ? 1 : 0) < at.size(); ++k)
    now_.chain.joints.push_back({data.points[at[k]], data.direction[at[k]], data.curvature[at[k]]});
  now_.feet.resize(data.points.size());
  pull_.assign(data.points.size(), 1);
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    const double length = data.length[at[k + 1]] - data.length[at[k]];
    now_.chain.lengths.push_back({length / 5, length / 5, length / 5, length / 5});
    rest_.push_back(length / 5);
    for (std::size_t i = at[k]; i <= at[k + 1]; ++i)
      now_.feet[i] = {k, (data.length[i] - data.length[at[k]]) / length};
  }
}

void QuinticSolver::run(double weight, int most) {
  double least = cost(weight);
  numeric::FactorDamping rule{.raise = 100, .least = 1e-9, .most = 1e3};
  numeric::damped_descent(rule, most, [&](double damping) -> numeric::StepOutcome {
    const State before = now_;
    step(weight, damping);
    const double now = cost(weight);
    if (!(now <= least * (1 + 1e-9))) {
      now_ = before;
      return {};
    }
    const bool settled = least - now < 1e-5 * least;
    least = now;
    return {settled ? numeric::StepEnd::settled : numeric::StepEnd::taken};
  });
}

bool QuinticSolver::run_within(double weight) {
  for (int round = 0;; ++round) {
    run(weight, kCalmIterations);
    if (result().within_tolerance) return true;
    if (round == kReweighted) return false;
    const std::vector<double> off = distances();
    for (std::size_t i = 0; i < off.size(); ++i)
      pull_[i] *= std::max(1.0, std::pow(off[i] / (kAimed * tolerance_), 4));
  }
}

void QuinticSolver::calm() {
  const double variation_before = variation();
  if (!(variation_before > 0)) return;
  const double near = std::max(move_feet(2), 1e-6 * tolerance_ * tolerance_);
  double weight = kFirstWeight * near / variation_before;
  double factor = kWeightStep;
  State best = now_;
  std::vector<double> best_pull = pull_;
  double best_variation = variation_before;
  int halvings = 0;
  for (int k = 0; k < kWeightSteps && halvings <= kWeightHalvings; ++k) {
    if (run_within(weight)) {
      const double calmer = variation();
      if (calmer < best_variation) {
        best = now_;
        best_pull = pull_;
        best_variation = calmer;
      }
    } else {
      now_ = best;
      pull_ = best_pull;
      weight /= factor;
      factor = std::sqrt(factor);
      ++halvings;
    }
    weight *= factor;
  }
  now_ = best;
}

std::vector<double> QuinticSolver::distances() const {
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  std::vector<double> off;
  off.reserve(now_.feet.size());
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    const Foot& f = now_.feet[i];
    off.push_back(distance(place(pieces[f.piece].control, f.t), data_.points[i]));
  }
  return off;
}

QuinticChain QuinticSolver::result() const {
  QuinticChain out;
  for (const JointedQuintic& piece : pieces_of(now_.chain))
    out.pieces.push_back({{piece.control.begin(), piece.control.end()}, {}});
  double sum = 0;
  for (const double d : distances()) {
    out.max_deviation = std::max(out.max_deviation, d);
    sum += d * d;
  }
  out.rms_deviation = std::sqrt(sum / static_cast<double>(data_.points.size()));
  out.within_tolerance = out.max_deviation <= tolerance_ && is_sound();
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

std::vector<QuinticSolver::Stray> QuinticSolver::strays() const {
  std::vector<Stray> found;
  std::size_t at = 0;
  for (std::size_t k = 0; k < now_.chain.lengths.size(); ++k) {
    const JointedQuintic piece = piece_of(now_.chain, k);
    for (std::size_t j = 0; j < kRateNodes; ++j) {
      const Point2 p = Point2{} + weighted(piece.control, rate_nodes()[j].place);
      const auto far = [&](std::size_t i) {
        const Vector2 off = data_.points[i] - p;
        return dot(off, off);
      };
      for (std::size_t i = at; i < data_.points.size() && i <= at + kAhead; ++i)
        if (far(i) < far(at)) at = i;
      if (far(at) <= tolerance_ * tolerance_) continue;
      const Nearest nearest = nearest_on_line(data_.points, at, p);
      const Vector2 way = nearest.place - p;
      const double off = core::norm(way);
      const double most = tolerance_ + kArc * nearest.edge;
      if (off > most) found.push_back({k, j, (1 - most / off) * way});
    }
  }
  return found;
}

/// What strays cost.
double QuinticSolver::off_line() const {
  double sum = 0;
  for (const Stray& stray : strays()) sum += dot(stray.way, stray.way);
  return sum;
}

void QuinticSolver::add_strays(const std::vector<JointedQuintic>& pieces,
                               std::vector<Normal>& parts) const {
  for (const Stray& stray : strays()) {
    const QuinticRow row = sensitivity(pieces[stray.piece], rate_nodes()[stray.node].place);
    Row x, y;
    for (int c = 0; c < 12; ++c) {
      x[c] = row[static_cast<std::size_t>(c)].x;
      y[c] = row[static_cast<std::size_t>(c)].y;
    }
    parts[stray.piece].add(x, stray.way.x);
    parts[stray.piece].add(y, stray.way.y);
  }
}

/// End edges that point forwards, and nowhere nearly a halt: no hidden cusp.
bool QuinticSolver::is_sound() const {
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!(pieces[k].lengths.a > 0 && pieces[k].lengths.b > 0)) return false;
    for (const RatePlace& node : rate_nodes())
      if (core::norm(weighted(pieces[k].control, node.first)) < kSlowest * 5 * rest_[k])
        return false;
  }
  return strays().empty();
}

/// Newton steps of every foot towards the nearest point, over joints too; the sum of the squared
/// distances.
double QuinticSolver::move_feet(int rounds) {
  const std::vector<JointedQuintic> h = pieces_of(now_.chain);
  double sum = 0;
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    Foot& f = now_.feet[i];
    const bool closed = now_.chain.closed;
    const bool end = !closed && (i == 0 || i + 1 == now_.feet.size());
    Vector2 off = data_.points[i] - place(h[f.piece].control, f.t);
    for (int round = 0; round < rounds && !end; ++round) {
      const Vector2 v = weighted(h[f.piece].control, first_weights(f.t));
      const double speed = dot(v, v);
      if (!(speed > 0)) break;
      f.t += dot(off, v) / speed;
      if (f.t < 0 && (closed || f.piece > 0)) {
        f = {(f.piece + h.size() - 1) % h.size(), 1};
      } else if (f.t > 1 && (closed || f.piece + 1 < h.size())) {
        f = {(f.piece + 1) % h.size(), 0};
      } else {
        f.t = std::clamp(f.t, 0.0, 1.0);
      }
      off = data_.points[i] - place(h[f.piece].control, f.t);
    }
    sum += pull_[i] * dot(off, off);
  }
  return sum;
}

/// What the stiffness of the lengths costs.
double QuinticSolver::off_rest() const {
  double sum = 0;
  for (std::size_t k = 0; k < now_.chain.lengths.size(); ++k) {
    const QuinticLengths& l = now_.chain.lengths[k];
    for (const double x : {l.a, l.b, l.c, l.d}) sum += kStiffness * (x - rest_[k]) * (x - rest_[k]);
  }
  return sum;
}

int QuinticSolver::joint_at(std::size_t j) const {
  return static_cast<int>(j) * (kJointSize + kPieceSize);
}

int QuinticSolver::piece_at(std::size_t k) const { return joint_at(k) + kJointSize; }

bool QuinticSolver::held(std::size_t j) const {
  return !now_.chain.closed && (j == 0 || j + 1 == now_.chain.joints.size());
}

void QuinticSolver::add(std::size_t piece, const Normal& part, Eigen::MatrixXd& a,
                        Eigen::VectorXd& g) const {
  std::array<int, 12> at{};
  const std::size_t last = (piece + 1) % now_.chain.joints.size();
  for (std::size_t c = 0; c < 12; ++c) {
    const int base = c < 4 ? joint_at(piece) : c < 8 ? piece_at(piece) : joint_at(last);
    at[c] = base + static_cast<int>(c % 4);
  }
  for (int r = 0; r < 12; ++r) {
    const auto to = static_cast<std::size_t>(r);
    g[at[to]] += part.wanted[r];
    for (int c = 0; c < 12; ++c) a(at[to], at[static_cast<std::size_t>(c)]) += part.matrix(r, c);
  }
}

void QuinticSolver::add_points(const std::vector<JointedQuintic>& pieces,
                               std::vector<Normal>& parts) const {
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    const Foot& f = now_.feet[i];
    const JointedQuintic& piece = pieces[f.piece];
    const Vector2 v = weighted(piece.control, first_weights(f.t));
    const double speed = std::sqrt(dot(v, v));
    if (!(speed > 0)) continue;
    const QuinticWeights b = place_weights(f.t);
    const Vector2 normal = (std::sqrt(pull_[i]) / speed) * core::perpendicular_left(v);
    const QuinticRow row = sensitivity(piece, b);
    Row d;
    for (int c = 0; c < 12; ++c) d[c] = dot(row[static_cast<std::size_t>(c)], normal);
    parts[f.piece].add(d, dot(data_.points[i] - place(piece.control, f.t), normal));
  }
}

void QuinticSolver::add_variation(double weight, const std::vector<JointedQuintic>& pieces,
                                  std::vector<Normal>& parts) const {
  const double cubed = std::pow(data_.length.back(), 3);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const RatePlace& node : rate_nodes()) {
      const RateNode rate = rate_at(pieces[k], node);
      const double root = std::sqrt(weight * cubed * node.weight);
      const QuinticRow first = sensitivity(pieces[k], node.first);
      const QuinticRow second = sensitivity(pieces[k], node.second);
      const QuinticRow third = sensitivity(pieces[k], node.third);
      Row d;
      for (int c = 0; c < 12; ++c) {
        const auto at = static_cast<std::size_t>(c);
        d[c] = root * (dot(first[at], rate.by_first) + dot(second[at], rate.by_second) +
                       dot(third[at], rate.by_third));
      }
      parts[k].add(d, -root * rate.value);
    }
}

void QuinticSolver::step(double weight, double damping) {
  const int size = static_cast<int>(kJointSize * now_.chain.joints.size() +
                                    kPieceSize * now_.chain.lengths.size());
  const std::vector<JointedQuintic> pieces = pieces_of(now_.chain);
  std::vector<Normal> parts(pieces.size());
  add_points(pieces, parts);
  add_strays(pieces, parts);
  if (weight > 0) add_variation(weight, pieces, parts);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  for (std::size_t k = 0; k < parts.size(); ++k) add(k, parts[k], a, g);
  solve(a, g, damping);
}

void QuinticSolver::solve(Eigen::MatrixXd& a, Eigen::VectorXd& g, double damping) {
  JointedQuintics& chain = now_.chain;
  for (std::size_t k = 0; k < chain.lengths.size(); ++k) {
    const QuinticLengths& l = chain.lengths[k];
    const std::array<double, 4> now = {l.a, l.b, l.c, l.d};
    for (int c = 0; c < 4; ++c) {
      a(piece_at(k) + c, piece_at(k) + c) += kStiffness;
      g[piece_at(k) + c] += kStiffness * (rest_[k] - now[static_cast<std::size_t>(c)]);
    }
  }
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    if (!held(j)) continue;
    for (int c = 0; c < 2; ++c) {
      a.row(joint_at(j) + c).setZero();
      a.col(joint_at(j) + c).setZero();
      g[joint_at(j) + c] = 0;
    }
  }
  for (Eigen::Index i = 0; i < a.rows(); ++i) a(i, i) += damping * a(i, i) + 1e-9;
  const Eigen::VectorXd x = numeric::solve_symmetric(a, g);
  if (!x.allFinite()) return;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    QuinticJoint& joint = chain.joints[j];
    const int at = joint_at(j);
    joint.place = joint.place + Vector2{x[at], x[at + 1]};
    joint.direction += std::clamp(x[at + 2], -0.5, 0.5);
    joint.curvature += x[at + 3];
  }
  for (std::size_t k = 0; k < chain.lengths.size(); ++k) {
    QuinticLengths& l = chain.lengths[k];
    const int at = piece_at(k);
    const double least = kLeastEdge * rest_[k];
    l.a = std::max(least, l.a + x[at]);
    l.b = std::max(least, l.b + x[at + 1]);
    l.c += x[at + 2];
    l.d += x[at + 3];
  }
}

}  // namespace keyline::fit
