#include "oracle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

namespace keyline::fairing::testing {
namespace {

using core::Point2;
using Vector = Eigen::VectorXd;

/// Start, direction, curvature at the start, then per piece its slope, length and curvature at its
/// end: a G2 chain whatever the numbers.
constexpr Eigen::Index kOfChain = 4;
constexpr Eigen::Index kOfPiece = 3;

Vector numbers_of(const lac::Chain& chain) {
  Vector x(kOfChain + kOfPiece * static_cast<Eigen::Index>(chain.pieces.size()));
  x.head<kOfChain>() << chain.start.position.x, chain.start.position.y, chain.start.direction,
      chain.pieces.front().curvature_start;
  Eigen::Index k = kOfChain;
  for (const lac::Piece& p : chain.pieces) {
    x.segment<kOfPiece>(k) << p.alpha, p.length, p.curvature_end;
    k += kOfPiece;
  }
  return x;
}

lac::Chain chain_of(const Vector& x) {
  lac::Chain chain{{{x[0], x[1]}, x[2]}, {}, false};
  double before = x[3];
  for (Eigen::Index k = kOfChain; k < x.size(); k += kOfPiece) {
    chain.pieces.push_back({x[k], x[k + 1], before, x[k + 2]});
    before = x[k + 2];
  }
  return chain;
}

double signed_power(double base, double exponent) {
  return base == 0 ? 0 : std::copysign(std::pow(std::abs(base), exponent), base);
}

/// The definition: kappa^-alpha is linear in arc length (its logarithm where alpha is 0).
double curvature_at(const lac::Piece& p, double u) {
  if (std::abs(p.alpha) < 1e-9)
    return p.curvature_start * std::pow(p.curvature_end / p.curvature_start, u);
  const double from = signed_power(p.curvature_start, -p.alpha);
  const double to = signed_power(p.curvature_end, -p.alpha);
  return signed_power(from + u * (to - from), -1 / p.alpha);
}

struct Place {
  Point2 point;
  double direction;
};

constexpr int kSteps = 200;  // of a piece

/// Places along the chain at equal steps of every piece: tangent angle and place by Simpson's rule.
std::vector<Place> track_of(const lac::Chain& chain) {
  std::vector<Place> track{{chain.start.position, chain.start.direction}};
  for (const lac::Piece& p : chain.pieces) {
    const double h = p.length / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const auto bend = [&](double part) { return curvature_at(p, (i + part) / kSteps); };
      const double k0 = bend(0), k1 = bend(0.5), k2 = bend(1);
      const double d0 = track.back().direction;
      // The parabola through the three, integrated to the middle and to the end.
      const double d1 = d0 + h * (5 * k0 + 8 * k1 - k2) / 24;
      const double d2 = d0 + h * (k0 + 4 * k1 + k2) / 6;
      const Point2 at = track.back().point;
      track.push_back({{at.x + h * (std::cos(d0) + 4 * std::cos(d1) + std::cos(d2)) / 6,
                        at.y + h * (std::sin(d0) + 4 * std::sin(d1) + std::sin(d2)) / 6},
                       d2});
    }
  }
  return track;
}

/// Distances to the left of the nearest place; of the first and the last point also along the
/// curve from its end. `feet`: where each was nearest last, and is looked for nearby.
Vector misses(const std::vector<Place>& track, const std::vector<Point2>& points,
              std::vector<std::size_t>& feet) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Vector r(n + 2);
  constexpr std::size_t kAround = 40;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const std::size_t from = feet[j] > kAround ? feet[j] - kAround : 0;
    const std::size_t to = std::min(feet[j] + kAround, track.size() - 1);
    for (std::size_t i = from; i <= to; ++i)
      if (distance(track[i].point, points[j]) < distance(track[feet[j]].point, points[j]))
        feet[j] = i;
    const Place& foot = track[feet[j]];
    const core::Vector2 miss = points[j] - foot.point;
    const double along = dot(miss, core::unit_vector(foot.direction));
    const std::size_t next = std::min(feet[j] + 1, track.size() - 1);
    const std::size_t last = next - 1;
    const double step = distance(track[next].point, track[last].point);
    const double bend = (track[next].direction - track[last].direction) / step;
    // Of the circle of curvature at the foot, so far along it.
    r[static_cast<Eigen::Index>(j)] =
        cross(core::unit_vector(foot.direction), miss) - 0.5 * bend * along * along;
  }
  const auto beyond = [&](const Place& end, Point2 p) {
    return dot(p - end.point, core::unit_vector(end.direction));
  };
  r[n] = beyond(track.front(), points.front());
  r[n + 1] = beyond(track.back(), points.back());
  return r;
}

/// Slopes that the points do not tell stay near the truth's.
constexpr double kSlopeSpread = 10;

class Problem {
 public:
  Problem(const lac::Chain& truth, const std::vector<Point2>& points, double noise)
      : points_(points), noise_(noise), start_(numbers_of(truth)), feet_(points.size()) {
    const auto track = track_of(truth);
    for (std::size_t j = 0; j < points.size(); ++j)
      feet_[j] = j * (track.size() - 1) / (points.size() - 1);
  }

  const Vector& start() const { return start_; }

  /// Where every point is nearest: kept with numbers that are taken, put back with others.
  const std::vector<std::size_t>& feet() const { return feet_; }
  void put_back(std::vector<std::size_t> feet) { feet_ = std::move(feet); }

  Vector residuals(const Vector& x) {
    const Vector r = misses(track_of(chain_of(x)), points_, feet_);
    const Eigen::Index pieces = (x.size() - kOfChain) / kOfPiece;
    Vector all(r.size() + pieces);
    all.head(r.size()) = r / noise_;
    for (Eigen::Index i = 0; i < pieces; ++i) {
      const Eigen::Index k = kOfChain + kOfPiece * i;
      all[r.size() + i] = (x[k] - start_[k]) / kSlopeSpread;
    }
    return all;
  }

  /// A curvature that is 0 in truth: what kind its pieces are.
  bool stays(Eigen::Index k) const {
    const bool bend = k == 3 || (k >= kOfChain && (k - kOfChain) % kOfPiece == 2);
    return bend && start_[k] == 0;
  }

  Eigen::MatrixXd derivatives(const Vector& x, const Vector& at_x) {
    Eigen::MatrixXd j(at_x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      if (stays(k)) {
        j.col(k).setZero();
        continue;
      }
      Vector moved = x;
      moved[k] += 1e-6 * std::max(1.0, std::abs(x[k]));
      j.col(k) = (residuals(moved) - at_x) / (moved[k] - x[k]);
    }
    return j;
  }

 private:
  const std::vector<Point2>& points_;
  double noise_;
  Vector start_;
  std::vector<std::size_t> feet_;
};

/// Of the truth's kind: curvature changes its sign at joints alone.
bool is_chain(const Vector& x) {
  if (!x.allFinite()) return false;
  double before = x[3];
  for (Eigen::Index k = kOfChain; k < x.size(); k += kOfPiece) {
    if (!(x[k + 1] > 0) || before * x[k + 2] < 0) return false;
    before = x[k + 2];
  }
  return true;
}

}  // namespace

lac::Chain oracle_fit(const lac::Chain& truth, const std::vector<Point2>& points, double noise) {
  Problem problem(truth, points, noise);
  Vector x = problem.start();
  Vector r = problem.residuals(x);
  double damping = 1e-3;
  for (int round = 0; round < 60 && damping < 1e12; ++round) {
    const Eigen::MatrixXd j = problem.derivatives(x, r);
    Eigen::MatrixXd normal = j.transpose() * j;
    normal.diagonal() *= 1 + damping;
    for (Eigen::Index k = 0; k < x.size(); ++k)
      if (problem.stays(k)) normal(k, k) = 1;
    const Vector next = x - normal.ldlt().solve(j.transpose() * r);
    std::vector<std::size_t> feet = problem.feet();
    const Vector there = is_chain(next) ? problem.residuals(next) : r;
    const bool better = is_chain(next) && there.squaredNorm() < r.squaredNorm();
    damping *= better ? 0.1 : 10;
    if (!better) {
      problem.put_back(std::move(feet));
      continue;
    }
    const bool settled = r.squaredNorm() - there.squaredNorm() < 1e-9 * r.squaredNorm();
    x = next;
    r = there;
    if (settled) break;
  }
  return chain_of(x);
}

}  // namespace keyline::fairing::testing
