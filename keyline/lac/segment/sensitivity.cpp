#include "keyline/lac/segment/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace keyline::lac {
namespace {

constexpr int kN = 17;
using Column = std::array<double, kN>;

/// Chebyshev-Lobatto nodes on [0, 1], barycentric weights and the matrix of integrals of the
/// Lagrange polynomials from 0 to each node.
struct Collocation {
  Column node{};
  Column weight{};
  std::array<Column, kN> integral{};

  Collocation() {
    for (int i = 0; i < kN; ++i) {
      node[i] = 0.5 * (1 - std::cos(std::numbers::pi * i / (kN - 1)));
      weight[i] = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == kN - 1 ? 0.5 : 1.0);
    }
    node[kN - 1] = 1;
    for (int j = 0; j < kN; ++j) fill_integral_column(j);
  }

 private:
  /// Lagrange polynomial j as a Chebyshev sum, integrated term by term.
  void fill_integral_column(int j) {
    const int m = kN - 1;
    std::array<double, kN + 2> a{};
    for (int k = 0; k <= m; ++k) {
      const double scale = (k == 0 || k == m ? 0.5 : 1.0) * (j == 0 || j == m ? 0.5 : 1.0);
      // x = 2 node - 1 = -cos(pi j / m); T_k there:
      const double t = (k % 2 == 0 ? 1 : -1) * std::cos(std::numbers::pi * k * j / m);
      a[k] = 2.0 / m * scale * t;
    }
    for (int i = 0; i < kN; ++i) {
      const double angle = std::numbers::pi - std::numbers::pi * i / m;  // x = cos(angle)
      double sum = 0;
      for (int k = 0; k <= m; ++k)
        sum += a[k] * (antiderivative(k, angle) - antiderivative(k, std::numbers::pi));
      integral[i][j] = 0.5 * sum;  // dx = 2 d(node)
    }
  }

  /// An antiderivative of T_k at cos(angle).
  static double antiderivative(int k, double angle) {
    if (k == 0) return std::cos(angle);
    if (k == 1) return 0.25 * std::cos(2 * angle);
    return 0.5 * (std::cos((k + 1) * angle) / (k + 1) - std::cos((k - 1) * angle) / (k - 1));
  }
};

const Collocation& collocation() {
  static const Collocation table;
  return table;
}

Column integrate(const Column& f) {
  const auto& table = collocation().integral;
  Column out{};
  for (int i = 1; i < kN; ++i) {
    double sum = 0;
    for (int j = 0; j < kN; ++j) sum += table[i][j] * f[j];
    out[i] = sum;
  }
  return out;
}

double signed_power(double x, double e) { return x < 0 ? -std::pow(-x, e) : std::pow(x, e); }

/// g(x) = log(1 + v (e^x - 1)) / x and its derivative: cumulants of a Bernoulli variable.
struct LogMean {
  double g;
  double dg;
};
LogMean log_mean(double x, double v) {
  const double k2 = v * (1 - v);
  if (std::abs(x) < 1e-3) {
    const double k3 = k2 * (1 - 2 * v);
    const double k4 = k2 * (1 - 6 * k2);
    return {v + x * (k2 / 2 + x * (k3 / 6 + x * k4 / 24)), k2 / 2 + x * (k3 / 3 + x * k4 / 8)};
  }
  if (x < -1) {  // no cancellation here, and v = 1 gives x itself
    const double last = v * std::exp(x);
    const double z = (1 - v) + last;
    const double g = z > 0 ? std::log(z) / x : 1;
    return {g, ((z > 0 ? last / z : 1) - g) / x};
  }
  const double e = std::expm1(x);
  const double z = 1 + v * e;
  const double g = std::log1p(v * e) / x;
  return {g, (v * (1 + e) / z - g) / x};
}

CurvatureValue same_sign(double k0, double k1, double alpha, double v) {
  const double p = -alpha;
  const double q = std::log(k1 / k0);
  const double x = p * q;
  if (x > 30) {  // measured from the other end: the mean is the same
    CurvatureValue r = same_sign(k1, k0, alpha, 1 - v);
    std::swap(r.by_start, r.by_end);
    return r;
  }
  const LogMean m = log_mean(x, v);
  CurvatureValue r;
  r.curvature = k0 * std::exp(q * m.g);
  const double last = v * std::exp(x);
  const double z = (1 - v) + last;
  r.by_start = z > 0 ? r.curvature * (1 - v) / z / k0 : 0;
  r.by_end = r.curvature * (z > 0 ? last / z : 1) / k1;
  r.by_alpha = -r.curvature * q * q * m.dg;
  return r;
}

CurvatureValue through_zero(double k0, double k1, double alpha, double v) {
  const double p = -alpha;
  const double scale = std::max(std::abs(k0), std::abs(k1));
  CurvatureValue r;
  if (scale == 0) {
    r.by_start = 1 - v;
    r.by_end = v;
    return r;
  }
  const double tiny = 1e-12;
  const double a = k0 / scale;
  const double b = k1 / scale;
  const double za = signed_power(a, p);
  const double zb = signed_power(b, p);
  const double z = (1 - v) * za + v * zb;
  r.curvature = scale * signed_power(z, 1 / p);
  const double zz = std::max(std::abs(z), tiny);
  const double outer = std::pow(zz, 1 / p - 1);
  r.by_start = (1 - v) * std::pow(std::max(std::abs(a), 1e-9), p - 1) * outer;
  r.by_end = v * std::pow(std::max(std::abs(b), 1e-9), p - 1) * outer;
  const double la = std::log(std::max(std::abs(a), 1e-300));
  const double lb = std::log(std::max(std::abs(b), 1e-300));
  const double dz = (1 - v) * za * la + v * zb * lb;
  const double by_p = r.curvature * (-std::log(zz) / (p * p)) + scale * outer * dz / p;
  r.by_alpha = -by_p;
  return r;
}

}  // namespace

CurvatureValue curvature_with_derivatives(double curvature_start, double curvature_end,
                                          double alpha, double v) {
  if (curvature_start * curvature_end > 0)
    return same_sign(curvature_start, curvature_end, alpha, v);
  return through_zero(curvature_start, curvature_end, alpha, v);
}

struct PieceTable::Running {
  End at;
};

void PieceTable::build(double curvature_start, double curvature_end, double length, double alpha,
                       bool fine) {
  fine_ = fine;
  curvature_start_ = curvature_start;
  curvature_end_ = curvature_end;
  length_ = length;
  alpha_ = alpha;
  plan_panels();
  Running running;
  for (Panel& panel : panels_) fill(panel, running);
  end_ = running.at;
}

void PieceTable::plan_panels() {
  panels_.clear();
  zero_ = -1;
  const double k0 = curvature_start_;
  const double k1 = curvature_end_;
  const auto add = [&](double from, double to, int graded) {
    panels_.push_back({.from = from, .to = to, .graded = graded, .node = {}});
  };
  if (k0 == k1) {
    const int parts = 1 + static_cast<int>(std::min(20.0, std::abs(k0) * length_ / 2.5));
    for (int i = 0; i < parts; ++i) add(double(i) / parts, double(i + 1) / parts, 0);
    return;
  }
  // Where curvature vanishes it goes as the power -1/alpha of the way: rough for alpha < -1 only.
  const bool rough = alpha_ < -1 || alpha_ > 0;
  if (k0 * k1 < 0) {
    const double z0 = std::pow(std::abs(k0), -alpha_);
    const double z1 = std::pow(std::abs(k1), -alpha_);
    zero_ = std::clamp(z0 / (z0 + z1), 1e-9, 1 - 1e-9);
    if (fine_) {
      add_geometric_panels(0, zero_, 0, 1);
      add_geometric_panels(zero_, 1, 0, -1);
      return;
    }
    add(0, zero_, rough ? 1 : 0);
    add(zero_, 1, rough ? -1 : 0);
    return;
  }
  // Log of the ratio of the two ends of the linear function whose power curvature is.
  const double low = 1e-300;
  const double ratio =
      -alpha_ * std::log(std::max(std::abs(k1), low) / std::max(std::abs(k0), low));
  const double turning = std::max(std::abs(k0), std::abs(k1)) * length_;
  const bool even = std::abs(ratio) < 2 || (!fine_ && !rough);
  const int grade = even ? 0 : (ratio > 0 ? -1 : 1);
  if (fine_ && grade != 0) {
    add_geometric_panels(0, 1, std::exp(-std::abs(ratio)), grade);
    return;
  }
  const int parts = 1 + static_cast<int>(std::min(8.0, turning / 3.5));
  if (grade == -1) {
    add(0, 1.0 / parts, -1);
    for (int i = 1; i < parts; ++i) add(double(i) / parts, double(i + 1) / parts, 0);
  } else {
    for (int i = 0; i + 1 < parts; ++i) add(double(i) / parts, double(i + 1) / parts, 0);
    add(double(parts - 1) / parts, 1, grade);
  }
}

/// Panels of [from, to] that halve towards the end where the linear function is smallest
/// (`least` of the other end's value), until it changes by no more than a factor of about two over
/// the last of them; grade -1: towards `from`, +1: towards `to`.
void PieceTable::add_geometric_panels(double from, double to, double least, int grade) {
  std::vector<double> cut{1};
  while (cut.back() > 2 * least && cut.back() > 1e-3) cut.push_back(0.5 * cut.back());
  cut.push_back(0);
  const bool to_zero = least < 1e-3;
  const double width = to - from;
  const std::size_t first = panels_.size();
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const int graded = to_zero && i + 2 == cut.size() ? grade : 0;
    if (grade < 0)
      panels_.push_back({from + width * cut[i + 1], from + width * cut[i], graded, {}});
    else
      panels_.push_back({to - width * cut[i], to - width * cut[i + 1], graded, {}});
  }
  if (grade < 0) std::reverse(panels_.begin() + static_cast<long>(first), panels_.end());
}

namespace {

double graded_fraction(double tau, int graded) {
  if (graded == 0) return tau;
  if (graded < 0) return tau * tau * tau * tau;
  const double s = 1 - tau;
  return 1 - s * s * s * s;
}

double graded_rate(double tau, int graded) {
  if (graded == 0) return 1;
  if (graded < 0) return 4 * tau * tau * tau;
  const double s = 1 - tau;
  return 4 * s * s * s;
}

double ungraded(double fraction, int graded) {
  if (graded == 0) return fraction;
  if (graded < 0) return std::sqrt(std::sqrt(fraction));
  return 1 - std::sqrt(std::sqrt(std::max(0.0, 1 - fraction)));
}

}  // namespace

/// Angle and its derivatives by the four variables at the nodes of a panel, and dv at each.
struct PieceTable::Turns {
  Column rate{};
  std::array<Column, 1 + kPieceVariables> turn{};
};

/// theta = length * integral of curvature; its derivatives likewise.
PieceTable::Turns PieceTable::turns_of(const Panel& panel, const End& at) const {
  const Column& node = collocation().node;
  const double width = panel.to - panel.from;
  Turns t;
  std::array<Column, 4> k{};  // curvature and its three derivatives, times dv
  for (int i = 0; i < kN; ++i) {
    const double v = panel.from + width * graded_fraction(node[i], panel.graded);
    const CurvatureValue c =
        curvature_with_derivatives(curvature_start_, curvature_end_, alpha_, v);
    t.rate[i] = width * graded_rate(node[i], panel.graded);
    k[0][i] = c.curvature * t.rate[i];
    k[1][i] = c.by_start * t.rate[i];
    k[2][i] = c.by_end * t.rate[i];
    k[3][i] = c.by_alpha * t.rate[i];
  }
  const Column mean = integrate(k[0]);
  const Column by_start = integrate(k[1]);
  const Column by_end = integrate(k[2]);
  const Column by_alpha = integrate(k[3]);
  for (int i = 0; i < kN; ++i) {
    t.turn[0][i] = at.angle + length_ * mean[i];
    t.turn[1][i] = at.dangle[kCurvatureStart] + length_ * by_start[i];
    t.turn[2][i] = at.dangle[kCurvatureEnd] + length_ * by_end[i];
    t.turn[3][i] = at.dangle[kLength] + mean[i];
    t.turn[4][i] = at.dangle[kAlpha] + length_ * by_alpha[i];
  }
  return t;
}

void PieceTable::fill(Panel& panel, Running& running) const {
  End& at = running.at;
  const auto& [rate, turn] = turns_of(panel, at);
  std::array<Column, 10> f{};
  for (int i = 0; i < kN; ++i) {
    const double c = std::cos(turn[0][i]) * rate[i];
    const double s = std::sin(turn[0][i]) * rate[i];
    f[0][i] = length_ * c;
    f[1][i] = length_ * s;
    for (int q = 0; q < 4; ++q) {
      f[2 + q][i] = -length_ * s * turn[1 + q][i] + (q == kLength ? c : 0);
      f[6 + q][i] = length_ * c * turn[1 + q][i] + (q == kLength ? s : 0);
    }
  }
  const std::array<double, 10> base{at.x,     at.y,     at.dx[0], at.dx[1], at.dx[2],
                                    at.dx[3], at.dy[0], at.dy[1], at.dy[2], at.dy[3]};
  for (int column = 0; column < 10; ++column) {
    const Column sum = integrate(f[column]);
    const int to = column < 2 ? column : column + 1;
    for (int i = 0; i < kN; ++i) panel.node[i][to] = base[column] + sum[i];
  }
  for (int i = 0; i < kN; ++i) panel.node[i][2] = turn[0][i];
  const auto& last = panel.node[kN - 1];
  at.x = last[0];
  at.y = last[1];
  at.angle = last[2];
  for (int q = 0; q < 4; ++q) {
    at.dx[q] = last[3 + q];
    at.dy[q] = last[7 + q];
    at.dangle[q] = turn[1 + q][kN - 1];
  }
}

PieceTable::Value PieceTable::at(double v) const {
  std::size_t index = 0;
  while (index + 1 < panels_.size() && v > panels_[index].to) ++index;
  const Panel& panel = panels_[index];
  const double width = panel.to - panel.from;
  const double tau = ungraded(std::clamp((v - panel.from) / width, 0.0, 1.0), panel.graded);
  const Collocation& table = collocation();
  std::array<double, kColumns> sum{};
  double total = 0;
  for (int i = 0; i < kN; ++i) {
    const double gap = tau - table.node[i];
    if (std::abs(gap) < 1e-15) {
      sum = panel.node[i];
      total = 1;
      break;
    }
    const double w = table.weight[i] / gap;
    total += w;
    for (int c = 0; c < kColumns; ++c) sum[c] += w * panel.node[i][c];
  }
  Value r;
  const double scale = 1 / total;
  r.x = sum[0] * scale;
  r.y = sum[1] * scale;
  r.angle = sum[2] * scale;
  for (int q = 0; q < 4; ++q) {
    r.dx[q] = sum[3 + q] * scale;
    r.dy[q] = sum[7 + q] * scale;
  }
  return r;
}

double PieceTable::curvature(double v) const {
  return curvature_with_derivatives(curvature_start_, curvature_end_, alpha_, v).curvature;
}

}  // namespace keyline::lac
