#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "own_gauss.h"
#include "own_numerics.h"
#include "random_curves.h"
#include "worst.h"

/// lac.drag and lac.taylor, asked at random (see random_requests_test.cpp).
namespace keyline::operations {
namespace {

using namespace own;
using Complex = std::complex<double>;

/// Curvature of a piece at a fraction of its length, by the law of its slope; of one sign.
double curvature_at(const json& p, double v) {
  const double alpha = p["alpha"], k0 = p["curvature"][0], k1 = p["curvature"][1];
  if (alpha == 0) return k0 * std::pow(k1 / k0, v);
  return k0 * std::pow(1 - v + v * std::pow(k1 / k0, -alpha), -1 / alpha);
}

/// The curve with a joint at a fraction of its length, and which one that is.
std::pair<json, std::size_t> cut_at(const json& curve, double at) {
  double left = 0;
  for (const json& p : curve["pieces"]) left += at * p["length"].get<double>();
  json cut = curve;
  cut["pieces"] = json::array();
  std::size_t joint = 0;
  for (const json& p : curve["pieces"]) {
    const double length = p["length"];
    if (joint == 0 && left < length) {
      json first = p, second = p;
      first["length"] = left;
      second["length"] = length - left;
      first["curvature"][1] = second["curvature"][0] = curvature_at(p, left / length);
      cut["pieces"].push_back(first);
      joint = cut["pieces"].size();
      cut["pieces"].push_back(second);
    } else {
      cut["pieces"].push_back(p);
    }
    left -= length;
  }
  return {cut, joint};
}

/// What a drag may change: curvature of each joint in units of the mean length of the pieces, or
/// its logarithm beside slopes from 0 on; then the logarithm of each length.
struct DragLaw {
  json base;
  double unit = 1;

  std::size_t pieces() const { return base["pieces"].size(); }
  bool by_logarithm(std::size_t joint) const {
    const auto steep = [&](std::size_t piece) { return base["pieces"][piece]["alpha"] >= 0.0; };
    return (joint > 0 && steep(joint - 1)) || (joint < pieces() && steep(joint));
  }
  std::vector<double> numbers(const json& curve) const {
    std::vector<double> all;
    for (std::size_t j = 0; j <= pieces(); ++j) {
      const json& p = curve["pieces"][j == 0 ? 0 : j - 1];
      const double k = p["curvature"][j == 0 ? 0 : 1];
      all.push_back(by_logarithm(j) ? std::log(std::abs(k)) : k * unit);
    }
    for (const json& p : curve["pieces"]) all.push_back(std::log(p["length"].get<double>()));
    return all;
  }
  json curve(const json& like, const std::vector<double>& x) const {
    json made = like;
    for (std::size_t i = 0; i < pieces(); ++i) {
      json& p = made["pieces"][i];
      for (std::size_t side = 0; side < 2; ++side) {
        const double value = x[i + side], k = p["curvature"][side];
        p["curvature"][side] =
            by_logarithm(i + side) ? std::copysign(std::exp(value), k) : value / unit;
      }
      p["length"] = std::exp(x[pieces() + 1 + i]);
    }
    return made;
  }
};

/// End, its direction, and the joint, in units.
std::vector<double> held_numbers(const json& curve, std::size_t joint, double unit) {
  const Track track = walked(curve);
  const Place end = track.end(), at = track.places[track.joints[joint]];
  return {end.x / unit, end.y / unit, end.direction, at.x / unit, at.y / unit};
}

/// How much of `x` is no combination of `rows`, as a share of it.
double outside(std::vector<std::vector<double>> rows, std::vector<double> x) {
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  const double whole = std::sqrt(product(x, x));
  for (int twice = 0; twice < 2; ++twice)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t q = 0; q < r; ++q) {
        const double by = product(rows[r], rows[q]);
        for (std::size_t i = 0; i < x.size(); ++i) rows[r][i] -= by * rows[q][i];
      }
      const double length = std::sqrt(product(rows[r], rows[r]));
      for (double& value : rows[r]) value /= length;
    }
  for (const auto& row : rows) {
    const double by = product(x, row);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= by * row[i];
  }
  return std::sqrt(product(x, x)) / whole;
}

/// At the least change the change is a combination of the gradients of what is held (Lagrange).
/// Differences are small beside a curvature too: next to 0 a piece's shape goes by its power.
void expect_least(const DragLaw& law, const json& now, std::size_t joint, double told,
                  Worst& worst) {
  const std::vector<double> x = law.numbers(now), from = law.numbers(law.base);
  std::vector<double> change;
  double square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    change.push_back(x[i] - from[i]);
    square += change[i] * change[i];
  }
  EXPECT_NEAR(told, std::sqrt(square), 1e-7 * std::sqrt(square) + 1e-10);
  if (std::sqrt(square) < 1e-4) return;
  std::vector<std::vector<double>> rows(5, std::vector<double>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<double> up = x, down = x;
    const bool curvature = i <= law.pieces() && !law.by_logarithm(i);
    const double step = curvature ? std::clamp(1e-3 * std::abs(x[i]), 1e-9, 1e-5) : 1e-5;
    up[i] += step;
    down[i] -= step;
    const auto a = held_numbers(law.curve(now, up), joint, law.unit);
    const auto b = held_numbers(law.curve(now, down), joint, law.unit);
    for (std::size_t r = 0; r < 5; ++r) rows[r][i] = (a[r] - b[r]) / (2 * step);
  }
  worst.expect_below(outside(rows, change), 1e-5);
}

json any_chain(Random& random) {
  const Frame2 frame = any_frame(random);
  json curve{{"type", "log-aesthetic"},
             {"start", frame(0, 0)},
             {"direction", frame.angle},
             {"pieces", json::array()}};
  const double side = sign(random);
  double k = uniform(random, 0.1, 1);
  const std::size_t count = 3 + random() % 4;
  for (std::size_t i = 0; i < count; ++i) {
    const double next = std::clamp(k * power_of_ten(random, -0.4, 0.4), 0.05, 2.0);
    curve["pieces"].push_back({{"alpha", random() % 3 == 0 ? -1 : uniform(random, -2, 2)},
                               {"length", frame.size * uniform(random, 0.3, 1)},
                               {"curvature", {side * k / frame.size, side * next / frame.size}}});
    k = next;
  }
  return curve;
}

TEST(RandomDrags, MoveOnePointAndAllElseAsLittleAsCanBe) {
  Random random(own::seed(51));
  Worst worst_place("place"), worst_least("least change");
  int dragged = 0;
  const int count = requests(0.03);
  for (int n = 0; n < count; ++n) {
    const json given = any_chain(random);
    const double at = uniform(random, 0.1, 0.9);
    auto [base, joint] = cut_at(given, at);
    const Track before = walked(base);
    const double reach = before.length * power_of_ten(random, -4, -1);
    const double heading = uniform(random, -3.2, 3.2);
    const Place from = before.places[before.joints[joint]];
    const double x = from.x + reach * std::cos(heading), y = from.y + reach * std::sin(heading);
    const json request{{"op", "lac.drag"}, {"curve", given}, {"at", at}, {"to", {x, y}}};
    SCOPED_TRACE(digest(request));
    const json answer = answered(request);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "not-converged") << answer;
      continue;
    }
    ++dragged;
    const json& result = answer["result"];
    const json& now = result["curve"];
    EXPECT_EQ(holes(result), std::vector<std::string>{});
    EXPECT_EQ(faults(now), std::vector<std::string>{});
    ASSERT_EQ(now["pieces"].size(), base["pieces"].size());
    ASSERT_EQ(result["joint"], joint);
    for (std::size_t i = 0; i < base["pieces"].size(); ++i)
      EXPECT_EQ(now["pieces"][i]["alpha"], base["pieces"][i]["alpha"]);
    const Track after = walked(now);
    const double size = before.length + std::hypot(from.x, from.y);
    const Place reached = after.places[after.joints[joint]];
    worst_place.expect_below(std::hypot(reached.x - x, reached.y - y) / size, 1e-11);
    worst_place.expect_below(
        std::hypot(after.end().x - before.end().x, after.end().y - before.end().y) / size, 1e-11);
    EXPECT_NEAR(wrapped(after.end().direction - before.end().direction), 0, 1e-11);
    EXPECT_EQ(now["start"], given["start"]);
    EXPECT_NEAR(wrapped(now["direction"].get<double>() - before.places[0].direction), 0, 1e-14);
    const DragLaw law{base, before.length / static_cast<double>(base["pieces"].size())};
    expect_least(law, now, joint, result["change"], worst_least);
  }
  EXPECT_GT(dragged, count / 2);
}

/// Radius of a piece by the share u of its angle, or angle by the share of its length, each times
/// what makes place' = weight(u) exp(i angle(u)); analytic up to where `linear` vanishes.
struct Analytic {
  double alpha = 0, turning = 0, length = 0, r0 = 0, r1 = 0;
  bool by_length = false;

  double exponent() const { return by_length ? -alpha : alpha - 1; }
  double power(double r) const { return std::pow(by_length ? 1 / r : r, exponent()); }
  /// Where curvature or radius runs to 0 or infinity.
  double singular() const { return power(r0) / (power(r0) - power(r1)); }
  Complex rate(Complex u, double about) const {
    const double from = power(r0), way = power(r1) - from, middle = from + about * way;
    const Complex linear = (from + u * way) / middle;  // real part above 0 about there
    const double e = 1 / exponent(), scale = std::pow(middle, e);
    if (!by_length)
      return turning * scale * std::pow(linear, e) * std::exp(Complex(0, turning) * u);
    const auto turned = [&](Complex w) {
      return length * scale * middle / ((e + 1) * way) * std::pow(w, e + 1);
    };
    return length * std::exp(Complex(0, 1) * (turned(linear) - turned(from / middle)));
  }
};

/// Coefficients of place' about a place, by Cauchy's integral over a circle; well inside that of
/// convergence, for by the length its edge has an essential singularity.
std::vector<Complex> coefficients(const Analytic& curve, double about, double radius, int count) {
  constexpr int kPlaces = 256;
  std::vector<Complex> all(static_cast<std::size_t>(count));
  for (int k = 0; k < kPlaces; ++k) {
    const Complex unit = std::polar(1.0, 2 * std::numbers::pi * k / kPlaces);
    const Complex value = curve.rate(about + radius * unit, about);
    for (int n = 0; n < count; ++n)
      all[static_cast<std::size_t>(n)] += value * std::pow(radius * unit, -n) / double{kPlaces};
  }
  return all;
}

/// Largest distance of the sum of so many terms from the curve at 257 even places, both from the
/// place of expansion on.
double largest_error(const Analytic& curve, double about, const std::vector<Complex>& c,
                     int terms) {
  double largest = 0;
  constexpr int kPlaces = 257;
  for (const double way : {-1.0, 1.0}) {
    Complex exact = 0;
    double before = about;
    for (int k = way > 0 ? 0 : kPlaces - 1; k >= 0 && k < kPlaces; k += way > 0 ? 1 : -1) {
      const double u = k / (kPlaces - 1.0);
      if ((u - about) * way < 0) continue;
      exact += gauss([&](double v) { return curve.rate(v, about); }, before, u);
      before = u;
      Complex sum = 0;
      for (int i = terms; i >= 1; --i)
        sum = (sum + c[static_cast<std::size_t>(i - 1)] / double(i)) * (u - about);
      largest = std::max(largest, std::abs(sum - exact));
    }
  }
  return largest;
}

TEST(RandomTaylor, ErrorsAreThoseOfTheSumsTheyAreToldOf) {
  Random random(own::seed(52));
  Worst worst("largest error, of itself");
  int judged = 0;
  for (int n = 0; n < requests(0.03); ++n) {
    const double theta = uniform(random, 0.1, 1.6), psi = theta * uniform(random, 0.4, 0.7);
    const double alpha = std::floor(uniform(random, -3, 3)) + uniform(random, 0.1, 0.9);
    const double s = std::sin(theta - psi) / std::sin(theta);
    const json points{{0, 0}, {s * std::cos(psi), -s * std::sin(psi)}, {1, 0}};
    const double about = random() % 3 == 0 ? 0.0 : uniform(random, 0, 1);
    const bool by_length = random() % 2 == 0;
    const double tolerance = power_of_ten(random, -12, -2);
    const json request{{"op", "lac.taylor"},
                       {"points", points},
                       {"alpha", alpha},
                       {"about", about},
                       {"variable", by_length ? "arc-length" : "tangent-angle"},
                       {"tolerance", tolerance}};
    SCOPED_TRACE(request.dump());
    const json segment = answered({{"op", "lac.segment"}, {"points", points}, {"alpha", alpha}});
    const json answer = answered(request);
    ASSERT_EQ(answer["ok"], segment["ok"]) << answer;
    if (answer["ok"] == false) continue;
    const json& piece = segment["result"]["curve"]["pieces"][0];
    Analytic curve{alpha, theta, piece["length"], 0, 0, by_length};
    curve.r0 = 1 / std::abs(piece["curvature"][0].get<double>());
    curve.r1 = 1 / std::abs(piece["curvature"][1].get<double>());
    const json& result = answer["result"];
    const double radius = std::abs(curve.singular() - about);
    EXPECT_NEAR(result["radius"].get<double>() / radius, 1, 1e-7);
    EXPECT_EQ(result["converges"], radius > std::max(about, 1 - about));
    // Next to the singular place panels of one 256th would not do.
    const bool clear = curve.singular() < -0.05 || curve.singular() > 1.05;
    int enough = 0;
    const auto c = coefficients(curve, about, std::min(0.3 * radius, 1.5), 12);
    for (const json& degree : result["degrees"]) {
      const int d = degree["degree"];
      const double largest = largest_error(curve, about, c, d);
      if (clear && largest > 1e-9 && largest < 1e3) {
        worst.expect_below(std::abs(degree["largest"].get<double>() / largest - 1), 1e-3);
        ++judged;
      }
      if (degree["bound"].is_null()) continue;
      const double bound = degree["bound"];
      EXPECT_GE(bound * (1 + 1e-9) + 1e-13, degree["largest"].get<double>());
      if (enough == 0 && bound <= tolerance) enough = d;
    }
    EXPECT_EQ(result["enough"].is_null() ? 0 : result["enough"].get<int>(), enough);
  }
  EXPECT_GT(judged, requests(0.03));
}

}  // namespace
}  // namespace keyline::operations
