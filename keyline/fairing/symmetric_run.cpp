#include "keyline/fairing/symmetric_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/analysis/comb_figures.h"
#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/free_ends.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/runs.h"
#include "keyline/lac/chain/chain_graph.h"

namespace keyline::fairing::detail {
namespace {

constexpr std::size_t kMostMirrored = 1000;        // points: means of more show symmetry as well
constexpr double kTwoErrors = 1.4142135623730951;  // the points and their images err independently
constexpr double kSure = 3;  // standard errors: of the mean square as of the noise, one in 2 n each
constexpr double kExactly = 1e-5;  // of the length: what interpolating exact points is off by
constexpr int kTightenings =
    4;  // of the half's tolerance: what is solved for are means of both sides
constexpr double kTighter = 1e-3;  // of the tolerance: each round aims so far within it
constexpr double kNearly = 1.5;    // of the tolerance: what is farther off is no matter of means
constexpr int kSamples = 24;       // of a piece, to find the feet of points near
constexpr double kWindow = 0.08;   // of the length, about where a foot is expected

std::vector<core::Point2> means_of(const acquire::KeyLine& line) {
  std::vector<core::Point2> points;
  for (const FitPoint& p : condense(line.points, line.weights, kMostMirrored))
    points.push_back(p.position);
  return points;
}

/// Shares of the length at which the points stand on their polygon.
std::vector<double> shares_of(const Run& run) {
  std::vector<double> at{0};
  for (std::size_t j = 1; j < run.points.size(); ++j)
    at.push_back(at.back() + core::distance(run.points[j - 1], run.points[j]));
  const double more = run.closed ? core::distance(run.points.back(), run.points.front()) : 0;
  const double whole = std::max(at.back() + more, 1e-300);
  for (double& share : at) share /= whole;
  return at;
}

struct Sample {
  double share = 0;  ///< of the chain's length
  Foot foot;
  core::Point2 at;
};

std::vector<Sample> samples_of(const lac::Chain& chain) {
  std::vector<Sample> samples;
  double way = 0;
  const double whole = lac::arc_length(chain);
  int piece = 0;
  for (const lac::Segment& segment : lac::segments(chain)) {
    for (int i = 0; i < kSamples; ++i) {
      const double t = (i + 0.5) / kSamples;
      samples.push_back(
          {(way + t * segment.length) / whole, {piece, t}, lac::pose_at(segment, t).position});
    }
    way += segment.length;
    ++piece;
  }
  return samples;
}

}  // namespace

std::vector<Foot> feet_on(const lac::Chain& chain, const Run& run, std::size_t first) {
  const std::vector<Sample> samples = samples_of(chain);
  const std::vector<double> shares = shares_of(run);
  std::vector<Foot> feet;
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    double expected = shares[j] - shares[first];
    if (run.closed) expected -= std::floor(expected);
    double least = HUGE_VAL;
    Foot best;
    for (const Sample& s : samples) {
      double off = std::abs(s.share - expected);
      if (run.closed) off = std::min(off, 1 - off);
      const double away = core::distance(s.at, run.points[j]);
      if (off > kWindow || away >= least) continue;
      least = away;
      best = s.foot;
    }
    feet.push_back(best);
  }
  return feet;
}

namespace {

std::size_t nearest(const std::vector<core::Point2>& points, core::Point2 to) {
  return static_cast<std::size_t>(
      std::ranges::min_element(points, {}, [&](core::Point2 p) { return core::distance(p, to); }) -
      points.begin());
}

/// The result of a whole run: `like` the half's in everything but the chain.
RunResult whole_run(const RunResult& like, const lac::Chain& chain, const Run& run) {
  RunResult result = like;
  result.chain = chain;
  result.to_canonical = {};
  result.reversed = false;
  result.fit = {};
  result.fit.feet = feet_on(chain, run, run.closed ? nearest(run.points, chain.start.position) : 0);
  result.point_of.clear();
  for (std::size_t j = 0; j < run.points.size(); ++j) result.point_of.push_back(j);
  return result;
}

core::HalfPlane mirrored_half(const core::HalfPlane& half, const core::Pose2& axis) {
  const core::Point2 on{half.at_least * half.normal.x, half.at_least * half.normal.y};
  const core::Vector2 normal = mirrored(axis, on + half.normal) - mirrored(axis, on);
  const core::Point2 image = mirrored(axis, on);
  return {normal, normal.x * image.x + normal.y * image.y};
}

/// Runs of the half; those at its ends know how they stand to the line of symmetry.
std::vector<Run> half_runs(const HalfLine& half, const core::Pose2& axis,
                           const std::vector<core::HalfPlane>& inside) {
  std::vector<Run> runs = smooth_runs(half.line);
  for (Run& run : runs) {
    for (std::size_t i = 0; i < half.measured.size(); ++i) {
      const auto at = std::ranges::find(run.index, half.belongs[i]);
      if (at == run.index.end()) continue;
      run.members.points.push_back(half.measured[i]);
      run.members.fitted.push_back(static_cast<std::size_t>(at - run.index.begin()));
    }
    for (const core::HalfPlane& one : inside) {
      run.inside.push_back(one);
      run.inside.push_back(mirrored_half(one, axis));
    }
  }
  runs.front().start_on_axis = half.start;
  runs.back().end_on_axis = half.end;
  if (half.start != HalfEnd::free) runs.front().axis = axis;
  if (half.end != HalfEnd::free) runs.back().axis = axis;
  return runs;
}

/// The whole key-line's runs solved, from those of the half; empty where they do not fit.
std::vector<RunResult> unfolded_runs(const std::vector<RunResult>& half_solved,
                                     const HalfLine& half, const core::Pose2& axis,
                                     const std::vector<Run>& runs) {
  if (half_solved.empty()) return {};
  std::vector<lac::Chain> solved;
  for (const RunResult& one : half_solved) solved.push_back(one.chain);
  const std::vector<lac::Chain> chains =
      unfold(solved, half, axis, runs.front().closed || half.start != HalfEnd::free);
  if (chains.size() != runs.size()) return {};
  std::vector<core::Point2> starts;
  for (const lac::Chain& chain : chains) starts.push_back(chain.start.position);
  std::vector<RunResult> all;
  for (const Run& run : runs) {
    const std::size_t k = nearest(starts, run.points.front());
    const std::size_t like = std::min(k, half_solved.size() - 1);
    all.push_back(whole_run(half_solved[like], chains[run.closed ? 0 : k], run));
  }
  return all;
}

/// The runs of one half solved, corners and ends in their places; empty where one has no chain.
std::vector<RunResult> solve_half(const HalfLine& half, const core::Pose2& axis, const Run& first,
                                  const OptionsOf& options) {
  std::vector<Run> sides = half_runs(half, axis, first.inside);
  if (half.start == HalfEnd::free) sides.front().tie_start = first.tie_start;
  std::vector<RunResult> solved;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    solved.push_back(fair_run(sides[k], {}, options(k)));
    if (winds(solved.back(), sides[k])) return {};
  }
  tie_corners(sides, solved, {}, options, false);
  if (half.start == HalfEnd::free) place_free_ends(solved[0], sides[0], options(0));
  return solved;
}

}  // namespace

std::string against_symmetry(const FairOptions& options) {
  if (options.region) return "a region";
  if (options.clamp.start != Clamp::none || options.clamp.end != Clamp::none) return "clamps";
  if (!options.interpretations.empty()) return "readings asked for";
  if (!options.must_pass.empty()) return "points to be passed";
  if (options.pieces > 0 || options.criterion != Criterion::least_variation)
    return "the shortest chain";
  return {};
}

std::optional<Mirror> mirror_within_noise(const acquire::KeyLine& line, double tolerance) {
  const std::vector<core::Point2> points = means_of(line);
  const auto mirror = best_mirror(points, line.closed);
  if (!mirror) return std::nullopt;
  const double n = static_cast<double>(points.size());
  const double noise = line.noise * std::sqrt(n / static_cast<double>(line.points.size()));
  const double explained = kTwoErrors * noise * (1 + kSure / std::sqrt(n));
  const double most = std::max(explained, kExactly * line.length);
  if (mirror->rms > most || mirror->largest > 2 * tolerance) return std::nullopt;
  return mirror;
}

Mirror mirror_in(const core::Pose2& line, const acquire::KeyLine& points) {
  return measured_in(line, means_of(points), points.closed);
}

std::string told(const core::Pose2& line) {
  const double exact = std::remainder(line.direction * 180 / core::kPi, 180.0);
  double degrees = std::round(exact * 100) / 100 + 0.0;  // + 0.0: never "-0.00"
  if (degrees == -90) degrees = 90;
  return fmt::format("({:.6g}, {:.6g}) at {:.2f} degrees", line.position.x, line.position.y,
                     degrees);
}

double largest_of(const std::vector<RunResult>& solved, const std::vector<Run>& runs) {
  double off = 0;
  for (std::size_t k = 0; k < solved.size(); ++k)
    off = std::max(off, largest_offset(solved[k], runs[k]));
  return off;
}

int waves_of(const std::vector<RunResult>& solved) {
  int waves = 0;
  for (const RunResult& one : solved)
    waves += analysis::comb_figures(lac::curvature_graph(one.chain)).waves;
  return waves;
}

core::Result<std::vector<RunResult>> solve_symmetric(const acquire::KeyLine& line,
                                                     const core::Pose2& axis,
                                                     const std::vector<Run>& runs,
                                                     const OptionsOf& options) {
  const auto half = fold(line, axis);
  if (!half) return std::unexpected(half.error());
  const double wanted = options(0).tolerance;
  double tolerance = wanted;
  std::vector<RunResult> found;
  for (int round = 0; round < kTightenings; ++round) {
    const auto tightened = [&](std::size_t k) {
      RunOptions one = options(k);
      one.tolerance = tolerance;
      return one;
    };
    found = unfolded_runs(solve_half(*half, axis, runs.front(), tightened), *half, axis, runs);
    if (found.empty())
      return core::fail(core::ErrorCode::undrawable, "the sides do not part as the whole does");
    const double off = largest_of(found, runs);
    if (off <= wanted || off > kNearly * wanted) break;
    tolerance *= (1 - kTighter) * wanted / off;
  }
  return found;
}

}  // namespace keyline::fairing::detail
