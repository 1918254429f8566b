#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Numerics of the tests' own to judge answers by: nothing here calls the library's geometry. What
/// is known of a log-aesthetic piece is its law alone (docs/readings.md): curvature is the power
/// mean of its ends by the fraction of the length, radius that by the fraction of the turning.
namespace keyline::own {

using nlohmann::json;

struct Place {
  double x = 0, y = 0, direction = 0;
};

/// A curve walked through in panels so short that quadrature of each is exact to rounding.
struct Track {
  std::vector<Place> places;        ///< ends of the panels, from the curve's start
  std::vector<std::size_t> joints;  ///< of the pieces, into places; first and last included
  double area = 0;                  ///< between curve and chord, positive left of the chord's right
  double length = 0;
  const Place& end() const { return places.back(); }
};

/// Of a log-aesthetic curve value.
Track walked(const json& curve);

/// Rules of the public form that the curve breaks, in words; empty: none.
std::vector<std::string> faults(const json& curve);

/// Where a JSON value holds null or a number that is not finite, without fields named in `allowed`.
std::vector<std::string> holes(const json& value, const std::vector<std::string>& allowed = {});

/// Integral over [from, to] by panels that halve towards `to` and `from`, Gauss's rule in each.
double integral(const std::function<double(double)>& f, double from, double to);

/// Greatest chord angle of a segment of slope alpha turning by theta in (0, 2 pi): that of the
/// curve with an inflection or a cusp at an end; theta for 0 <= alpha <= 1.
double greatest_chord_angle(double alpha, double theta);

struct SpaceEnd {
  std::array<double, 3> place{}, tangent{};
};
/// End of a log-aesthetic curve in space: Frenet's equations by Runge and Kutta's method of order 4
/// in `steps` steps for each piece.
SpaceEnd integrated(const json& curve, int steps = 2000);

/// The answer to a request, through the text a client sends. How many of its operation were asked
/// so far is recorded beside the test.
json answered(const json& request);

/// Its result; a failure of the test where there is none.
json result_of(const json& request);

double uniform(std::mt19937_64& random, double low, double high);
double wrapped(double angle);

/// Of a kind of requests: the kind's own, or another where KEYLINE_SEED holds a number.
std::uint64_t seed(std::uint64_t kind);

/// So many requests: `share` of 2,000, of 100,000 where KEYLINE_FULL is set, or of
/// KEYLINE_REQUESTS.
int requests(double share);

}  // namespace keyline::own
