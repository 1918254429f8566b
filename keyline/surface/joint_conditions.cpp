#include "keyline/surface/joint_conditions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <Eigen/Core>

#include "keyline/curve/bernstein.h"
#include "keyline/numeric/solve.h"

namespace keyline::surface::detail {
namespace {

using core::Point3;
using core::Vector3;

constexpr double kGoodFit = 1e-7;  ///< of the derivatives: multipliers that are meant
constexpr int kMostRaised = 2;     ///< degrees of beta tried, from 0

/// Bernstein coefficients of a polynomial whose values are such sums; of a scalar one.
using Forms = std::vector<Form>;
using Scalar = std::vector<double>;

void add(Form& sum, double weight, const Form& form) {
  for (const auto& [index, w] : form) sum[index] += weight * w;
}

void add(double& sum, double weight, double value) { sum += weight * value; }

/// Of a scalar polynomial and one of either kind.
template <class Value>
std::vector<Value> product(const Scalar& f, const std::vector<Value>& g) {
  const std::size_t m = f.size() - 1;
  const std::size_t n = g.size() - 1;
  const auto of_f = curve::detail::binomials<double>(m);
  const auto of_g = curve::detail::binomials<double>(n);
  const auto of_h = curve::detail::binomials<double>(m + n);
  std::vector<Value> h(m + n + 1);
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      add(h[i + j], f[i] * of_f[i] * of_g[j] / of_h[i + j], g[j]);
  return h;
}

Forms raised(const Forms& f, std::size_t degree) {
  return f.size() > degree ? f : product(Scalar(degree + 2 - f.size(), 1.0), f);
}

/// Empty: that of a constant is 0.
Forms derivative(const Forms& f) {
  Forms d(f.size() - 1);
  const double n = static_cast<double>(f.size() - 1);
  for (std::size_t j = 0; j < d.size(); ++j) {
    add(d[j], n, f[j + 1]);
    add(d[j], -n, f[j]);
  }
  return d;
}

Forms sum(const std::vector<std::pair<double, Forms>>& terms) {
  std::size_t degree = 0;
  for (const auto& [weight, forms] : terms) degree = std::max(degree, forms.size() - 1);
  Forms total(degree + 1);
  for (const auto& [weight, forms] : terms) {
    const Forms up = raised(forms, degree);
    for (std::size_t j = 0; j <= degree; ++j) add(total[j], weight, up[j]);
  }
  return total;
}

/// The nets of all patches as one list of numbered points.
class Points {
 public:
  explicit Points(std::span<const BezierSurface> patches) : patches_(patches) {
    base_.push_back(0);
    for (const BezierSurface& s : patches)
      base_.push_back(base_.back() + static_cast<Eigen::Index>(s.net.points.size()));
  }
  Eigen::Index count() const { return base_.back(); }
  Eigen::Index first(std::size_t patch) const { return base_[patch]; }

  /// The row of control points that is `depth` rows inside an edge, along growing parameter.
  Forms row(std::size_t patch, Edge edge, int depth) const {
    const Net& net = patches_[patch].net;
    const bool u = edge == Edge::u0 || edge == Edge::u1;
    const bool far = edge == Edge::u1 || edge == Edge::v1;
    const int across = (far ? (u ? net.rows : net.columns) - 1 - depth : depth);
    const int along = u ? net.columns : net.rows;
    Forms forms(static_cast<std::size_t>(along));
    for (int j = 0; j < along; ++j)
      forms[static_cast<std::size_t>(j)]
           [base_[patch] +
            static_cast<Eigen::Index>(u ? net.index(across, j) : net.index(j, across))] = 1;
    return forms;
  }
  int degree_across(std::size_t patch, Edge edge) const {
    const Net& net = patches_[patch].net;
    return (edge == Edge::u0 || edge == Edge::u1 ? net.rows : net.columns) - 1;
  }

 private:
  std::span<const BezierSurface> patches_;
  std::vector<Eigen::Index> base_;
};

/// Values of forms: a row each.
Eigen::MatrixX3d values(const Forms& forms, const Eigen::MatrixX3d& points) {
  Eigen::MatrixX3d v = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(forms.size()), 3);
  for (std::size_t j = 0; j < forms.size(); ++j)
    for (const auto& [index, w] : forms[j])
      v.row(static_cast<Eigen::Index>(j)) += w * points.row(index);
  return v;
}

/// Edge, first and second derivative into a patch.
struct Side {
  Forms edge, first, second;
};

/// A polynomial of the Bernstein basis.
Scalar basis(std::size_t count, std::size_t i) {
  Scalar unit(count, 0);
  unit[i] = 1;
  return unit;
}

/// The polynomials f and g of degrees d and d + 1 that bring rest + f A + g B nearest to 0, and how
/// near, of the size of A.
struct Multipliers {
  Scalar f, g;
  double misfit = 0;
};

Multipliers fit(const Forms& rest, const Forms& a, const Forms& b, std::size_t degree,
                const Eigen::MatrixX3d& points) {
  const std::size_t top = std::max({rest.size() - 1, a.size() - 1 + degree, b.size() + degree});
  const auto rows = static_cast<Eigen::Index>(3 * (top + 1));
  Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(2 * degree + 3));
  const auto column = [&](const Forms& forms) {
    const Eigen::MatrixX3d v = values(raised(forms, top), points);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), v.size()));
  };
  Eigen::Index c = 0;
  for (const auto& [forms, count] : {std::pair{&a, degree + 1}, std::pair{&b, degree + 2}})
    for (std::size_t k = 0; k < count; ++k)
      matrix.col(c++) = column(product(basis(count, k), *forms));
  const Eigen::VectorXd right = -column(rest);
  const Eigen::VectorXd x = numeric::least_norm(matrix, right);
  Multipliers m{Scalar(degree + 1), Scalar(degree + 2), 0};
  for (std::size_t k = 0; k <= degree; ++k) m.f[k] = x[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k <= degree + 1; ++k)
    m.g[k] = x[static_cast<Eigen::Index>(degree + 1 + k)];
  m.misfit = (matrix * x - right).norm() / std::max(1e-300, column(a).norm());
  return m;
}

/// Terms of a polynomial whose coefficients are to stay what they are.
using Terms = std::vector<std::pair<Factors, Forms>>;

/// Multipliers of one equation by their number among those of a joint: polynomials f and g.
struct Numbers {
  std::size_t first = 0;   ///< of f
  std::size_t degree = 0;  ///< of f; that of g is one more

  int f(std::size_t i) const { return static_cast<int>(first + i); }
  int g(std::size_t i) const { return static_cast<int>(first + degree + 1 + i); }
  std::size_t f_count() const { return degree + 1; }
  std::size_t g_count() const { return degree + 2; }
};

/// f A + g B.
void add_linear(Terms& terms, const Numbers& m, const Forms& a, const Forms& b) {
  for (std::size_t i = 0; i < m.f_count(); ++i)
    terms.push_back({{m.f(i), -1}, product(basis(m.f_count(), i), a)});
  for (std::size_t i = 0; i < m.g_count(); ++i)
    terms.push_back({{m.g(i), -1}, product(basis(m.g_count(), i), b)});
}

/// -(f f S + 2 f g T + g g C) for the second derivatives S, T, C.
void add_squares(Terms& terms, const Numbers& m, const Forms& s, const Forms& t, const Forms& c) {
  const auto add = [&](int i, int j, const Scalar& a, const Scalar& b, double weight,
                       const Forms& forms) {
    if (!forms.empty()) terms.push_back({{i, j}, sum({{weight, product(product(a, b), forms)}})});
  };
  for (std::size_t i = 0; i < m.f_count(); ++i) {
    const Scalar fi = basis(m.f_count(), i);
    for (std::size_t j = 0; j < m.f_count(); ++j)
      add(m.f(i), m.f(j), fi, basis(m.f_count(), j), -1, s);
    for (std::size_t j = 0; j < m.g_count(); ++j)
      add(m.f(i), m.g(j), fi, basis(m.g_count(), j), -2, t);
  }
  for (std::size_t i = 0; i < m.g_count(); ++i)
    for (std::size_t j = 0; j < m.g_count(); ++j)
      add(m.g(i), m.g(j), basis(m.g_count(), i), basis(m.g_count(), j), -1, c);
}

/// The conditions of a joint as forms that keep their values.
class Conditions {
 public:
  Conditions(const Points& points, const Eigen::MatrixX3d& given)
      : points_(points), given_(given) {}

  JointEquations of(const HeldJoint& held) const {
    const PatchJoint& joint = held.joint;
    Side one = side(joint.first, joint.edges[0]);
    Side two = side(joint.second, joint.edges[1]);
    turn_alike(one, two);
    JointEquations all;
    if (held.stiff) {
      for (const Side* s : {&one, &two}) {
        keep({{kNoFactor, s->edge}}, all);
        if (held.order >= 1) keep({{kNoFactor, s->first}}, all);
        if (held.order >= 2) keep({{kNoFactor, s->second}}, all);
      }
      return all;
    }
    keep({{kNoFactor, sum({{1, one.edge}, {-1, two.edge}})}}, all);
    if (held.order >= 1) keep_orders(held.order, one, two, all);
    return all;
  }

 private:
  /// The equation of a common tangent plane, and that of a common curvature.
  void keep_orders(int order, const Side& one, const Side& two, JointEquations& all) const {
    const Forms along = derivative(one.edge);
    Multipliers m;
    for (std::size_t degree = 0; degree <= kMostRaised; ++degree) {
      m = fit(one.first, two.first, along, degree, given_);
      if (m.misfit < kGoodFit) break;
    }
    all.meets = m.misfit < kGoodFit;
    const Numbers first = number(m, all);
    Terms plane{{kNoFactor, one.first}};
    add_linear(plane, first, two.first, along);
    keep(plane, all);
    if (order < 2) return;
    Terms bend{{kNoFactor, one.second}};
    add_squares(bend, first, two.second, derivative(two.first), derivative(along));
    const Multipliers n =
        fit(at(bend, all.multipliers), two.first, along, 2 * first.degree, given_);
    add_linear(bend, number(n, all), two.first, along);
    keep(bend, all);
  }

  static Numbers number(const Multipliers& m, JointEquations& all) {
    const Numbers numbers{all.multipliers.size(), m.f.size() - 1};
    all.multipliers.insert(all.multipliers.end(), m.f.begin(), m.f.end());
    all.multipliers.insert(all.multipliers.end(), m.g.begin(), m.g.end());
    return numbers;
  }

  static Forms at(const Terms& terms, const std::vector<double>& multipliers) {
    std::vector<std::pair<double, Forms>> weighted;
    for (const auto& [factors, forms] : terms)
      weighted.emplace_back(value_of(factors, multipliers), forms);
    return sum(weighted);
  }

  /// Coefficient by coefficient, all terms of the highest degree.
  static void keep(const Terms& terms, JointEquations& all) {
    std::size_t count = 0;
    for (const auto& [factors, forms] : terms) count = std::max(count, forms.size());
    std::vector<JointForm> rows(count);
    for (const auto& [factors, forms] : terms) {
      const Forms up = raised(forms, count - 1);
      for (std::size_t j = 0; j < count; ++j) rows[j].terms.emplace_back(factors, up[j]);
    }
    std::ranges::move(rows, std::back_inserter(all.forms));
  }

  Side side(std::size_t patch, Edge edge) const {
    const int m = points_.degree_across(patch, edge);
    const Forms r0 = points_.row(patch, edge, 0);
    const Forms r1 = points_.row(patch, edge, 1);
    const Forms r2 = points_.row(patch, edge, std::min(2, m));
    const double square_of = m > 1 ? m * (m - 1) : 0;
    return {r0, sum({{m, r1}, {-m, r0}}),
            sum({{square_of, r2}, {-2 * square_of, r1}, {square_of, r0}})};
  }

  /// Turns the second edge where it runs against the first.
  void turn_alike(const Side& one, Side& two) const {
    const Eigen::MatrixX3d a = values(one.edge, given_);
    const Eigen::MatrixX3d b = values(two.edge, given_);
    const double alike = (a.row(0) - b.row(0)).norm() + (a.bottomRows(1) - b.bottomRows(1)).norm();
    const double against =
        (a.row(0) - b.bottomRows(1)).norm() + (a.bottomRows(1) - b.row(0)).norm();
    if (alike <= against) return;
    for (Forms* f : {&two.edge, &two.first, &two.second}) std::reverse(f->begin(), f->end());
  }

  const Points& points_;
  const Eigen::MatrixX3d& given_;
};

}  // namespace

Eigen::MatrixX3d coordinates(std::span<const BezierSurface> patches) {
  Eigen::Index count = 0;
  for (const BezierSurface& s : patches) count += static_cast<Eigen::Index>(s.net.points.size());
  Eigen::MatrixX3d all(count, 3);
  Eigen::Index i = 0;
  for (const BezierSurface& s : patches)
    for (const Point3 p : s.net.points) all.row(i++) << p.x, p.y, p.z;
  return all;
}

std::vector<BezierSurface> with_coordinates(std::span<const BezierSurface> patches,
                                            const Eigen::MatrixX3d& all) {
  std::vector<BezierSurface> moved(patches.begin(), patches.end());
  Eigen::Index i = 0;
  for (BezierSurface& s : moved)
    for (Point3& p : s.net.points) {
      p = {all(i, 0), all(i, 1), all(i, 2)};
      ++i;
    }
  return moved;
}

double value_of(const Factors& factors, const std::vector<double>& multipliers) {
  double value = 1;
  for (const int i : factors)
    if (i >= 0) value *= multipliers[static_cast<std::size_t>(i)];
  return value;
}

Form JointForm::at(const std::vector<double>& multipliers) const {
  Form all;
  for (const auto& [factors, form] : terms) add(all, value_of(factors, multipliers), form);
  return all;
}

std::vector<JointEquations> joint_equations(std::span<const BezierSurface> given,
                                            std::span<const HeldJoint> joints) {
  const Points points(given);
  const Eigen::MatrixX3d before = coordinates(given);
  const Conditions conditions(points, before);
  std::vector<JointEquations> all;
  for (const HeldJoint& joint : joints) all.push_back(conditions.of(joint));
  return all;
}

std::vector<Form> joint_conditions(std::span<const BezierSurface> given,
                                   std::span<const HeldJoint> joints) {
  std::vector<Form> all;
  for (const JointEquations& own : joint_equations(given, joints))
    for (const JointForm& form : own.forms) all.push_back(form.at(own.multipliers));
  return all;
}

}  // namespace keyline::surface::detail
