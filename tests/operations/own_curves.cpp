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

/// Halves of a curve.
std::array<Bezier, 2> halves(Bezier b) {
  const std::size_t last = b.size() - 1;
  Bezier left(b.size());
  for (std::size_t level = 0; level <= last; ++level) {
    left[level] = b[0];
    for (std::size_t i = 0; i + level < last; ++i)
      for (std::size_t k = 0; k < 4; ++k) b[i][k] = 0.5 * (b[i][k] + b[i + 1][k]);
  }
  return {std::move(left), std::move(b)};
}

/// Whether no place of the curve is nearer to the origin: |point|^2 - near^2 weight^2 has no
/// coefficient below 0 in Bernstein's basis.
bool keeps_off(const Bezier& b, double near) {
  Bezier scaled = b;
  double binomial = 1;
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (double& x : scaled[i]) x *= binomial;
    binomial *= static_cast<double>(b.size() - 1 - i) / static_cast<double>(i + 1);
  }
  for (std::size_t sum = 0; sum + 1 < 2 * b.size(); ++sum) {
    double coefficient = 0;
    for (std::size_t i = sum < b.size() ? 0 : sum + 1 - b.size(); i < b.size() && i <= sum; ++i) {
      const Four &p = scaled[i], &q = scaled[sum - i];
      coefficient += dot(front(p), front(q)) - near * near * p[3] * q[3];
    }
    if (!(coefficient > 0)) return false;
  }
  return true;
}

}  // namespace

double distance_from(const std::vector<Bezier>& curve, const Vec& point) {
  constexpr double kNearer = 1 - 1e-9;  // by less than that Newton's steps find by themselves
  struct Part {
    Bezier control;  ///< less the point
    const Bezier* whole;
    double from, to;
  };
  std::vector<Part> left;
  double best = INFINITY;
  const auto offer = [&](const Bezier& whole, double t, double off) {
    if (off < best) best = std::min(off, closed_in(whole, point, t));
  };
  const auto off = [](const Four& p) { return size(front(p)) / p[3]; };
  for (const Bezier& c : curve) {
    Part part{c, &c, 0, 1};
    for (Four& p : part.control)
      for (std::size_t k = 0; k < 3; ++k) p[k] -= p[3] * point[k];
    offer(c, 0, off(part.control.front()));
    offer(c, 1, off(part.control.back()));
    left.push_back(std::move(part));
  }
  while (!left.empty()) {
    const Part part = std::move(left.back());
    left.pop_back();
    if (part.to - part.from < 1e-16 || keeps_off(part.control, kNearer * best)) continue;
    auto [first, second] = halves(part.control);
    const double middle = 0.5 * (part.from + part.to);
    offer(*part.whole, middle, off(second.front()));
    left.push_back({std::move(first), part.whole, part.from, middle});
    left.push_back({std::move(second), part.whole, middle, part.to});
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
