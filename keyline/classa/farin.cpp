#include "keyline/classa/farin.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "keyline/core/extent.h"
#include "keyline/curve/bernstein.h"
#include "keyline/curve/bounded.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Vector3;
using curve::MonotoneVerdict;
using curve::detail::Bounded;
using curve::detail::Coefficients;
using curve::detail::combination;
using curve::detail::derivative;
using curve::detail::product;
using curve::detail::Sign;

namespace {

Vector3 times(const Matrix3& m, Vector3 v) {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
          m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

/// N'V - 3NV' in plain Bernstein coefficients.
Coefficients<Bounded> rate_of(const curve::Bezier3& c) {
  const double size = core::reach(c.control);
  const auto axis = [&](double core::Point3::* coordinate) {
    Coefficients<Bounded> a;
    for (const auto& p : c.control) {
      const double v = (p.*coordinate - c.control.front().*coordinate) / size;
      a.push_back({v, 2 * curve::detail::kRounding * std::abs(v)});
    }
    return derivative(curve::detail::scaled(a));
  };
  const std::array<Coefficients<Bounded>, 3> first = {
      axis(&core::Point3::x), axis(&core::Point3::y), axis(&core::Point3::z)};
  Coefficients<Bounded> turning = {Bounded(0)};
  Coefficients<Bounded> speed = {Bounded(0)};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = first[i];
    const auto& b = first[(i + 1) % 3];
    const auto minor = combination(product(a, derivative(b)), -1, product(b, derivative(a)));
    turning = combination(turning, 1, product(minor, minor));
    speed = combination(speed, 1, product(a, a));
  }
  auto rate =
      combination(product(derivative(turning), speed), -3, product(turning, derivative(speed)));
  const auto binomial = curve::detail::binomials<Bounded>(rate.size() - 1);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = rate[i] / binomial[i];
  return rate;
}

Sign common_sign(const Coefficients<Bounded>& b) {
  Sign common = Sign::zero;
  for (const Bounded& x : b) {
    const Sign s = sign_of(x);
    if (s == Sign::zero) continue;
    if (s == Sign::unknown || (common != Sign::zero && common != s)) return Sign::unknown;
    common = s;
  }
  return common;
}

struct Tally {
  const curve::Bezier3* curve;
  double length = 1;     // of the control polygon
  double total[2] = {};  // relative change on the parts that fall and rise
  double largest[2] = {};
  double at[2] = {};
  bool doubt = false;
  double doubt_at = 0;
  int budget = 2000;

  void count(Sign sign, double low, double high) {
    const double middle = 0.5 * (low + high);
    if (sign == Sign::unknown) {
      doubt = true;
      doubt_at = middle;
    }
    if (sign == Sign::unknown || sign == Sign::zero) return;
    const double before = curvature(*curve, low);
    const double after = curvature(*curve, high);
    const double unit = std::max({before, after, 1 / length});
    const double change = std::isfinite(unit) ? std::abs(after - before) / unit : 1;
    const int side = sign == Sign::positive ? 1 : 0;
    total[side] += change;
    if (change >= largest[side]) {
      largest[side] = change;
      at[side] = middle;
    }
  }
};

void visit(const Coefficients<Bounded>& rate, double low, double high, int depth, Tally& tally) {
  const Sign sign = common_sign(rate);
  if (sign != Sign::unknown || depth == 0 || --tally.budget < 0) {
    tally.count(sign, low, high);
    return;
  }
  const std::size_t n = rate.size() - 1;
  Coefficients<Bounded> b = rate;
  Coefficients<Bounded> left = rate;
  Coefficients<Bounded> right = rate;
  for (std::size_t level = 0; level <= n; ++level) {
    left[level] = b[0];
    right[n - level] = b[n - level];
    for (std::size_t i = 0; i + level < n; ++i) b[i] = half_sum(b[i], b[i + 1]);
  }
  const double middle = 0.5 * (low + high);
  visit(left, low, middle, depth - 1, tally);
  visit(right, middle, high, depth - 1, tally);
}

/// All edges along one line, up to the rounding of the control points.
bool is_straight(const curve::Bezier3& c) {
  Vector3 longest;
  double size = 0;
  for (const auto& p : c.control) {
    size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (norm(p - c.control.front()) > norm(longest)) longest = p - c.control.front();
  }
  return std::all_of(c.control.begin(), c.control.end(), [&](const core::Point3& p) {
    return norm(cross(p - c.control.front(), longest)) <= 8e-16 * size * norm(longest);
  });
}

}  // namespace

core::Result<void> validate(const SpaceMatrixCurve& c) {
  if (!is_finite(c.start))
    return fail(ErrorCode::bad_input, "the start is not finite", {}, "start");
  if (!is_finite(c.tangent) || !(norm(c.tangent) > 0))
    return fail(ErrorCode::bad_input, "the tangent has no direction",
                "give a finite vector that is not zero", "tangent");
  if (c.degree < 2 || c.degree > curve::kMaxBezierDegree)
    return fail(ErrorCode::bad_input, "the degree has to lie between 2 and 30", {}, "degree");
  for (const auto& row : c.matrix)
    for (const double x : row)
      if (!std::isfinite(x))
        return fail(ErrorCode::bad_input, "the matrix is not finite", {}, "matrix");
  for (const auto& p : to_bezier(c).control)
    if (!is_finite(p))
      return fail(ErrorCode::bad_input, "powers of the matrix overflow", "scale it down", "matrix");
  return {};
}

curve::Bezier3 to_bezier(const SpaceMatrixCurve& c) {
  curve::Bezier3 bezier;
  bezier.control.push_back(c.start);
  Vector3 edge = c.tangent;
  for (int i = 0; i < c.degree; ++i) {
    bezier.control.push_back(bezier.control.back() + edge);
    edge = times(c.matrix, edge);
  }
  return bezier;
}

FarinConditions farin_conditions(const SpaceMatrixCurve& c) {
  FarinConditions farin;
  const Vector3 v = c.tangent;
  const Vector3 image = times(c.matrix, v);
  farin.segment = 2 * dot(v, image) - 2 * dot(v, v) >= 0 && dot(image, image) >= dot(v, v);
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) m(i, k) = c.matrix[i][k];
  const Eigen::Matrix3d symmetric = m + m.transpose() - 2 * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric, Eigen::EigenvaluesOnly);
  farin.expands = solver.eigenvalues()[0] >= -1e-14 * m.norm();
  const Eigen::Vector3d sigma = Eigen::JacobiSVD<Eigen::Matrix3d>(m).singularValues();
  farin.sigma = {sigma[0], sigma[1], sigma[2]};
  farin.singular_values = sigma[2] * sigma[2] >= sigma[0] * (1 - 1e-14);
  return farin;
}

MonotoneVerdict certify_monotone_curvature(const curve::Bezier3& c, double tolerance) {
  if (!curve::validate(c) || is_rational(c))
    throw core::InvalidInput("certify_monotone_curvature: a polynomial curve is needed");
  constexpr int kDepth = 24;
  Tally tally{&c, 0};
  for (std::size_t i = 0; i + 1 < c.control.size(); ++i)
    tally.length += distance(c.control[i], c.control[i + 1]);
  MonotoneVerdict verdict;
  if (tally.length == 0) return verdict;
  if (is_straight(c)) {
    verdict.answer = MonotoneVerdict::yes;
    return verdict;
  }
  visit(rate_of(c), 0, 1, kDepth, tally);
  const bool rises = tally.total[1] >= tally.total[0];
  const int back = rises ? 0 : 1;
  const bool both = tally.total[0] > 0 && tally.total[1] > 0;
  verdict.direction = tally.total[0] == 0 && tally.total[1] == 0 ? 0 : rises ? 1 : -1;
  verdict.backward = both ? tally.largest[back] : 0;
  if (both && verdict.backward > tolerance) {
    verdict.answer = MonotoneVerdict::no;
    verdict.witness = tally.at[back];
  } else if (both || tally.doubt) {
    verdict.witness = both ? tally.at[back] : tally.doubt_at;
  } else {
    verdict.answer = MonotoneVerdict::yes;
  }
  return verdict;
}

}  // namespace keyline::classa
