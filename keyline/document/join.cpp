#include "keyline/document/join.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/document/path_gap.h"

namespace keyline::document {
namespace {

using core::Point2;

/// A curve as it is run through.
struct Run {
  std::size_t curve = 0;
  bool backwards = false;
};

/// Curves in an order and direction in which each goes on from the one before it.
class Trail {
 public:
  /// As far as it comes from the first of the curves. Precondition: there is one.
  Trail(const std::vector<Path>& curves, bool first_backwards, double gap) : gap_(gap) {
    for (const Path& c : curves) ends_.push_back({evaluate(c, 0), evaluate(c, 1)});
    left_.resize(curves.size() - 1);
    std::iota(left_.begin(), left_.end(), std::size_t{1});
    runs_.push_back({0, first_backwards});
    const std::vector<Run> rest = walk(end());
    runs_.insert(runs_.end(), rest.begin(), rest.end());
    put_in_loops();
  }

  const std::vector<Run>& runs() const { return runs_; }
  bool is_whole() const { return left_.empty(); }
  Point2 end() const { return end_of(runs_.back()); }
  /// From its end to the nearest end left over.
  double to_next() const { return nearest(end()).away; }
  double largest_gap() const {
    double most = 0;
    for (std::size_t i = 1; i < runs_.size(); ++i)
      most = std::max(most, distance(end_of(runs_[i - 1]), start_of(runs_[i])));
    return most;
  }

 private:
  struct Next {
    Run run;
    double away = std::numeric_limits<double>::infinity();
  };

  Point2 start_of(const Run& r) const { return ends_[r.curve][r.backwards ? 1 : 0]; }
  Point2 end_of(const Run& r) const { return ends_[r.curve][r.backwards ? 0 : 1]; }

  /// Of curves left over, the first of those equally near.
  Next nearest(Point2 to) const {
    Next best;
    for (const std::size_t i : left_)
      for (const bool turned : {false, true})
        if (const double away = distance(to, start_of({i, turned})); away < best.away)
          best = {{i, turned}, away};
    return best;
  }

  /// On from there with the nearest curve that is left while there is one.
  std::vector<Run> walk(Point2 from) {
    std::vector<Run> way;
    for (Next next = nearest(from); next.away <= gap_; next = nearest(end_of(next.run))) {
      way.push_back(next.run);
      left_.erase(std::ranges::lower_bound(left_, next.run.curve));
    }
    return way;
  }

  void put_in_loops() {
    for (std::size_t i = 1; i < runs_.size() && !left_.empty(); ++i) {
      std::vector<Run> loop = walk(end_of(runs_[i - 1]));
      for (; !loop.empty() && !(distance(end_of(loop.back()), start_of(runs_[i])) <= gap_);
           loop.pop_back())
        left_.insert(std::ranges::lower_bound(left_, loop.back().curve), loop.back().curve);
      runs_.insert(runs_.begin() + static_cast<std::ptrdiff_t>(i), loop.begin(), loop.end());
    }
  }

  double gap_;
  std::vector<std::array<Point2, 2>> ends_;
  std::vector<std::size_t> left_;  ///< in order
  std::vector<Run> runs_;
};

/// The first curve as given if that leaves none over, else the way round that leaves fewer.
Trail longest_trail(const std::vector<Path>& curves, double gap) {
  Trail forwards(curves, false, gap);
  if (forwards.is_whole()) return forwards;
  Trail backwards(curves, true, gap);
  return backwards.runs().size() > forwards.runs().size() ? backwards : forwards;
}

}  // namespace

core::Result<Joined> joined(const std::vector<Path>& curves, double gap) {
  const Trail trail = longest_trail(curves, gap);
  if (!trail.is_whole()) {
    const Point2 end = trail.end();
    return core::fail(core::ErrorCode::undrawable,
                      "the nearest end is " + core::number_text(trail.to_next(), 6) +
                          " away from (" + core::number_text(end.x, 6) + ", " +
                          core::number_text(end.y, 6) + ")",
                      "allow a larger gap with the tolerance, or blend the curves", "tolerance");
  }
  Joined made;
  made.gap = trail.largest_gap();
  for (const Run& run : trail.runs()) {
    if (run.backwards) made.reversed.push_back(run.curve);
    const Path next = run.backwards ? reverse(curves[run.curve]) : curves[run.curve];
    made.path.curves.insert(made.path.curves.end(), next.curves.begin(), next.curves.end());
  }
  const double closing = distance(evaluate(made.path, 1), evaluate(made.path, 0));
  made.path.closed = made.path.curves.size() > 1 && closing <= gap;
  if (made.path.closed) made.gap = std::max(made.gap, closing);
  close_gaps(made.path);
  return made;
}

}  // namespace keyline::document
