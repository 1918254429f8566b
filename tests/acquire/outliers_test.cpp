#include "keyline/acquire/outliers.h"

#include <cmath>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::acquire {
namespace {

std::vector<core::Point2> ellipse_with_strays(const std::vector<std::size_t>& strays, int points) {
  std::vector<core::Point2> list;
  for (int i = 0; i < points; ++i) {
    const double t = 2 * core::kPi * i / points;
    list.push_back({300 * std::cos(t), 180 * std::sin(t)});
  }
  double out = 30;
  for (const std::size_t i : strays) {
    list[i] = list[i] + (out / core::norm(list[i] - core::Point2{})) * (list[i] - core::Point2{});
    out = -out;
  }
  return list;
}

/// Each is among the neighbours that the other is judged by.
TEST(Outliers, DoNotHideEachOtherAFewPointsApart) {
  for (const std::vector<std::size_t>& strays :
       {std::vector<std::size_t>{40, 42}, {40, 43}, {40, 41, 43}, {40, 42, 43}, {40, 42, 44}}) {
    EXPECT_EQ(find_outliers(ellipse_with_strays(strays, 120), true, 1e-6, 1), strays)
        << strays.size() << " up to " << strays.back();
  }
}

/// Also where a closed curve starts between them.
TEST(Outliers, AreFoundOnBothSidesOfTheStart) {
  for (const std::vector<std::size_t>& strays :
       {std::vector<std::size_t>{0, 119}, {1, 119}, {0, 118}, {0, 1, 119}}) {
    EXPECT_EQ(find_outliers(ellipse_with_strays(strays, 120), true, 1e-6, 1), strays)
        << strays.size() << " up to " << strays.back();
  }
}

}  // namespace
}  // namespace keyline::acquire
