#include "keyline/lac/space/space_shooting.h"

#include <algorithm>
#include <span>
#include <vector>

#include "keyline/lac/space/space_stretch.h"
#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac::detail {
namespace {

using core::Vector3;

/// Of a stretch that is all, next to a zero, or one of several.
int steps_of(const Stretch& stretch, std::size_t of) {
  return stretch.power != 1 ? 24 : of == 1 ? 32 : 12;
}

/// Curvature and torsion times length over the fraction of the length.
struct Laws {
  double alpha, beta;
  double bend, length;
  double start_torsion;
  double torsion_rate;  ///< T^-beta = T0^-beta + beta torsion_rate t

  double curvature(double t) const { return length * carried(1, alpha, bend * t); }
  double torsion(double t) const { return carried(start_torsion, beta, torsion_rate * t); }
};

/// A place of the curve and its frame.
struct Motion {
  Vector3 at;
  Vector3 tangent{1, 0, 0};
  Vector3 normal{0, 1, 0};
  Vector3 binormal{0, 0, 1};

  Vector3 turned(Vector3 v) const { return v.x * tangent + v.y * normal + v.z * binormal; }
};

/// The motion after exp of the twist (turn, shift), both in the moving frame.
Motion moved(const Motion& m, Vector3 turn, Vector3 shift) {
  const double square = dot(turn, turn);
  const double angle = std::sqrt(square);
  const bool tiny = angle < 1e-3;
  const double s = tiny ? 1 - square / 6 : std::sin(angle) / angle;
  const double c = tiny ? 0.5 - square / 24 : (1 - std::cos(angle)) / square;
  const double v = tiny ? 1.0 / 6 - square / 120 : (1 - s) / square;
  const auto rotated = [&](Vector3 a) {
    const Vector3 once = cross(turn, a);
    return a + s * once + c * cross(turn, once);
  };
  const Vector3 once = cross(turn, shift);
  Motion next;
  next.at = m.at + m.turned(shift + c * once + v * cross(turn, once));
  next.tangent = m.turned(rotated({1, 0, 0}));
  next.normal = m.turned(rotated({0, 1, 0}));
  next.binormal = cross(next.tangent, next.normal);
  return next;
}

/// One step of Magnus' method with Gauss' two nodes.
Motion stepped(const Laws& laws, const Motion& m, const Stretch& stretch, double from, double h) {
  constexpr const auto& kPlaces = numeric::gauss_legendre<2>.nodes;
  std::array<Vector3, 2> turn;
  std::array<double, 2> speed;
  for (int i = 0; i < 2; ++i) {
    const double s = from + h * kPlaces[i];
    const double t = stretch.place(s);
    speed[i] = stretch.rate(s);
    turn[i] = speed[i] * Vector3{laws.torsion(t), 0, laws.curvature(t)};
  }
  const double bracket = h * h * (kPlaces[1] - kPlaces[0]) / 4;
  const Vector3 forward{1, 0, 0};
  return moved(m, h / 2 * (turn[0] + turn[1]) + bracket * cross(turn[0], turn[1]),
               h / 2 * (speed[0] + speed[1]) * forward +
                   bracket * cross(speed[1] * turn[0] - speed[0] * turn[1], forward));
}

/// Places of the steps' ends, with weights of Simpson's rule over the length.
struct Node {
  double place = 0;
  double weight = 0;
};

/// How curvature and torsion at one place change with the three unknowns.
struct Change {
  std::array<double, 3> curvature{};
  std::array<double, 3> torsion{};
};

/// x^e, kept finite where x vanishes and e < 0.
double bounded_power(double x, double e) { return std::pow(std::max(std::abs(x), 1e-9), e); }

void find_changes(const Laws& laws, double omega, std::span<const Node> nodes,
                  std::span<Change> change) {
  const double by_length =
      omega == 0 ? 0.0 : omega * (1 - laws.beta) * std::pow(laws.length, -laws.beta);
  const bool none = laws.start_torsion == 0 && laws.beta >= 0;
  double all = 0;
  double shifted = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = nodes[i].place;
    const double bend = laws.curvature(t) / laws.length;
    const bool counts = nodes[i].weight > 0;
    change[i].curvature[2] = bend;
    change[i].curvature[0] = counts ? -t * laws.length * bounded_power(bend, 1 + laws.alpha) : 0.0;
    const double sensitive = none ? 1 : bounded_power(laws.torsion(t), 1 + laws.beta);
    change[i].torsion[1] = counts ? sensitive : 0.0;
    all += nodes[i].weight * change[i].torsion[1];
    shifted -= nodes[i].weight * by_length * t * change[i].torsion[1];
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    change[i].torsion[2] = -(by_length * nodes[i].place + shifted / all) * change[i].torsion[1];
    change[i].torsion[1] /= all;
  }
}

/// Cut where a law's few steps would not follow it.
std::vector<Stretch> stretches_of(const Laws& laws) {
  LawRun bend{HUGE_VAL, laws.alpha, -laws.bend};
  LawRun twist{HUGE_VAL, laws.beta, -laws.torsion_rate};
  if (laws.alpha != 0 && laws.bend != 0) bend.place = -1 / (laws.alpha * laws.bend);
  const double t = laws.start_torsion;
  if (laws.beta != 0 && laws.torsion_rate != 0)
    twist.place = -std::copysign(std::pow(std::abs(t), -laws.beta), laws.beta < 0 ? t : 1) /
                  (laws.beta * laws.torsion_rate);
  return graded_stretches(bend, twist);
}

}  // namespace

std::optional<double> start_torsion(double beta, double omega, const SpaceUnknowns& x) {
  const double rate = unit_rate(beta, omega, x.length);
  if (rate == 0 || (x.twist == 0 && beta >= 0)) return x.twist;
  // Somewhere the torsion is its own mean: there the law is anchored, and the place is sought.
  const auto excess = [&](double place) {
    const double first = carried(x.twist, beta, -rate * place);
    const double last = carried(x.twist, beta, rate * (1 - place));
    if (std::isnan(first) || std::isnan(last)) return 1e300;  // infinite torsion on the way
    const double mean =
        beta < 0 ? numeric::signed_power_mean_integral(first, last, -beta, 1)
                 : numeric::power_mean_integral(std::abs(first), std::abs(last), -beta, 1);
    return beta < 0 ? mean - x.twist : mean - std::abs(x.twist);
  };
  if (excess(0.5) == 0) return carried(x.twist, beta, -rate / 2);
  const auto place = numeric::bracketed_root(excess, 0, 1, 0);
  if (!place) return std::nullopt;
  const double start = carried(x.twist, beta, -rate * *place);
  const double end = carried(x.twist, beta, rate * (1 - *place));
  if (!std::isfinite(start) || !std::isfinite(end)) return std::nullopt;
  return start;
}

std::optional<SpaceShot> shoot_space(const SpaceStandardForm& form, const SpaceUnknowns& x) {
  const auto torsion = start_torsion(form.beta, form.omega, x);
  if (!torsion || !(x.length > 0)) return std::nullopt;
  const Laws laws{form.alpha, form.beta, x.bend,
                  x.length,   *torsion,  unit_rate(form.beta, form.omega, x.length)};
  if (!std::isfinite(laws.curvature(1)) || !std::isfinite(laws.torsion(1))) return std::nullopt;
  std::vector<Motion> motion;
  std::vector<Node> node;
  Motion end;
  const std::vector<Stretch> stretches = stretches_of(laws);
  for (const Stretch& stretch : stretches) {
    const int steps = steps_of(stretch, stretches.size());
    for (int i = 0; i <= steps; ++i) {
      const double s = i / double(steps);
      const double simpson = (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) / (3.0 * steps);
      if (i > 0) end = stepped(laws, end, stretch, (i - 1) / double(steps), 1.0 / steps);
      motion.push_back(end);
      node.push_back({stretch.place(s), simpson * stretch.rate(s)});
    }
  }
  const std::size_t count = node.size();
  std::vector<Change> change(count);
  find_changes(laws, form.omega, node, change);
  SpaceShot shot{end.at, end.tangent, {}, {}};
  for (int unknown = 0; unknown < 3; ++unknown) {
    Vector3 turned;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3 turn = node[i].weight * (change[i].torsion[unknown] * motion[i].tangent +
                                             change[i].curvature[unknown] * motion[i].binormal);
      turned = turned + turn;
      shot.chord_by[unknown] = shot.chord_by[unknown] + cross(turn, end.at - motion[i].at);
    }
    shot.tangent_by[unknown] = cross(turned, end.tangent);
  }
  return shot;
}

}  // namespace keyline::lac::detail
