#include "keyline/fit/quintic_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "keyline/core/error.h"
#include "keyline/fit/chain_data.h"
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
constexpr int kIterations = 12;
constexpr int kEvenPieces = 4;       ///< up to here joints are laid evenly, then where they lack
constexpr double kStiffness = 1e-3;  ///< pull of the four lengths to a fifth of the piece
constexpr double kLeastEdge = 0.5;   ///< of that fifth; shorter end edges hide a cusp behind them

struct Joint {
  Point2 place;
  double direction = 0;
  double curvature = 0;
};

struct Lengths {
  double a = 0, b = 0, c = 0, d = 0;
};

/// A point of the data: which piece it belongs to and where on it.
struct Foot {
  std::size_t piece = 0;
  double t = 0;
};

struct Chain {
  std::vector<Joint> joints;  ///< closed: as many as pieces; open: one more
  std::vector<Lengths> lengths;
  bool closed = false;

  const Joint& end_of(std::size_t piece) const { return joints[(piece + 1) % joints.size()]; }
};

using Handles = std::array<Point2, 6>;

Vector2 unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

Handles handles(const Chain& chain, std::size_t i) {
  const Joint& p = chain.joints[i];
  const Joint& q = chain.end_of(i);
  const Lengths& l = chain.lengths[i];
  const Vector2 t0 = unit(p.direction);
  const Vector2 t1 = unit(q.direction);
  Handles h;
  h[0] = p.place;
  h[1] = p.place + l.a * t0;
  h[2] = h[1] + l.c * t0 + (1.25 * p.curvature * l.a * l.a) * core::perpendicular_left(t0);
  h[5] = q.place;
  h[4] = q.place - l.b * t1;
  h[3] = h[4] - l.d * t1 + (1.25 * q.curvature * l.b * l.b) * core::perpendicular_left(t1);
  return h;
}

std::array<double, 6> bernstein5(double t) {
  const double u = 1 - t;
  const double u2 = u * u;
  const double t2 = t * t;
  return {u2 * u2 * u,      5 * u2 * u2 * t, 10 * u2 * u * t2,
          10 * u2 * t2 * t, 5 * u * t2 * t2, t2 * t2 * t};
}

Point2 point_at(const Handles& h, double t) {
  const auto b = bernstein5(t);
  Point2 p;
  for (std::size_t k = 0; k < 6; ++k) p = p + b[k] * (h[k] - Point2{});
  return p;
}

Vector2 derivative_at(const Handles& h, double t) {
  const double u = 1 - t;
  const std::array<double, 5> b = {u * u * u * u, 4 * u * u * u * t, 6 * u * u * t * t,
                                   4 * u * t * t * t, t * t * t * t};
  Vector2 v{};
  for (std::size_t k = 0; k < 5; ++k) v = v + (5 * b[k]) * (h[k + 1] - h[k]);
  return v;
}

class Fit {
 public:
  Fit(const ChainData& data, bool closed, const std::vector<std::size_t>& at) : data_(data) {
    chain_.closed = closed;
    for (std::size_t k = 0; k + (closed ? 1 : 0) < at.size(); ++k)
      chain_.joints.push_back({data.points[at[k]], data.direction[at[k]], data.curvature[at[k]]});
    feet_.resize(data.points.size());
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      const double length = data.length[at[k + 1]] - data.length[at[k]];
      chain_.lengths.push_back({length / 5, length / 5, length / 5, length / 5});
      rest_.push_back(length / 5);
      for (std::size_t i = at[k]; i <= at[k + 1]; ++i)
        feet_[i] = {k, (data.length[i] - data.length[at[k]]) / length};
    }
  }

  void run() {
    double cost = move_feet();
    numeric::FactorDamping rule{.raise = 100, .least = 1e-9, .most = 1e3};
    numeric::damped_descent(rule, kIterations, [&](double damping) -> numeric::StepOutcome {
      const Chain before = chain_;
      const std::vector<Foot> feet_before = feet_;
      step(damping);
      const double now = move_feet();
      if (now > cost * (1 + 1e-9)) {
        chain_ = before;
        feet_ = feet_before;
        return {};
      }
      const bool settled = cost - now < 1e-5 * cost;
      cost = now;
      return {settled ? numeric::StepEnd::settled : numeric::StepEnd::taken};
    });
  }

  QuinticChain result(double tolerance) const {
    QuinticChain out;
    std::vector<Handles> h;
    for (std::size_t k = 0; k < chain_.lengths.size(); ++k) {
      h.push_back(handles(chain_, k));
      out.pieces.push_back({{h[k].begin(), h[k].end()}, {}});
    }
    double sum = 0;
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      const double d = distance(point_at(h[feet_[i].piece], feet_[i].t), data_.points[i]);
      out.max_deviation = std::max(out.max_deviation, d);
      sum += d * d;
    }
    out.rms_deviation = std::sqrt(sum / static_cast<double>(data_.points.size()));
    out.within_tolerance = out.max_deviation <= tolerance && is_sound();
    return out;
  }

  /// Largest distance of the points of every piece.
  std::vector<double> deviations() const {
    std::vector<double> worst(chain_.lengths.size(), 0);
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      const Foot& f = feet_[i];
      const double d = distance(point_at(handles(chain_, f.piece), f.t), data_.points[i]);
      worst[f.piece] = std::max(worst[f.piece], d);
    }
    return worst;
  }

 private:
  /// End edges that point forwards: no hidden cusp.
  bool is_sound() const {
    return std::all_of(chain_.lengths.begin(), chain_.lengths.end(),
                       [](const Lengths& l) { return l.a > 0 && l.b > 0; });
  }

  /// Newton steps of every foot towards the nearest point, over joints too; the mean of the squared
  /// distances along the normals, plus the stiffness.
  double move_feet() {
    std::vector<Handles> h;
    for (std::size_t k = 0; k < chain_.lengths.size(); ++k) h.push_back(handles(chain_, k));
    double cost = 0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      Foot& f = feet_[i];
      const bool end = i == 0 || i + 1 == feet_.size();
      for (int round = 0; round < 2 && !end; ++round) {
        const Vector2 v = derivative_at(h[f.piece], f.t);
        const double speed = dot(v, v);
        if (!(speed > 0)) break;
        f.t += dot(data_.points[i] - point_at(h[f.piece], f.t), v) / speed;
        if (f.t < 0 && f.piece > 0) {
          f = {f.piece - 1, 1};
        } else if (f.t > 1 && f.piece + 1 < h.size()) {
          f = {f.piece + 1, 0};
        } else {
          f.t = std::clamp(f.t, 0.0, 1.0);
        }
      }
      const Vector2 off = data_.points[i] - point_at(h[f.piece], f.t);
      cost += dot(off, off);
    }
    for (std::size_t k = 0; k < chain_.lengths.size(); ++k) {
      const Lengths& l = chain_.lengths[k];
      for (const double x : {l.a, l.b, l.c, l.d})
        cost += kStiffness * (x - rest_[k]) * (x - rest_[k]);
    }
    return cost;
  }

  /// First unknown of a joint, of a piece. Ends of an open chain hold their place.
  int joint_at(std::size_t j) const { return static_cast<int>(j) * (kJointSize + kPieceSize); }
  int piece_at(std::size_t k) const { return joint_at(k) + kJointSize; }
  bool held(std::size_t j) const {
    return !chain_.closed && (j == 0 || j + 1 == chain_.joints.size());
  }

  using Row = std::array<Vector2, 2 * kJointSize + kPieceSize>;

  /// Derivatives of the point at t of piece k: by its first joint, its lengths, its last joint.
  Row derivatives(std::size_t k, double t) const {
    const Joint& p = chain_.joints[k];
    const Joint& q = chain_.end_of(k);
    const Lengths& l = chain_.lengths[k];
    const auto b = bernstein5(t);
    const Vector2 t0 = unit(p.direction);
    const Vector2 n0 = core::perpendicular_left(t0);
    const Vector2 t1 = unit(q.direction);
    const Vector2 n1 = core::perpendicular_left(t1);
    Row row{};
    const double start = b[0] + b[1] + b[2];
    const double end = b[3] + b[4] + b[5];
    row[0] = {start, 0};
    row[1] = {0, start};
    row[2] = (b[1] * l.a + b[2] * (l.a + l.c)) * n0 - (b[2] * 1.25 * p.curvature * l.a * l.a) * t0;
    row[3] = (b[2] * 1.25 * l.a * l.a) * n0;
    row[4] = (b[1] + b[2]) * t0 + (b[2] * 2.5 * p.curvature * l.a) * n0;
    row[5] = -(b[3] + b[4]) * t1 + (b[3] * 2.5 * q.curvature * l.b) * n1;
    row[6] = b[2] * t0;
    row[7] = -b[3] * t1;
    row[8] = {end, 0};
    row[9] = {0, end};
    row[10] =
        -(b[4] * l.b + b[3] * (l.b + l.d)) * n1 - (b[3] * 1.25 * q.curvature * l.b * l.b) * t1;
    row[11] = (b[3] * 1.25 * l.b * l.b) * n1;
    return row;
  }

  void step(double damping) {
    const std::size_t pieces = chain_.lengths.size();
    const int size = static_cast<int>(kJointSize * chain_.joints.size() + kPieceSize * pieces);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
    std::vector<Handles> h;
    for (std::size_t k = 0; k < pieces; ++k) h.push_back(handles(chain_, k));
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const Foot& f = feet_[i];
      const Row row = derivatives(f.piece, f.t);
      const Vector2 v = derivative_at(h[f.piece], f.t);
      const double speed = core::norm(v);
      if (!(speed > 0)) continue;
      const Vector2 normal = core::perpendicular_left(v) / speed;
      const double off = dot(data_.points[i] - point_at(h[f.piece], f.t), normal);
      std::array<int, 12> at{};
      std::array<double, 12> d{};
      const std::size_t last = (f.piece + 1) % chain_.joints.size();
      for (std::size_t c = 0; c < 12; ++c) {
        const int base = c < 4 ? joint_at(f.piece) : c < 8 ? piece_at(f.piece) : joint_at(last);
        at[c] = base + static_cast<int>(c % 4);
        d[c] = dot(row[c], normal);
      }
      for (std::size_t r = 0; r < 12; ++r) {
        g[at[r]] += d[r] * off;
        for (std::size_t c = 0; c < 12; ++c) a(at[r], at[c]) += d[r] * d[c];
      }
    }
    solve(a, g, damping);
  }

  void solve(Eigen::MatrixXd& a, Eigen::VectorXd& g, double damping) {
    for (std::size_t k = 0; k < chain_.lengths.size(); ++k) {
      const Lengths& l = chain_.lengths[k];
      const std::array<double, 4> now = {l.a, l.b, l.c, l.d};
      for (int c = 0; c < 4; ++c) {
        a(piece_at(k) + c, piece_at(k) + c) += kStiffness;
        g[piece_at(k) + c] += kStiffness * (rest_[k] - now[static_cast<std::size_t>(c)]);
      }
    }
    for (std::size_t j = 0; j < chain_.joints.size(); ++j) {
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
    for (std::size_t j = 0; j < chain_.joints.size(); ++j) {
      Joint& joint = chain_.joints[j];
      const int at = joint_at(j);
      joint.place = joint.place + Vector2{x[at], x[at + 1]};
      joint.direction += std::clamp(x[at + 2], -0.5, 0.5);
      joint.curvature += x[at + 3];
    }
    for (std::size_t k = 0; k < chain_.lengths.size(); ++k) {
      Lengths& l = chain_.lengths[k];
      const int at = piece_at(k);
      const double least = kLeastEdge * rest_[k];
      l.a = std::max(least, l.a + x[at]);
      l.b = std::max(least, l.b + x[at + 1]);
      l.c += x[at + 2];
      l.d += x[at + 3];
    }
  }

  const ChainData& data_;
  Chain chain_;
  std::vector<double> rest_;  ///< a fifth of each piece's length
  std::vector<Foot> feet_;
};

}  // namespace

QuinticChain fit_quintic_chain(const std::vector<Point2>& points, bool closed,
                               const QuinticChainOptions& options) {
  if (points.size() < 2) throw core::InvalidInput("fit_quintic_chain needs at least two points");
  const ChainData data = prepare_chain_data(points, closed);
  const int most =
      std::clamp(static_cast<int>(points.size()) / 3, closed ? 2 : 1, options.max_pieces);
  QuinticChain best;
  std::vector<std::size_t> at = joint_indices(data, closed ? 2 : 1);
  while (true) {
    const int pieces = static_cast<int>(at.size()) - 1;
    Fit fit(data, closed, at);
    fit.run();
    QuinticChain found = fit.result(options.tolerance);
    if (best.pieces.empty() || found.within_tolerance || found.max_deviation < best.max_deviation)
      best = std::move(found);
    if (best.within_tolerance || pieces >= most) return best;
    if (pieces < kEvenPieces) {
      at = joint_indices(data, pieces + 1);
    } else if (!split_worst(data, fit.deviations(), options.tolerance, most, at)) {
      return best;
    }
  }
}

}  // namespace keyline::fit
