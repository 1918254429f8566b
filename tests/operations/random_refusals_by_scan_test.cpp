#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "own_numerics.h"

/// Refusals of lac.volume and of the forms of lac.quasi that are polygons, held against searches of
/// another kind (see random_refusals_test.cpp).
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::uniform;
using Random = std::mt19937_64;
using Complex = std::complex<double>;

int refusals(int plain) { return std::getenv("KEYLINE_FULL") ? 1000 : plain; }

/// A piece that turns by theta and whose curvature grows by e^growth; its length is 1.
own::Track turning_by(double alpha, double theta, double growth) {
  json curve{{"start", {0, 0}}, {"direction", 0}};
  double scale = 1;
  // Turning is proportional to curvature.
  for (int twice = 0; twice < 2; ++twice) {
    const double k0 = scale * std::exp(-growth / 2), k1 = scale * std::exp(growth / 2);
    curve["pieces"] = {{{"alpha", alpha}, {"length", 1}, {"curvature", {k0, k1}}}};
    if (twice == 0) {
      // By the integral of the power mean of both ends, in panels: no quadrature of the curve yet.
      const auto law = [&](double v) {
        const double base = std::exp(-growth / 2);
        if (std::abs(alpha) < 1e-9) return base * std::exp(growth * v);
        return base * std::pow(1 - v + v * std::exp(-alpha * growth), -1 / alpha);
      };
      scale = theta / own::integral(law, 0, 1);
    }
  }
  return own::walked(curve);
}

/// The growth of curvature at which the chord lies at psi from the first tangent, nearly.
std::optional<own::Track> with_chord_at(double alpha, double theta, double psi) {
  const auto angle = [](const own::Track& t) { return std::atan2(t.end().y, t.end().x); };
  double low = -40, high = 40;  // curvature that grows turns late: the chord stays low
  own::Track at_low = turning_by(alpha, theta, low);
  if (angle(at_low) < psi || angle(turning_by(alpha, theta, high)) > psi) return std::nullopt;
  for (int k = 0; k < 20; ++k) {
    const double middle = 0.5 * (low + high);
    (angle(turning_by(alpha, theta, middle)) > psi ? low : high) = middle;
  }
  return turning_by(alpha, theta, 0.5 * (low + high));
}

/// Least and largest area of the curves found, with a chord of 1 at psi from the first tangent.
std::pair<double, double> volumes_found(double alpha, double psi) {
  double least = INFINITY, most = 0;
  constexpr int kTurnings = 24;
  for (int i = 1; i <= kTurnings; ++i) {
    const double share = i / (kTurnings + 1.0);  // small volumes lie next to the least turning
    const double theta = std::lerp(psi, 1.2 * std::numbers::pi, share * share);
    const auto track = with_chord_at(alpha, theta, psi);
    if (!track) continue;
    const double chord = std::hypot(track->end().x, track->end().y);
    const double area = std::abs(track->area) / (chord * chord);
    least = std::min(least, area);
    most = std::max(most, area);
  }
  return {least, most};
}

/// Every curve found has a volume that exists; volumes between them exist as well.
TEST(RandomRefusals, NoVolumeIsFoundByScanningAllTurnings) {
  Random random(own::seed(44));
  const int wanted = refusals(8);
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
    if (answer["ok"] == true && answered_ == 8) continue;
    const auto [least, most] = volumes_found(alpha, psi);
    if (answer["ok"] == true) {
      ++answered_;
      found += volume > least && volume < most;
      continue;
    }
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    EXPECT_FALSE(volume > least * 1.01 && volume < most * 0.99) << least << ' ' << most << answer;
  }
  EXPECT_EQ(refused, wanted);
  EXPECT_GT(found, 0);  // of what exists the search does find some: it goes but to 1.2 half turns
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
