#include "keyline/sketch/turn_backs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kTurn = 0.75 * std::numbers::pi;
constexpr double kBeside = 2.0 / 3;  ///< of the shorter way

/// Times the distance of passes: how far to either side a turn is looked at. Around a half circle
/// of that diameter it is three quarters of a half turn.
constexpr double kWindow = 1.5;
/// Times that distance: how far along the other way the nearest place is looked for.
constexpr double kLook = 3;

/// Turn of the stroke at every point, as chords over `window` points on either side show it; 0 near
/// the ends.
std::vector<double> turns_of(const std::vector<Point2>& points, std::size_t window) {
  std::vector<double> turns(points.size(), 0);
  for (std::size_t i = window; i + window < points.size(); ++i) {
    const Vector2 to = points[i] - points[i - window];
    const Vector2 from = points[i + window] - points[i];
    turns[i] = std::abs(std::atan2(core::cross(to, from), core::dot(to, from)));
  }
  return turns;
}

/// The sharpest place of every stretch that turns as much.
std::vector<std::size_t> sharp_places(const std::vector<double>& turns) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] < kTurn) continue;
    std::size_t last = i;
    while (last + 1 < turns.size() && turns[last + 1] >= kTurn) ++last;
    const auto first = turns.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = turns.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    places.push_back(static_cast<std::size_t>(std::max_element(first, end) - turns.begin()));
    i = last;
  }
  return places;
}

/// A stretch of points walked from one of its ends.
struct Way {
  const std::vector<Point2>& points;
  std::size_t from;
  std::ptrdiff_t step;
  std::size_t size;
  Point2 operator[](std::size_t k) const {
    return points[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(from) +
                                           step * static_cast<std::ptrdiff_t>(k))];
  }
};

/// Share of the points of one way that have the other within reach, both walked from where they
/// meet.
double share_beside(const Way& one, const Way& other, double reach, std::size_t look) {
  std::size_t at = 0;
  std::size_t beside = 0;
  for (std::size_t k = 0; k < one.size; ++k) {
    std::size_t nearest = at;
    for (std::size_t j = at; j < std::min(at + look, other.size); ++j)
      if (core::distance(one[k], other[j]) < core::distance(one[k], other[nearest])) nearest = j;
    at = nearest;
    beside += core::distance(one[k], other[at]) <= reach ? 1 : 0;
  }
  return static_cast<double>(beside) / static_cast<double>(one.size);
}

}  // namespace

std::vector<std::size_t> turn_backs(const std::vector<Point2>& points, const PassModel& at_most) {
  if (points.size() < 3) return {};
  const double step = core::distance(points[0], points[1]);
  const double apart = pass_distance(at_most, 0);
  if (!(step > 0)) return {};
  const auto steps = [&](double length) { return static_cast<std::size_t>(length / step) + 1; };
  const auto places = sharp_places(turns_of(points, steps(kWindow * apart)));
  std::vector<std::size_t> backs;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t at = places[k];
    const std::size_t before = k == 0 ? 0 : places[k - 1];
    const std::size_t after = k + 1 < places.size() ? places[k + 1] : points.size() - 1;
    Way shorter{points, at, -1, at - before + 1};
    Way longer{points, at, 1, after - at + 1};
    const bool swapped = shorter.size > longer.size;
    const Way& one = swapped ? longer : shorter;
    const Way& other = swapped ? shorter : longer;
    const double reach = pass_distance(at_most, step * static_cast<double>(one.size));
    if (share_beside(one, other, reach, steps(kLook * apart)) >= kBeside) backs.push_back(at);
  }
  return backs;
}

}  // namespace keyline::sketch
