#include "keyline/fairing/dense_step.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kSide = 0.8;       // of a curvature that may go in a step
constexpr int kHeldRounds = 3;      // of pulls at an end until it comes to where it is held…
constexpr double kGivenWay = 1e-2;  // …but for what counts so much in the merit

bool line(const DenseCurve& curve, std::size_t p) {
  return !curve.kind.empty() && curve.kind[p] == PieceKind::line;
}

}  // namespace

void set_step(Cell& cell, const DenseCurve& curve, const Gaps& gaps, std::size_t i) {
  const CellPlace& end = gaps.end[i];
  const core::Vector2 arm = end.at - curve.joints[i].position;
  cell.step << 1, 0, -arm.y, end.by_start.x, end.by_end.x, arm.x / curve.length,  //
      0, 1, arm.x, end.by_start.y, end.by_end.y, arm.y / curve.length,            //
      0, 0, 1, end.angle_by_start, end.angle_by_end, 0;
  cell.gap = gaps.cell[i];
}

void add(Cell& cell, const Vector6& d, double weight, double slope) {
  cell.hessian.noalias() += weight * d * d.transpose();
  cell.gradient += slope * d;
}

void damp(std::vector<Cell>& cells, const DenseCurve& curve, double damping) {
  if (damping == 0) return;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double h = curve.at[i + 1] - curve.at[i];
    for (int k = 0; k < 3; ++k) cells[i].hessian(k, k) += damping * h;
  }
}

DenseCurve moved(const DenseCurve& curve, const DenseStep& step, double share) {
  DenseCurve next = curve;
  for (std::size_t i = 0; i < next.joints.size(); ++i) {
    next.joints[i].position.x += share * step.state[i](0);
    next.joints[i].position.y += share * step.state[i](1);
    next.joints[i].direction += share * step.state[i](2);
  }
  for (std::size_t p = 0; p + 1 < next.cut.size(); ++p) {
    const Vector6& state = step.state[next.cut[p]];
    next.value[p] += share * state(3);
    if (p + 2 == next.cut.size()) next.value[p + 1] += share * state(4);
  }
  next.length += share * step.state[0](5);
  return next;
}

bool alike(const DenseStep& a, const DenseStep& b, double share) {
  const auto near = [&](int from, int count) {
    double apart = 0;
    double size = 0;
    for (std::size_t i = 0; i < a.state.size(); ++i) {
      apart += (a.state[i] - b.state[i]).segment(from, count).squaredNorm();
      size += b.state[i].segment(from, count).squaredNorm();
    }
    return apart < share * share * size;
  };
  return near(0, 3) && near(3, 2);
}

std::vector<std::array<double, 2>> meant_ends(const DenseCurve& curve, const DenseStep& step) {
  std::vector<std::array<double, 2>> change;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    const Vector6& state = step.state[curve.cut[p]];
    change.push_back({state(3), state(4)});
  }
  return change;
}

double keeps_side(const DenseCurve& curve, const DenseStep& step) {
  double share = 1;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    if (passes_inflection(curve.alpha[p])) continue;
    const Vector6& by = step.state[curve.cut[p]];
    for (const int end : {0, 1}) {
      const double now = curve.value[p + end];
      const double change = by(3 + end);
      if (now * change < 0 && std::abs(change) > kSide * std::abs(now))
        share = std::min(share, kSide * std::abs(now / change));
    }
  }
  return share;
}

DenseBoundary boundary_of(const DenseCurve& curve, const Vector6& seam, const Vector6& multiplier,
                          double weight) {
  DenseBoundary b;
  b.closed = curve.closed;
  const int start = static_cast<int>(curve.hold_start);
  for (int k = curve.slides_start ? 1 : 0; k < 4; ++k) b.fixed_start[k] = start > 0 && k <= start;
  b.fixed_start[3] = b.fixed_start[3] || end_of_line(curve, 0);
  b.fixed_start[4] = flat(curve, 0) || end_of_line(curve, 1);
  const int end = static_cast<int>(curve.hold_end);
  for (int k = !curve.closed && curve.slides_end ? 1 : 0; k < 4; ++k)
    if (curve.closed || (end > 0 && k <= end))
      b.end_hessian(k, k) = k == 3 ? 1e-2 * weight : weight;
  b.end_gradient = b.end_hessian * seam + multiplier;
  return b;
}

DenseStep solve_held(const std::vector<Cell>& cells, DenseBoundary boundary, const Vector6& seam) {
  DenseStep step = solve_cells(cells, boundary);
  for (int round = 0; round < kHeldRounds && step.sound; ++round) {
    Vector6 left = seam + step.state.back();
    if (boundary.closed) left -= step.state.front();
    const Vector6 pull = boundary.end_hessian * left;
    const double given = left.head<3>().cwiseProduct(pull.head<3>().cwiseSign()).sum();
    if (gap_price(step) * given <= kGivenWay) break;
    boundary.end_gradient += pull;
    step = solve_cells(cells, boundary);
  }
  return step;
}

bool end_of_line(const DenseCurve& curve, std::size_t cut) {
  const std::size_t pieces = curve.alpha.size();
  const bool before = cut > 0 ? line(curve, cut - 1) : curve.closed && line(curve, pieces - 1);
  const bool after = cut < pieces ? line(curve, cut) : curve.closed && line(curve, 0);
  return before || after;
}

}  // namespace keyline::fairing::detail
