#include "keyline/surface/tensor.h"

#include <algorithm>

#include "keyline/core/error.h"

namespace keyline::surface::detail {
namespace {

using core::Vector3;

constexpr int kMost = curve::kMaxBezierDegree;
using Row = std::array<double, kMost + 1>;

/// Basis of the degree on span [knots[span], knots[span + 1]) at x, by Cox and de Boor.
/// low(i) and high(i) give knots[span + 1 - i] and knots[span + i].
template <class Low, class High>
Row cox_de_boor(int degree, double x, Low low, High high) {
  Row n;
  n[0] = 1;
  for (int p = 1; p <= degree; ++p) {
    double saved = 0;
    for (int r = 0; r < p; ++r) {
      const double right = high(r + 1) - x;
      const double left = x - low(p - r);
      const double part = n[r] / (right + left);
      n[r] = saved + right * part;
      saved = left * part;
    }
    n[p] = saved;
  }
  return n;
}

/// Derivative of the combination with coefficients on degree p - 1 raised to degree p:
/// N'_i,p = p (N_i,p-1 / (U_{i+p} - U_i) - N_{i+1,p-1} / (U_{i+p+1} - U_{i+1})).
template <class Low, class High>
Row differentiated(const Row& lower, int p, Low low, High high) {
  Row n;
  std::fill_n(n.begin(), p + 1, 0.0);
  for (int r = 0; r < p; ++r) {  // lower[r] lives on [low(p - r), high(r + 1)]
    const double d = p * lower[r] / (high(r + 1) - low(p - r));
    n[r] -= d;
    n[r + 1] += d;
  }
  return n;
}

template <class Low, class High>
void fill(Basis& basis, int degree, double x, double scale, int orders, Low low, High high) {
  basis.count = degree + 1;
  double factor = 1;
  for (int order = 0; order < orders; ++order, factor *= scale) {
    Row& values = basis.values[order];
    if (order > degree) {
      std::fill_n(values.begin(), basis.count, 0.0);
      continue;
    }
    Row row = cox_de_boor(degree - order, x, low, high);
    for (int p = degree - order + 1; p <= degree; ++p) row = differentiated(row, p, low, high);
    for (int i = 0; i < basis.count; ++i) values[i] = factor * row[i];
  }
}

int span_of(int degree, std::span<const double> knots, double x) {
  const auto first = knots.begin() + degree;
  const auto last = knots.end() - degree - 1;
  auto at = std::upper_bound(first + 1, last, x) - 1;
  while (at > first && !(*at < at[1])) --at;
  return static_cast<int>(at - knots.begin());
}

/// Quotient rule for mixed derivatives: from those of (w S, w) to those of S, in place.
void divide(std::array<std::array<Vector3, kOrders>, kOrders>& a,
            const std::array<std::array<double, kOrders>, kOrders>& w, int orders) {
  constexpr double choose[kOrders][kOrders] = {
      {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  for (int total = 0; total < orders; ++total) {
    for (int i = 0; i <= total; ++i) {
      const int j = total - i;
      Vector3 sum = a[i][j];
      for (int k = 0; k <= i; ++k)
        for (int l = 0; l <= j; ++l)
          if (k + l > 0) sum = sum - choose[i][k] * choose[j][l] * w[k][l] * a[i - k][j - l];
      a[i][j] = sum / w[0][0];
    }
  }
}

}  // namespace

Basis bernstein_basis(int degree, double t, int orders) {
  Basis basis;
  fill(
      basis, degree, std::clamp(t, 0.0, 1.0), 1, orders, [](int) { return 0.0; },
      [](int) { return 1.0; });
  return basis;
}

Basis spline_basis(int degree, std::span<const double> knots, double t, int orders) {
  const double start = knots[degree];
  const double end = knots[knots.size() - degree - 1];
  const double u = std::clamp(t, 0.0, 1.0);
  const double x = (1 - u) * start + u * end;
  const int span = span_of(degree, knots, x);
  Basis basis;
  basis.first = span - degree;
  fill(
      basis, degree, x, end - start, orders, [&](int i) { return knots[span + 1 - i]; },
      [&](int i) { return knots[span + i]; });
  return basis;
}

void contract(const NetView& view, const Basis& u, int orders, Strip& strip) {
  const Net& net = *view.net;
  const bool rational = !view.weights->empty();
  for (int order = 0; order < orders; ++order) {
    auto& vectors = strip.vector[order];
    auto& weights = strip.weight[order];
    vectors.assign(net.columns, Vector3{});
    weights.assign(rational ? net.columns : 0, 0.0);
    for (int i = 0; i < u.count; ++i) {
      const double b = u.values[order][i];
      for (int j = 0; j < net.columns; ++j) {
        const std::size_t at = net.index(u.first + i, j);
        const double w = rational ? b * (*view.weights)[at] : b;
        const core::Point3& p = net.points[at];
        vectors[j] = vectors[j] + w * Vector3{p.x, p.y, p.z};
        if (rational) weights[j] += w;
      }
    }
  }
}

SurfaceJet combine(const Strip& strip, const Basis& v, int orders) {
  std::array<std::array<Vector3, kOrders>, kOrders> d{};
  std::array<std::array<double, kOrders>, kOrders> w{};
  const bool rational = !strip.weight[0].empty();
  for (int i = 0; i < orders; ++i) {
    for (int k = 0; k < v.count; ++k) {
      const int at = v.first + k;
      for (int j = 0; i + j < orders; ++j) {
        d[i][j] = d[i][j] + v.values[j][k] * strip.vector[i][at];
        if (rational) w[i][j] += v.values[j][k] * strip.weight[i][at];
      }
    }
  }
  if (rational) divide(d, w, orders);
  return {core::Point3{} + d[0][0],
          d[1][0],
          d[0][1],
          d[2][0],
          d[1][1],
          d[0][2],
          d[3][0],
          d[2][1],
          d[1][2],
          d[0][3]};
}

}  // namespace keyline::surface::detail
