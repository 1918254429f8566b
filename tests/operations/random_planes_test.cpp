#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "random_curves.h"
#include "worst.h"

/// curve.plane and curve.diagrams, asked at random (see random_requests_test.cpp).
namespace keyline::operations {
namespace {

using namespace own;
using Complex = std::complex<double>;

/// Control points of the curve of one matrix, first edge 1.
std::vector<Complex> matrix_points(double alpha, double s, int degree) {
  std::vector<Complex> points{0};
  Complex edge = 1;
  for (int i = 0; i < degree; ++i) {
    points.push_back(points.back() + edge);
    edge *= std::polar(s, alpha);
  }
  return points;
}
/// Strain energy of such a curve whose ends are `chord` apart.
double matrix_energy(double alpha, double s, int degree, double chord) {
  Bezier b;
  for (const Complex& p : matrix_points(alpha, s, degree)) b.push_back({p.real(), p.imag(), 0, 1});
  return energy_of(b) * std::abs(matrix_points(alpha, s, degree).back()) / chord;
}

TEST(RandomPlanes, ShowTheEnergiesAndPlacesOfTheirCurves) {
  Random random(own::seed(53));
  Worst worst_energy("energy"), worst_reach("reach");
  int shown = 0;
  for (int n = 0; n < requests(0.01); ++n) {
    const int degree = 2 + static_cast<int>(random() % 5);
    const double alpha = uniform(random, 0.05, 1), s = uniform(random, 0.6, 2);
    const double beta = power_of_ten(random, -2, 2);
    const json request{{"op", "curve.plane"}, {"alpha", alpha},   {"s", s},
                       {"beta", beta},        {"degree", degree}, {"direction", "as-given"}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == false) {  // held against a search in random_refusals_test.cpp
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      continue;
    }
    ++shown;
    const json& result = answer["result"];
    const Complex end = matrix_points(alpha, s, degree).back();
    const double chord = beta * std::abs(end);
    const auto rows = result["energy"].size(), columns = result["energy"][0].size();
    for (int k = 0; k < 12; ++k) {
      const std::size_t i = random() % rows, j = 1 + random() % (columns - 1);
      const double a = std::lerp(result["alpha"][0].get<double>(), result["alpha"][1].get<double>(),
                                 static_cast<double>(j) / static_cast<double>(columns - 1));
      const double at = std::lerp(result["s"][0].get<double>(), result["s"][1].get<double>(),
                                  static_cast<double>(i) / static_cast<double>(rows - 1));
      const double energy = matrix_energy(a, at, degree, chord);
      worst_energy.expect_below(std::abs(result["energy"][i][j].get<double>() / energy - 1), 1e-7);
    }
    for (const json& p : result["growing"])
      EXPECT_NEAR(p[1].get<double>() * std::cos(p[0].get<double>()), 1, 1e-12);
    for (const json& p : result["falling"])
      EXPECT_NEAR(p[1].get<double>(), std::cos(p[0].get<double>()), 1e-12);
    EXPECT_FALSE(result["reach"].empty());
    for (const json& p : result["reach"]) {
      const Complex there = matrix_points(p[0], p[1], degree).back();
      worst_reach.expect_below(std::abs(std::arg(there / end)), 1e-9);
    }
    json cav = request;
    cav["op"] = "curve.cav";
    EXPECT_EQ(result["value"], result_of(cav));
  }
  EXPECT_GT(shown, requests(0.01) / 4);
}

/// Found at random: no places for curves whose chord lies more than half way round.
TEST(RandomPlanes, PlacesOfACurveThatTurnsFar) {
  const double alpha = 0.9096554632005563, s = 1.6131604046199874;
  const json result = result_of({{"op", "curve.plane"},
                                 {"alpha", alpha},
                                 {"s", s},
                                 {"degree", 6},
                                 {"direction", "as-given"}});
  const Complex end = matrix_points(alpha, s, 6).back();
  ASSERT_LT(std::arg(end), 0);
  double nearest = INFINITY;
  for (const json& p : result["reach"]) {
    EXPECT_NEAR(std::arg(matrix_points(p[0], p[1], 6).back() / end), 0, 1e-9);
    nearest = std::min(nearest, std::hypot(p[0].get<double>() - alpha, p[1].get<double>() - s));
  }
  EXPECT_LT(nearest, 0.05);
}

/// Samples of a curve's Béziers at equal steps of its length: how many radii fall into each bin of
/// 0.05 of log10(radius / length), from -3 on.
std::vector<int> bins_of(const std::vector<Bezier>& curve, int samples) {
  std::vector<double> lengths, radii;
  double length = 0;
  for (const Bezier& c : curve) {
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double middle = (i + 0.5) / kSteps;
      const Spot s = spot(c, middle);
      length += size(s.first) / kSteps;
      lengths.push_back(length);
      radii.push_back(1 / std::abs(curvature(s)));
    }
  }
  std::vector<int> bins(100, 0);
  std::size_t at = 0;
  for (int k = 0; k <= samples; ++k) {
    while (at + 1 < lengths.size() && lengths[at] < length * k / samples) ++at;
    const double bin = (std::log10(radii[at] / length) + 3) / 0.05;
    if (bin >= 0 && bin < 100) ++bins[static_cast<std::size_t>(bin)];
  }
  return bins;
}

/// Counts at the edges of bins may differ by what one place is off: never more than a few.
void expect_bars(const json& lddc, const std::vector<int>& bins) {
  for (const json& bar : lddc["bars"]) {
    const auto bin = static_cast<std::size_t>(std::lround((bar["low"].get<double>() + 3) / 0.05));
    ASSERT_LT(bin, bins.size());
    EXPECT_NEAR(bar["count"].get<int>(), bins[bin], 4) << bar;
    EXPECT_NEAR(bar["height"].get<double>(), std::log10(bar["count"].get<double>() / 1000), 2e-3)
        << bar;
  }
}

/// Share of the pairs that both numbers order: the paper's index falls as the volume grows. Pairs
/// of which either number is equal tell nothing.
double agreement(const std::vector<double>& index, const std::vector<double>& volume) {
  int same = 0, all = 0;
  const auto differ = [](double a, double b) {
    return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b));
  };
  for (std::size_t i = 0; i < index.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!differ(index[i], index[j]) || !differ(volume[i], volume[j])) continue;
      ++all;
      same += (index[i] < index[j]) == (volume[i] > volume[j]);
    }
  return all == 0 ? NAN : static_cast<double>(same) / all;
}

TEST(RandomPlanes, DiagramsTellLengthsVolumesAndBars) {
  Random random(own::seed(54));
  Worst worst("length and volume");
  for (int n = 0; n < requests(0.01); ++n) {
    json curves = json::array();
    const std::size_t count = 1 + random() % 4;
    for (std::size_t i = 0; i < count; ++i)
      curves.push_back({{"type", "bezier"},
                        {"points", any_points(random, 3 + random() % 4, any_frame(random), true)}});
    const json request{{"op", "curve.diagrams"}, {"curves", curves}};
    SCOPED_TRACE(digest(request));
    const json result = result_of(request);
    ASSERT_EQ(result["sections"].size(), count);
    std::vector<double> index, volume;
    for (std::size_t i = 0; i < count; ++i) {
      const json& section = result["sections"][i];
      const auto beziers = beziers_of(curves[i]);
      const double length = length_of(beziers);
      worst.expect_below(std::abs(section["length"].get<double>() / length - 1), 1e-9);
      worst.expect_below(
          std::abs(section["volume"].get<double>() - volume_of(beziers)) / (length * length), 1e-9);
      EXPECT_NEAR(section["relative_volume"].get<double>(),
                  section["volume"].get<double>() / (length * length), 1e-12);
      double sum = 0;
      for (const json& p : section["pieces"]) sum += p["length"].get<double>();
      EXPECT_NEAR(sum / length, 1, 1e-6);
      expect_bars(section["lddc"], bins_of(beziers, 1000));
      if (section["lddc"]["c_curve"].empty()) continue;  // not drawn
      index.push_back(section["lddc"]["distance_ab"]);
      volume.push_back(section["relative_volume"]);
      for (const json& p : section["lddc"]["c_curve"])
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const json& range = result["joint"][axis == 0 ? "x" : "y"];
          EXPECT_GE(p[axis].get<double>(), range[0].get<double>());
          EXPECT_LE(p[axis].get<double>(), range[1].get<double>());
        }
    }
    const double share = agreement(index, volume);
    EXPECT_EQ(result["joint"]["agreement"].is_null(), std::isnan(share));
    if (!std::isnan(share)) {
      EXPECT_NEAR(result["joint"]["agreement"].get<double>(), share, 1e-12);
    }
    for (const json& other : {mirrored(curves[0]), scaled(curves[0], 8)}) {
      const json twin = result_of({{"op", "curve.diagrams"}, {"curves", {other}}})["sections"][0];
      EXPECT_NEAR(twin["relative_volume"].get<double>(),
                  result["sections"][0]["relative_volume"].get<double>(), 1e-12);
      EXPECT_EQ(twin["pieces"].size(), result["sections"][0]["pieces"].size());
    }
  }
}

}  // namespace
}  // namespace keyline::operations
