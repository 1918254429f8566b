#include "keyline/surface/joint_conditions.h"

#include <algorithm>
#include <cmath>
#include <map>

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
    for (std::size_t k = 0; k < count; ++k) {
      Scalar unit(count, 0);
      unit[k] = 1;
      matrix.col(c++) = column(product(unit, *forms));
    }
  const Eigen::VectorXd right = -column(rest);
  const Eigen::VectorXd x = numeric::least_norm(matrix, right);
  Multipliers m{Scalar(degree + 1), Scalar(degree + 2), 0};
  for (std::size_t k = 0; k <= degree; ++k) m.f[k] = x[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k <= degree + 1; ++k)
    m.g[k] = x[static_cast<Eigen::Index>(degree + 1 + k)];
  m.misfit = (matrix * x - right).norm() / std::max(1e-300, column(a).norm());
  return m;
}

/// The conditions of a joint as forms that keep their values.
class Conditions {
 public:
  Conditions(const Points& points, const Eigen::MatrixX3d& given)
      : points_(points), given_(given) {}

  Forms of(const HeldJoint& held) const {
    const PatchJoint& joint = held.joint;
    Side one = side(joint.first, joint.edges[0]);
    Side two = side(joint.second, joint.edges[1]);
    turn_alike(one, two);
    Forms all;
    const auto keep = [&](const Forms& forms) {
      all.insert(all.end(), forms.begin(), forms.end());
    };
    if (held.stiff) {
      for (const Side* s : {&one, &two}) {
        keep(s->edge);
        if (held.order >= 1) keep(s->first);
        if (held.order >= 2) keep(s->second);
      }
      return all;
    }
    keep(sum({{1, one.edge}, {-1, two.edge}}));
    if (held.order < 1) return all;
    const Forms along = derivative(one.edge);
    Multipliers m;
    for (std::size_t degree = 0; degree <= kMostRaised; ++degree) {
      m = fit(one.first, two.first, along, degree, given_);
      if (m.misfit < kGoodFit) break;
    }
    keep(sum({{1, one.first}, {1, product(m.f, two.first)}, {1, product(m.g, along)}}));
    if (held.order < 2 || along.size() < 2) return all;
    const Forms rest = sum({{1, one.second},
                            {-1, product(product(m.f, m.f), two.second)},
                            {-2, product(product(m.f, m.g), derivative(two.first))},
                            {-1, product(product(m.g, m.g), derivative(along))}});
    const std::size_t degree = 2 * (m.f.size() - 1);
    const Multipliers n = fit(rest, two.first, along, degree, given_);
    keep(sum({{1, rest}, {1, product(n.f, two.first)}, {1, product(n.g, along)}}));
    return all;
  }

 private:
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

std::vector<Form> joint_conditions(std::span<const BezierSurface> given,
                                   std::span<const HeldJoint> joints) {
  const Points points(given);
  const Eigen::MatrixX3d before = coordinates(given);
  const Conditions conditions(points, before);
  std::vector<Form> all;
  for (const HeldJoint& joint : joints) {
    const Forms own = conditions.of(joint);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace keyline::surface::detail
