#include "keyline/fairing/dense_step.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kSide = 0.8;  // of a curvature that may go in a step

bool line(const DenseCurve& curve, std::size_t p) {
  return !curve.kind.empty() && curve.kind[p] == PieceKind::line;
}

}  // namespace

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

std::vector<double> meant_rises(const DenseCurve& curve, const DenseStep& step) {
  std::vector<double> change;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    const Vector6& state = step.state[curve.cut[p]];
    change.push_back(state(4) - state(3));
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

bool end_of_line(const DenseCurve& curve, std::size_t cut) {
  const std::size_t pieces = curve.alpha.size();
  const bool before = cut > 0 ? line(curve, cut - 1) : curve.closed && line(curve, pieces - 1);
  const bool after = cut < pieces ? line(curve, cut) : curve.closed && line(curve, 0);
  return before || after;
}

}  // namespace keyline::fairing::detail
