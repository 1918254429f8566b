#include "keyline/lac/hermite/handle_region.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kFar = 50;       // times the distance of the handles that stay
constexpr int kTurnings = 96;     // places along each border: under a pixel on a screen
constexpr int kAcross = 48;       // places from border to border at the least and largest turning
constexpr double kFlat = 1e-6;    // least turning, and least missing to half a turn
constexpr double kInside = 1e-3;  // of the region's width
constexpr int kHalvings = 24;     // of a step of turning: to 1e-7 of it

/// A triangle but for one vertex.
struct Open {
  std::array<Point2, 3> points;
  int handle = 0;
  double side = 1;  ///< 1: turning left

  const Point2& after(int steps) const {
    return points[static_cast<std::size_t>((handle + steps) % 3)];
  }
  /// Where the handle stands for these angles; at most kFar away.
  Point2 place(double theta, double psi) const {
    const std::array angles{psi, core::kPi - theta, theta - psi};
    const auto angle = [&](int steps) {
      return angles[static_cast<std::size_t>((handle + steps) % 3)];
    };
    const Vector2 base = after(2) - after(1);
    const double away = std::sin(angle(2)) / std::max(std::sin(angle(0)), 1e-12);
    const double turn = side * angle(1);
    const Vector2 ray{base.x * std::cos(turn) - base.y * std::sin(turn),
                      base.x * std::sin(turn) + base.y * std::cos(turn)};
    return after(1) + std::clamp(away, 0.0, kFar) * ray;
  }
};

/// From 0 to 1 in n steps, denser towards both ends, where borders bend.
double eased(int i, int n) { return 0.5 * (1 - std::cos(core::kPi * i / n)); }

double turning(int i) { return kFlat + eased(i, kTurnings - 1) * (core::kPi - 2 * kFlat); }

std::vector<Point2> outline(const Open& triangle, const RegionOfTurning& region) {
  std::vector<Point2> line;
  std::vector<Point2> back;
  const auto across = [&](double theta, bool up) {
    const core::Interval psi = region(theta);
    for (int i = 1; i < kAcross; ++i) {
      const double share = eased(i, kAcross);
      line.push_back(triangle.place(theta, at(psi, up ? share : 1 - share)));
    }
  };
  for (int i = 0; i < kTurnings; ++i) {
    const double theta = turning(i);
    const core::Interval psi = region(theta);
    line.push_back(triangle.place(theta, psi.low));
    back.push_back(triangle.place(theta, psi.high));
  }
  across(turning(kTurnings - 1), true);
  line.insert(line.end(), back.rbegin(), back.rend());
  across(turning(0), false);
  return line;
}

struct Nearest {
  double distance = HUGE_VAL;
  Point2 place;

  void offer(Point2 other, double away) {
    if (!(away < distance)) return;
    distance = away;
    place = other;
  }
};

/// The nearest place of one border, a little inside of it.
void offer_border(Nearest& nearest, const Open& triangle, const RegionOfTurning& region,
                  double share) {
  const Point2& from = triangle.after(0);
  const auto place = [&](double theta) { return triangle.place(theta, at(region(theta), share)); };
  const auto away = [&](double theta) { return core::distance(place(theta), from); };
  int best = 0;
  for (int i = 1; i < kTurnings; ++i)
    if (away(turning(i)) < away(turning(best))) best = i;
  double low = turning(std::max(best - 1, 0));
  double high = turning(std::min(best + 1, kTurnings - 1));
  for (int i = 0; i < kHalvings; ++i) {
    const double third = (high - low) / 3;
    if (away(low + third) < away(high - third))
      high -= third;
    else
      low += third;
  }
  const double theta = 0.5 * (low + high);
  nearest.offer(place(theta), away(theta));
}

bool is_drawable(const std::array<Point2, 3>& points, const RegionOfTurning& region) {
  const auto angles = handle_angles(points[0], points[1], points[2]);
  if (!angles) return false;
  const double theta = std::abs(angles->turning);
  if (theta == 0) return true;  // a straight line
  if (!(theta < core::kPi)) return false;
  const core::Interval psi = region(theta);
  const double chord_angle = std::abs(angles->chord_angle);
  return chord_angle > psi.low && chord_angle < psi.high;
}

}  // namespace

HandleRegion handle_region(const std::array<Point2, 3>& points, int handle,
                           const RegionOfTurning& region) {
  HandleRegion found;
  Open left{points, handle, 1};
  if (!(core::distance(left.after(1), left.after(2)) > 0)) return found;
  const Open right{points, handle, -1};
  found.outlines = {outline(left, region), outline(right, region)};
  if (is_drawable(points, region)) return found;
  Nearest nearest;
  for (const Open& triangle : {left, right})
    for (const double share : {kInside, 1 - kInside})
      offer_border(nearest, triangle, region, share);
  found.nearest = nearest.place;
  return found;
}

}  // namespace keyline::lac
