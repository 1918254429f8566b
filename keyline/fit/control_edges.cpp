#include "keyline/fit/control_edges.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/curve/least_edge.h"

namespace keyline::fit {

using core::cross;
using core::dot;
using core::ErrorCode;
using core::Point2;
using core::Result;
using core::Vector2;
using curve::Bezier2;
using curve::PiecewiseBezier;

namespace {

std::array<double, 5> bernstein4(double t) {
  const double u = 1 - t;
  return {u * u * u * u, 4 * u * u * u * t, 6 * u * u * t * t, 4 * u * t * t * t, t * t * t * t};
}
std::array<double, 4> bernstein3(double t) {
  const double u = 1 - t;
  return {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
}

}  // namespace

Result<std::vector<Edges>> edges_of(const PiecewiseBezier& chain) {
  std::vector<Edges> all;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const auto& q = chain.pieces[i].control;
    Edges edges;
    for (std::size_t n = 0; n < kEdges; ++n) {
      const Vector2 edge = q[n + 1] - q[n];
      edges.length[n] = core::norm(edge);
      edges.direction[n] = edge / edges.length[n];
    }
    const auto [least, most] = std::minmax_element(edges.length.begin(), edges.length.end());
    if (!(*least > curve::kLeastEdge * *most))
      return core::fail(ErrorCode::bad_input, "a control edge has no length, so no direction",
                        "move the two handles apart", "curve.curves[" + std::to_string(i) + "]");
    all.push_back(edges);
  }
  return all;
}

PiecewiseBezier chain_of(Point2 start, const std::vector<Edges>& edges, const Eigen::VectorXd& a) {
  PiecewiseBezier chain;
  Point2 p = start;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Bezier2 piece{{p}, {}};
    for (std::size_t n = 0; n < kEdges; ++n) {
      p = p + a[static_cast<Eigen::Index>(kEdges * i + n)] * edges[i].direction[n];
      piece.control.push_back(p);
    }
    chain.pieces.push_back(std::move(piece));
  }
  return chain;
}

double curvature_with_gradient(const Edges& e, double u, std::array<double, kEdges>* gradient) {
  const auto b4 = bernstein4(u);
  const auto b3 = bernstein3(u);
  std::array<Vector2, kEdges> first;   // ∂R'/∂a_n, R' = Σ a_n first_n
  std::array<Vector2, kEdges> second;  // likewise of R''
  Vector2 r1{};
  Vector2 r2{};
  for (std::size_t n = 0; n < kEdges; ++n) {
    first[n] = (5 * b4[n]) * e.direction[n];
    const double weight = (n > 0 ? b3[n - 1] : 0) - (n < 4 ? b3[n] : 0);
    second[n] = (20 * weight) * e.direction[n];
    r1 = r1 + e.length[n] * first[n];
    r2 = r2 + e.length[n] * second[n];
  }
  const double speed = core::norm(r1);
  const double cube = speed * speed * speed;
  const double kappa = cross(r1, r2) / cube;
  if (gradient)
    for (std::size_t n = 0; n < kEdges; ++n)
      (*gradient)[n] = (cross(first[n], r2) + cross(r1, second[n])) / cube -
                       3 * kappa * dot(r1, first[n]) / (speed * speed);
  return kappa;
}

FreeLengths::FreeLengths(std::vector<Edges> start, const Held& held) : start_(std::move(start)) {
  role_.assign(kEdges * start_.size(), Role::free);
  if (held.outermost)
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      role_[k] = Role::fixed;
      role_[role_.size() - 1 - k] = Role::fixed;
    }
  for (std::size_t i = 0; i + (held.closed ? 0 : 1) < start_.size(); ++i)
    tie_joint(i, (i + 1) % start_.size());
  if (held.end || held.closed) choose_pair();
  for (std::size_t k = 0; k < role_.size(); ++k)
    if (role_[k] == Role::free) free_.push_back(k);
  for (const Edges& e : start_)
    for (std::size_t n = 0; n < kEdges; ++n) end_ = end_ + e.length[n] * e.direction[n];
}

bool FreeLengths::expand(const Eigen::VectorXd& x, Eigen::VectorXd& a, RowMatrix* by_x) const {
  const auto all = static_cast<Eigen::Index>(role_.size());
  a.resize(all);
  if (by_x) by_x->setZero(all, size());
  for (Eigen::Index k = 0; k < all; ++k) a[k] = start_at(static_cast<std::size_t>(k));
  for (Eigen::Index k = 0; k < size(); ++k) {
    const auto at = static_cast<Eigen::Index>(free_[static_cast<std::size_t>(k)]);
    if (!(std::abs(x[k]) < 600)) return false;
    a[at] *= std::exp(x[k]);
    if (by_x) (*by_x)(at, k) = a[at];
  }
  for (const Joint& j : joints_) expand_joint(j, a, by_x);
  return !pair_found_ || expand_pair(a, by_x);
}

/// Where a joint has one curvature on both sides, that of the next piece follows.
void FreeLengths::tie_joint(std::size_t i, std::size_t next) {
  const Edges& before = start_[i];
  const Edges& after = start_[next];
  const double s4 = cross(before.direction[3], before.direction[4]);
  const double s1 = cross(after.direction[0], after.direction[1]);
  const double k0 = 0.8 * before.length[3] * s4 / (before.length[4] * before.length[4]);
  const double k1 = 0.8 * after.length[1] * s1 / (after.length[0] * after.length[0]);
  const double scale = std::abs(k0) + std::abs(k1);
  const bool smooth = dot(before.direction[4], after.direction[0]) > 1 - 1e-8;
  const double size = before.length[4] + after.length[0];
  // straight there on both sides, whatever the lengths; or no G2 joint to be kept
  if (!smooth || scale * size < 1e-7 || std::abs(k0 - k1) > 1e-3 * scale) return;
  const auto base = static_cast<Eigen::Index>(kEdges * i);
  const auto other = static_cast<Eigen::Index>(kEdges * next);
  joints_.push_back({other + 1, base + 3, base + 4, other, s4 / s1});
  role_[static_cast<std::size_t>(other + 1)] = Role::joint;
  source_.insert(source_.end(), {kEdges * i + 3, kEdges * i + 4, kEdges * next});
}

/// Two free lengths that no joint depends on, as far from parallel as can be.
void FreeLengths::choose_pair() {
  wants_pair_ = true;
  double best = 1e-3;
  const auto usable = [&](std::size_t k) {
    return role_[k] == Role::free && std::find(source_.begin(), source_.end(), k) == source_.end();
  };
  for (std::size_t p = 0; p < role_.size(); ++p)
    for (std::size_t q = p + 1; usable(p) && q < role_.size(); ++q) {
      if (!usable(q)) continue;
      const double sine = std::abs(cross(direction_at(p), direction_at(q)));
      if (sine <= best) continue;
      best = sine;
      pair_ = {p, q};
      pair_found_ = true;
    }
  if (pair_found_) role_[pair_[0]] = role_[pair_[1]] = Role::end;
}

void FreeLengths::expand_joint(const Joint& j, Eigen::VectorXd& a, RowMatrix* by_x) const {
  const double ratio = a[j.a1] / a[j.a5];
  a[j.target] = j.factor * a[j.a4] * ratio * ratio;
  if (!by_x) return;
  by_x->row(j.target) = a[j.target] * (by_x->row(j.a4) / a[j.a4] + 2 * by_x->row(j.a1) / a[j.a1] -
                                       2 * by_x->row(j.a5) / a[j.a5]);
}

bool FreeLengths::expand_pair(Eigen::VectorXd& a, RowMatrix* by_x) const {
  const auto p = static_cast<Eigen::Index>(pair_[0]);
  const auto q = static_cast<Eigen::Index>(pair_[1]);
  const Vector2 dp = direction_at(pair_[0]);
  const Vector2 dq = direction_at(pair_[1]);
  const double sine = cross(dp, dq);
  Vector2 rest = end_;
  if (by_x) by_x->row(p).setZero(), by_x->row(q).setZero();
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    if (k == p || k == q) continue;
    const Vector2 d = direction_at(static_cast<std::size_t>(k));
    rest = rest - a[k] * d;
    if (!by_x) continue;
    by_x->row(p) -= (cross(d, dq) / sine) * by_x->row(k);
    by_x->row(q) -= (cross(dp, d) / sine) * by_x->row(k);
  }
  a[p] = cross(rest, dq) / sine;
  a[q] = cross(dp, rest) / sine;
  return a[p] > 0 && a[q] > 0;
}

}  // namespace keyline::fit
