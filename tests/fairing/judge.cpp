#include "judge.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::fairing::testing {
namespace {

constexpr int kSamples = 64;  // of a piece, to find a foot and to look at its curvature

double relative(double jump, double size, double length) {
  return std::abs(jump) / std::max(std::abs(size), 1 / length);
}

void judge_seam(Judgement& j, const lac::Chain& chain) {
  const double length = lac::arc_length(chain);
  const core::Pose2 end = lac::end_pose(chain);
  j.gap = std::max(j.gap, core::distance(end.position, chain.start.position) / length);
  j.turn_gap =
      std::max(j.turn_gap, std::abs(core::wrap_angle(end.direction - chain.start.direction)));
  const double k0 = chain.pieces.back().curvature_end;
  const double k1 = chain.pieces.front().curvature_start;
  j.curvature_jump = std::max(j.curvature_jump, relative(k1 - k0, k1, length));
}

void judge_corner(Judgement& j, const lac::Chain& before, const lac::Chain& after, double length) {
  const double gap = core::distance(lac::end_pose(before).position, after.start.position);
  j.gap = std::max(j.gap, gap / length);
}

void judge_pieces(Judgement& j, const lac::Chain& chain) {
  const double length = lac::arc_length(chain);
  if (const auto sound = lac::validate(chain); !sound) j.fault = sound.error().message;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const lac::Piece& piece = chain.pieces[i];
    const double rise = piece.curvature_end - piece.curvature_start;
    const double size = std::max(std::abs(piece.curvature_start), std::abs(piece.curvature_end));
    double before = lac::curvature(piece, 0);
    for (int k = 1; k <= kSamples; ++k) {
      const double here = lac::curvature(piece, double(k) / kSamples);
      const double step = rise >= 0 ? here - before : before - here;
      if (!(step >= -1e-12 * size)) j.monotone = false;
      j.turning += 0.5 * std::abs(here + before) * piece.length / kSamples;
      before = here;
    }
    if (i + 1 == chain.pieces.size()) break;
    const double next = chain.pieces[i + 1].curvature_start;
    j.curvature_jump =
        std::max(j.curvature_jump, relative(next - piece.curvature_end, next, length));
  }
}

/// Distance from one segment: its samples, then Newton's method from the nearest.
double distance_from(const lac::Segment& s, const std::vector<core::Point2>& track,
                     core::Point2 p) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < track.size(); ++k)
    if (core::distance(track[k], p) < core::distance(track[best], p)) best = k;
  double t = static_cast<double>(best) / static_cast<double>(track.size() - 1);
  double least = core::distance(track[best], p);
  for (int round = 0; round < 12; ++round) {
    const core::Pose2 at = lac::pose_at(s, t);
    const core::Vector2 tangent{std::cos(at.direction), std::sin(at.direction)};
    const core::Vector2 miss = p - at.position;
    const double bend = 1 - lac::curvature(s, t) * core::cross(tangent, miss);
    const double step = core::dot(miss, tangent) / std::max(0.2, bend) / s.length;
    t = std::clamp(t + std::clamp(step, -0.05, 0.05), 0.0, 1.0);
    least = std::min(least, core::distance(lac::evaluate(s, t), p));
  }
  return least;
}

struct Tracks {
  std::vector<lac::Segment> segments;
  std::vector<std::vector<core::Point2>> samples;
};

double deviation_of(const Tracks& tracks, core::Point2 p) {
  std::vector<std::pair<double, std::size_t>> rough;
  for (std::size_t i = 0; i < tracks.segments.size(); ++i) {
    double least = HUGE_VAL;
    for (const core::Point2 q : tracks.samples[i]) least = std::min(least, core::distance(p, q));
    rough.push_back({least - tracks.segments[i].length / kSamples, i});
  }
  std::sort(rough.begin(), rough.end());
  double found = HUGE_VAL;
  for (const auto& [bound, i] : rough) {
    if (bound > found) break;
    found = std::min(found, distance_from(tracks.segments[i], tracks.samples[i], p));
  }
  return found;
}

double polygon(const std::vector<core::Point2>& points, bool closed) {
  double sum = closed ? core::distance(points.back(), points.front()) : 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += core::distance(points[i - 1], points[i]);
  return sum;
}

void find_fault(Judgement& j, const FairResult& result) {
  std::ostringstream fault;
  if (!result.within_tolerance) fault << "says that it misses the tolerance; ";
  if (!(j.deviation <= result.tolerance * (1 + 1e-9)))
    fault << "deviation " << j.deviation << " above tolerance " << result.tolerance << "; ";
  if (!(std::abs(j.deviation - result.max_deviation) <= 1e-3 * result.tolerance))
    fault << "deviation " << j.deviation << " told as " << result.max_deviation << "; ";
  if (!(j.curvature_jump <= 1e-9)) fault << "curvature jumps by " << j.curvature_jump << "; ";
  if (!(j.gap <= 1e-9)) fault << "gap of " << j.gap << "; ";
  if (!(j.turn_gap <= 1e-9)) fault << "kink of " << j.turn_gap << " at the seam; ";
  if (!j.monotone) fault << "a piece is not monotone; ";
  j.fault += fault.str();
}

}  // namespace

Judgement judge(const FairResult& result, const std::vector<core::Point2>& points) {
  Judgement j;
  Tracks tracks;
  double length = 0;
  const lac::Chain* before = nullptr;
  for (const FairCurve& curve : result.curves) {
    const auto& chain = std::get<lac::Chain>(curve);
    j.pieces += static_cast<int>(chain.pieces.size());
    length += lac::arc_length(chain);
    judge_pieces(j, chain);
    if (chain.closed) judge_seam(j, chain);
    if (before) judge_corner(j, *before, chain, result.length);
    before = &chain;
    for (const lac::Segment& s : lac::segments(chain)) {
      tracks.segments.push_back(s);
      tracks.samples.push_back(lac::sample(s, kSamples + 1));
    }
  }
  if (result.closed && result.curves.size() > 1)
    judge_corner(j, *before, std::get<lac::Chain>(result.curves.front()), result.length);
  for (const core::Point2 p : points) j.deviation = std::max(j.deviation, deviation_of(tracks, p));
  j.length_ratio = length / polygon(points, result.closed);
  find_fault(j, result);
  return j;
}

}  // namespace keyline::fairing::testing
