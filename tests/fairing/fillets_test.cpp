#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"

#include "truth.h"

/// Straights and the arcs between them, as drawn with ruler and compass.
namespace keyline::fairing {
namespace {

/// Straights with arcs of these turnings and radii between them.
struct Fillets {
  std::vector<double> straight;
  std::vector<double> turn;
  std::vector<double> radius;

  double length() const {
    double sum = 0;
    for (const double s : straight) sum += s;
    for (std::size_t i = 0; i < turn.size(); ++i) sum += std::abs(turn[i]) * radius[i];
    return sum;
  }

  core::Point2 at(double s) const {
    core::Point2 place{0, 0};
    double direction = 0;
    for (std::size_t i = 0; i < straight.size() && s > 0; ++i) {
      const double along = std::min(s, straight[i]);
      place = place + along * core::unit_vector(direction);
      s -= along;
      if (i == turn.size() || s <= 0) break;
      const double angle = std::copysign(std::min(s / radius[i], std::abs(turn[i])), turn[i]);
      const double chord = 2 * radius[i] * std::sin(std::abs(angle) / 2);
      place = place + chord * core::unit_vector(direction + angle / 2);
      direction += angle;
      s -= std::abs(angle) * radius[i];
    }
    return place;
  }

  /// Hills of its curvature, and valleys between two that turn one way.
  int waves() const {
    int count = static_cast<int>(turn.size());
    for (std::size_t i = 1; i < turn.size(); ++i) count += turn[i - 1] * turn[i] > 0 ? 1 : 0;
    return count;
  }
};

FairResult faired(const Fillets& fillets, int count, double noise) {
  std::mt19937_64 dice(static_cast<unsigned>(count));
  std::normal_distribution<double> normal;
  const double size = noise * fillets.length();
  std::vector<core::Point2> points;
  for (int i = 0; i < count; ++i) {
    const core::Point2 p = fillets.at(fillets.length() * i / (count - 1));
    points.push_back({p.x + size * normal(dice), p.y + size * normal(dice)});
  }
  return fair(testing::line_through(points)).value();
}

// Counter-bends before and behind a fillet save energy, but nothing in the points asks for them.
TEST(Fillets, HaveNoWavesBesideThem) {
  const Fillets one{{2.86, 1.87}, {1.25}, {0.63}};
  const Fillets s{{1, 1.4, 1.2}, {0.9, -0.7}, {0.4, 0.6}};
  const Fillets two{{1.5, 1, 2}, {0.8, 1.1}, {0.5, 0.3}};
  struct Case {
    const Fillets& fillets;
    int count;
    double noise;
  };
  for (const auto& [fillets, count, noise] :
       {Case{one, 40, 0}, Case{one, 100, 0}, Case{one, 120, 1e-4}, Case{s, 60, 0},
        Case{s, 300, 4e-4}, Case{two, 60, 1e-4}, Case{two, 300, 4e-4}}) {
    SCOPED_TRACE(count);
    const FairResult result = faired(fillets, count, noise);
    EXPECT_TRUE(result.within_tolerance);
    EXPECT_LE(result.fairness.answer.waves, fillets.waves()) << noise;
    EXPECT_TRUE(result.fairness.fair) << noise;
  }
}

}  // namespace
}  // namespace keyline::fairing
