#include "keyline/fairing/chain_edit.h"

#include <algorithm>
#include <cmath>

#include "keyline/lac/segment/segment.h"
#include "keyline/lac/segment/sensitivity.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::fairing::detail {
namespace {

/// Mean curvature of a piece, to the few digits a starting guess needs.
double mean_curvature(double k0, double k1, double alpha) {
  const lac::PieceCurvature bend(k0, k1, alpha);
  return numeric::integrate_gauss<4>([&](double at) { return bend.curvature(at); }, 0, 1);
}

/// Slope with which a piece from k0 to k1 turns by `mean` times its length; -1 where none does.
double slope_of_mean(double k0, double mean, double k1) {
  const bool crosses = k0 * k1 <= 0;
  double low = crosses ? -5 : -8;
  double high = crosses ? -0.3 : 8;
  if (std::abs(k1 - k0) < 1e-3 * std::max(std::abs(k0), std::abs(k1))) return -1;
  const double at_low = mean_curvature(k0, k1, low) - mean;
  const double at_high = mean_curvature(k0, k1, high) - mean;
  if (at_low * at_high > 0) return std::abs(at_low) < std::abs(at_high) ? low : high;
  for (int i = 0; i < 24; ++i) {
    const double alpha = 0.5 * (low + high);
    const double here = mean_curvature(k0, k1, alpha) - mean;
    (here * at_low > 0 ? low : high) = alpha;
  }
  return 0.5 * (low + high);
}

/// Slope, and where no slope does it the end curvatures, that turn a merged piece by `mean` per
/// length. Curvatures that are held stay.
void guess_merged(FitChain& chain, int at, double mean) {
  FitJoint& from = chain.joints[at];
  FitJoint& to = chain.joints[at + 2];
  FitPiece& piece = chain.pieces[at];
  const double low = std::min(from.curvature, to.curvature);
  const double high = std::max(from.curvature, to.curvature);
  const double margin = 0.02 * (high - low);
  if (mean > low + margin && mean < high - margin) {
    piece.alpha = slope_of_mean(from.curvature, mean, to.curvature);
    return;
  }
  piece.alpha = -1;
  const double shift = mean - 0.5 * (low + high);
  const bool from_held = at == 0 && (chain.closed || chain.hold_start == Hold::curvature);
  const bool to_held = at + 3 == static_cast<int>(chain.joints.size()) &&
                       (chain.closed || chain.hold_end == Hold::curvature);
  if (!from_held) from.curvature += shift;
  if (!to_held) to.curvature += shift;
}

}  // namespace

FitChain without_joint(const FitChain& chain, int at) {
  FitChain next = chain;
  FitPiece& kept = next.pieces[at - 1];
  const double first = kept.length;
  const double second = chain.pieces[at].length;
  const double share = first / (first + second);
  kept.length = first + second;
  kept.kind = PieceKind::curve;
  const double turning = next.joints[at + 1].direction - next.joints[at - 1].direction;
  guess_merged(next, at - 1, turning / kept.length);
  next.joints.erase(next.joints.begin() + at);
  next.pieces.erase(next.pieces.begin() + at);
  for (Foot& foot : next.feet) {
    if (foot.piece == at - 1) {
      foot.fraction *= share;
    } else if (foot.piece >= at) {
      if (foot.piece == at) foot.fraction = share + (1 - share) * foot.fraction;
      --foot.piece;
    }
  }
  return next;
}

FitChain with_joint(const FitChain& chain, int at, double fraction) {
  FitChain next = chain;
  const FitPiece& piece = chain.pieces[at];
  const FitJoint& before = chain.joints[at];
  const double end = chain.joints[at + 1].curvature;
  const double alpha = before.curvature * end <= 0 && piece.alpha >= 0 ? -1 : piece.alpha;
  const lac::Segment whole{
      {before.position, before.direction}, alpha, piece.length, before.curvature, end};
  const core::Pose2 pose = lac::pose_at(whole, fraction);
  next.joints.insert(next.joints.begin() + at + 1,
                     {pose.position, pose.direction, lac::curvature(whole, fraction)});
  next.pieces.insert(next.pieces.begin() + at, piece);
  next.pieces[at].length *= fraction;
  next.pieces[at + 1].length *= 1 - fraction;
  for (Foot& foot : next.feet) {
    if (foot.piece > at) {
      ++foot.piece;
    } else if (foot.piece == at && foot.fraction > fraction) {
      foot = {at + 1, (foot.fraction - fraction) / (1 - fraction)};
    } else if (foot.piece == at) {
      foot.fraction /= fraction;
    }
  }
  return next;
}

FitChain parted(const FitChain& chain, std::size_t pieces) {
  FitChain next = chain;
  while (next.pieces.size() < pieces) {
    const auto longest = std::ranges::max_element(next.pieces, {}, &FitPiece::length);
    next = with_joint(next, static_cast<int>(longest - next.pieces.begin()), 0.5);
  }
  return next;
}

void rotate_start(FitChain& chain, int by) {
  const int n = static_cast<int>(chain.pieces.size());
  for (int k = 0; k < by; ++k) {
    chain.joints.erase(chain.joints.begin());
    chain.joints.push_back(chain.joints.front());
    chain.joints.back().direction += chain.turning;
  }
  std::rotate(chain.pieces.begin(), chain.pieces.begin() + by % n, chain.pieces.end());
  for (Foot& foot : chain.feet) foot.piece = (foot.piece + n - by % n) % n;
}

Window cut_window(const FitChain& chain, const std::vector<FitPoint>& points, int first,
                  int count) {
  Window w;
  w.first = first;
  const int n = static_cast<int>(chain.pieces.size());
  w.chain.joints.assign(chain.joints.begin() + first, chain.joints.begin() + first + count + 1);
  w.chain.pieces.assign(chain.pieces.begin() + first, chain.pieces.begin() + first + count);
  w.chain.hold_start = chain.closed || first > 0 ? Hold::curvature : chain.hold_start;
  w.chain.hold_end = chain.closed || first + count < n ? Hold::curvature : chain.hold_end;
  w.chain.first_at_start = chain.first_at_start && first == 0;
  w.chain.last_at_end = chain.last_at_end && first + count == n;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Foot& foot = chain.feet[j];
    if (foot.piece < first || foot.piece >= first + count) continue;
    w.chain.feet.push_back({foot.piece - first, foot.fraction});
    w.points.push_back(points[j]);
    w.index.push_back(j);
  }
  return w;
}

/// Puts a solved window, one piece shorter than cut, back into the whole.
FitChain paste_window(const FitChain& whole, const Window& w, int count) {
  FitChain next;
  next.closed = whole.closed;
  next.turning = whole.turning;
  next.hold_start = whole.hold_start;
  next.hold_end = whole.hold_end;
  next.first_at_start = whole.first_at_start;
  next.last_at_end = whole.last_at_end;
  const auto tail = w.first + count;
  next.joints.assign(whole.joints.begin(), whole.joints.begin() + w.first);
  next.joints.insert(next.joints.end(), w.chain.joints.begin(), w.chain.joints.end());
  next.joints.insert(next.joints.end(), whole.joints.begin() + tail + 1, whole.joints.end());
  next.pieces.assign(whole.pieces.begin(), whole.pieces.begin() + w.first);
  next.pieces.insert(next.pieces.end(), w.chain.pieces.begin(), w.chain.pieces.end());
  next.pieces.insert(next.pieces.end(), whole.pieces.begin() + tail, whole.pieces.end());
  next.feet = whole.feet;
  const int grown = static_cast<int>(w.chain.pieces.size()) - count;
  for (Foot& foot : next.feet)
    if (foot.piece >= tail) foot.piece += grown;
  for (std::size_t k = 0; k < w.index.size(); ++k) {
    next.feet[w.index[k]] = w.chain.feet[k];
    next.feet[w.index[k]].piece += w.first;
  }
  return next;
}

}  // namespace keyline::fairing::detail
