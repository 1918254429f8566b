#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::sketch {

/// A stroke as points at even steps with unit tangents.
struct SampledStroke {
  std::vector<core::Point2> points;
  std::vector<core::Vector2> tangents;
  double length = 0;
  bool closed = false;
};

/// Tangents are taken over two points on either side. At least two points come out.
SampledStroke sample_stroke(const std::vector<core::Point2>& points, bool closed, double step);

/// Points of strokes by square cells.
class StrokeGrid {
 public:
  StrokeGrid(const std::vector<SampledStroke>& strokes, double cell)
      : strokes_(strokes), cell_(cell) {
    for (std::size_t s = 0; s < strokes.size(); ++s)
      for (std::size_t i = 0; i < strokes[s].points.size(); ++i)
        cells_[key(strokes[s].points[i])].emplace_back(s, i);
  }

  /// Calls see(stroke, index) for every point within `reach` (at most one cell) of p.
  template <class See>
  void visit(core::Point2 p, double reach, const See& see) const {
    visit_others(p, reach, strokes_.size(), see);
  }

  /// The same, without the points of one stroke.
  template <class See>
  void visit_others(core::Point2 p, double reach, std::size_t own, const See& see) const {
    const double far = reach * reach * (1 + 1e-9);  // surely
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key({p.x + dx * cell_, p.y + dy * cell_}));
        if (found == cells_.end()) continue;
        for (const auto& [s, i] : found->second) {
          if (s == own) continue;
          const core::Vector2 way = strokes_[s].points[i] - p;
          if (dot(way, way) <= far && core::norm(way) <= reach) see(s, i);
        }
      }
  }

 private:
  std::int64_t key(core::Point2 p) const {
    const auto cell = [this](double v) { return static_cast<std::int64_t>(std::floor(v / cell_)); };
    return cell(p.x) * 1000003 + cell(p.y);
  }

  const std::vector<SampledStroke>& strokes_;
  double cell_;
  std::unordered_map<std::int64_t, std::vector<std::pair<std::size_t, std::size_t>>> cells_;
};

}  // namespace keyline::sketch
