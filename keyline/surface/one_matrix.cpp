#include "keyline/surface/one_matrix.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>

#include "keyline/core/axis.h"
#include "keyline/numeric/levenberg_marquardt.h"
#include "keyline/numeric/solve.h"

namespace keyline::surface::detail {
namespace {

using core::cross;
using core::dot;
using core::norm;
using core::Point3;
using core::Vector3;

constexpr double kDepartureWeight = 0.1;
constexpr double kShortest = 1e-9;  ///< edge, as share of the size

/// Twice the largest distance from the centroid: the same in every pose.
double size_of(const Net& net) {
  Vector3 sum;
  for (const Point3& p : net.points) sum = sum + (p - Point3{});
  const Point3 middle = Point3{} + sum / static_cast<double>(net.points.size());
  double most = 0;
  for (const Point3& p : net.points) most = std::max(most, core::distance(p, middle));
  return 2 * most;
}

int degree_of(const Net& net, int curve) { return (curve < net.rows ? net.columns : net.rows) - 1; }

int matrix_count(const OneMatrixProblem& p, int curve) {
  return p.wishes[curve].loose ? 0 : 3 * std::max(degree_of(p.net, curve) - 2, 0);
}

/// Equations of one curve: its matrix, then growth, turn and tangent as wished.
int residual_count(const OneMatrixProblem& p, int curve) {
  const CurveWish& wish = p.wishes[curve];
  return matrix_count(p, curve) + (wish.growth ? 1 : 0) + (wish.turn ? 1 : 0) +
         (wish.tangent ? 3 : 0) + (wish.turn_within ? 1 : 0) + (wish.growth_within ? 1 : 0);
}
double outside(const core::Interval& range, double x) { return x - core::clamp(range, x); }

/// Residuals of the curves and of the departure, with unknowns as shares of the net's size.
class System {
 public:
  System(const OneMatrixProblem& problem, double size, double equation_weight)
      : p_(problem), size_(size), equation_weight_(equation_weight) {
    const Net& net = p_.net;
    for (std::size_t i = 0; i < net.points.size(); ++i) {
      const int count = p_.freedom[i] == Freedom::free ? 3 : p_.freedom[i] == Freedom::along;
      for (int k = 0; k < count; ++k) unknowns_.push_back({i, k});
    }
    int row = 0;
    for (int c = 0; c < net.rows + net.columns; ++c) {
      first_.push_back(row);
      row += residuals_of(c);
    }
    departure_row_ = row;
  }

  int unknowns() const { return static_cast<int>(unknowns_.size()); }
  int equations() const { return departure_row_; }
  int residuals() const { return departure_row_ + unknowns(); }

  Eigen::VectorXd coordinates(const Net& net) const {
    Eigen::VectorXd x(unknowns());
    for (int j = 0; j < unknowns(); ++j) x[j] = coordinate(net, unknowns_[j]) / size_;
    return x;
  }

  Net net_at(const Eigen::VectorXd& x) const {
    Net net = p_.net;
    for (int j = 0; j < unknowns(); ++j) set(net, unknowns_[j], x[j] * size_);
    return net;
  }

  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) const {
    for (int j = 0; j < unknowns(); ++j)
      if (p_.freedom[unknowns_[j].point] == Freedom::along && !(x[j] > kShortest)) return false;
    Net net = net_at(x);
    r.resize(residuals());
    for (std::size_t c = 0; c < first_.size(); ++c)
      if (!fill(net, static_cast<int>(c), r)) return false;
    for (int j = 0; j < unknowns(); ++j)
      r[departure_row_ + j] = kDepartureWeight * (x[j] - coordinate(p_.net, unknowns_[j]) / size_);
    if (jacobian) differentiate(net, x, *jacobian);
    return true;
  }

 private:
  struct Unknown {
    std::size_t point;
    int axis;
  };

  int residuals_of(int curve) const { return residual_count(p_, curve); }

  Vector3 ray(std::size_t point) const {
    const Vector3 d = p_.net.points[point] - p_.net.points[0];
    return d / norm(d);
  }

  double coordinate(const Net& net, const Unknown& u) const {
    const Point3& p = net.points[u.point];
    if (p_.freedom[u.point] == Freedom::along) return dot(p - p_.net.points[0], ray(u.point));
    return u.axis == 0 ? p.x : u.axis == 1 ? p.y : p.z;
  }

  void set(Net& net, const Unknown& u, double value) const {
    Point3& p = net.points[u.point];
    if (p_.freedom[u.point] == Freedom::along)
      p = p_.net.points[0] + value * ray(u.point);
    else
      (u.axis == 0 ? p.x : u.axis == 1 ? p.y : p.z) = value;
  }

  std::vector<Vector3> edges_of(const Net& net, int curve) const {
    const bool row = curve < net.rows;
    std::vector<Vector3> edges;
    for (int i = 0; i < degree_of(net, curve); ++i)
      edges.push_back(row ? net.at(curve, i + 1) - net.at(curve, i)
                          : net.at(i + 1, curve - net.rows) - net.at(i, curve - net.rows));
    return edges;
  }

  /// Residuals of one curve; false where an edge has no length.
  bool fill(const Net& net, int curve, Eigen::VectorXd& r) const {
    const auto e = edges_of(net, curve);
    int row = first_[curve];
    const auto put = [&](Vector3 v) {
      for (const double x : {v.x, v.y, v.z}) r[row++] = equation_weight_ * x / size_;
    };
    for (const Vector3& edge : e)
      if (!(norm(edge) > kShortest * size_)) return false;
    const CurveWish& wish = p_.wishes[curve];
    for (std::size_t i = 2; i < e.size() && !wish.loose; ++i) {
      const double a = dot(e[i - 2], e[i - 2]);
      put(e[i] - (2 * dot(e[i - 2], e[i - 1]) / a) * e[i - 1] +
          (dot(e[i - 1], e[i - 1]) / a) * e[i - 2]);
    }
    const double steps = std::max<double>(static_cast<double>(e.size()) - 1, 1);
    const auto growth = [&] { return std::log(norm(e.back()) / norm(e.front())) / steps; };
    const auto turn = [&] { return core::angle_between(e[0], e[1]); };
    if (wish.growth)
      r[row++] = (wish.firm ? equation_weight_ : p_.growth_weight) * (growth() - *wish.growth);
    if (wish.turn) r[row++] = equation_weight_ * (turn() - *wish.turn);
    if (wish.growth_within) r[row++] = equation_weight_ * outside(*wish.growth_within, growth());
    if (wish.turn_within) r[row++] = equation_weight_ * outside(*wish.turn_within, turn());
    if (wish.tangent) put(e[0] - dot(e[0], *wish.tangent) * *wish.tangent);
    return true;
  }

  /// Central differences: a point stands in one row and one column only.
  void differentiate(Net& net, const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) const {
    constexpr double h = 1e-6;
    jacobian.setZero(residuals(), unknowns());
    Eigen::VectorXd more(residuals());
    Eigen::VectorXd less(residuals());
    for (int j = 0; j < unknowns(); ++j) {
      const Unknown& u = unknowns_[j];
      const int row = static_cast<int>(u.point) / net.columns;
      const int column = net.rows + static_cast<int>(u.point) % net.columns;
      for (const int c : {row, column}) {
        const int count = residuals_of(c);
        set(net, u, (x[j] + h) * size_);
        const bool above = fill(net, c, more);
        set(net, u, (x[j] - h) * size_);
        const bool below = fill(net, c, less);
        if (above && below)
          jacobian.col(j).segment(first_[c], count) =
              (more.segment(first_[c], count) - less.segment(first_[c], count)) / (2 * h);
      }
      set(net, u, x[j] * size_);
      jacobian(departure_row_ + j, j) = kDepartureWeight;
    }
  }

  const OneMatrixProblem& p_;
  double size_;
  double equation_weight_;
  std::vector<Unknown> unknowns_;
  std::vector<int> first_;  ///< residual at which each curve's begin
  int departure_row_ = 0;
};

/// Rows of the equations to be met exactly.
std::vector<int> exact_rows(const OneMatrixProblem& p, bool with_growth) {
  std::vector<int> rows;
  int row = 0;
  for (int c = 0; c < p.net.rows + p.net.columns; ++c) {
    const CurveWish& wish = p.wishes[c];
    const int end = row + residual_count(p, c);
    for (int i = 0; i < matrix_count(p, c); ++i) rows.push_back(row++);
    if (wish.growth && !with_growth && !wish.firm) ++row;
    while (row < end) rows.push_back(row++);
  }
  return rows;
}

/// The curve a row belongs to.
int curve_of_row(const OneMatrixProblem& p, int row) {
  int c = 0;
  for (int first = residual_count(p, 0); row >= first; first += residual_count(p, c)) ++c;
  return c;
}

/// Shortest steps that meet the linearised equations, shortened until they leave at most half of
/// what they should be rid of: where equations are nearly dependent longer ones zigzag, and
/// rounding grows into another net.
void polish(const System& system, const std::vector<int>& rows, Eigen::VectorXd& x) {
  constexpr double kDependent = 1e-7;  // differences do not tell flatter directions from rounding
  Eigen::VectorXd r;
  Eigen::MatrixXd jacobian;
  for (int step = 0; step < 30; ++step) {
    if (!system.evaluate(x, r, &jacobian)) return;
    const Eigen::VectorXd left = r(rows);
    if (left.lpNorm<Eigen::Infinity>() < 1e-14) return;
    const Eigen::VectorXd whole = numeric::least_norm(jacobian(rows, Eigen::all), left, kDependent);
    bool better = false;
    for (double share = 1; share > 1e-4 && !better; share *= 0.5) {
      const Eigen::VectorXd next = x - share * whole;
      Eigen::VectorXd after;
      if (!system.evaluate(next, after, nullptr)) continue;
      better = Eigen::VectorXd(after(rows)).norm() < (1 - 0.5 * share) * left.norm();
      if (better) x = next;
    }
    if (!better) return;
  }
}

/// The net at x, moved on to meet the equations, and how far it does.
OneMatrixNet polished(const OneMatrixProblem& problem, double size, bool exact_growth,
                      Eigen::VectorXd x) {
  OneMatrixProblem plain = problem;
  plain.growth_weight = 1;
  const System system(plain, size, 1);
  polish(system, exact_rows(problem, exact_growth), x);
  OneMatrixNet result{system.net_at(x)};
  Eigen::VectorXd r;
  if (!system.evaluate(x, r, nullptr)) return {problem.net, 1, 1};
  for (const int row : exact_rows(problem, false)) {
    if (!(std::abs(r[row]) > result.violation)) continue;
    result.violation = std::abs(r[row]);
    result.worst = curve_of_row(problem, row);
  }
  result.growth_error = r.head(system.equations()).lpNorm<Eigen::Infinity>();
  return result;
}

}  // namespace

OneMatrixNet solve_one_matrix(const OneMatrixProblem& problem, const Net& start,
                              bool exact_growth) {
  const double size = size_of(problem.net);
  Eigen::VectorXd x = System(problem, size, 1).coordinates(start);
  numeric::LevenbergMarquardtOptions options;
  options.cost_tolerance = 1e-9;
  for (const double weight : {10.0, 1000.0}) {
    const System system(problem, size, weight);
    options.max_iterations = weight < 100 ? 60 : 120;
    const auto f = [&](const Eigen::VectorXd& at, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
      return system.evaluate(at, r, j);
    };
    numeric::minimize_least_squares(f, x, options);
  }
  return polished(problem, size, exact_growth, std::move(x));
}

OneMatrixNet meet_by_shortest_steps(const OneMatrixProblem& problem, const Net& start) {
  const double size = size_of(problem.net);
  return polished(problem, size, true, System(problem, size, 1).coordinates(start));
}

}  // namespace keyline::surface::detail
