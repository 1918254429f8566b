#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/curve/bezier.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

constexpr int kSamples = 40;

/// Rational cubics with given ends, tangents and end curvatures: handle lengths a and b are free.
/// With curvature 2/3 w0 w2 / w1^2 h / a^2 at an end, h the distance of the far handle from the
/// tangent there, and w0 = w3 = 1 the weights follow.
class Family {
 public:
  explicit Family(const UnitPiece& unit)
      : end_(displacement(unit.piece, 1)),
        tangent_(core::unit_vector(unit.turning)),
        k0_(unit.piece.curvature_start),
        k1_(unit.piece.curvature_end) {
    const double first = cross(end_, tangent_) / tangent_.y;
    const double last = end_.y / tangent_.y;
    if (first > 0 && last > 0) longest_ = {first, last};
  }

  /// Lengths up to where both tangents meet, beyond which no handle ends; of tangents that do not
  /// meet ahead twice the chord.
  const std::array<double, 2>& longest() const { return longest_; }

  /// False where rounding would lose a handle or what it leaves to the tangents' meeting, or a
  /// weight would not be positive, or beyond what leaves a curve but corners.
  bool member(double a, double b, RationalCubic& c) const {
    if (!outlasts_rounding(a, longest_[0]) || !outlasts_rounding(b, longest_[1])) return false;
    const Vector2 b1{a, 0};
    const Vector2 b2 = end_ - b * tangent_;
    const double h0 = b2.y;
    const double h1 = cross(tangent_, b1 - end_);
    const double p = k0_ * 1.5 * a * a / h0;  // w2 / w1^2
    const double q = k1_ * 1.5 * b * b / h1;  // w1 / w2^2
    if (!(h0 > 0 && h1 > 0 && p > 0 && q > 0)) return false;
    c.polygon = {{0, 0}, b1, b2, end_};
    c.weights = {1, 1 / std::cbrt(p * p * q), 1 / std::cbrt(p * q * q), 1};
    return fits(c.weights[1]) && fits(c.weights[2]);
  }

 private:
  static bool fits(double weight) {
    return weight >= 1 / kMostRationalWeight && weight <= kMostRationalWeight;
  }

  static bool outlasts_rounding(double handle, double longest) {
    return handle > kShortestHandle && longest - handle > kShortestHandle;
  }

  Vector2 end_, tangent_;
  double k0_, k1_;
  std::array<double, 2> longest_{2, 2};
};

/// Vertical distances of graph points from their line of least squares, each weighted by the root
/// of the arc length it stands for; false where the graph is not defined all along.
bool graph_residuals(const RationalCubic& c, Eigen::VectorXd& r) {
  curve::Bezier2 bezier{{}, c.weights};
  for (const Vector2 v : c.polygon) bezier.control.push_back({v.x, v.y});
  Eigen::ArrayXd x(kSamples), y(kSamples), w(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double t = 0.5 - 0.5 * std::cos(core::kPi * (i + 0.5) / kSamples);
    const curve::Jet2 j = jet(bezier, t);
    const double kappa = curvature(j);
    const double rate = curvature_rate(j);
    x[i] = -std::log(std::abs(kappa));
    y[i] = std::log(std::abs(kappa / rate));
    w[i] = speed(j) * std::sqrt(t * (1 - t));
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || !(kappa > 0)) return false;
  }
  w /= w.sum();
  const double mx = (w * x).sum();
  const double my = (w * y).sum();
  const double slope = (w * (x - mx) * (y - my)).sum() / (w * (x - mx).square()).sum();
  r = (w.sqrt() * (y - my - slope * (x - mx))).matrix();
  return r.allFinite();
}

/// Unknowns: ln(x / (1 - x)), x the shares of the longest handles. A handle that ends beside that
/// of both tangents' meeting is as far from others as one that is short.
using Handles = std::array<double, 2>;

/// Derivatives by central differences.
struct Variance {
  const Family& family;
  std::array<double, 2> longest = family.longest();

  bool member(const Eigen::VectorXd& x, RationalCubic& c) const {
    const auto share = [](double logit) { return 1 / (1 + std::exp(-logit)); };
    return family.member(longest[0] * share(x[0]), longest[1] * share(x[1]), c);
  }
  /// Of handles; beyond the longest ones infinite or not a number, which no member has.
  Handles unknowns(double first, double last) const {
    return {std::log(first / (longest[0] - first)), std::log(last / (longest[1] - last))};
  }
  bool value(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    RationalCubic c;
    return member(x, c) && graph_residuals(c, r);
  }
  bool operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) const {
    if (!value(x, r)) return false;
    if (!jacobian) return true;
    jacobian->resize(kSamples, 2);
    for (int k = 0; k < 2; ++k) {
      const double h = 1e-6;
      Eigen::VectorXd up = x, down = x, ru, rd;
      up[k] += h;
      down[k] -= h;
      if (!value(up, ru) || !value(down, rd)) return false;
      jacobian->col(k) = (ru - rd) / (2 * h);
    }
    return true;
  }
};

/// Of a grid of handles those with fit weights, which may be few beside one another.
std::vector<Handles> members(const Variance& variance) {
  constexpr int kSteps = 240;
  const double most = -std::log(kShortestHandle);
  const auto logit = [most](int i) { return most * (1 - 2.0 * i / kSteps); };
  std::vector<Handles> all;
  RationalCubic c;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      if (variance.member(Eigen::Vector2d(logit(i), logit(j)), c))
        all.push_back({logit(i), logit(j)});
  return all;
}

/// Where the variance is least of some thousand members: what is left to start from where a guess
/// has no graph.
std::vector<Handles> scanned(const Variance& variance) {
  constexpr std::size_t kStarts = 4, kMeasured = 2000;
  struct Place {
    Handles handles;
    double cost = 0;
  };
  std::vector<Place> places;
  const std::vector<Handles> all = members(variance);
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / kMeasured) {
    Eigen::VectorXd r;
    if (variance.value(Eigen::Vector2d(all[i][0], all[i][1]), r))
      places.push_back({all[i], r.squaredNorm()});
  }
  std::ranges::sort(places, {}, &Place::cost);
  if (places.size() > kStarts) places.resize(kStarts);
  std::vector<Handles> starts;
  for (const Place& place : places) starts.push_back(place.handles);
  return starts;
}

/// The least of the minima reached from the starts.
RationalCubic least_variance(const Variance& variance, const std::vector<Handles>& starts) {
  RationalCubic best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [first, last] : starts) {
    Eigen::VectorXd x = Eigen::Vector2d(first, last);
    const auto report = numeric::minimize_least_squares(variance, x);
    if (report.status == numeric::LevenbergMarquardtStatus::no_start) continue;
    RationalCubic c;
    if (report.cost < least && variance.member(x, c)) {
      least = report.cost;
      best = std::move(c);
    }
  }
  return best;
}

}  // namespace

RationalCubic rational_cubic(const UnitPiece& unit) {
  const double theta = unit.turning;
  RationalCubic best;
  if (theta == 0) return {{{0, 0}, {1.0 / 3, 0}, {2.0 / 3, 0}, {1, 0}}, {1, 1, 1, 1}};
  const Family family(unit);
  const double radius = 1 / theta;  // of the arc of this length and turning
  const double arc_handle =
      2 * radius * std::sin(theta / 2) / (1 + 2 * std::cos(theta / 2));  // exact for an arc
  const double handle = theta < 3.5 ? arc_handle : 0.5;
  if (unit.piece.curvature_start == unit.piece.curvature_end) {
    family.member(arc_handle, arc_handle, best);
    return best;
  }
  const Variance variance{family};
  const double share = std::log(unit.piece.curvature_start / unit.piece.curvature_end) / 6;
  std::vector<Handles> starts;
  for (const double tilt : {0.0, 0.5, 1.0})
    starts.push_back(
        variance.unknowns(handle * std::exp(-tilt * share), handle * std::exp(tilt * share)));
  best = least_variance(variance, starts);
  if (best.polygon.empty()) best = least_variance(variance, scanned(variance));
  return best;
}

}  // namespace keyline::lac::detail
