#include "keyline/sketch/lone_strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/sketch/align_strokes.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr std::size_t kSeveral = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kNone = kSeveral - 1;

/// Calls see(k, p) for the samples p of an aligned stroke, in the line's order, with the sample k
/// of the line beside each.
template <class See>
void visit_aligned(const SampledStroke& stroke, const Alignment& alignment, const See& see) {
  const std::size_t n = alignment.at.size();
  for (std::size_t i = 0; i < n; ++i)
    if (alignment.at[i] >= 0)
      see(static_cast<std::size_t>(alignment.at[i]),
          stroke.points[alignment.reversed ? n - 1 - i : i]);
}

/// Adds a stroke to those beside the samples of the line; ones stepped over count, too.
void add_beside(const SampledStroke& line, const SampledStroke& stroke, const Alignment& alignment,
                double reach, std::size_t number, std::vector<std::size_t>& lone) {
  const std::size_t m = lone.size();
  std::size_t last = kNone;
  visit_aligned(stroke, alignment, [&](std::size_t to, Point2 p) {
    if (core::distance(p, line.points[to]) > 2 * reach) {
      last = kNone;
      return;
    }
    for (std::size_t k = last == kNone ? to : (last + 1) % m; k != (to + 1) % m; k = (k + 1) % m)
      lone[k] = lone[k] == kNone ? number : kSeveral;
    last = to;
  });
}

/// By sample of the line the stroke that is alone beside it, or kSeveral. One that goes far off is
/// still alone where no other runs.
std::vector<std::size_t> lone_beside(const SampledStroke& line,
                                     const std::vector<SampledStroke>& strokes,
                                     const std::vector<Alignment>& alignments, double reach) {
  const std::size_t m = line.points.size();
  std::vector<std::size_t> lone(m, kNone);
  for (std::size_t s = 0; s < strokes.size(); ++s)
    add_beside(line, strokes[s], alignments[s], reach, s, lone);
  for (std::size_t k = 1; k < (line.closed ? 2 * m : m); ++k)
    if (lone[k % m] == kNone) lone[k % m] = lone[(k - 1) % m];
  for (std::size_t k = m; k-- > 0;)
    if (lone[k] == kNone) lone[k] = k + 1 < m ? lone[k + 1] : kSeveral;
  return lone;
}

/// By sample how far the line has gone over to its lone stroke, from 0 where there are several, or
/// it changes from one to another.
std::vector<double> gone_over(const SampledStroke& line, const std::vector<std::size_t>& lone,
                              double over) {
  const std::size_t m = lone.size();
  const double step = line.length / static_cast<double>(m);
  std::vector<double> gone(m, HUGE_VAL);
  for (const bool back : {false, true}) {
    double far = HUGE_VAL;
    std::size_t before = back == line.closed ? lone.front() : lone.back();
    for (std::size_t turn = 0; turn < (line.closed ? 2 * m : m); ++turn) {
      const std::size_t k = back ? m - 1 - turn % m : turn % m;
      far = lone[k] == kSeveral || lone[k] != before ? 0 : far + step;
      before = lone[k];
      gone[k] = std::min(gone[k], far);
    }
  }
  for (double& one : gone) {
    one = std::min(1.0, one / over);
    one *= one * (3 - 2 * one);
  }
  return gone;
}

}  // namespace

std::vector<Point2> follow_lone_strokes(const SampledStroke& line,
                                        const std::vector<SampledStroke>& strokes, double reach,
                                        double over) {
  std::vector<Alignment> alignments;
  for (const SampledStroke& s : strokes) alignments.push_back(align(s, line, reach));
  const std::vector<std::size_t> lone = lone_beside(line, strokes, alignments, reach);
  const std::vector<double> gone = gone_over(line, lone, over);
  std::vector<std::vector<Point2>> instead(lone.size());  // of samples with a lone stroke
  for (std::size_t s = 0; s < strokes.size(); ++s)
    visit_aligned(strokes[s], alignments[s], [&](std::size_t k, Point2 p) {
      if (lone[k] == s) instead[k].push_back(core::mix(line.points[k], p, gone[k]));
    });
  std::vector<Point2> points;
  for (std::size_t k = 0; k < lone.size(); ++k) {
    if (lone[k] == kSeveral) points.push_back(line.points[k]);
    points.insert(points.end(), instead[k].begin(), instead[k].end());
  }
  return points;
}

}  // namespace keyline::sketch
