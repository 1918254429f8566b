#include "keyline/sketch/align_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr int kLargestStep = 3;       ///< samples of the line per sample of the stroke
constexpr double kOffCost = 4;        ///< reaches squared: of a sample before or after the line
constexpr double kTurnCost = 1;       ///< reaches squared: of a direction off by a right angle
constexpr double kFarCost = 8;        ///< reaches squared: of a sample far off beside the line
constexpr std::int8_t kStart = 100;   ///< came from before the line
constexpr std::int8_t kNothing = -1;  ///< no way here

/// Least cost over the states of one sample: before the line, at sample j of it, after it.
class Way {
 public:
  Way(const SampledStroke& stroke, const SampledStroke& line, double reach, bool reversed)
      : stroke_(stroke),
        line_(line),
        reversed_(reversed),
        n_(static_cast<int>(stroke.points.size())),
        m_(static_cast<int>(line.points.size())),
        unit_(reach * reach),
        from_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(m_), kNothing),
        left_(static_cast<std::size_t>(n_), -1) {}

  Alignment find() {
    std::vector<double> here(static_cast<std::size_t>(m_));
    std::vector<double> next(here.size());
    for (int j = 0; j < m_; ++j) here[static_cast<std::size_t>(j)] = cost(0, j);
    double before = kOffCost * unit_;
    double after = std::numeric_limits<double>::infinity();
    for (int i = 1; i < n_; ++i) {
      const double leave = here[static_cast<std::size_t>(m_ - 1)];
      for (int j = 0; j < m_; ++j) next[static_cast<std::size_t>(j)] = best(here, before, i, j);
      if (!line_.closed && leave < after) {
        left_[static_cast<std::size_t>(i)] = 1;
        after = leave;
      }
      after += kOffCost * unit_;
      before += kOffCost * unit_;
      here.swap(next);
    }
    return trace_back(here, after);
  }

 private:
  std::size_t sample(int i) const { return static_cast<std::size_t>(reversed_ ? n_ - 1 - i : i); }
  std::int8_t& from(int i, int j) {
    return from_[static_cast<std::size_t>(i) * static_cast<std::size_t>(m_) +
                 static_cast<std::size_t>(j)];
  }

  double cost(int i, int j) const {
    const Point2 p = stroke_.points[sample(i)];
    const Vector2 t = stroke_.tangents[sample(i)];
    const auto k = static_cast<std::size_t>(j);
    const Vector2 d = p - line_.points[k];
    const double along = core::dot(t, line_.tangents[k]) * (reversed_ ? -1 : 1);
    return std::min(core::dot(d, d) + kTurnCost * unit_ * (1 - along), kFarCost * unit_);
  }

  /// Least cost of sample i at sample j of the line, from sample i - 1.
  double best(const std::vector<double>& here, double before, int i, int j) {
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= kLargestStep; ++step) {
      int k = j - step;
      if (k < 0) {
        if (!line_.closed || k + m_ < 0) break;
        k += m_;
      }
      if (here[static_cast<std::size_t>(k)] >= least) continue;
      least = here[static_cast<std::size_t>(k)];
      from(i, j) = static_cast<std::int8_t>(step);
    }
    if (!line_.closed && j <= kLargestStep && before < least) {
      least = before;
      from(i, j) = kStart;
    }
    return least + cost(i, j);
  }

  Alignment trace_back(const std::vector<double>& last, double after) {
    Alignment result;
    result.reversed = reversed_;
    result.at.assign(static_cast<std::size_t>(n_), Alignment::kBefore);
    int j = static_cast<int>(std::min_element(last.begin(), last.end()) - last.begin());
    result.cost = last[static_cast<std::size_t>(j)];
    int i = n_ - 1;
    if (after < result.cost) {
      result.cost = after;
      for (bool found = false; i > 0 && !found; --i) {
        result.at[static_cast<std::size_t>(i)] = Alignment::kAfter;
        found = left_[static_cast<std::size_t>(i)] == 1;
      }
      j = m_ - 1;
    }
    for (; i >= 0; --i) {
      result.at[static_cast<std::size_t>(i)] = j;
      if (i == 0) break;
      const std::int8_t step = from(i, j);
      if (step == kStart) break;
      j -= step;
      if (j < 0) j += m_;
    }
    return result;
  }

  const SampledStroke& stroke_;
  const SampledStroke& line_;
  bool reversed_;
  int n_;
  int m_;
  double unit_;
  std::vector<std::int8_t> from_;
  std::vector<std::int8_t> left_;  ///< 1 where the way past the end begins anew at this sample
};

}  // namespace

Alignment align(const SampledStroke& stroke, const SampledStroke& line, double reach) {
  Alignment forward = Way(stroke, line, reach, false).find();
  Alignment backward = Way(stroke, line, reach, true).find();
  return backward.cost < forward.cost ? backward : forward;
}

}  // namespace keyline::sketch
