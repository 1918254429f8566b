#include "own_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "own_bezier.h"
#include "own_gauss.h"

namespace keyline::own {
namespace {

double speed(const Bezier& c, double t) { return size(spot(c, t).first); }

template <class F>
double adaptive(const F& f, double from, double to, double whole, double allowed, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss(f, from, middle), right = gauss(f, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= allowed) return left + right;
  return adaptive(f, from, middle, left, allowed, depth - 1) +
         adaptive(f, middle, to, right, allowed, depth - 1);
}

/// To about 1e-12 of what a first estimate says.
template <class F>
double adaptive(const F& f, double from, double to) {
  constexpr int kPanels = 8;
  double sum = 0;
  std::array<double, kPanels> first{};
  const double step = (to - from) / kPanels;
  for (int i = 0; i < kPanels; ++i) {
    first[static_cast<std::size_t>(i)] = gauss(f, from + i * step, from + (i + 1) * step);
    sum += std::abs(first[static_cast<std::size_t>(i)]);
  }
  double all = 0;
  for (int i = 0; i < kPanels; ++i)
    all += adaptive(f, from + i * step, from + (i + 1) * step, first[static_cast<std::size_t>(i)],
                    1e-13 * sum, 14);
  return all;
}

}  // namespace

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double size(const Vec& a) { return std::hypot(a[0], a[1], a[2]); }
double distance(const Vec& a, const Vec& b) { return size(a - b); }
Vec vec(const json& point) {
  return {point[0], point[1], point.size() > 2 ? point[2].get<double>() : 0};
}

Spot spot(const Bezier& c, double t) {
  const Bezier d = derivative(c), dd = derivative(d);
  const Four a = casteljau(c, t), a1 = casteljau(d, t), a2 = casteljau(dd, t);
  Spot s;
  s.place = (1 / a[3]) * front(a);
  s.first = (1 / a[3]) * (front(a1) - a1[3] * s.place);
  s.second = (1 / a[3]) * (front(a2) - 2 * a1[3] * s.first - a2[3] * s.place);
  return s;
}

double curvature(const Spot& s) {
  const double v = size(s.first);
  return cross(s.first, s.second)[2] / (v * v * v);
}

double curvature_rate(const Bezier& c, double t) {
  const Bezier d = derivative(c), dd = derivative(d), ddd = derivative(dd);
  const Vec a = front(casteljau(d, t)), b = front(casteljau(dd, t)), e = front(casteljau(ddd, t));
  return dot(a, a) * cross(a, e)[2] - 3 * cross(a, b)[2] * dot(a, b);
}

double direction(const Spot& s) { return std::atan2(s.first[1], s.first[0]); }

std::vector<Bezier> beziers_of(const json& curve) {
  const std::string type = curve.at("type");
  std::vector<Bezier> all;
  if (type == "path") {
    for (const json& member : curve["curves"])
      for (Bezier& b : beziers_of(member)) all.push_back(std::move(b));
    return all;
  }
  const Bezier control =
      control_of(curve.at("points"), curve.contains("weights") ? &curve["weights"] : nullptr);
  if (type == "bezier") return {control};
  if (type == "bspline") return cut(control, curve["knots"], curve["degree"]);
  if (type != "polyline") throw std::invalid_argument(type);
  for (std::size_t i = 0; i + 1 < control.size(); ++i) all.push_back({control[i], control[i + 1]});
  return all;
}

double length_of(const Bezier& c, double from, double to) {
  return adaptive([&](double t) { return speed(c, t); }, from, to);
}

double length_of(const std::vector<Bezier>& curve) {
  double sum = 0;
  for (const Bezier& c : curve) sum += length_of(c);
  return sum;
}

std::vector<Spot> spots(const std::vector<Bezier>& curve, int each) {
  std::vector<Spot> all;
  for (const Bezier& c : curve)
    for (int k = all.empty() ? 0 : 1; k <= each; ++k)
      all.push_back(spot(c, static_cast<double>(k) / each));
  return all;
}

namespace {

/// Newton's steps from a parameter near the nearest one, halved until they help.
double closed_in(const Bezier& c, const Vec& point, double t) {
  const auto off = [&](double at) {
    const Four p = casteljau(c, at);
    return distance((1 / p[3]) * front(p), point);
  };
  double best = off(t);
  for (int n = 0; n < 20; ++n) {
    const Spot s = spot(c, t);
    const Vec away = s.place - point;
    const double slope = dot(away, s.first), speed = dot(s.first, s.first);
    const double bend = std::max(speed + dot(away, s.second), 1e-3 * speed);
    if (!(bend > 0)) break;
    bool better = false;
    for (double step = -slope / bend; !better && std::abs(step) > 1e-16; step /= 4) {
      const double at = std::clamp(t + step, 0.0, 1.0), here = off(at);
      better = here < best;
      if (better) t = at;
      best = std::min(best, here);
    }
    if (!better) break;
  }
  return best;
}

}  // namespace

double distance_from(const std::vector<Bezier>& curve, const Vec& point) {
  constexpr int kPlaces = 40, kFiner = 16;
  double best = INFINITY;
  for (const Bezier& c : curve) {
    const auto at = [&](double t) {
      const Four p = casteljau(c, t);
      return (1 / p[3]) * front(p);
    };
    std::vector<Vec> places;
    for (int k = 0; k <= kPlaces; ++k) places.push_back(at(k / double{kPlaces}));
    for (int k = 0; k <= kPlaces; ++k) {
      const auto off = [&](int i) {
        return i < 0 || i > kPlaces ? INFINITY
                                    : distance(places[static_cast<std::size_t>(i)], point);
      };
      best = std::min(best, off(k));
      double spacing = 0;  // of the places around: next to a cusp they crowd
      for (int i = std::max(1, k - 2); i <= std::min(kPlaces, k + 3); ++i)
        spacing = std::max(spacing, distance(places[static_cast<std::size_t>(i)],
                                             places[static_cast<std::size_t>(i) - 1]));
      if (off(k) > off(k - 1) || off(k) > off(k + 1) || off(k) > best + 2 * spacing) continue;
      // Both branches of a hairpin may pass there: from every finer place nearer than its own.
      std::array<double, 2 * kFiner + 3> finer{};
      finer.fill(INFINITY);
      const auto finer_t = [&](int i) {
        return std::clamp((k + (i - 1 - kFiner) / double{kFiner}) / kPlaces, 0.0, 1.0);
      };
      for (int i = 1; i <= 2 * kFiner + 1; ++i)
        finer[static_cast<std::size_t>(i)] = distance(at(finer_t(i)), point);
      for (std::size_t i = 1; i + 1 < finer.size(); ++i)
        if (finer[i] <= finer[i - 1] && finer[i] <= finer[i + 1])
          best = std::min(best, closed_in(c, point, finer_t(static_cast<int>(i))));
    }
  }
  return best;
}

double volume_of(const std::vector<Bezier>& curve) {
  const Vec start = spot(curve.front(), 0).place;
  Vec chord = spot(curve.back(), 1).place - start;
  const double long_ = size(chord);
  chord = long_ > 0 ? (1 / long_) * chord : Vec{1, 0, 0};
  double sum = 0, part = 0;
  for (const Bezier& c : curve) {
    const auto height = [&](double t) { return cross(chord, spot(c, t).place - start)[2]; };
    const auto pace = [&](double t) { return height(t) * dot(chord, spot(c, t).first); };
    constexpr int kSteps = 200;
    std::vector<double> steps;  // both ends lie on the chord: it may be crossed right behind them
    for (int k = 1; k < kSteps; ++k) steps.push_back(k / double{kSteps});
    for (double step = 0.5 / kSteps; step > 1e-6; step /= 2)
      for (const double t : {step, 1 - step}) steps.push_back(t);
    std::ranges::sort(steps);
    double from = 0;
    for (std::size_t k = 1; k < steps.size(); ++k) {
      double low = steps[k - 1], high = steps[k];
      const double before = height(low), after = height(high);
      if (before * after < 0) {
        for (int n = 0; n < 60; ++n) {
          const double middle = 0.5 * (low + high);
          (height(middle) * before > 0 ? low : high) = middle;
        }
        part += adaptive(pace, from, low);
        sum += std::abs(part);
        part = 0;
        from = low;
      }
    }
    part += adaptive(pace, from, 1);
  }
  return sum + std::abs(part);
}

double energy_of(const Bezier& c) {
  return adaptive(
      [&](double t) {
        const Spot s = spot(c, t);
        const double v = size(s.first), k = size(cross(s.first, s.second)) / (v * v * v);
        return k * k * v;
      },
      0, 1);
}

std::vector<Vec> places_of(const json& curve, int about) {
  std::vector<Vec> all;
  if (curve.at("type") == "path") {
    for (const json& member : curve["curves"])
      for (const Vec& p : places_of(member, 1 + about / static_cast<int>(curve["curves"].size())))
        all.push_back(p);
    return all;
  }
  if (curve["type"] == "log-aesthetic") {
    for (const Place& p : walked(curve).places) all.push_back({p.x, p.y, 0});
    return all;
  }
  const auto beziers = beziers_of(curve);
  for (const Spot& s : spots(beziers, 1 + about / static_cast<int>(beziers.size())))
    all.push_back(s.place);
  return all;
}

}  // namespace keyline::own
