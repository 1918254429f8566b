#include "keyline/lac/g2/blend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/chain/extend.h"
#include "keyline/lac/g2/g2_hermite.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;

void measure(BlendSolution& blend, double alpha) {
  blend.absolute_turning = blend.bending_energy = 0;
  blend.overridden.clear();
  for (std::size_t i = 0; i < blend.chain.pieces.size(); ++i) {
    const Piece& piece = blend.chain.pieces[i];
    blend.absolute_turning += detail::absolute_turning(piece);
    blend.bending_energy += detail::bending_energy(piece);
    if (piece.alpha != alpha) blend.overridden.push_back(i);
  }
}

core::Result<BlendSolution> blend_g1(const BlendEnd& from, const BlendEnd& to, double alpha) {
  const auto one = solve_g1_directions(from.pose, to.pose, alpha);
  if (!one) return std::unexpected(one.error());
  BlendSolution blend{chain_of(one->segment), {}, 0, 0};
  measure(blend, alpha);
  return blend;
}

core::Result<BlendSolution> blend_g2(const BlendEnd& from, const BlendEnd& to, double alpha) {
  auto g2 = solve_g2({from.pose, from.curvature}, {to.pose, to.curvature}, alpha);
  if (!g2) return std::unexpected(g2.error());
  BlendSolution blend{std::move(g2->chain), {}, 0, 0};
  measure(blend, alpha);
  return blend;
}

/// The piece that starts with the end's curvature and rate; empty where there is none so long.
std::optional<Segment> outer_piece(const BlendEnd& end, double length, double chord, double alpha) {
  if (end.curvature_rate == 0) {
    return Segment{end.pose, alpha, length, end.curvature, end.curvature};
  }
  const bool nearly_zero = std::abs(end.curvature) * chord < 1e-3;
  const double slope = nearly_zero && alpha < 0 ? -1 : alpha;
  if (nearly_zero && alpha >= 0) return std::nullopt;
  const auto far = detail::curvature_continued(slope, end.curvature, end.curvature_rate, length);
  if (!far) return std::nullopt;
  // Bounded, so that the outer piece is not itself the wild part.
  if (!(std::abs(*far) * chord < 40)) return std::nullopt;
  return Segment{end.pose, slope, length, end.curvature, *far};
}

std::optional<BlendSolution> blend_g3_with(const BlendEnd& from, const BlendEnd& to, double length,
                                           double chord, double alpha) {
  const auto first = outer_piece(from, length, chord, alpha);
  const auto last_backwards = outer_piece(opposite(to), length, chord, alpha);
  if (!first || !last_backwards) return std::nullopt;
  Segment last = reverse(*last_backwards);
  const auto inner =
      solve_g2({end_pose(*first), first->curvature_end}, {last.start, last.curvature_start}, alpha);
  if (!inner) return std::nullopt;
  BlendSolution blend{{from.pose, {piece_of(*first)}, false}, {}, 0, 0};
  for (const Piece& piece : inner->chain.pieces) blend.chain.pieces.push_back(piece);
  blend.chain.pieces.push_back(piece_of(last));
  measure(blend, alpha);
  return blend;
}

core::Result<BlendSolution> blend_g3(const BlendEnd& from, const BlendEnd& to, double alpha) {
  if (!std::isfinite(from.curvature_rate) || !std::isfinite(to.curvature_rate)) {
    return core::fail(ErrorCode::bad_input, "a curvature rate is not finite");
  }
  // Without regard to the rates first: what fails here fails for good.
  const auto g2 = blend_g2(from, to, alpha);
  if (!g2) return g2;
  const double chord = distance(from.pose.position, to.pose.position);
  std::optional<BlendSolution> best;
  for (const double share : {0.3, 0.2, 0.12, 0.06, 0.03, 0.01, 0.003}) {
    auto blend = blend_g3_with(from, to, share * chord, chord, alpha);
    if (!blend) continue;
    const double gap = best ? blend->absolute_turning - best->absolute_turning : -1;
    const bool calmer =
        std::abs(gap) <= 1e-9 ? blend->bending_energy < best->bending_energy : gap < 0;
    if (calmer) best = std::move(blend);
  }
  if (best) return *best;
  return core::fail(ErrorCode::not_converged,
                    "no blend with these rates of curvature was found with any of the lengths "
                    "tried for its outer pieces",
                    alpha < 0 ? "use order G2" : "use order G2 or slope -1");
}

constexpr double kMet = 1e-12;  // how well an end is met, as a share of the size of what is asked

/// The size of what is asked: the chord, or a radius given at an end. A curvature within rounding
/// of none (1e-12 of that of the chord) gives no radius.
double size_asked(const BlendEnd& from, const BlendEnd& to, BlendOrder order) {
  const double chord = distance(from.pose.position, to.pose.position);
  double size = chord;
  if (order == BlendOrder::g1) return size;
  for (const double curvature : {std::abs(from.curvature), std::abs(to.curvature)})
    if (curvature * chord > kMet) size = std::max(size, 1 / curvature);
  return size;
}

/// A curve so long that rounding of its own points passes kMet: a circle nearly full, its ends
/// nearly opposite to the chord. Its length falls as the turning that is left up to 2 pi grows.
core::Result<BlendSolution> within_reach(core::Result<BlendSolution> blend, double size,
                                         double chord) {
  if (!blend) return blend;
  const double length = arc_length(blend->chain);
  const double longest = kMet / std::numeric_limits<double>::epsilon() * size;
  if (length <= longest) return blend;
  const double left = (2 * core::kPi - blend->absolute_turning) * (length / longest);
  return core::fail(
      ErrorCode::undrawable,
      "the blend would be " + core::number_text(length / chord, 2) +
          " times as long as its chord: rounding alone would move its end by more than 1e-12 of "
          "what is asked",
      "turn the ends, nearly opposite to the chord now, away from that by " +
          core::number_text(left, 4) + " rad together, towards each other");
}

}  // namespace

core::Result<BlendSolution> solve_blend(const BlendEnd& from, const BlendEnd& to, BlendOrder order,
                                        double alpha) {
  auto blend = order == BlendOrder::g1   ? blend_g1(from, to, alpha)
               : order == BlendOrder::g2 ? blend_g2(from, to, alpha)
                                         : blend_g3(from, to, alpha);
  return within_reach(std::move(blend), size_asked(from, to, order),
                      distance(from.pose.position, to.pose.position));
}

}  // namespace keyline::lac
