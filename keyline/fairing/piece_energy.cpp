#include "keyline/fairing/piece_energy.h"

#include <algorithm>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kEven = 1e-6;    // log of the ends' ratio below which a piece is as good as linear
constexpr double kZero = 1e-9;    // of the larger end: where powers are no longer told apart
constexpr double kMostLog = 300;  // e^300 is 2e130: a product of two is finite

/// (e^(q l) - 1) / q.
double growth(double q, double l) {
  const double x = std::clamp(q * l, -kMostLog, kMostLog);
  return std::abs(x) < 1e-12 ? l : std::expm1(x) / q;
}

PieceEnergy same_sign(double a, double b, double p) {
  const double l = std::log(b / a);
  if (std::abs(l) < kEven) return {b - a, -1, 1};
  const double first = growth(p, l);
  const double second = growth(2 - p, l);
  const double root = std::copysign(std::sqrt(first * second), l);
  const double rise = std::exp(std::clamp(p * l, -kMostLog, kMostLog)) * second +
                      std::exp(std::clamp((2 - p) * l, -kMostLog, kMostLog)) * first;
  const double by_log = rise / (2 * root);
  return {a * root, root - by_log, by_log * a / b};
}

PieceEnergy through_zero(double a, double b, double p) {
  const double scale = std::max(std::abs(a), std::abs(b));
  if (scale == 0) return {0, -1, 1};
  const double u = std::max(std::abs(a) / scale, kZero);
  const double v = std::max(std::abs(b) / scale, kZero);
  const double first = (std::pow(u, p) + std::pow(v, p)) / p;
  const double second = (std::pow(u, 2 - p) + std::pow(v, 2 - p)) / (2 - p);
  const double root = std::sqrt(first * second);
  const double by_u = (std::pow(u, p - 1) * second + std::pow(u, 1 - p) * first) / (2 * root);
  const double by_v = (std::pow(v, p - 1) * second + std::pow(v, 1 - p) * first) / (2 * root);
  const double way = b > a ? 1 : -1;
  return {way * scale * root, -by_u, by_v};
}

}  // namespace

PieceEnergy piece_energy(double a, double b, double alpha) {
  if (alpha == -1) return {b - a, -1, 1};
  if (a * b > 0) return same_sign(a, b, -alpha);
  return through_zero(a, b, -alpha);
}

}  // namespace keyline::fairing::detail
