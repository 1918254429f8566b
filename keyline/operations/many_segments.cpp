#include <algorithm>

#include "keyline/core/error.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/numeric/parallel.h"
#include "keyline/operations/held_curve.h"

namespace keyline::operations {
namespace {

/// Enough for the vector lanes, few enough to stay in the cache.
constexpr std::size_t kBlock = 4096;

void solve_block(std::span<const double> handles, std::span<const double> alphas, std::size_t from,
                 std::size_t to, SegmentColumns& columns) {
  std::vector<lac::G1Problem> problems;
  problems.reserve(to - from);
  for (std::size_t i = from; i < to; ++i) {
    const double* h = &handles[6 * i];
    problems.push_back(
        {{h[0], h[1]}, {h[2], h[3]}, {h[4], h[5]}, alphas[alphas.size() > 1 ? i : 0]});
  }
  std::vector<lac::G1Outcome> outcomes(problems.size());
  lac::solve_g1(problems, outcomes);
  for (std::size_t i = from; i < to; ++i) {
    const lac::G1Outcome& outcome = outcomes[i - from];
    const lac::Segment& segment = outcome.segment;
    columns.start[2 * i] = segment.start.position.x;
    columns.start[2 * i + 1] = segment.start.position.y;
    columns.direction[i] = segment.start.direction;
    columns.length[i] = segment.length;
    columns.curvature[2 * i] = segment.curvature_start;
    columns.curvature[2 * i + 1] = segment.curvature_end;
    columns.lambda[i] = outcome.lambda;
    columns.drawn[i] = outcome.drawn ? 1 : 0;
    columns.reversed[i] = outcome.reversed ? 1 : 0;
  }
}

}  // namespace

core::Result<SegmentColumns> many_segments(std::span<const double> handles,
                                           std::span<const double> alphas, int threads) {
  const std::size_t count = handles.size() / 6;
  if (handles.size() != 6 * count || (alphas.size() != 1 && alphas.size() != count))
    return core::fail(core::ErrorCode::bad_input,
                      "there is not one slope for each triple of points",
                      "give one slope, or as many as triples", "alpha");
  SegmentColumns columns;
  columns.start.resize(2 * count);
  columns.direction.resize(count);
  columns.length.resize(count);
  columns.curvature.resize(2 * count);
  columns.lambda.resize(count);
  columns.drawn.resize(count);
  columns.reversed.resize(count);
  numeric::parallel_for((count + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    solve_block(handles, alphas, block * kBlock, std::min(count, (block + 1) * kBlock), columns);
  });
  return columns;
}

}  // namespace keyline::operations
