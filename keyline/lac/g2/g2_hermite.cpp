#include "keyline/lac/g2/g2_hermite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/g2/g2_shooting.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/segment/slope.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Vector2;
using detail::ShortChain;
using detail::UnitG2;

/// Best solution so far, in units of the chord.
struct Best {
  std::optional<Segment> one;  ///< the segment between the poses without regard to curvature
  double wild_turning = detail::kWildTurning;  ///< of a piece, and
  double wild_length = detail::kWildLength;    ///< of the chain, from which on it does not count
  std::optional<G2Solution> solution;
  int starts = 0;

  void offer(G2Solution candidate) {
    if (!solution) {
      solution = std::move(candidate);
      return;
    }
    const double gap = candidate.absolute_turning - solution->absolute_turning;
    const bool less_wild =
        std::abs(gap) <= 1e-9 ? candidate.bending_energy < solution->bending_energy : gap < 0;
    if (less_wild) solution = std::move(candidate);
  }
};

/// A start for the request: what counts as wild or astray is measured by the one segment.
Best best_for(UnitG2& request) {
  Best best;
  const auto one = solve_g1_directions({{0, 0}, request.from}, {{1, 0}, request.to}, request.alpha);
  if (!one) return best;
  best.one = one->segment;
  best.wild_turning =
      std::max(best.wild_turning, 1.25 * detail::absolute_turning(piece_of(one->segment)));
  best.wild_length = std::max(best.wild_length, 2 * one->segment.length);
  request.longest = std::max(request.longest, 2.5 * one->segment.length);
  return best;
}

/// Measures a chain of unit chord; empty where it counts as wild.
std::optional<G2Solution> measured(const Best& best, Chain chain, double residual) {
  G2Solution s;
  double length = 0;
  for (const Piece& piece : chain.pieces) {
    const double turned = detail::absolute_turning(piece);
    if (!(turned <= best.wild_turning)) return std::nullopt;
    s.absolute_turning += turned;
    s.bending_energy += detail::bending_energy(piece);
    length += piece.length;
  }
  if (!(length <= best.wild_length)) return std::nullopt;
  s.chain = std::move(chain);
  s.residual = residual;
  return s;
}

Chain chain_of(const UnitG2& request, const ShortChain& found) {
  Chain chain{{{}, request.from}, {}, false};
  for (int i = 0; i < found.pieces; ++i) {
    chain.pieces.push_back(
        {request.alpha, found.length_of(i), found.curvature[i], found.curvature[i + 1]});
  }
  return chain;
}

void try_start(const UnitG2& request, const ShortChain& start, Best& best) {
  ++best.starts;
  double residual = 0;
  const auto found = detail::shoot(request, start, &residual);
  if (!found) return;
  if (auto s = measured(best, chain_of(request, *found), residual)) best.offer(std::move(*s));
}

/// Keeps a guessed curvature usable where curvature must not change sign.
double usable(const UnitG2& request, double curvature) {
  if (request.alpha < 0) return curvature;
  const double sign = request.curvature_start > 0 ? 1 : -1;
  const double least = 0.1 * std::min({std::abs(request.curvature_start),
                                       std::abs(request.curvature_end), 10 * core::kPi});
  return sign * std::max(sign * curvature, least);
}

void search_two(const UnitG2& request, Best& best) {
  const double turning = request.to - request.from;
  const double k0 = request.curvature_start;
  const double k1 = request.curvature_end;
  for (const double length : {1.05, 1.4, 2.2}) {
    for (const double share : {0.08, 0.25, 0.5, 0.75, 0.92}) {
      // As if curvature were linear: its mean gives the turning.
      const double joint = 2 * turning / length - k0 * share - k1 * (1 - share);
      ShortChain start;
      start.pieces = 2;
      start.curvature = {k0, usable(request, joint), k1, 0};
      start.length = {share * length, (1 - share) * length, 0};
      try_start(request, start, best);
    }
  }
}

/// The piece between the poses without regard to curvature, or an arc about as long.
Piece between(const UnitG2& request, const Best& best) {
  if (best.one) return piece_of(*best.one);
  const double turning = request.to - request.from;
  const double h = std::min(std::abs(turning) / 2, 2.5);
  const double length = h > 0 ? h / std::sin(h) : 1;
  return {request.alpha, length, turning / length, turning / length};
}

void search_three(const UnitG2& request, Best& best) {
  const Piece middle = between(request, best);
  for (const double outer : {1.0, 0.5, 0.2, 0.08, 0.02}) {
    for (const double stretch : {1.0, 1.3, 2.0}) {
      ShortChain start;
      start.pieces = 3;
      start.outer = outer;
      start.curvature = {request.curvature_start, usable(request, middle.curvature_start / stretch),
                         usable(request, middle.curvature_end / stretch), request.curvature_end};
      start.length = {0, stretch * middle.length / (1 + 2 * outer), 0};
      try_start(request, start, best);
    }
    // Long outer pieces are the calm ones: the first that serve end the search.
    if (best.solution && outer <= 0.5) return;
  }
}

/// From the one segment between the poses, cut in three: its end curvatures are moved to the ones
/// asked for, step by step.
void follow_from_one(const UnitG2& request, double outer, Best& best) {
  const Segment& one = *best.one;
  const Piece whole = piece_of(one);
  const double share = outer / (1 + 2 * outer);
  ShortChain chain;
  chain.pieces = 3;
  chain.outer = outer;
  chain.length = {0, whole.length * (1 - 2 * share), 0};
  chain.curvature = {whole.curvature_start, curvature(whole, share), curvature(whole, 1 - share),
                     whole.curvature_end};
  ++best.starts;
  double gone = 0;
  double residual = 0;
  for (double step = 0.25; gone < 1 && step > 0.005;) {
    const double next = std::min(1.0, gone + step);
    UnitG2 between = request;
    between.curvature_start = std::lerp(one.curvature_start, request.curvature_start, next);
    between.curvature_end = std::lerp(one.curvature_end, request.curvature_end, next);
    ShortChain start = chain;
    start.curvature[0] = between.curvature_start;
    start.curvature[3] = between.curvature_end;
    const auto found = detail::shoot(between, start, &residual);
    step *= found ? 1.5 : 0.4;
    if (!found) continue;
    chain = *found;
    gone = next;
  }
  if (gone < 1) return;
  if (auto s = measured(best, chain_of(request, chain), residual)) best.offer(std::move(*s));
}

/// Where no start led to an answer.
void search_by_following(const UnitG2& request, Best& best) {
  if (!best.one) return;
  for (const double outer : {0.5, 0.2, 0.08, 0.03, 0.01, 0.003, 0.001, 0.0003}) {
    follow_from_one(request, outer, best);
    if (best.solution) return;
  }
}

/// Pieces of a chain whose ends carry the curvatures asked for to those of the segment between:
/// the outer ones as long as `share` of the sharper radius at their ends.
struct Bridge {
  std::array<Piece, 3> piece;
  double change = HUGE_VAL;  ///< of the segment's end curvatures in the last round, of themselves
};

std::optional<Bridge> next_bridge(const UnitG2& request, const Piece& middle, double share) {
  const auto outer = [&](double k0, double k1) {
    const double sharper = std::max({std::abs(k0), std::abs(k1), 1.0});
    return Piece{request.alpha, share / sharper, k0, k1};
  };
  Bridge b{{outer(request.curvature_start, middle.curvature_start), middle,
            outer(middle.curvature_end, request.curvature_end)}};
  const Piece& first = b.piece[0];
  const Piece& last = b.piece[2];
  const core::Pose2 from{core::Point2{} + rotate_ccw(displacement(first, 1), request.from),
                         request.from + turning(first, 1)};
  const double before = request.to - turning(last, 1);
  const core::Pose2 to{core::Point2{1, 0} - rotate_ccw(displacement(last, 1), before), before};
  const auto segment = solve_g1_directions(from, to, request.alpha);
  if (!segment) return std::nullopt;
  b.piece[1] = piece_of(segment->segment);
  const auto change = [](double now, double was) {
    return now == was ? 0 : std::abs(now - was) / std::abs(was);
  };
  b.change = std::max(change(b.piece[1].curvature_start, middle.curvature_start),
                      change(b.piece[1].curvature_end, middle.curvature_end));
  return b;
}

/// The segment between the poses with a short piece at either end. The shorter these are the less
/// they move the segment, so that for slopes below 0, which have a segment between any directions,
/// there is an answer; the longest that settle are the calmest.
void search_bridge(const UnitG2& request, Best& best) {
  if (!best.one) return;
  const Piece whole = piece_of(*best.one);
  const bool one_way = whole.curvature_start * request.curvature_start > 0 &&
                       whole.curvature_end * request.curvature_end > 0;
  if (request.alpha >= 0 && !one_way) return;
  for (double share = 1; share > 1e-4 && !best.solution; share /= 2) {
    ++best.starts;
    std::optional<Bridge> bridge{Bridge{{whole, whole, whole}}};
    for (int round = 0; round < 60 && bridge && bridge->change > 1e-15; ++round)
      bridge = next_bridge(request, bridge->piece[1], share);
    if (!bridge || bridge->change > 1e-13) continue;
    Chain chain{{{}, request.from}, {bridge->piece.begin(), bridge->piece.end()}, false};
    chain.pieces[1].curvature_start = chain.pieces[0].curvature_end;
    chain.pieces[1].curvature_end = chain.pieces[2].curvature_start;
    const double residual = distance(end_pose(chain).position, {1, 0});
    if (auto s = measured(best, std::move(chain), residual)) best.offer(std::move(*s));
  }
}

/// The single piece, where with the curvatures asked for it meets the end as nearly as chains have
/// to: data that come from a piece give it back, however much its curvatures move with rounding.
std::optional<G2Solution> single(const UnitG2& request, const Best& best) {
  if (!best.one) return std::nullopt;
  const Piece found = piece_of(*best.one);
  const Piece piece{found.alpha, found.length, request.curvature_start, request.curvature_end};
  const Chain chain{{{}, request.from}, {piece}, false};
  if (!validate(chain)) return std::nullopt;
  const core::Pose2 end = end_pose(chain);
  const double miss = std::max(distance(end.position, {1, 0}),
                               std::abs(core::wrap_angle(end.direction - request.to)));
  if (!(miss <= 1e-12)) return std::nullopt;
  return measured(best, chain, miss);
}

/// The same ends on the way back, turned half round: directions keep their angle with the chord.
UnitG2 on_the_way_back(UnitG2 request) {
  std::swap(request.from, request.to);
  std::swap(request.curvature_start, request.curvature_end);
  request.curvature_start *= -1;
  request.curvature_end *= -1;
  return request;
}

/// Whether the search travels from the end to the start: several chains may serve, and starts are
/// laid out from one end, so that both ways, and a mirror's, must be searched from the same one.
bool goes_back(const UnitG2& request) {
  const UnitG2 back = on_the_way_back(request);
  const auto way = [](const UnitG2& r) {
    return std::tuple{std::abs(r.from), std::abs(r.curvature_start), r.from * r.curvature_start};
  };
  return way(back) > way(request);
}

Best search_forward(UnitG2 request) {
  Best best = best_for(request);
  if (auto one = single(request, best)) {
    best.offer(std::move(*one));
    return best;
  }
  search_two(request, best);
  if (!best.solution) search_three(request, best);
  if (!best.solution) search_by_following(request, best);
  if (!best.solution) search_bridge(request, best);
  return best;
}

Best search(const UnitG2& request) {
  if (!goes_back(request)) return search_forward(request);
  Best best = search_forward(on_the_way_back(request));
  if (best.solution) best.solution->chain = reverse(best.solution->chain);
  return best;
}

/// Why a slope of 0 or more cannot serve, or nothing.
const char* needs_inflection(const UnitG2& r) {
  if (r.alpha < 0) return nullptr;
  const double turning = r.to - r.from;
  const bool bends_one_way = (r.from < 0 && r.to > 0) || (r.from > 0 && r.to < 0);
  if (!bends_one_way) return "these directions need an inflection, which slopes from 0 on lack";
  if (!(r.curvature_start * turning > 0) || !(r.curvature_end * turning > 0)) {
    return "with a slope of 0 or more both curvatures must be of the sign of the turning";
  }
  return nullptr;
}

std::unexpected<core::Failure> no_chain(const UnitG2& request, double chord, ErrorCode code,
                                        const char* reason) {
  std::string hint;
  const auto one = solve_g1_directions({{0, 0}, request.from}, {{1, 0}, request.to}, request.alpha);
  if (one) {
    hint = "one segment serves with the curvatures " +
           core::number_text(one->segment.curvature_start / chord, 9) + " and " +
           core::number_text(one->segment.curvature_end / chord, 9);
  }
  if (request.alpha != -1) {
    UnitG2 clothoid = request;
    clothoid.alpha = -1;
    if (search(clothoid).solution)
      hint += std::string(hint.empty() ? "" : "; ") + "slope -1 serves";
  }
  return core::fail(code, reason, hint);
}

core::Result<void> checked(const CurvatureElement& start, const CurvatureElement& end,
                           double alpha) {
  if (!is_slope(alpha)) {
    return core::fail(ErrorCode::bad_input, kSlopeRule, {}, "alpha");
  }
  for (const auto* e : {&start, &end}) {
    if (!is_finite(e->pose.position) || !std::isfinite(e->pose.direction) ||
        !std::isfinite(e->curvature)) {
      return core::fail(ErrorCode::bad_input, "a position, direction or curvature is not finite");
    }
  }
  if (!(norm(end.pose.position - start.pose.position) > 0)) {
    return core::fail(ErrorCode::bad_input, "start and end point coincide", "move one of them",
                      "end");
  }
  return {};
}

}  // namespace

core::Result<G2Solution> solve_g2(const CurvatureElement& start, const CurvatureElement& end,
                                  double alpha) {
  if (const auto ok = checked(start, end, alpha); !ok) return std::unexpected(ok.error());
  const Vector2 across = end.pose.position - start.pose.position;
  const double chord = norm(across);
  const double axis = core::direction_of(across);
  const UnitG2 request{core::wrap_angle(start.pose.direction - axis),
                       core::wrap_angle(end.pose.direction - axis), start.curvature * chord,
                       end.curvature * chord, alpha};
  const bool straight = request.from == 0 && request.to == 0 && request.curvature_start == 0 &&
                        request.curvature_end == 0;
  if (!straight) {
    if (const char* reason = needs_inflection(request))
      return no_chain(request, chord, ErrorCode::undrawable, reason);
  }
  Best best = search(request);
  if (!best.solution) {
    return no_chain(request, chord, ErrorCode::not_converged,
                    "no chain of up to three pieces without loops was found for these ends");
  }
  G2Solution& s = *best.solution;
  s.starts = best.starts;
  s.bending_energy /= chord;
  s.chain.start = start.pose;
  for (Piece& piece : s.chain.pieces) {
    piece.length *= chord;
    piece.curvature_start /= chord;
    piece.curvature_end /= chord;
  }
  s.chain.pieces.front().curvature_start = start.curvature;
  s.chain.pieces.back().curvature_end = end.curvature;
  return s;
}

}  // namespace keyline::lac
