#include "keyline/classa/nearest.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "keyline/core/extent.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/length.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::classa {

using core::Point2;
using core::Vector2;
using Complex = std::complex<double>;

namespace {

constexpr int kSamples = 65;

/// The curve from 0 to 1 in the complex plane with the matrix z: t G(1 - t + t z)/G(z) with
/// G(w) = 1 + w + … + w^(n-1); its edges are powers of z up to a factor.
struct UnitCurve {
  Complex z;
  int degree;
  Complex whole;  // G(z)

  UnitCurve(double alpha, double log_s, int n)
      : z(std::polar(std::exp(log_s), alpha)), degree(n), whole(powers(z)) {}

  Complex powers(Complex w) const {
    Complex sum = 0;
    for (int i = 0; i < degree; ++i) sum = sum * w + 1.0;
    return sum;
  }
  Complex point(double t) const { return t * powers(1.0 + t * (z - 1.0)) / whole; }
  Complex tangent(double t) const {
    const Complex w = 1.0 + t * (z - 1.0);
    Complex power = 1;
    for (int i = 1; i < degree; ++i) power *= w;
    return static_cast<double>(degree) * power / whole;
  }
};

/// The given curve's points in a frame whose chord runs from 0 to 1.
struct Samples {
  std::vector<Complex> points;
  double chord = 1;
};

Samples sample_even(const curve::Bezier2& given) {
  const Vector2 chord = given.control.back() - given.control.front();
  const Complex unit(chord.x, chord.y);
  Samples samples{{}, norm(chord)};
  for (const double t : equal_length_parameters(given, kSamples, 1e-9)) {
    const Vector2 v = evaluate(given, t) - given.control.front();
    samples.points.push_back(Complex(v.x, v.y) / unit);
  }
  return samples;
}

/// Feet of the samples on the curve: Newton's method from the neighbour's parameter, over a table.
std::vector<double> feet(const UnitCurve& c, const std::vector<Complex>& points) {
  constexpr int kTable = 64;
  std::vector<Complex> table;
  for (int i = 0; i <= kTable; ++i) table.push_back(c.point(i / static_cast<double>(kTable)));
  std::vector<double> t;
  for (const Complex& p : points) {
    const auto nearest = std::min_element(
        table.begin(), table.end(),
        [&p](const Complex& a, const Complex& b) { return std::norm(a - p) < std::norm(b - p); });
    double foot = static_cast<double>(nearest - table.begin()) / kTable;
    for (int i = 0; i < 3; ++i) {
      const Complex tangent = c.tangent(foot);
      const Complex off = p - c.point(foot);
      foot += (off * std::conj(tangent)).real() / std::norm(tangent);
      foot = std::clamp(foot, 0.0, 1.0);
    }
    t.push_back(foot);
  }
  return t;
}

/// Distances across the curve, signed; from an end of it, the whole distance.
std::vector<double> misfits(const UnitCurve& c, const std::vector<Complex>& points) {
  const std::vector<double> t = feet(c, points);
  std::vector<double> off;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Complex tangent = c.tangent(t[i]);
    const Complex v = points[i] - c.point(t[i]);
    off.push_back(std::copysign(std::abs(v), (v * std::conj(tangent)).imag()));
  }
  return off;
}

double squares(const std::vector<double>& off) {
  double sum = 0;
  for (const double d : off) sum += d * d;
  return sum;
}

struct Place {
  double alpha = 0;
  double log_s = 0;
  double cost = HUGE_VAL;
};

Place place_at(double alpha, double log_s, int degree, const std::vector<Complex>& points) {
  const double cost = squares(misfits({alpha, log_s, degree}, points));
  return {alpha, log_s, std::isfinite(cost) ? cost : HUGE_VAL};  // sorted by it: no NaN
}

std::vector<Place> best_of_grid(int degree, const std::vector<Complex>& points,
                                const NearestOptions& o) {
  constexpr int kAlpha = 8;
  constexpr int kScale = 4;
  const double reach = std::min({1.4, std::log(o.s.high), -std::log(o.s.low)});
  std::vector<Complex> sparse;
  for (std::size_t i = 0; i < points.size(); i += 8) sparse.push_back(points[i]);
  std::vector<Place> places;
  for (int i = -kAlpha; i <= kAlpha; ++i)
    for (int j = -kScale; j <= kScale; ++j)
      places.push_back(place_at(o.alpha_max * i / kAlpha, reach * j / kScale, degree, sparse));
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.cost < b.cost; });
  places.resize(3);
  return places;
}

Place improve(const Place& start, int degree, const std::vector<Complex>& points,
              const NearestOptions& o) {
  const auto function = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residuals,
                            Eigen::MatrixXd* jacobian) {
    if (std::abs(x[0]) > o.alpha_max || x[1] < std::log(o.s.low) || x[1] > std::log(o.s.high))
      return false;
    const auto at = [&](double alpha, double log_s) {
      const std::vector<double> off = misfits({alpha, log_s, degree}, points);
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(off.data(), off.size()));
    };
    residuals = at(x[0], x[1]);
    if (jacobian) {
      constexpr double kStep = 1e-6;
      jacobian->resize(residuals.size(), 2);
      jacobian->col(0) = (at(x[0] + kStep, x[1]) - at(x[0] - kStep, x[1])) / (2 * kStep);
      jacobian->col(1) = (at(x[0], x[1] + kStep) - at(x[0], x[1] - kStep)) / (2 * kStep);
    }
    return true;
  };
  Eigen::VectorXd x(2);
  x << std::clamp(start.alpha, -o.alpha_max, o.alpha_max), start.log_s;
  numeric::minimize_least_squares(function, x, {.max_iterations = 25, .step_tolerance = 1e-10});
  return place_at(x[0], x[1], degree, points);
}

curve::Bezier2 place_curve(const UnitCurve& c, const curve::Bezier2& given) {
  const Vector2 chord = given.control.back() - given.control.front();
  curve::Bezier2 made;
  Complex at = 0;
  Complex edge = 1.0 / c.whole;
  for (int i = 0; i <= c.degree; ++i) {
    made.control.push_back(given.control.front() +
                           Vector2{chord.x * at.real() - chord.y * at.imag(),
                                   chord.x * at.imag() + chord.y * at.real()});
    at += edge;
    edge *= c.z;
  }
  made.control.back() = given.control.back();
  return made;
}

double farthest(const curve::Bezier2& from, const curve::Bezier2& to) {
  double most = 0;
  for (const double t : equal_length_parameters(from, kSamples, 1e-9))
    most = std::max(most, closest_point(to, evaluate(from, t)).distance);
  return most;
}

/// Precondition: a chord.
std::optional<NearestCurve> nearest_from_start(const curve::Bezier2& given,
                                               const NearestOptions& options) {
  const int degree = curve::degree(given);
  const Samples samples = sample_even(given);
  Place best;
  for (const Place& start : best_of_grid(degree, samples.points, options)) {
    const Place place = improve(start, degree, samples.points, options);
    if (place.cost < best.cost) best = place;
  }
  if (!std::isfinite(best.cost)) return std::nullopt;
  const UnitCurve unit(best.alpha, best.log_s, degree);
  NearestCurve nearest{{best.alpha, std::exp(best.log_s)}, place_curve(unit, given), 0, 0};
  nearest.distance = std::max(farthest(given, nearest.curve), farthest(nearest.curve, given));
  nearest.rms = samples.chord * std::sqrt(best.cost / kSamples);
  return nearest;
}

}  // namespace

std::optional<NearestCurve> nearest_matrix_curve(const curve::Bezier2& given,
                                                 const NearestOptions& options) {
  const double size = core::reach(given.control);
  if (curve::degree(given) < 2 ||
      distance(given.control.front(), given.control.back()) <= 1e-9 * size)
    return std::nullopt;
  if (!edges_shrink(given.control)) return nearest_from_start(given, options);
  auto back = nearest_from_start(reverse(given), options);  // the same search from either end
  if (back)
    *back = {
        {-back->matrix.alpha, 1 / back->matrix.s}, reverse(back->curve), back->distance, back->rms};
  return back;
}

}  // namespace keyline::classa
