#include "true_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace keyline::fairing::testing {
namespace {

using core::Point2;

struct Formula {
  const char* name;
  double from;
  double to;
  bool closed;
  Point2 (*at)(double t);
};

constexpr double kPi = std::numbers::pi;

double power(double base, double exponent) {
  return std::copysign(std::pow(std::abs(base), exponent), base);
}

/// Thickness of the NACA four-digit sections (Abbott and von Doenhoff, Theory of Wing Sections,
/// 6.2), in the square root of the chord's share so that the nose has a tangent.
double naca_thickness(double root) {
  const double x = root * root;
  return 5 * 0.12 *
         (0.2969 * root - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1015 * x * x * x * x);
}

constexpr Formula kFormulas[] = {
    {"ellipse", 0, 2 * kPi, true,
     [](double t) { return Point2{3 * std::cos(t), 1.2 * std::sin(t)}; }},
    {"parabola", -1.5, 1, false, [](double t) { return Point2{t, t * t}; }},
    {"catenary", -2, 1.2, false, [](double t) { return Point2{t, std::cosh(t)}; }},
    {"sine", 0, 2 * kPi, false, [](double t) { return Point2{t, std::sin(t)}; }},
    {"logarithmic spiral", 0, 2 * kPi, false,
     [](double t) {
       return Point2{std::exp(0.2 * t) * std::cos(t), std::exp(0.2 * t) * std::sin(t)};
     }},
    {"spiral of Archimedes", 1, 3 * kPi, false,
     [](double t) { return Point2{t * std::cos(t), t * std::sin(t)}; }},
    {"cycloid", 0.5, 2 * kPi - 0.5, false,
     [](double t) { return Point2{t - std::sin(t), 1 - std::cos(t)}; }},
    {"involute", 0.5, 4, false,
     [](double t) { return Point2{std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)}; }},
    {"superellipse", 0, 2 * kPi, true,
     [](double t) { return Point2{3 * power(std::cos(t), 0.8), 2 * power(std::sin(t), 0.8)}; }},
    {"limacon", 0, 2 * kPi, true,
     [](double t) {
       return Point2{(3 + std::cos(t)) * std::cos(t), (3 + std::cos(t)) * std::sin(t)};
     }},
    {"wing section", -0.95, 0.95, false,
     [](double t) { return Point2{t * t, std::copysign(naca_thickness(std::abs(t)), t)}; }},
    {"hyperbola", -1, 1.6, false, [](double t) { return Point2{std::cosh(t), std::sinh(t)}; }}};

/// Places at equal steps of the length of a fine polygon.
std::vector<Point2> evenly(const std::vector<Point2>& fine, std::size_t count, bool closed) {
  std::vector<double> length{0};
  for (std::size_t i = 1; i < fine.size(); ++i)
    length.push_back(length.back() + distance(fine[i - 1], fine[i]));
  std::vector<Point2> places;
  std::size_t i = 1;
  const auto steps = static_cast<double>(closed ? count : count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    const double s = length.back() * static_cast<double>(k) / steps;
    while (i + 1 < fine.size() && length[i] < s) ++i;
    const double share = (s - length[i - 1]) / (length[i] - length[i - 1]);
    places.push_back(fine[i - 1] + share * (fine[i] - fine[i - 1]));
  }
  return places;
}

/// Normal errors, the same in every build (std::normal_distribution is not): Box and Muller's.
class Errors {
 public:
  double operator()() {
    const double u = (1.0 + static_cast<double>(engine_())) / 4294967297.0;
    const double v = static_cast<double>(engine_()) / 4294967296.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
  }

 private:
  std::mt19937 engine_{20261122};
};

}  // namespace

std::vector<TrueCurve> true_curves() {
  constexpr std::size_t kPoints = 160;
  constexpr int kFine = 20000;
  constexpr double kNoise[] = {0, 1e-4, 5e-4};  // of the length, in turn
  std::vector<TrueCurve> curves;
  Errors error;
  for (const Formula& formula : kFormulas) {
    TrueCurve curve{formula.name, formula.closed, 0, {}, {}};
    for (int i = 0; i <= kFine; ++i)
      curve.truth.push_back(formula.at(formula.from + (formula.to - formula.from) * i / kFine));
    double length = 0;
    for (int i = 1; i <= kFine; ++i) {
      const auto k = static_cast<std::size_t>(i);
      length += distance(curve.truth[k - 1], curve.truth[k]);
    }
    curve.noise = length * kNoise[curves.size() % 3];
    curve.points = evenly(curve.truth, kPoints, formula.closed);
    for (Point2& p : curve.points) p = {p.x + curve.noise * error(), p.y + curve.noise * error()};
    curves.push_back(std::move(curve));
  }
  return curves;
}

Away away_from(const TrueCurve& curve, const std::vector<Point2>& answer) {
  Away away;
  for (const Point2 p : answer) {
    double least = distance(p, curve.truth.front());
    for (const Point2 q : curve.truth) least = std::min(least, distance(p, q));
    away.largest = std::max(away.largest, least);
    away.rms += least * least / static_cast<double>(answer.size());
  }
  away.rms = std::sqrt(away.rms);
  return away;
}

}  // namespace keyline::fairing::testing
