#include "keyline/lac/segment/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace keyline::lac {
namespace {

constexpr int kN = 17;
using Column = std::array<double, kN>;

/// Chebyshev-Lobatto nodes on [0, 1], barycentric weights and, for every Lagrange polynomial, its
/// integrals from 0 to each node.
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
      integral[j][i] = 0.5 * sum;  // dx = 2 d(node)
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
  for (int j = 0; j < kN; ++j)
    for (int i = 0; i < kN; ++i) out[i] += table[j][i] * f[j];
  out[0] = 0;
  return out;
}

}  // namespace

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
  bend_ = PieceCurvature(curvature_start, curvature_end, alpha);
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
  // Where curvature vanishes it goes as the power -1/alpha of the way: rough for alpha < -1 only.
  const bool rough = alpha_ < -1 || alpha_ > 0;
  if (k0 == k1) {
    add_even_panels(1 + static_cast<int>(std::min(20.0, std::abs(k0) * length_ / 2.5)), 0);
  } else if (k0 * k1 < 0) {
    plan_around_zero(rough);
  } else {
    plan_without_zero(rough);
  }
}

/// Panels of equal width, the one where the linear function is smallest graded: the first for -1,
/// the last for +1.
void PieceTable::add_even_panels(int parts, int grade) {
  for (int i = 0; i < parts; ++i) {
    const bool smallest = i == (grade < 0 ? 0 : parts - 1);
    panels_.push_back({.from = double(i) / parts,
                       .to = double(i + 1) / parts,
                       .graded = smallest ? grade : 0,
                       .node = {}});
  }
}

void PieceTable::plan_around_zero(bool rough) {
  const double z0 = std::pow(std::abs(curvature_start_), -alpha_);
  const double z1 = std::pow(std::abs(curvature_end_), -alpha_);
  zero_ = std::clamp(z0 / (z0 + z1), 1e-9, 1 - 1e-9);
  if (fine_) {
    add_geometric_panels(0, zero_, 0, 1);
    add_geometric_panels(zero_, 1, 0, -1);
    return;
  }
  panels_.push_back({.from = 0, .to = zero_, .graded = rough ? 1 : 0, .node = {}});
  panels_.push_back({.from = zero_, .to = 1, .graded = rough ? -1 : 0, .node = {}});
}

void PieceTable::plan_without_zero(bool rough) {
  const double k0 = curvature_start_;
  const double k1 = curvature_end_;
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
  add_even_panels(1 + static_cast<int>(std::min(8.0, turning / 3.5)), grade);
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
    const CurvatureValue c = bend_.at(v);
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

/// The first columns at a fraction, by the barycentric formula.
template <int count>
std::array<double, count> PieceTable::columns_at(double v) const {
  std::size_t index = 0;
  while (index + 1 < panels_.size() && v > panels_[index].to) ++index;
  const Panel& panel = panels_[index];
  const double width = panel.to - panel.from;
  const double tau = ungraded(std::clamp((v - panel.from) / width, 0.0, 1.0), panel.graded);
  const Collocation& table = collocation();
  std::array<double, count> sum{};
  Column weight;
  for (int i = 0; i < kN; ++i) {
    weight[i] = tau - table.node[i];
    if (std::abs(weight[i]) >= 1e-15) continue;
    std::copy_n(panel.node[i].begin(), count, sum.begin());
    return sum;
  }
  for (int i = 0; i < kN; ++i) weight[i] = table.weight[i] / weight[i];
  double total = 0;
  for (int i = 0; i < kN; ++i) {
    total += weight[i];
    for (int c = 0; c < count; ++c) sum[c] += weight[i] * panel.node[i][c];
  }
  const double scale = 1 / total;
  for (double& value : sum) value *= scale;
  return sum;
}

PieceTable::Value PieceTable::at(double v) const {
  const auto column = columns_at<kColumns>(v);
  Value r{.x = column[0], .y = column[1], .angle = column[2], .dx = {}, .dy = {}};
  for (int q = 0; q < 4; ++q) {
    r.dx[q] = column[3 + q];
    r.dy[q] = column[7 + q];
  }
  return r;
}

PieceTable::Place PieceTable::place(double v) const {
  const auto [x, y, angle] = columns_at<3>(v);
  return {x, y, angle};
}

}  // namespace keyline::lac
