// The minimum of [Oya] 3.2 against matrices in space: energies, ends and curvature by numerics of
// this file's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include "keyline/classa/edit.h"
#include "keyline/classa/minimum_energy.h"

namespace keyline::classa {
namespace {

using V = std::array<double, 3>;
using Matrix = std::array<V, 3>;

V operator+(const V& a, const V& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
V operator*(double s, const V& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double size(const V& a) { return std::sqrt(dot(a, a)); }
V times(const Matrix& m, const V& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

/// A Bezier curve by its edges.
struct Edges {
  std::vector<V> edge;

  V end() const {
    V sum{};
    for (const V& e : edge) sum = sum + e;
    return sum;
  }
  /// Between start tangent and chord.
  double off() const { return std::atan2(size(cross(edge[0], end())), dot(edge[0], end())); }
  /// x' and x'' over the degree, by de Casteljau.
  std::array<V, 2> at(double t) const {
    std::vector<V> p = edge;
    for (std::size_t left = p.size() - 1; left > 1; --left)
      for (std::size_t i = 0; i < left; ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
    if (p.size() == 1) return {p[0], V{}};
    const double n = static_cast<double>(edge.size()) - 1;
    return {(1 - t) * p[0] + t * p[1], n * (p[1] + -1.0 * p[0])};
  }
  double curvature(double t) const {
    const auto [d, dd] = at(t);
    const double v = size(d);
    return size(cross(d, dd)) / (v * v * v * static_cast<double>(edge.size()));
  }
  /// Integral of the squared curvature along the length, times the chord: of no unit.
  double energy() const {
    double sum = 0;
    for (int panel = 0; panel < 4; ++panel) {
      sum += boost::math::quadrature::gauss<double, 20>::integrate(
          [&](double t) {
            const double k = curvature(t);
            return k * k * size(at(t)[0]) * static_cast<double>(edge.size());
          },
          panel / 4.0, (panel + 1) / 4.0);
    }
    return sum * size(end());
  }
  /// Curvature only falls, at `steps` places.
  bool falls(int steps) const {
    double before = curvature(0);
    for (int i = 1; i <= steps; ++i) {
      const double k = curvature(static_cast<double>(i) / steps);
      if (k > before * (1 + 1e-9)) return false;
      before = k;
    }
    return true;
  }
};

Edges powers(const Matrix& m, const V& v, int degree) {
  Edges c{{v}};
  while (static_cast<int>(c.edge.size()) < degree) c.edge.push_back(times(m, c.edge.back()));
  return c;
}

/// Rotation by `angle` about the unit axis, times s (Rodrigues' formula).
Matrix similarity(const V& axis, double angle, double s) {
  Matrix m{};
  for (std::size_t k = 0; k < 3; ++k) {
    V unit{};
    unit[k] = 1;
    const V turned = std::cos(angle) * unit + std::sin(angle) * cross(axis, unit) +
                     (1 - std::cos(angle)) * dot(axis, unit) * axis;
    for (std::size_t row = 0; row < 3; ++row) m[row][k] = s * turned[row];
  }
  return m;
}

/// The minimum of a rotation times a scale for chord 1 at the angle `off` from the tangent.
core::Result<EnergyMinimum> least_in_plane(double off, int degree) {
  EnergyConditions conditions;
  conditions.chord = {std::cos(off), std::sin(off)};
  conditions.degree = degree;
  return minimum_energy(conditions);
}

V any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> n;
  const V v{n(random), n(random), n(random)};
  return (1 / size(v)) * v;
}

TEST(SpaceMinimum, NoRotationTimesScaleInSpaceBendsLess) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> unit(0, 1);
  double least = HUGE_VAL;
  int tried = 0;
  while (tried < 1000) {
    const double alpha = kDefaultAlphaMax * unit(random);
    const double s = 1 / std::cos(alpha) * (1 + unit(random) * unit(random));
    const int degree = 3 + static_cast<int>(random() % 4);
    // Half of them close to the plane.
    V v = any_direction(random);
    const V axis = any_direction(random);
    if (random() % 2 == 0) v = v + (-0.9 * dot(v, axis)) * axis;
    const Edges c = powers(similarity(axis, alpha, s), v, degree);
    if (c.off() < 0.02 || c.off() > 2 || !c.falls(200)) continue;
    const auto plane = least_in_plane(c.off(), degree);
    if (!plane) continue;  // turns by more than the plane's steps may
    ++tried;
    least = std::min(least, c.energy() / plane->energy);
    EXPECT_GE(c.energy(), plane->energy * (1 - 1e-9)) << alpha << ' ' << s << ' ' << c.off();
  }
  RecordProperty("least", std::to_string(least));
}

/// Any three edges in general position are v, Mv, M^2 v of some matrix in space, so that the least
/// of all cubics with falling curvature is that of all matrices: by random steps from a curve
/// that is out of the plane.
Edges descended(const Edges& start, std::mt19937_64& random) {
  std::normal_distribution<double> n;
  Edges best = start;
  double least = start.energy();
  double step = 0.1;
  for (int i = 0; i < 6000; ++i) {
    Edges c = best;
    c.edge[0] = std::exp(step * n(random)) * c.edge[0];
    for (double& x : c.edge[1]) x += 0.3 * step * n(random);
    c.edge[2] = start.end() + -1.0 * (c.edge[0] + c.edge[1]);
    const double e = c.energy();
    const bool better = e < least && c.falls(60);
    step = std::clamp(step * (better ? 1.5 : 0.97), 1e-6, 0.3);
    if (!better) continue;
    best = c;
    least = e;
  }
  return best;
}

TEST(SpaceMinimum, OfAllMatricesLiesInThePlaneAndAFewPerCentLower) {
  std::mt19937_64 random(72);
  for (const double off : {0.3, 0.7, 1.1}) {
    const auto plane = least_in_plane(off, 3);
    ASSERT_TRUE(plane);
    const V end{std::cos(off), std::sin(off), 0};
    double least = HUGE_VAL, lift = 1;
    for (int start = 0; start < 3; ++start) {
      Edges c = powers(similarity({0, 0, 1}, plane->alpha, plane->s), {plane->beta, 0, 0}, 3);
      c.edge[1][2] = 0.05 * (start - 1);
      c.edge[2] = end + -1.0 * (c.edge[0] + c.edge[1]);
      const Edges found = descended(c, random);
      if (found.energy() >= least) continue;
      least = found.energy();
      lift = std::abs(found.edge[1][2]);
    }
    EXPECT_LT(lift, 2e-3) << off;
    EXPECT_LT(least, plane->energy * 0.995) << off;
    EXPECT_GT(least, plane->energy * 0.95) << off;
    RecordProperty("off" + std::to_string(off), std::to_string(least / plane->energy));
  }
}

TEST(SpaceMinimum, EditingAnyCurveInSpaceLeadsThere) {
  std::mt19937_64 random(73);
  std::uniform_real_distribution<double> unit(0, 1);
  EditOptions options;
  options.cav.end_tolerance = 0;
  int edited = 0;
  for (int n = 0; n < 1000; ++n) {
    curve::Bezier3 given{{{0, 0, 0}}, {}};
    V step = any_direction(random);
    for (int k = 0; k < 3 + static_cast<int>(random() % 3); ++k) {
      const core::Point3& p = given.control.back();
      given.control.push_back({p.x + step[0], p.y + step[1], p.z + step[2]});
      step = (0.7 + 0.7 * unit(random)) * step + 0.4 * any_direction(random);
    }
    const auto result = edit(given, options);
    if (!result) {
      EXPECT_EQ(result.error().code, core::ErrorCode::undrawable) << result.error().message;
      continue;
    }
    ++edited;
    std::vector<core::Point3> p = result->curve.control, g = given.control;
    EXPECT_LT(core::distance(p.front(), g.front()), 1e-9);
    EXPECT_LT(core::distance(p.back(), g.back()), 1e-9);
    if (result->flat.after.reversed) {
      std::reverse(p.begin(), p.end());
      std::reverse(g.begin(), g.end());
    }
    const auto edges = [](const std::vector<core::Point3>& c) {
      Edges e;
      for (std::size_t i = 1; i < c.size(); ++i)
        e.edge.push_back({c[i].x - c[i - 1].x, c[i].y - c[i - 1].y, c[i].z - c[i - 1].z});
      return e;
    };
    const Edges now = edges(p), was = edges(g);
    EXPECT_LT(size(cross(now.edge[0], was.edge[0])), 1e-7 * size(now.edge[0]) * size(was.edge[0]));
    const auto plane = least_in_plane(was.off(), static_cast<int>(now.edge.size()));
    ASSERT_TRUE(plane);
    EXPECT_NEAR(now.energy() / plane->energy, 1, 1e-6);
  }
  EXPECT_GT(edited, 800);
}

}  // namespace
}  // namespace keyline::classa
