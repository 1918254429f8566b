#include "keyline/sketch/branch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::Point2;
using core::Vector2;

constexpr std::size_t kMostBranches = 10;

/// Half the usual width of an edge.
double half_width(const GraphEdge& e) { return core::quantile(e.radii); }

/// Direction of the line at point i, from the parabola through points i … j.
template <class PointAt>
Vector2 direction(const PointAt& point, std::size_t i, std::size_t j) {
  const Vector2 chord = point(j) - point(i);
  if (j < i + 6) return core::norm(chord) > 0 ? chord / core::norm(chord) : Vector2{1, 0};
  // least squares of p(s) = c + v s + w s² over s in [-1, 1], v and w by orthogonal polynomials
  const double n = static_cast<double>(j - i + 1);
  Vector2 linear{};
  Vector2 square{};
  double linear_norm = 0;
  double square_norm = 0;
  double mean_square = 0;
  const auto at = [&](std::size_t k) { return 2 * static_cast<double>(k - i) / (n - 1) - 1; };
  for (std::size_t k = i; k <= j; ++k) mean_square += at(k) * at(k) / n;
  for (std::size_t k = i; k <= j; ++k) {
    const double s = at(k);
    const double q = s * s - mean_square;
    linear = linear + s * (point(k) - point(i));
    square = square + q * (point(k) - point(i));
    linear_norm += s * s;
    square_norm += q * q;
  }
  const Vector2 d = linear / linear_norm - (2 / square_norm) * square;
  return core::norm(d) > 0 ? d / core::norm(d) : Vector2{1, 0};
}

/// Goes through all ways to pair branches, giving up where they cost more than the best so far.
class Pairing {
 public:
  Pairing(const std::vector<Branch>& branches, double turn)
      : branches_(branches),
        turn_(turn),
        mate_(branches.size(), kOpen),
        best_(branches.size(), -1) {
    search(0, 0);
  }
  std::vector<int> best() const { return best_; }

 private:
  static constexpr int kOpen = -2;

  void search(std::size_t first, double spent) {
    if (spent >= least_) return;
    while (first < mate_.size() && mate_[first] != kOpen) ++first;
    if (first == mate_.size()) {
      least_ = spent;
      best_ = mate_;
      return;
    }
    for (std::size_t k = first + 1; k < mate_.size(); ++k) {
      if (mate_[k] != kOpen) continue;
      const double bend = bend_between(branches_[first], branches_[k]);
      if (bend > turn_) continue;
      mate_[first] = static_cast<int>(k);
      mate_[k] = static_cast<int>(first);
      search(first + 1, spent + bend);
      mate_[k] = kOpen;
    }
    mate_[first] = -1;
    search(first + 1, spent + 0.5 * turn_);
    mate_[first] = kOpen;
  }

  const std::vector<Branch>& branches_;
  double turn_;
  std::vector<int> mate_;
  std::vector<int> best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Branch make_branch(const StrokeGraph& graph, int edge, bool at_end, double skip) {
  const GraphEdge& line = graph.edges[static_cast<std::size_t>(edge)];
  const std::size_t n = line.points.size();
  const auto point = [&](std::size_t i) { return line.points[at_end ? n - 1 - i : i]; };
  Branch b;
  b.edge = edge;
  b.at_end = at_end;
  skip = std::min(skip, 0.4 * length_of(line));
  std::size_t i = 0;
  for (double run = 0; i + 1 < n && run < skip; ++i) run += distance(point(i), point(i + 1));
  const double reach = std::max(10.0, 7 * half_width(line));
  std::size_t j = i;
  for (double run = 0; j + 1 < n && run < reach; ++j) run += distance(point(j), point(j + 1));
  b.anchor = at_end ? n - 1 - i : i;
  b.place = point(i);
  b.outward = direction(point, i, j);
  return b;
}

double bend_between(const Branch& a, const Branch& b) {
  const Vector2 chord = b.place - a.place;
  if (core::norm(chord) < 1.0) return std::abs(core::angle_between(-a.outward, b.outward));
  const double first = core::angle_between(-a.outward, chord);
  const double second = core::angle_between(chord, b.outward);
  return 0.5 * std::abs(first + second) + std::abs(first - second);
}

double off_parabola(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach) {
  std::vector<Point2> points;
  for (const Branch* branch : {&a, &b}) {
    const GraphEdge& line = graph.edges[static_cast<std::size_t>(branch->edge)];
    const std::size_t n = line.points.size();
    double run = 0;
    for (std::size_t i = branch->anchor; run <= std::max(reach, 16.0);
         i += branch->at_end ? -1 : 1) {
      points.push_back(line.points[i]);
      if (i == (branch->at_end ? 0 : n - 1)) break;
      run += distance(line.points[i], line.points[branch->at_end ? i - 1 : i + 1]);
    }
  }
  const Vector2 chord = b.place - a.place;
  const double length = std::max(core::norm(chord), 1e-9);
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd across(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Vector2 d = points[static_cast<std::size_t>(i)] - a.place;
    const double x = core::dot(chord, d) / (length * length) - 0.5;
    rows.row(i) << 1, x, x * x;
    across[i] = core::cross(chord, d) / length;
  }
  const Eigen::VectorXd rest = rows * rows.householderQr().solve(across) - across;
  return rest.norm() / std::sqrt(static_cast<double>(points.size()));
}

std::vector<int> pair_up(const std::vector<Branch>& branches, double turn) {
  if (branches.size() <= kMostBranches) return Pairing(branches, turn).best();
  const std::vector<Branch> first(branches.begin(),
                                  branches.begin() + static_cast<long>(kMostBranches));
  std::vector<int> mates = Pairing(first, turn).best();
  mates.resize(branches.size(), -1);
  return mates;
}

}  // namespace keyline::sketch
