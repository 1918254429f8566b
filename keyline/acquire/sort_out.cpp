#include "keyline/acquire/sort_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "keyline/acquire/band.h"
#include "keyline/acquire/kd_tree.h"
#include "keyline/acquire/order.h"
#include "keyline/acquire/places.h"
#include "keyline/acquire/statistics.h"
#include "keyline/acquire/turnbacks.h"
#include "keyline/core/quantile.h"
#include "keyline/core/text.h"

namespace keyline::acquire::detail {
namespace {

constexpr std::size_t kFewTurns = 4;         // that many corners any section may have
constexpr std::size_t kMostOrdered = 20000;  // more points are averaged first

/// Merges points at the same place wherever they stand in the input.
void merge_anywhere(Working& work, KeyLine& line) {
  const std::vector<std::size_t> first = first_at_place(work.points);
  std::vector<std::size_t> repeated;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) continue;
    repeated.push_back(i);
    if (!work.weights.empty()) work.weights[first[i]] += work.weights[i];
  }
  remove_points(work, repeated);
  line.report.duplicates += repeated.size();
  if (!repeated.empty()) {
    line.report.notes.push_back(core::counted(repeated.size(), "further point") +
                                " at the same place as another merged");
  }
}

/// Drops points whose second neighbour is far away compared with what is usual.
void drop_isolated(Working& work, KeyLine& line) {
  const std::size_t n = work.points.size();
  if (n < 16) return;
  const KdTree tree(work.points);
  std::vector<double> reach(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto near = tree.nearest(work.points[i], 2, i);
    reach[i] = core::distance(work.points[i], work.points[near.back()]);
  }
  const double most = std::max(5 * core::quantile(reach, 9, 10), 0.02 * extent_of(work.points));
  std::vector<std::size_t> isolated;
  for (std::size_t i = 0; i < n; ++i) {
    if (reach[i] > most) isolated.push_back(i);
  }
  if (isolated.empty() || isolated.size() > n / 20 + 1) return;
  for (const std::size_t i : isolated) line.report.outlier_sources.push_back(work.sources[i]);
  line.report.outliers += isolated.size();
  remove_points(work, isolated);
}

void take(Working& work, Averaged averaged, KeyLine& line) {
  line.report.averaged = work.points.size();
  line.report.notes.push_back("a band of " + std::to_string(work.points.size()) +
                              " points averaged to a line of " +
                              std::to_string(averaged.points.size()));
  work.points = std::move(averaged.points);
  work.weights = std::move(averaged.weights);
  work.sources.clear();
}

void permute(Working& work, const std::vector<std::size_t>& order) {
  const auto arranged = [&](auto& values) {
    if (values.empty()) return;
    auto copy = values;
    copy.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) copy[k] = values[order[k]];
    values = std::move(copy);
  };
  arranged(work.points);
  arranged(work.weights);
  arranged(work.sources);
}

void order_anew(Working& work, const core::CancellationToken& cancellation, KeyLine& line) {
  merge_anywhere(work, line);
  if (work.points.size() < 3 || cancellation.stop_requested()) return;
  drop_isolated(work, line);
  line.report.reordered = true;
  line.report.notes.emplace_back("the points were not in order: put in order along the curve");
  if (cancellation.stop_requested()) return;
  const BandWidth band = measure_band(work.points);
  if (cancellation.stop_requested()) return;
  if (band.width > 0) {
    take(work, average_band(work.points, work.weights, band.radius), line);
    return;
  }
  if (work.points.size() > kMostOrdered) {
    take(work, average_cells(work.points, work.weights, kMostOrdered), line);
  }
  const Ordering ordering = order_points(work.points);
  line.report.apart = ordering.dropped.size();
  if (!ordering.dropped.empty()) {
    line.report.notes.push_back(core::counted(ordering.dropped.size(), "point") +
                                " apart from the curve dropped");
  }
  permute(work, ordering.order);
}

/// A stretch of consecutive points, read forward or backward.
struct Run {
  std::size_t from = 0;
  std::size_t to = 0;  // last point
  bool turned = false;
};

core::Point2 entry(const Working& work, const Run& run) {
  return work.points[run.turned ? run.to : run.from];
}
core::Point2 leave(const Working& work, const Run& run) {
  return work.points[run.turned ? run.from : run.to];
}

/// Runs between jumps that are far longer than usual steps.
std::vector<Run> runs_of(const Working& work) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < work.points.size(); ++i) {
    steps.push_back(core::distance(work.points[i - 1], work.points[i]));
  }
  const double jump = std::max(20 * core::quantile(steps), 0.1 * extent_of(work.points));
  std::vector<Run> runs{{0, 0, false}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] > jump) runs.push_back({i + 1, i + 1, false});
    runs.back().to = i + 1;
  }
  return runs;
}

double sum_of_gaps(const Working& work, const std::vector<Run>& runs) {
  double sum = 0;
  for (std::size_t k = 1; k < runs.size(); ++k) {
    sum += core::distance(leave(work, runs[k - 1]), entry(work, runs[k]));
  }
  return sum;
}

/// The arrangement found by always taking up the nearest end, from the given first run on.
std::vector<Run> arranged_from(const Working& work, std::vector<Run> rest, std::size_t first,
                               bool turned) {
  std::vector<Run> arranged{rest[first]};
  arranged[0].turned = turned;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(first));
  while (!rest.empty()) {
    const core::Point2 end = leave(work, arranged.back());
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      for (const bool flip : {false, true}) {
        Run run = rest[k];
        run.turned = flip;
        const double gap = core::distance(end, entry(work, run));
        if (gap >= nearest) continue;
        nearest = gap;
        best = k;
        rest[k].turned = flip;
      }
    }
    arranged.push_back(rest[best]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return arranged;
}

/// Puts runs end to end where that at least halves the jumps between them.
void join_runs(Working& work, KeyLine& line) {
  if (work.points.size() < 8) return;
  const std::vector<Run> runs = runs_of(work);
  const bool strays =
      std::any_of(runs.begin(), runs.end(), [](const Run& r) { return r.to - r.from < 3; });
  if (runs.size() < 2 || runs.size() > 16 || strays) return;
  std::vector<Run> best = runs;
  for (std::size_t first = 0; first < runs.size(); ++first) {
    for (const bool turned : {false, true}) {
      std::vector<Run> trial = arranged_from(work, runs, first, turned);
      if (sum_of_gaps(work, trial) < 0.999 * sum_of_gaps(work, best)) best = std::move(trial);
    }
  }
  if (sum_of_gaps(work, best) > 0.5 * sum_of_gaps(work, runs)) return;
  std::vector<std::size_t> order;
  for (const Run& run : best) {
    for (std::size_t k = 0; k <= run.to - run.from; ++k) {
      order.push_back(run.turned ? run.to - k : run.from + k);
    }
  }
  permute(work, order);
  line.report.reordered = true;
  line.report.notes.push_back(std::to_string(runs.size()) +
                              " runs of points with jumps between them put end to end");
  line.report.duplicates += merge_repeated(work);
}

/// Points of a random sample: what their order cannot tell is averaged, what is left is told.
void calm(Working& work, KeyLine& line) {
  const std::size_t averaged = average_turnbacks(work);
  if (averaged > 0)
    line.report.notes.push_back(core::counted(averaged, "point") +
                                " at which the way through the sample would turn back "
                                "averaged with their neighbours");
  const std::size_t sharp = sharp_turns(work);
  if (sharp > kFewTurns)
    line.report.notes.push_back(
        "the way through the sample turns sharply at " + std::to_string(sharp) +
        " places: corners of the shape, or points whose order the sample does not tell; look at "
        "the picture, and try another band");
}

}  // namespace

void put_in_order(Working& work, const AcquireOptions& options, KeyLine& line) {
  if (work.points.size() < 6 && !options.ordered) return;
  if (options.ordered ? *options.ordered : is_ordered(work.points, options.cancellation)) {
    if (!options.ordered) join_runs(work, line);
  } else {
    order_anew(work, options.cancellation, line);
  }
  if (work.scattered && !options.ordered.value_or(false)) calm(work, line);
}

}  // namespace keyline::acquire::detail
