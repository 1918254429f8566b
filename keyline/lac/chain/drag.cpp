#include "keyline/lac/chain/drag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Pose2;
using core::Vector2;
using detail::CurvatureStep;
using detail::CurvatureVariable;

constexpr int kRows = 5;  ///< end position, end direction, dragged position
using Rows = std::array<double, kRows>;

/// Unknowns of a chain: a change of curvature per joint, of ln(length) per piece, from the chain
/// before the drag; the problem in units of the mean length of a piece.
class DragProblem {
 public:
  DragProblem(Chain chain, std::size_t joint, bool hold_curvatures);

  std::size_t unknowns() const { return joints_ + base_.pieces.size(); }
  /// Constraints: an end that is dragged itself has no position to hold.
  int rows() const { return joint_ == base_.pieces.size() ? 3 : kRows; }
  std::size_t freedom() const;
  Chain moved(const std::vector<double>& change) const;
  /// Misses and their derivatives, for a target given in the units of the problem.
  Rows misses(const std::vector<double>& change, Point2 target, std::vector<Rows>& by) const;
  const Chain& base() const { return base_; }

 private:
  std::vector<detail::PieceShape> shapes(const Chain& chain) const;
  std::size_t joint_slot(std::size_t i) const { return i == joints_ ? 0 : i; }

  Chain base_;
  std::size_t joint_;
  std::size_t joints_;  ///< number of curvature unknowns
  std::vector<CurvatureVariable> variable_;
  std::vector<bool> held_;
  std::vector<Pose2> before_;
};

DragProblem::DragProblem(Chain chain, std::size_t joint, bool hold_curvatures)
    : base_(std::move(chain)), joint_(joint) {
  const std::size_t m = base_.pieces.size();
  joints_ = base_.closed ? m : m + 1;
  variable_.resize(joints_);
  held_.assign(joints_, false);
  before_ = joints(base_);
  for (std::size_t i = 0; i < m; ++i) {
    const Piece& p = base_.pieces[i];
    if (p.alpha < 0) continue;
    for (const std::size_t slot : {joint_slot(i), joint_slot(i + 1)}) {
      variable_[slot].step = CurvatureStep::logarithm;
      // A straight piece of such a slope, or a cusp, stays what it is.
      const bool fixed = p.curvature_start == 0 || p.curvature_end == 0 ||
                         std::isinf(p.curvature_start) || std::isinf(p.curvature_end);
      if (fixed) held_[slot] = true;
    }
  }
  if (hold_curvatures) held_.front() = held_.back() = true;
}

std::size_t DragProblem::freedom() const {
  return unknowns() - static_cast<std::size_t>(std::count(held_.begin(), held_.end(), true));
}

Chain DragProblem::moved(const std::vector<double>& change) const {
  Chain chain = base_;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    Piece& p = chain.pieces[i];
    const std::size_t a = joint_slot(i);
    const std::size_t b = joint_slot(i + 1);
    if (!held_[a]) p.curvature_start = stepped(p.curvature_start, change[a], variable_[a]);
    if (!held_[b]) p.curvature_end = stepped(p.curvature_end, change[b], variable_[b]);
    p.length *= std::exp(change[joints_ + i]);
  }
  return chain;
}

std::vector<detail::PieceShape> DragProblem::shapes(const Chain& chain) const {
  std::vector<detail::PieceShape> all;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const Piece& p = chain.pieces[i];
    all.push_back(piece_shape(p.alpha, p.curvature_start * p.length, p.curvature_end * p.length,
                              variable_[joint_slot(i)], variable_[joint_slot(i + 1)]));
  }
  return all;
}

Rows DragProblem::misses(const std::vector<double>& change, Point2 target,
                         std::vector<Rows>& by) const {
  const Chain chain = moved(change);
  const std::size_t m = chain.pieces.size();
  const std::vector<detail::PieceShape> shape = shapes(chain);
  std::vector<Pose2> at{chain.start};
  for (std::size_t i = 0; i < m; ++i) {
    const Vector2 chord = core::rotate_ccw(shape[i].chord, at[i].direction);
    at.push_back(
        {at[i].position + chain.pieces[i].length * chord, at[i].direction + shape[i].turning});
  }
  by.assign(unknowns(), Rows{});
  const bool end_dragged = joint_ == m;
  const auto add = [&](std::size_t i, std::size_t unknown, Vector2 local, double turned) {
    const auto position_by = [&](Point2 p) {
      return core::rotate_ccw(local, at[i].direction) +
             turned * core::perpendicular_left(p - at[i + 1].position);
    };
    const Vector2 end = position_by(at[m].position);
    by[unknown][0] += end.x;
    by[unknown][1] += end.y;
    by[unknown][2] += turned;
    if (end_dragged || i >= joint_) return;
    const Vector2 dragged = position_by(at[joint_].position);
    by[unknown][3] += dragged.x;
    by[unknown][4] += dragged.y;
  };
  for (std::size_t i = 0; i < m; ++i) {
    const double length = chain.pieces[i].length;
    for (int side = 0; side < 2; ++side) {
      const std::size_t slot = joint_slot(i + static_cast<std::size_t>(side));
      if (held_[slot]) continue;
      const double s = variable_[slot].step == CurvatureStep::linear ? length : 1.0;
      add(i, slot, length * s * shape[i].chord_by[side], s * shape[i].turning_by[side]);
    }
    add(i, joints_ + i, length * shape[i].chord_by_length, shape[i].turning);
  }
  const Vector2 end = at[m].position - (end_dragged ? target : before_[m].position);
  const Vector2 dragged = end_dragged ? Vector2{} : at[joint_].position - target;
  return {end.x, end.y, at[m].direction - before_[m].direction, dragged.x, dragged.y};
}

/// The least change that meets the constraints as they are linearised at `change`.
template <std::size_t N>
bool project(const std::vector<Rows>& by, const Rows& miss, std::vector<double>& change) {
  std::array<std::array<double, N>, N> normal{};
  std::array<double, N> side{};
  for (std::size_t r = 0; r < N; ++r) side[r] = -miss[r];
  for (std::size_t u = 0; u < by.size(); ++u) {
    for (std::size_t r = 0; r < N; ++r) {
      side[r] += by[u][r] * change[u];
      for (std::size_t c = 0; c < N; ++c) normal[r][c] += by[u][r] * by[u][c];
    }
  }
  if (!detail::solve_small(normal, side)) return false;
  for (std::size_t u = 0; u < by.size(); ++u) {
    change[u] = 0;
    for (std::size_t r = 0; r < N; ++r) change[u] += by[u][r] * side[r];
  }
  return true;
}

bool is_valid_chain(const Chain& chain) {
  return std::all_of(chain.pieces.begin(), chain.pieces.end(), [](const Piece& p) {
    return validate(p) && detail::absolute_turning(p) < 2 * core::kPi;
  });
}

/// Iterates to the target from a change near by; false where it does not settle.
bool settle(const DragProblem& problem, Point2 target, double scale, std::vector<double>& change,
            int& iterations) {
  std::vector<Rows> by;
  double before = 1e300;
  for (int i = 0; i < 60; ++i) {
    const Rows miss = problem.misses(change, target, by);
    const double size = detail::size_of(miss);
    if (!(size < 1e6)) return false;
    const std::vector<double> old = change;
    const bool solved =
        problem.rows() == 3 ? project<3>(by, miss, change) : project<5>(by, miss, change);
    if (!solved) return false;
    ++iterations;
    double step = 0;
    for (std::size_t u = 0; u < change.size(); ++u) {
      step = std::max(step, std::abs(change[u] - old[u]));
    }
    if (!std::isfinite(step) || step > 3) return false;
    if (size < 1e-13 * scale && (step < 1e-9 || step >= 0.9 * before)) {
      change = old;  // the one whose misses are known
      return is_valid_chain(problem.moved(change));
    }
    before = step;
  }
  return false;
}

Chain scaled(const Chain& chain, double factor) {
  Chain s = transform(chain, {factor, 0, {}});
  s.start.position = {0, 0};
  return s;
}

/// Joint at parameter t; a new one where there is none within 1e-9 of a piece.
std::size_t joint_at(Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  if (at.t < 1e-9) return at.piece;
  if (at.t > 1 - 1e-9) return at.piece + 1;
  const Piece whole = chain.pieces[at.piece];
  const auto place = chain.pieces.begin() + static_cast<std::ptrdiff_t>(at.piece);
  *place = part(whole, 0, at.t);
  chain.pieces.insert(place + 1, part(whole, at.t, 1));
  return at.piece + 1;
}

/// Steps towards the target, shorter where one does not settle; the share of the way that was gone.
double go(const DragProblem& problem, Point2 from, Point2 to, std::vector<double>& change,
          DragSolution& solution) {
  const Vector2 way = to - from;
  const double scale = static_cast<double>(problem.base().pieces.size());
  double share = 0;
  for (double step = 1; share < 1 && step > 1e-3;) {
    const double next_share = std::min(1.0, share + step);
    std::vector<double> next = change;
    if (settle(problem, from + next_share * way, scale, next, solution.iterations)) {
      change = next;
      share = next_share;
      step *= 1.5;
    } else {
      step *= 0.4;
    }
  }
  return share;
}

core::Result<DragSolution> drag_start(const Chain& chain, Point2 target,
                                      const DragOptions& options) {
  auto turned = drag(reverse(chain), 1, target, options);
  if (!turned) return turned;
  turned->chain = reverse(turned->chain);
  turned->joint = 0;
  return turned;
}

}  // namespace

core::Result<DragSolution> drag(const Chain& given, double t, Point2 target,
                                const DragOptions& options) {
  if (const auto ok = validate(given); !ok) return std::unexpected(ok.error());
  if (!(t >= 0 && t <= 1) || !is_finite(target)) {
    return core::fail(ErrorCode::bad_input, "the parameter must be in [0, 1], the target finite");
  }
  Chain chain = given;
  const std::size_t joint = joint_at(chain, t);
  if (chain.closed && joint % chain.pieces.size() == 0) {
    return core::fail(ErrorCode::undrawable, "the start of a closed chain is what is held",
                      "drag another point");
  }
  if (joint == 0) return drag_start(given, target, options);
  const double unit = arc_length(chain) / static_cast<double>(chain.pieces.size());
  const DragProblem problem(scaled(chain, 1 / unit), joint, options.hold_end_curvatures);
  if (problem.freedom() < static_cast<std::size_t>(problem.rows())) {
    return core::fail(ErrorCode::undrawable, "too few pieces for what is held",
                      "split a piece, or do not hold the end curvatures");
  }
  DragSolution solution;
  std::vector<double> change(problem.unknowns(), 0.0);
  const Point2 scaled_target = Point2{} + (target - chain.start.position) / unit;
  if (const double share =
          go(problem, joints(problem.base())[joint].position, scaled_target, change, solution);
      share < 1) {
    return core::fail(ErrorCode::not_converged, "the point cannot be dragged so far",
                      core::number_text(share, 3) + " of the way could be gone");
  }
  solution.chain = transform(problem.moved(change), {unit, 0, {}});
  solution.chain.start = chain.start;
  solution.joint = joint;
  for (const double c : change) solution.change += c * c;
  solution.change = std::sqrt(solution.change);
  return solution;
}

}  // namespace keyline::lac
