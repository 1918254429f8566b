#include "keyline/sketch/consolidate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "keyline/core/error.h"
#include "keyline/core/polygon.h"
#include "keyline/sketch/double_edges.h"
#include "keyline/sketch/hand_seen.h"
#include "keyline/sketch/lone_passes.h"
#include "keyline/sketch/meant_line.h"
#include "keyline/sketch/never_touching.h"
#include "keyline/sketch/pass_evidence.h"
#include "keyline/sketch/stroke_grid.h"
#include "keyline/sketch/two_lines.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::Point2;

/// Lengths of overlap: more than any evidence for two strokes that are of two lines, less than a
/// wish.
constexpr double kTwoLines = 1e6;

/// Widths within which lines of a picture touch: there is no room for another between them.
constexpr double kTouch = 2;

/// Widths of pens that are probable: from the first to the second times the geometric mean of a
/// drawing's size and the mean length of its strokes.
constexpr double kThinPen = 0.006;
constexpr double kThickPen = 0.0084;
constexpr double kOutOfQuestion = 3;  ///< times thinner than that

/// The pen's width that passes are counted in, and the one its lines are held to.
struct Pen {
  double counted = 1;
  double held = 1;
};

/// Widths as drawings of that size and such strokes are drawn with: files that were scaled without
/// their pen would otherwise have passes far too near or far apart. Lines keep to the pen as given
/// unless it is out of the question.
Pen plausible_pen(const std::vector<DrawnStroke>& strokes, double width) {
  Point2 low{INFINITY, INFINITY};
  Point2 high{-INFINITY, -INFINITY};
  double length = 0;
  for (const DrawnStroke& s : strokes) {
    length += core::polygon_length(s.points, s.closed) / static_cast<double>(strokes.size());
    for (const Point2 p : s.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double size = distance(low, high);
  if (!(size > 0) || !(length > 0)) return {width, width};
  const double usual = std::sqrt(size * length);
  return {std::clamp(width, kThinPen * usual, kThickPen * usual),
          std::clamp(width, kThinPen * usual / kOutOfQuestion, kThickPen * usual)};
}

/// Groups of some of the strokes, by the evidence between them alone.
std::vector<std::vector<std::size_t>> groups_among(const std::vector<std::size_t>& some,
                                                   const PassEvidence& evidence) {
  PassEvidence between(some.size());
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t j = 0; j < some.size(); ++j)
      if (const auto found = evidence[some[i]].find(some[j]); found != evidence[some[i]].end())
        between[i][j] = found->second;
  auto groups = group_by_evidence(between);
  for (auto& group : groups)
    for (std::size_t& i : group) i = some[i];
  return groups;
}

/// Strokes, what speaks for or against their being passes of one line, and the groups it makes.
struct Passes {
  Pen pen;
  PassModel model;
  std::vector<SampledStroke> sampled;
  PassEvidence evidence;
  std::vector<std::vector<std::size_t>> groups;
};

/// Says that strokes are of two lines; true if nothing said so of some, nor a wish joins two.
bool tell_apart(const TwoLines& lines, PassEvidence& evidence) {
  for (const std::size_t a : lines.one)
    for (const std::size_t b : lines.other)
      if (evidence[a][b] >= kTwoLines) return false;
  bool more = false;
  for (const std::size_t a : lines.one)
    for (const std::size_t b : lines.other) {
      if (evidence[a][b] <= -kTwoLines) continue;
      evidence[a][b] = evidence[b][a] = -kTwoLines;
      more = true;
    }
  return more;
}

/// Groups by the evidence, with what makes them two lines added to it until nothing does.
void settle_groups(const PassModel& at_most, bool in_picture, Passes& all) {
  for (bool settled = false; !settled;) {
    settled = true;
    all.groups = group_by_evidence(all.evidence);
    auto told = two_lines(all.sampled, all.groups, at_most);
    if (in_picture) {
      std::ranges::copy(
          never_touching(all.sampled, all.groups, kTouch * at_most.width, at_most.angle),
          std::back_inserter(told));
      std::ranges::copy(double_edges(all.sampled, all.groups, at_most), std::back_inserter(told));
    }
    for (const TwoLines& lines : told)
      if (tell_apart(lines, all.evidence)) settled = false;
  }
}

Passes passes_of(const std::vector<DrawnStroke>& strokes, const ConsolidateOptions& options) {
  Passes all;
  all.pen =
      options.measured ? Pen{options.width, options.width} : plausible_pen(strokes, options.width);
  const PassModel at_most{all.pen.counted, options.apart, options.hand, options.angle};
  for (const DrawnStroke& s : strokes) {
    if (s.points.size() < 2) throw core::InvalidInput("consolidate needs two points per stroke");
    all.sampled.push_back(sample_stroke(s.points, s.closed, std::max(at_most.width, 1e-12)));
  }
  const PassReach reach = hand_seen(all.sampled, at_most);
  all.model = reach.seen;
  all.evidence = pass_evidence(all.sampled, reach);
  wish(options.wishes, all.evidence);
  settle_groups(at_most, options.measured, all);
  return all;
}

}  // namespace

std::size_t count_lines(const std::vector<DrawnStroke>& strokes,
                        const ConsolidateOptions& options) {
  return passes_of(strokes, options).groups.size();
}

std::vector<MeantLine> consolidate(const std::vector<DrawnStroke>& strokes,
                                   const ConsolidateOptions& options) {
  const auto [pen, model, sampled, evidence, groups] = passes_of(strokes, options);
  std::vector<std::vector<std::size_t>> open = groups;
  std::vector<MeantLine> lines;
  std::vector<std::size_t> strays;
  while (!open.empty()) {  // strays of a line are lines of their own
    const std::vector<std::size_t> group = std::move(open.back());
    open.pop_back();
    lines.push_back(meant_line(sampled, group,
                               {.width = pen.held, .step = model.width, .passes = model}, strays));
    for (auto& rest : groups_among(strays, evidence)) open.push_back(std::move(rest));
  }
  take_lone_passes(lines, pen.held, model.angle, [&](std::size_t stroke, const MeantLine& line) {
    return std::ranges::none_of(line.members, [&](std::size_t m) {
      const auto said = evidence[stroke].find(m);
      return said != evidence[stroke].end() && said->second < -kTwoLines;  // a wish
    });
  });
  std::sort(lines.begin(), lines.end(), [](const MeantLine& a, const MeantLine& b) {
    return a.members.front() < b.members.front();
  });
  return lines;
}

}  // namespace keyline::sketch
