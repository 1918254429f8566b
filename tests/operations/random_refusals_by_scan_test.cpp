#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "own_gauss.h"
#include "random_values.h"

/// Refusals of lac.volume and of the forms of lac.quasi that are polygons, held against searches of
/// another kind (see random_refusals_test.cpp).
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::Random;
using own::refusals;
using own::uniform;
using Complex = std::complex<double>;

/// A piece of a curve that turns by theta, its larger end radius 1: where it leads from the origin
/// along x, and the area between it and its chord.
struct Swept {
  Complex end;
  double area = 0;
};

/// Curvature grows by e^growth. By the law of the radius in the tangent angle, in panels that are
/// close at both ends, each as an arc over its chord.
Swept swept(double alpha, double theta, double growth) {
  const double first = growth > 0 ? 1 : std::exp(growth);
  const double last = growth > 0 ? std::exp(-growth) : 1;
  const auto radius = [&](double from_first, double from_last) {  // both shares, neither rounded
    if (std::abs(alpha - 1) < 1e-9) return std::pow(first, from_last) * std::pow(last, from_first);
    return std::pow(from_last * std::pow(first, alpha - 1) + from_first * std::pow(last, alpha - 1),
                    1 / (alpha - 1));
  };
  Swept s;
  const auto panel = [&](double low, double high, bool from_end) {
    const auto rho = [&](double x) { return from_end ? radius(1 - x, x) : radius(x, 1 - x); };
    const auto turned = [&](double x) { return theta * (from_end ? 1 - x : x); };
    const Complex step =
        theta * own::gauss([&](double x) { return std::polar(rho(x), turned(x)); }, low, high);
    const double bend = theta * (high - low), middle = rho(0.5 * (low + high));
    s.area +=
        0.5 * (std::conj(s.end) * step).imag() + 0.5 * middle * middle * (bend - std::sin(bend));
    s.end += step;
  };
  constexpr int kHalvings = 50, kParts = 16;
  const auto edge = [](int i) {  // halvings to 1/8, equal parts from there to the middle
    return i == 0           ? 0
           : i <= kHalvings ? std::exp2(i - kHalvings - 3)
                            : 0.125 + 0.375 * (i - kHalvings) / kParts;
  };
  for (int i = 0; i < kHalvings + kParts; ++i) panel(edge(i), edge(i + 1), false);
  for (int i = kHalvings + kParts; i > 0; --i) panel(edge(i - 1), edge(i), true);
  return s;
}

/// The growth of curvature at which the chord lies at psi from the first tangent, nearly.
std::optional<Swept> with_chord_at(double alpha, double theta, double psi) {
  const auto angle = [&](double growth) { return std::arg(swept(alpha, theta, growth).end); };
  double low = -40, high = 40;  // curvature that grows turns late: the chord stays low
  if (angle(low) < psi || angle(high) > psi) return std::nullopt;
  for (int k = 0; k < 24; ++k) {
    const double middle = 0.5 * (low + high);
    (angle(middle) > psi ? low : high) = middle;
  }
  return swept(alpha, theta, 0.5 * (low + high));
}

/// Least and largest area of the curves found, with a chord of 1 at psi from the first tangent.
std::pair<double, double> volumes_found(double alpha, double psi) {
  double least = INFINITY, most = 0;
  constexpr int kTurnings = 24;
  for (int i = 1; i <= kTurnings; ++i) {
    const double share = i / (kTurnings + 1.0);  // small volumes lie next to the least turning
    const double theta = std::lerp(psi, psi + std::numbers::pi, share * share);
    const auto found = with_chord_at(alpha, theta, psi);
    if (!found) continue;
    const double area = std::abs(found->area) / std::norm(found->end);
    least = std::min(least, area);
    most = std::max(most, area);
  }
  return {least, most};
}

/// Every curve found has a volume that exists; volumes between them exist as well.
TEST(RandomRefusals, NoVolumeIsFoundByScanningAllTurnings) {
  Random random(own::seed(44));
  const int wanted = refusals(60);
  int refused = 0, answered_ = 0, found = 0;
  for (int n = 0; refused < wanted && n < 100 * wanted; ++n) {
    const double alpha = uniform(random, -3, 3), psi = uniform(random, 0.1, 1.2);
    const double volume = std::pow(10, uniform(random, -2.5, -0.3));
    const json request{{"op", "lac.volume"},
                       {"points", {{0, 0}, {1, 0}}},
                       {"direction", -psi},
                       {"alpha", alpha},
                       {"volume", volume}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == true && answered_ == 24) continue;
    const auto [least, most] = volumes_found(alpha, psi);
    if (answer["ok"] == true) {
      ++answered_;
      found += volume > least && volume < most;
      continue;
    }
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    EXPECT_FALSE(volume > least * 1.002 && volume < most * 0.998) << least << ' ' << most << answer;
  }
  EXPECT_EQ(refused, wanted);
  EXPECT_GE(found, 8);  // of 24 that exist: no inflections, few turnings, radii to e^40 apart
}

constexpr double kShortest = 1e-8;  ///< end edge, of the chord, whose direction outlasts rounding

/// A polygon that turns by theta between its first and last edge: what the forms draw. `growth` is
/// that of the radius over the whole target. NaN where an end edge is too short to be one.
double polygon_chord_angle(bool by_angle, double alpha, int edges, double theta, double growth) {
  const auto mean = [](double exponent, double ratio, double u) {
    if (std::abs(exponent) < 1e-9) return std::pow(ratio, u);
    return std::pow(1 - u + u * std::pow(ratio, exponent), 1 / exponent);
  };
  Complex end = 0;
  double shortest = INFINITY;
  if (by_angle) {  // parts of equal angle: edges as long as the parts
    for (int j = 0; j < edges; ++j) {
      const double part =
          own::integral([&](double u) { return mean(alpha - 1, std::exp(growth), u); },
                        static_cast<double>(j) / edges, (j + 1.0) / edges);
      end += std::polar(part, theta * j / (edges - 1));
      if (j == 0 || j + 1 == edges) shortest = std::min(shortest, part);
    }
    return shortest > kShortest * std::abs(end) ? std::arg(end) : NAN;
  }
  std::vector<double> turned;  // parts of equal length: edges along their middles
  double sum = 0;
  for (int j = 0; j < edges; ++j) {
    if (j > 0)
      sum += own::integral([&](double v) { return mean(-alpha, std::exp(-growth), v); },
                           (j - 0.5) / edges, (j + 0.5) / edges);
    turned.push_back(sum);
  }
  for (const double angle : turned) end += std::polar(1.0, theta * angle / sum);
  return std::arg(end);
}

bool finds_polygon(bool by_angle, double alpha, int edges, double theta, double psi) {
  double before = NAN;
  for (double growth = -40; growth <= 40; growth += 0.25) {
    const double off = polygon_chord_angle(by_angle, alpha, edges, theta, growth) - psi;
    if (before * off < 0 && std::abs(off - before) < 1) return true;
    if (std::isfinite(off)) before = off;
  }
  return false;
}

TEST(RandomRefusals, NoPolygonOfAQuasiFormIsFoundByScanningAllRatios) {
  Random random(own::seed(45));
  const int wanted = refusals(30);
  int refused = 0, answered_ = 0;
  for (int n = 0; refused < wanted && n < 200 * wanted; ++n) {
    const double theta = uniform(random, 0.2, 2.5), psi = theta * uniform(random, 0.05, 0.95);
    const double alpha = uniform(random, -3, 3), s = std::sin(theta - psi) / std::sin(theta);
    const bool by_angle = random() % 2 == 0;
    const int degree = 5 + static_cast<int>(random() % 6);
    const json request{{"op", "lac.quasi"},
                       {"points", {{0, 0}, {s * std::cos(psi), -s * std::sin(psi)}, {1, 0}}},
                       {"alpha", alpha},
                       {"form", by_angle ? "discrete-angle" : "discrete-arc"},
                       {"degree", degree}};
    const json answer = answered(request);
    SCOPED_TRACE(request.dump() + answer.dump());
    if (answer["ok"] == true) {
      if (answered_ == 20) continue;
      ++answered_;
      EXPECT_TRUE(finds_polygon(by_angle, alpha, degree, theta, psi));
      continue;
    }
    ASSERT_EQ(answer["error"]["code"], "undrawable");
    const std::string why = answer["error"]["message"];
    if (why.find("no Lambda") == std::string::npos) continue;  // that of the target itself
    ++refused;
    EXPECT_FALSE(finds_polygon(by_angle, alpha, degree, theta, psi));
  }
  EXPECT_EQ(refused, wanted);
}

}  // namespace
}  // namespace keyline::operations
