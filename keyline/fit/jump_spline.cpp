#include "keyline/fit/jump_spline.h"

#include <algorithm>
#include <cmath>

#include "keyline/fit/basis_rows.h"

namespace keyline::fit::detail {
namespace {

/// Jumps at t[0] of the fifth derivatives, over 5!, of the seven quintic B-splines that have it as
/// a knot: what the divided differences that they are have of (x - t[0])^5. Of the first and the
/// last the knot at the other end cancels: t[-5] … t[5] are read.
std::array<double, 7> jumps_at(const double* t) {
  std::array<double, 7> jump;
  for (int j = 0; j < 7; ++j) {  // of knots t[j - 6] … t[j]
    jump[j] = j == 0 ? -1 : j == 6 ? 1 : t[j] - t[j - 6];
    for (int l = std::max(j - 6, -5); l <= std::min(j, 5); ++l)
      if (l != 0) jump[j] /= t[l] - t[0];
  }
  return jump;
}

}  // namespace

JumpSpline::JumpSpline(const PlacedPoints& data, std::span<const std::size_t> knots)
    : data_(data), spans_(static_cast<int>(knots.size()) - 1) {
  unknowns_ = data.closed ? spans_ : spans_ + kDegree;
  lay_knots(knots);
  gather(knots);
  penalise();
}

void JumpSpline::lay_knots(std::span<const std::size_t> knots) {
  const auto place = [&](int i) {
    const std::size_t point = knots[static_cast<std::size_t>(i)];
    return point < data_.at.size() ? data_.at[point] : 1.0;
  };
  spline_.degree = kDegree;
  spline_.control.resize(static_cast<std::size_t>(spans_ + kDegree));
  for (int i = -kDegree; i <= spans_ + kDegree; ++i) {
    const int turns = static_cast<int>(std::floor(static_cast<double>(i) / spans_));
    spline_.knots.push_back(data_.closed ? place(i - turns * spans_) + turns
                                         : place(std::clamp(i, 0, spans_)));
  }
}

void JumpSpline::gather(std::span<const std::size_t> knots) {
  const std::size_t count = data_.points.size();
  stride_ = padded(count) + kLanes;  // a span's rows are padded, too
  basis_.resize(kOrder * stride_);
  right_ = Eigen::MatrixXd::Zero(unknowns_, 2);
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < spans_; ++k) {
    const std::size_t first = knots[static_cast<std::size_t>(k)];
    const std::size_t last = k + 1 < spans_ ? knots[static_cast<std::size_t>(k) + 1] : count;
    basis_rows<kOrder>(spline_.knots.data(), static_cast<std::size_t>(k + kDegree),
                       {data_.at.data() + first, last - first}, nullptr, basis_.data() + first,
                       stride_);
    span_.insert(span_.end(), last - first, k);
    const auto products = add_span(k, first, last);
    for (int j = 0; j < kOrder; ++j)
      for (int l = 0; l < kOrder; ++l)
        entries.emplace_back(unknown(k + j), unknown(k + l),
                             products[std::max(j, l)][std::min(j, l)]);
  }
  squares_.resize(unknowns_, unknowns_);
  squares_.setFromTriplets(entries.begin(), entries.end());
}

/// Adds a span's points to the right-hand sides; the products of its splines, those of a later one
/// with an earlier.
JumpSpline::Products JumpSpline::add_span(int k, std::size_t first, std::size_t last) {
  Products products{};
  Eigen::Matrix<double, kOrder, 2> right = Eigen::Matrix<double, kOrder, 2>::Zero();
  for (std::size_t i = first; i < last; ++i)
    for (int j = 0; j < kOrder; ++j) {
      const double b = basis(j, i);
      for (int l = 0; l <= j; ++l) products[j][l] += b * basis(l, i);
      right(j, 0) += b * data_.points[i].x;
      right(j, 1) += b * data_.points[i].y;
    }
  for (int j = 0; j < kOrder; ++j) right_.row(unknown(k + j)) += right.row(j);
  return products;
}

void JumpSpline::penalise() {
  const double scale = std::pow(spans_, -kDegree);
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = data_.closed ? 0 : 1; k < spans_; ++k) {
    const auto jump = jumps_at(&spline_.knots[k + kDegree]);
    // The first of the seven begins a span before this one; a closed one's spans go on before 0.
    const int first = k - 1 + (data_.closed ? spans_ : 0);
    for (int j = 0; j < 7; ++j)
      for (int l = 0; l < 7; ++l)
        entries.emplace_back(unknown(first + j), unknown(first + l),
                             scale * jump[j] * scale * jump[l]);
  }
  jumps_.resize(unknowns_, unknowns_);
  jumps_.setFromTriplets(entries.begin(), entries.end());
}

bool JumpSpline::solve(double penalty) {
  const Eigen::SparseMatrix<double> matrix = squares_ + penalty * jumps_;
  factor_.renew(matrix);
  if (!factor_) return false;
  const Eigen::MatrixXd found = factor_.solve(right_);
  for (std::size_t j = 0; j < spline_.control.size(); ++j) {
    const int i = unknown(static_cast<int>(j));
    spline_.control[j] = {found(i, 0), found(i, 1)};
  }
  return found.allFinite();
}

core::Vector2 JumpSpline::offset(std::size_t point) const {
  core::Point2 sum{0, 0};
  for (int j = 0; j < kOrder; ++j) {
    const core::Point2 c = spline_.control[static_cast<std::size_t>(span_[point] + j)];
    sum.x += basis(j, point) * c.x;
    sum.y += basis(j, point) * c.y;
  }
  return sum - data_.points[point];
}

}  // namespace keyline::fit::detail
