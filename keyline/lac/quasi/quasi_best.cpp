#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_family.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/numeric/damped_descent.h"
#include "keyline/numeric/lawson.h"
#include "keyline/numeric/solve.h"

namespace keyline::lac::detail {

using core::Vector2;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Where a search begins: unknowns, and parameters of the feet.
struct Start {
  VectorXd x;
  std::vector<double> feet;
  double miss = 0;
};

/// Fractions of the arc length, close at the ends; where one end is much sharper than the other,
/// as many by tangent angle, so that it is not passed by.
std::vector<double> places(const UnitPiece& unit, int count) {
  std::vector<double> at;
  const double k0 = unit.piece.curvature_start;
  const double k1 = unit.piece.curvature_end;
  const bool uneven = k0 * k1 > 0 && std::max(k0, k1) > 20 * std::min(k0, k1);
  for (int j = 0; j < count; ++j) {
    const double v = 0.5 - 0.5 * std::cos(core::kPi * (j + 0.5) / count);
    at.push_back(v);
    if (uneven) at.push_back(fraction_at_turning(unit.piece, v));
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// Share of the parameter up to each place where it runs as the power gamma of the curvature over
/// the arc length: 0 arc length, 1 tangent angle.
std::vector<double> parameters(const UnitPiece& unit, const std::vector<double>& at, double gamma) {
  if (gamma == 0) return at;
  constexpr int kPanels = 400;
  const double floor = 0.02 * unit.turning;  // an inflection takes its share too
  const auto rate = [&](double v) {
    return std::pow(std::min(std::abs(curvature(unit.piece, v)), 1e6) + floor, gamma);
  };
  std::vector<double> sum{0};
  const auto place = [](int i) { return 0.5 - 0.5 * std::cos(core::kPi * i / kPanels); };
  for (int i = 0; i < kPanels; ++i) {
    const double v0 = place(i), v1 = place(i + 1);
    sum.push_back(sum.back() + (v1 - v0) * rate(0.5 * (v0 + v1)));
  }
  std::vector<double> out;
  for (const double v : at) {
    const double k = std::acos(1 - 2 * v) / core::kPi * kPanels;
    const int i = std::clamp(static_cast<int>(k), 0, kPanels - 1);
    out.push_back((sum[i] + (k - i) * (sum[i + 1] - sum[i])) / sum.back());
  }
  return out;
}

/// Smallest largest normal distance at places of the piece: damped Gauss-Newton steps on weighted
/// distances, weights growing where the distance is large (Lawson's rule).
class Fit {
 public:
  Fit(const UnitPiece& unit, int degree, const BestSearch& search)
      : unit_(unit),
        search_(search),
        family_(unit, degree, search.curvatures_held),
        degree_(degree) {
    at_ = places(unit, 4 * degree + 8);
    for (const double v : at_) {
      points_.push_back(displacement(unit.piece, v));
      tangents_.push_back(core::unit_vector(turning(unit.piece, v)));
    }
  }

  /// From the polygon given, or unit speed where there is none, or, where they leave much, from the
  /// best of many starts too.
  ControlPolygon run() {
    if (!search_.from.empty())
      descend_from({family_.nearest(search_.from), feet_on(search_.from), 0});
    if (search_.thorough || search_.from.empty()) from_unit_speed();
    if (search_.thorough && !(least_ < kGood)) {
      for (const Start& start : starts()) descend_from(start);
      for (const Start& start : other_forms()) descend_from(start);
    }
    if (std::isinf(least_)) return {};
    return family_.polygon(best_);
  }

 private:
  /// Deviation from which on, of the length, other starts are worth their time.
  static constexpr double kGood = 1e-9;
  static constexpr double kExact = 1e-15;
  static constexpr double kHopeless = 40;  ///< times the nearest so far
  static constexpr double kSame = 0.01;    ///< of the largest distance

  /// Of a parameter's speed at an end, in reach of the end's curvature: a handle as long as the
  /// radius bends the polygon by about a radian.
  double handle(double speed, double curvature) const {
    if (!search_.curvatures_held || std::isinf(curvature)) return speed / degree_;
    return std::min(speed / degree_, 1 / std::abs(curvature));
  }

  void from_unit_speed() {
    double miss = 0;
    const double handle = 1.0 / degree_;
    descend_from({family_.start(handle, handle, at_, points_, miss), at_, miss});
  }

  /// Where a curve along the piece is nearest to the places, of many of its parameters.
  std::vector<double> feet_on(const ControlPolygon& b) const {
    const int count = 8 * static_cast<int>(at_.size());
    std::vector<Vector2> curve;
    const auto parameter = [&](int i) { return 0.5 - 0.5 * std::cos(core::kPi * i / count); };
    for (int i = 0; i <= count; ++i)
      curve.push_back(combine(Basis(degree_, parameter(i)).value, b));
    const auto square = [](Vector2 v) { return dot(v, v); };
    std::vector<double> feet;
    int i = 0;
    for (const Vector2& p : points_) {
      int nearest = i;
      for (int k = i; k <= count; ++k)
        if (square(curve[k] - p) < square(curve[nearest] - p)) nearest = k;
      i = nearest;
      feet.push_back(parameter(i));
    }
    return feet;
  }

  /// From the Taylor forms about either end and the middle, and the discretised ones.
  std::vector<Start> other_forms() const {
    std::vector<Start> all;
    const auto add = [&](SeriesVariable variable, const ControlPolygon& polygon) {
      const bool sound = std::all_of(polygon.begin(), polygon.end(),
                                     [](Vector2 v) { return std::isfinite(norm(v)); });
      if (!sound) return;
      std::vector<double> feet = at_;
      if (variable == SeriesVariable::tangent_angle)
        for (double& t : feet) t = std::clamp(turning(unit_.piece, t) / unit_.turning, 0.0, 1.0);
      all.push_back({family_.nearest(polygon), feet, 0});
    };
    const bool turns = unit_.turning > 0 && !(inflection(unit_.piece) > 0) &&
                       unit_.piece.curvature_start * unit_.piece.curvature_end > 0;
    for (const auto variable : {SeriesVariable::arc_length, SeriesVariable::tangent_angle}) {
      if (variable == SeriesVariable::tangent_angle && !turns) continue;
      for (const double about : {0.0, 0.5, 1.0}) {
        const TaylorSeries series = taylor_series(unit_, variable, about, degree_);
        if (series.analytic) add(variable, taylor_polygon(unit_, series));
      }
      add(variable, discrete_polygon(unit_, variable, degree_));
    }
    return all;
  }

  /// Handles about those of each parameter's own speed; the closest first.
  std::vector<Start> starts() const {
    std::vector<Start> all;
    for (const double gamma : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const std::vector<double> t = parameters(unit_, at_, gamma);
      const double first = handle(at_.front() / t.front(), unit_.piece.curvature_start);
      const double last = handle((1 - at_.back()) / (1 - t.back()), unit_.piece.curvature_end);
      Start best{{}, t, std::numeric_limits<double>::infinity()};
      for (const double a : {0.4, 0.6, 0.8, 1.0, 1.3, 1.7})
        for (const double b : {0.4, 0.6, 0.8, 1.0, 1.3, 1.7}) {
          double miss = 0;
          VectorXd x = family_.start(a * first, b * last, t, points_, miss);
          if (miss < best.miss) best = {std::move(x), t, miss};
        }
      if (best.x.size() > 0) all.push_back(std::move(best));
    }
    std::sort(all.begin(), all.end(),
              [](const Start& a, const Start& b) { return a.miss < b.miss; });
    return all;
  }

  void descend_from(const Start& start) {
    weights_ = VectorXd::Constant(static_cast<Eigen::Index>(at_.size()), 1.0);
    damping_ = {.raise = 30, .least = 1e-13, .most = 1e2};
    round_least_ = std::numeric_limits<double>::infinity();
    feet_of_last_ = start.feet;
    last_ = start.x;
    residuals_.resize(0);
    descend(start.x, 40);
    if (std::isinf(round_least_) || !is_worth_rounds()) return;
    for (int round = 0; round < 25 && least_ > 1e-14; ++round) {
      reweight();
      descend(last_, 2);
    }
  }

  /// Whether the least squares just found may become the nearest curve: not where another start led
  /// to the same, or where they are farther off than weights ever make good.
  bool is_worth_rounds() {
    const double largest = residuals_.cwiseAbs().maxCoeff();
    if (largest > kHopeless * least_) return false;
    for (const VectorXd& known : least_squares_)
      if ((known - residuals_).cwiseAbs().maxCoeff() < kSame * largest) return false;
    least_squares_.push_back(residuals_);
    return true;
  }

  /// Distances along the normals at x, feet moved along; false where a foot is lost.
  bool distances(const VectorXd& x, VectorXd& r, MatrixXd* jacobian) {
    const ControlPolygon b = family_.polygon(x);
    const int rows = static_cast<int>(at_.size());
    r.resize(rows);
    if (jacobian) jacobian->resize(rows, family_.unknowns());
    for (int j = 0; j < rows; ++j) {
      double& t = feet_[j];
      const Vector2 tangent = tangents_[j];
      const Vector2 normal = core::perpendicular_left(tangent);
      Basis basis(degree_, t);
      Vector2 velocity = combine(basis.slope, b);
      Vector2 off = combine(basis.value, b) - points_[j];
      for (int step = 0; step < 4; ++step) {
        const double pace = dot(velocity, tangent);
        if (!(pace > 0)) return false;
        const double to = std::clamp(t - dot(off, tangent) / pace, 0.0, 1.0);
        if (std::abs(to - t) < 1e-13) break;
        t = to;
        basis = Basis(degree_, t);
        velocity = combine(basis.slope, b);
        off = combine(basis.value, b) - points_[j];
      }
      r[j] = dot(off, normal);
      if (!jacobian) continue;
      const double lean = dot(velocity, normal) / dot(velocity, tangent);
      for (int k = 0; k < family_.unknowns(); ++k) {
        const Vector2 d = family_.change(x, basis.value, k);
        (*jacobian)(j, k) = dot(d, normal) - lean * dot(d, tangent);
      }
    }
    return r.allFinite();
  }

  void keep_better(const VectorXd& x, const VectorXd& r) {
    // A handle the other way reverses an end tangent, one too short loses it in rounding.
    if (!(x[0] > kShortestHandle) || !(x[2] > kShortestHandle)) return;
    const double largest = r.cwiseAbs().maxCoeff();
    round_least_ = std::min(round_least_, largest);
    if (!(largest < least_)) return;
    least_ = largest;
    best_ = x;
  }

  void descend(VectorXd x, int steps) {
    VectorXd r;
    MatrixXd jacobian;
    feet_ = feet_of_last_;
    if (!distances(x, r, &jacobian)) return;
    keep_better(x, r);
    if (!(least_ > kExact)) steps = 0;
    numeric::damped_descent(damping_, steps, [&](double damping) -> numeric::StepOutcome {
      const double cost = weights_.dot(r.cwiseAbs2());
      const MatrixXd weighted = weights_.asDiagonal() * jacobian;
      MatrixXd normal = jacobian.transpose() * weighted;
      normal.diagonal().array() += damping * normal.diagonal().maxCoeff();
      const VectorXd next = x - numeric::solve_symmetric(normal, weighted.transpose() * r);
      const std::vector<double> feet = feet_;
      VectorXd moved;
      MatrixXd slopes;
      const bool fine = distances(next, moved, &slopes);
      if (!fine || !(weights_.dot(moved.cwiseAbs2()) <= cost)) {
        feet_ = feet;
        return {};
      }
      const bool settled = weights_.dot(moved.cwiseAbs2()) > 0.999 * cost;
      x = next;
      r = moved;
      jacobian = slopes;
      keep_better(x, r);
      return {settled || !(least_ > kExact) ? numeric::StepEnd::settled : numeric::StepEnd::taken};
    });
    feet_of_last_ = feet_;
    last_ = x;
    residuals_ = r;
  }

  void reweight() {
    if (residuals_.size() != weights_.size()) return;
    const VectorXd distances = residuals_.cwiseAbs();
    const auto count = static_cast<std::size_t>(distances.size());
    numeric::lawson_weights({weights_.data(), count}, {distances.data(), count});
    damping_.value = std::min(damping_.value, 1e-6);
  }

  const UnitPiece& unit_;
  const BestSearch& search_;
  Family family_;
  int degree_;
  std::vector<double> at_, feet_, feet_of_last_;
  std::vector<Vector2> points_, tangents_;
  VectorXd weights_, best_, last_, residuals_;
  std::vector<VectorXd> least_squares_;  ///< distances where each start's descent ended
  numeric::FactorDamping damping_;
  double least_ = std::numeric_limits<double>::infinity();
  double round_least_ = std::numeric_limits<double>::infinity();  ///< from the present start
};

}  // namespace

ControlPolygon best_polygon(const UnitPiece& unit, int degree, const BestSearch& search) {
  return Fit(unit, degree, search).run();
}

}  // namespace keyline::lac::detail
