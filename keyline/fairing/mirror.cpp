#include "keyline/fairing/mirror.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/fairing/between_points.h"

namespace keyline::fairing {
namespace {

using core::Point2;
using core::Vector2;

constexpr int kPlaces = 256;         // of the curve, for pairing
constexpr int kPerGap = 8;           // vertices of the curve between two points
constexpr int kMostVertices = 4000;  // of the curve: more than 500 points have fewer vertices a gap
constexpr int kDrawings = 8;         // of the line to the curve
constexpr double kSurelyFarther = 1 + 1e-12;  // rounding is less
constexpr double kReach =
    0.05;  // of the vertices: how far from where it is expected a foot is sought

/// The curve through the points as a fine polygon, and which share of the length each vertex is at.
struct Fine {
  std::vector<Point2> vertex;
  std::vector<double> at;
  std::vector<double> edge;  ///< lengths from vertex to vertex
  double rounding = 0;       ///< more than distances are told wrongly by
  bool closed = false;
};

Fine fine_polygon(const std::vector<Point2>& points, bool closed) {
  Fine fine;
  fine.closed = closed;
  const std::size_t n = points.size();
  const int parts = std::clamp(kMostVertices / static_cast<int>(n), 1, kPerGap);
  const std::size_t gaps = closed ? n : n - 1;
  for (std::size_t i = 0; i < gaps; ++i)
    for (int k = 0; k < parts; ++k)
      fine.vertex.push_back(k == 0 ? points[i]
                                   : detail::between_points(points, closed, i, 1.0 * k / parts));
  fine.vertex.push_back(closed ? points.front() : points.back());
  fine.at.push_back(0);
  for (std::size_t i = 1; i < fine.vertex.size(); ++i) {
    fine.edge.push_back(core::distance(fine.vertex[i - 1], fine.vertex[i]));
    fine.at.push_back(fine.at.back() + fine.edge.back());
  }
  for (double& at : fine.at) at /= std::max(fine.at.back(), 1e-300);
  for (const Point2& p : fine.vertex)
    fine.rounding = std::max({fine.rounding, 1e-12 * std::abs(p.x), 1e-12 * std::abs(p.y)});
  return fine;
}

/// Where on the polygon a share of its length is.
struct Place {
  Point2 point;
  std::size_t edge = 0;
};
Place place_at(const Fine& fine, double share) {
  const auto next = std::upper_bound(fine.at.begin() + 1, fine.at.end() - 1, share);
  const auto i = static_cast<std::size_t>(next - fine.at.begin());
  const double step = std::max(fine.at[i] - fine.at[i - 1], 1e-300);
  return {core::mix(fine.vertex[i - 1], fine.vertex[i], (share - fine.at[i - 1]) / step), i - 1};
}

/// Signed distance of the point from the polygon near an edge, and the normal there.
struct Offset {
  double distance = HUGE_VAL;
  Vector2 normal;
};
/// From the nearest place of an edge that is no point.
Vector2 from_edge(const Fine& fine, std::size_t i, Point2 p) {
  const Point2 a = fine.vertex[i];
  const Vector2 along = fine.vertex[i + 1] - a;
  const double u = std::clamp(core::dot(p - a, along) / (fine.edge[i] * fine.edge[i]), 0.0, 1.0);
  return p - (a + u * along);
}

Offset offset_near(const Fine& fine, Point2 p, std::size_t edge) {
  const auto edges = static_cast<long>(fine.vertex.size()) - 1;
  const long reach = std::max(4L, std::lround(kReach * static_cast<double>(edges)));
  const bool expected = fine.edge[edge] > 0;
  double near = expected ? core::norm(from_edge(fine, edge, p)) : HUGE_VAL;
  Offset best;
  double least = HUGE_VAL;
  double farther = 0;  // so far along the polygon it is surely farther than what is near
  for (long k = -reach; k <= reach; ++k) {
    long i = static_cast<long>(edge) + k;
    if (fine.closed) i = ((i % edges) + edges) % edges;
    if (i < 0 || i >= edges) continue;
    const double size = fine.edge[i];
    farther -= size;
    if (size == 0 || farther > 0) continue;
    const Vector2 from = from_edge(fine, i, p);
    const double away = core::norm(from);
    near = std::min(near, away);
    farther = away - size - kSurelyFarther * near - fine.rounding;
    if (away >= least) continue;
    least = away;
    const Vector2 normal = core::perpendicular_left(fine.vertex[i + 1] - fine.vertex[i]) / size;
    best = {core::dot(from, normal), normal};
  }
  return best;
}

/// The line, and the pairing of shares t -> sum - t that it belongs to.
struct Pairing {
  core::Pose2 line;
  double sum = 1;
  double misfit = HUGE_VAL;
};

/// The best line for each pairing of evenly spaced places.
Pairing best_pairing(const Fine& fine) {
  std::vector<std::complex<double>> z;
  const int n = fine.closed ? kPlaces : kPlaces + 1;
  std::complex<double> mean = 0;
  for (int i = 0; i < n; ++i) {
    const Point2 p = place_at(fine, static_cast<double>(i) / kPlaces).point;
    z.emplace_back(p.x, p.y);
    mean += z.back() / static_cast<double>(n);
  }
  double square = 0;
  for (auto& w : z) {
    w -= mean;
    square += std::norm(w);
  }
  Pairing best;
  for (int k = fine.closed ? 0 : n - 1; k < n; ++k) {
    std::complex<double> sum = 0;
    for (int i = 0; i < n; ++i) sum += z[i] * z[((k - i) % n + n) % n];
    const double misfit = square - std::abs(sum);
    if (misfit >= best.misfit) continue;
    best = {{{mean.real(), mean.imag()}, 0.5 * std::arg(sum)},
            fine.closed ? static_cast<double>(k) / kPlaces : 1,
            misfit};
  }
  return best;
}

struct Misfit {
  double across = 0;  ///< move of the line to its left…
  double turn = 0;    ///< …and its turn that take most of the offsets away
  double rms = 0;
  double largest = 0;
};

/// Offsets of the mirrored points, and the move of the line that lessens them most.
Misfit misfit_of(const Fine& fine, const std::vector<Point2>& points, const Pairing& pairing) {
  const Vector2 along = core::unit_vector(pairing.line.direction);
  const Vector2 left = core::perpendicular_left(along);
  std::array<double, 5> s{};
  Misfit found;
  double square = 0;
  const std::size_t n = points.size();
  const std::size_t per_gap = (fine.vertex.size() - 1) / (fine.closed ? n : n - 1);
  for (std::size_t j = 0; j < n; ++j) {
    double share = pairing.sum - fine.at[j * per_gap];
    share -= fine.closed ? std::floor(share) : 0.0;
    const Point2 image = mirrored(pairing.line, points[j]);
    const Offset offset = offset_near(fine, image, place_at(fine, share).edge);
    square += offset.distance * offset.distance;
    found.largest = std::max(found.largest, std::abs(offset.distance));
    // The image moves by 2 across, and turns by 2 about the line's point.
    const double by_across = 2 * core::dot(left, offset.normal);
    const double by_turn =
        2 * core::dot(core::perpendicular_left(image - pairing.line.position), offset.normal);
    s[0] += by_across * by_across;
    s[1] += by_across * by_turn;
    s[2] += by_turn * by_turn;
    s[3] += by_across * offset.distance;
    s[4] += by_turn * offset.distance;
  }
  const double det = s[0] * s[2] - s[1] * s[1];
  if (det > 1e-12 * s[0] * s[2]) {
    found.across = -(s[2] * s[3] - s[1] * s[4]) / det;
    found.turn = -(s[0] * s[4] - s[1] * s[3]) / det;
  }
  found.rms = std::sqrt(square / static_cast<double>(n));
  return found;
}

}  // namespace

Point2 mirrored(const core::Pose2& line, Point2 p) {
  const Vector2 left = core::perpendicular_left(core::unit_vector(line.direction));
  return p - 2 * core::dot(p - line.position, left) * left;
}

double beside(const core::Pose2& line, Point2 p) {
  return core::cross(core::unit_vector(line.direction), p - line.position);
}

std::optional<Mirror> best_mirror(const std::vector<Point2>& points, bool closed) {
  if (points.size() < 6) return std::nullopt;
  const Fine fine = fine_polygon(points, closed);
  Pairing pairing = best_pairing(fine);
  Misfit now = misfit_of(fine, points, pairing);
  Mirror best{pairing.line, now.rms, now.largest};
  for (int round = 0; round < kDrawings; ++round) {
    const Vector2 left = core::perpendicular_left(core::unit_vector(pairing.line.direction));
    pairing.line.position = pairing.line.position + now.across * left;
    pairing.line.direction += now.turn;
    now = misfit_of(fine, points, pairing);
    if (!(now.rms < best.rms)) break;
    best = {pairing.line, now.rms, now.largest};
  }
  return best;
}

Mirror measured_in(const core::Pose2& line, const std::vector<Point2>& points, bool closed) {
  const Fine fine = fine_polygon(points, closed);
  Pairing pairing{line, 1, HUGE_VAL};
  Mirror best{line, HUGE_VAL, HUGE_VAL};
  // The pairing that the line makes: where the first point's image is nearest.
  for (int k = 0; k < (closed ? kPlaces : 1); ++k) {
    pairing.sum = closed ? static_cast<double>(k) / kPlaces : 1;
    const Misfit now = misfit_of(fine, points, pairing);
    if (now.rms < best.rms) best = {line, now.rms, now.largest};
  }
  return best;
}

}  // namespace keyline::fairing
