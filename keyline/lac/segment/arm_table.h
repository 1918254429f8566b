#pragma once

#include <array>
#include <vector>

#include "keyline/lac/segment/arm.h"

/// Internals: an arm integrated once, to be evaluated at many points.
namespace keyline::lac::detail {

/// The vector of arm_vector as Chebyshev series of degree 16, panel by panel.
class ArmTable {
 public:
  explicit ArmTable(const Arm& arm);
  const Arm& arm() const { return arm_; }
  /// As arm_vector_at; accuracy 1e-15 of the arm's length.
  core::Vector2 vector_at(double fraction, double complement) const;
  core::Vector2 end() const { return end_; }

 private:
  static constexpr int kOrder = 16;
  struct Series {
    double from = 0;
    double to = 0;
    bool straight = false;
    core::Vector2 origin;     ///< where the panel begins
    core::Vector2 direction;  ///< of a straight panel
    double arc = 0;           ///< fraction of the length where a straight panel begins
    std::array<core::Vector2, kOrder + 1> coefficient{};
  };
  void add_series(Series& series, const Panel& panel) const;
  core::Vector2 value(const Series& series, double lambda, double fraction) const;

  Arm arm_;
  std::vector<Series> series_;
  core::Vector2 end_;
};

}  // namespace keyline::lac::detail
