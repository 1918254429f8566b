#include "keyline/surface/strands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

namespace keyline::surface::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixX3d;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double kLongest = 0.25;   ///< change of an edge in one step, of the edge
constexpr double kStraight = 1e-9;  ///< sine of a turn that is none
constexpr double kSlack = 0.01;     ///< of steps of multipliers, against those of points

using Edges = std::array<Vector3d, 3>;

Vector3d edge_of(const Strand& s, const MatrixX3d& x, std::size_t i) {
  return (x.row(s.points[i + 1]) - x.row(s.points[i])).transpose();
}

Edges edges_of(const Strand& s, const MatrixX3d& x, std::size_t i) {
  return {edge_of(s, x, i), edge_of(s, x, i + 1), edge_of(s, x, i + 2)};
}

double length_of(const Strand& s, const MatrixX3d& x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < s.points.size(); ++i) sum += edge_of(s, x, i).norm();
  return sum;
}

/// Of the plane through the first point that is nearest to the others.
Vector3d normal_of(const Strand& s, const MatrixX3d& x) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Index p : s.points) {
    const Vector3d d = (x.row(p) - x.row(s.points[0])).transpose();
    sum += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
}

/// Places of the points over that plane, the strand's length as unit.
Eigen::VectorXd heights_of(const Strand& s, const MatrixX3d& x, const Vector3d& normal) {
  const double size = length_of(s, x);
  Eigen::VectorXd heights(static_cast<Index>(s.points.size()) - 1);
  for (std::size_t i = 1; i < s.points.size(); ++i)
    heights[static_cast<Index>(i) - 1] =
        (x.row(s.points[i]) - x.row(s.points[0])).dot(normal) / size;
  return heights;
}

/// What the third edge lacks of what turning and scaling once more gives, the second as unit.
Vector3d off_matrix(const Edges& e) {
  const double c = e[0].squaredNorm();
  const Vector3d off = e[2] - 2 * e[0].dot(e[1]) / c * e[1] + e[1].squaredNorm() / c * e[0];
  return off / e[1].norm();
}

/// Rows of a least squares problem as they are put together.
class Rows {
 public:
  explicit Rows(const std::vector<Index>& column) : column_(column) {}

  Index next() const { return static_cast<Index>(right_.size()); }
  void put(Index row, Index point, const RowVector3d& d) {
    const Index c = column_[static_cast<std::size_t>(point)];
    for (int k = 0; k < 3 && c >= 0; ++k)
      if (d[k] != 0) entries_.emplace_back(row, c + k, d[k]);
  }
  void put_unknown(Index row, Index column, double d) { entries_.emplace_back(row, column, d); }
  void close(double residual) { right_.push_back(residual); }

  /// Residuals that depend on three edges from point i on, with their derivatives.
  void put_edges(const Strand& s, std::size_t i, const std::array<Eigen::Matrix3d, 3>& d,
                 const Vector3d& r) {
    for (int n = 0; n < 3; ++n) {
      const Index row = next();
      for (std::size_t k = 0; k < 3; ++k) {
        put(row, s.points[i + k], -d[k].row(n));
        put(row, s.points[i + k + 1], d[k].row(n));
      }
      close(r[n]);
    }
  }

  Eigen::SparseMatrix<double> matrix(Index columns) const {
    Eigen::SparseMatrix<double> j(next(), columns);
    j.setFromTriplets(entries_.begin(), entries_.end());
    return j;
  }
  Eigen::Map<const Eigen::VectorXd> residuals() const { return {right_.data(), next()}; }

 private:
  const std::vector<Index>& column_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

void put_joint(Rows& rows, const JointRow& joint, Index first_multiplier) {
  const double w = std::sqrt(kHolds);
  for (int k = 0; k < 3; ++k) {
    const Index row = rows.next();
    for (const auto& [i, f] : joint.points) rows.put(row, i, w * f * RowVector3d::Unit(k));
    for (const auto& [i, by] : joint.multipliers)
      rows.put_unknown(row, first_multiplier + i, w * by[k]);
    rows.close(w * joint.lacks[k]);
  }
}

void put_matrix(Rows& rows, const Strand& s, const MatrixX3d& x, double w) {
  for (std::size_t i = 0; i + 3 < s.points.size(); ++i) {
    const Edges e = edges_of(s, x, i);
    const double f = w / e[1].norm();
    const double a = e[0].dot(e[1]);
    const double b = e[1].squaredNorm();
    const double c = e[0].squaredNorm();
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Vector3d slope = e[1] / c - 2 * a / (c * c) * e[0];  // of a/c by the first edge
    const Eigen::Matrix3d by0 =
        b / c * one - 2 * e[1] * slope.transpose() - 2 * b / (c * c) * e[0] * e[0].transpose();
    const Eigen::Matrix3d by1 =
        -2 * a / c * one - 2 / c * e[1] * e[0].transpose() + 2 / c * e[0] * e[1].transpose();
    rows.put_edges(s, i, {f * by0, f * by1, f * one}, w * off_matrix(e));
  }
}

void put_plane(Rows& rows, const Strand& s, const MatrixX3d& x) {
  const double w = std::sqrt(kHolds);
  const Vector3d n = normal_of(s, x);
  const Eigen::VectorXd heights = heights_of(s, x, n);
  const RowVector3d d = w / length_of(s, x) * n.transpose();
  for (std::size_t i = 1; i < s.points.size(); ++i) {
    const Index row = rows.next();
    rows.put(row, s.points[i], d);
    rows.put(row, s.points[0], -d);
    rows.close(w * heights[static_cast<Index>(i) - 1]);
  }
}

/// Each edge stays the same sum of the two before it; a straight strand the same multiple.
void put_likeness(Rows& rows, const Strand& s, const MatrixX3d& x, const MatrixX3d& given) {
  for (std::size_t i = 0; i + 3 < s.points.size(); ++i) {
    const Edges g = edges_of(s, given, i);
    Eigen::Vector2d k{0, g[2].dot(g[1]) / g[1].squaredNorm()};
    if (g[0].cross(g[1]).norm() > kStraight * g[0].norm() * g[1].norm()) {
      Eigen::Matrix<double, 3, 2> two;
      two << g[0], g[1];
      k = two.colPivHouseholderQr().solve(g[2]);
    }
    const double f = std::sqrt(kHolds) / g[1].norm();
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Edges e = edges_of(s, x, i);
    rows.put_edges(s, i, {-f * k[0] * one, -f * k[1] * one, f * one},
                   f * (e[2] - k[0] * e[0] - k[1] * e[1]));
  }
}

void put_shape(Rows& rows, const Strand& s, const MatrixX3d& x, const MatrixX3d& given,
               double weight) {
  switch (s.asked) {
    case Asked::one_matrix:
      return put_matrix(rows, s, x, std::sqrt(weight));
    case Asked::plane:
      return put_plane(rows, s, x);
    case Asked::likeness:
      return put_likeness(rows, s, x, given);
    case Asked::nothing:
      return;
  }
}

void put_growth(Rows& rows, const Strand& s, const MatrixX3d& x, double misfit, double weight) {
  const double w = std::sqrt(weight);
  const auto n = s.points.size();
  const Index row = rows.next();
  for (const auto& [k, sign] : {std::pair{std::size_t{0}, -1.0}, std::pair{n - 2, 1.0}}) {
    const Vector3d e = edge_of(s, x, k);
    const RowVector3d d = sign * w / (static_cast<double>(n - 2) * e.squaredNorm()) * e.transpose();
    rows.put(row, s.points[k], -d);
    rows.put(row, s.points[k + 1], d);
  }
  rows.close(w * misfit);
}

}  // namespace

StrandSystem::StrandSystem(std::span<const BezierSurface> patches,
                           std::span<const HeldJoint> joints,
                           const std::vector<std::vector<bool>>& fixed,
                           JointMultipliers multipliers)
    : given_(coordinates(patches)) {
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const auto base = static_cast<Index>(column_.size());
    for (std::size_t i = 0; i < patches[p].net.points.size(); ++i) {
      column_.push_back(fixed[p][i] ? -1 : unknowns_);
      if (!fixed[p][i]) unknowns_ += 3;
    }
    add_strands(patches[p].net, p, base);
  }
  double sum = 0;
  for (const Strand& s : strands_) sum += length_of(s, given_);
  size_ = sum / static_cast<double>(strands_.size());
  joints_.emplace(joint_equations(patches, joints), given_, size_, multipliers);
}

void StrandSystem::add_strands(const Net& net, std::size_t patch, Index base) {
  for (const NetworkCurve& c : network_curves(net)) {
    Strand s;
    s.patch = patch;
    for (int i = 0; i < static_cast<int>(c.control.size()); ++i)
      s.points.push_back(
          base + static_cast<Index>(c.is_row ? net.index(c.index, i) : net.index(i, c.index)));
    strands_.push_back(std::move(s));
  }
}

double StrandSystem::misfit(const Strand& s, const MatrixX3d& x) const {
  if (s.asked == Asked::plane) return heights_of(s, x, normal_of(s, x)).norm();
  if (s.asked != Asked::one_matrix) return 0;
  double square = 0;
  for (std::size_t i = 0; i + 3 < s.points.size(); ++i)
    square += off_matrix(edges_of(s, x, i)).squaredNorm();
  return std::sqrt(square);
}

double StrandSystem::growth(const Strand& s, const MatrixX3d& x) const {
  const auto n = s.points.size();
  return std::log(edge_of(s, x, n - 2).norm() / edge_of(s, x, 0).norm()) /
         static_cast<double>(n - 2);
}

Eigen::VectorXd StrandSystem::whole_step(const MatrixX3d& x, const MatrixX3d& home, double homing,
                                         const StrandWeights& weights) {
  Rows rows(column_);
  for (std::size_t i = 0; i < joints_->count(); ++i) put_joint(rows, joints_->at(i, x), unknowns_);
  for (std::size_t i = 0; i < strands_.size(); ++i) {
    const Strand& s = strands_[i];
    put_shape(rows, s, x, given_, weights.shape[i]);
    if (s.growth && weights.growth[i] > 0)
      put_growth(rows, s, x, growth(s, x) - *s.growth, weights.growth[i]);
  }
  const double h = homing / (size_ * size_);
  for (std::size_t p = 0; p < column_.size(); ++p)
    for (int k = 0; k < 3 && column_[p] >= 0; ++k) {
      const auto point = static_cast<Index>(p);
      rows.put(rows.next(), point, std::sqrt(h) * RowVector3d::Unit(k));
      rows.close(std::sqrt(h) * (x(point, k) - home(point, k)));
    }
  for (std::size_t i = 0; i < multipliers().size(); ++i) {
    rows.put_unknown(rows.next(), unknowns_ + static_cast<Index>(i),
                     std::sqrt(homing) * kSlack * std::max(kSlack, joints_->weight(i)));
    rows.close(0);
  }
  const Eigen::SparseMatrix<double> j = rows.matrix(all_unknowns());
  if (!factor_.renew(j.transpose() * j)) return Eigen::VectorXd::Zero(all_unknowns());
  return -factor_.solve(Eigen::VectorXd(j.transpose() * rows.residuals()));
}

RowVector3d StrandSystem::moved(Index point, const Eigen::VectorXd& dx) const {
  const Index c = column_[static_cast<std::size_t>(point)];
  return c < 0 ? RowVector3d::Zero().eval() : dx.segment<3>(c).transpose().eval();
}

double StrandSystem::share_of(const MatrixX3d& x, const Eigen::VectorXd& dx) const {
  double share = 1;
  for (const Strand& s : strands_)
    for (std::size_t i = 0; i + 1 < s.points.size(); ++i) {
      const double change = (moved(s.points[i + 1], dx) - moved(s.points[i], dx)).norm();
      const double most = kLongest * edge_of(s, x, i).norm();
      if (most > 0 && change > most) share = std::min(share, most / change);
    }
  return share;
}

double StrandSystem::step(MatrixX3d& x, const MatrixX3d& home, double homing,
                          const StrandWeights& weights) {
  if (unknowns_ == 0) return 0;
  const Eigen::VectorXd dx = whole_step(x, home, homing, weights);
  if (!dx.allFinite()) return 0;
  const double share = share_of(x, dx);
  for (Index p = 0; p < x.rows(); ++p) x.row(p) += share * moved(p, dx);
  std::vector<double> now = multipliers();
  for (std::size_t i = 0; i < now.size(); ++i)
    now[i] += share * dx[unknowns_ + static_cast<Index>(i)];
  set_multipliers(std::move(now));
  return share * dx.head(unknowns_).lpNorm<Eigen::Infinity>() / size_;
}

}  // namespace keyline::surface::detail
