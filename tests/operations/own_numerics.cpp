#include "own_numerics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/operations/perform.h"

#include "own_gauss.h"

namespace keyline::own {
namespace {

using Function = std::function<double(double)>;
using Complex = std::complex<double>;

/// A piece by some variable x in [0, 1]: tangent angle from the start, and ds/dx.
struct Walk {
  Function angle, pace;
  std::vector<double> breaks;
};

std::vector<double> even_breaks(double count) {
  const int n = static_cast<int>(count) + 4;
  std::vector<double> breaks;
  for (int i = 0; i <= n; ++i) breaks.push_back(static_cast<double>(i) / n);
  return breaks;
}

/// Halving towards both ends.
std::vector<double> graded_breaks() {
  std::vector<double> breaks{0};
  for (int k = 70; k > 1; --k) breaks.push_back(std::ldexp(1, -k));
  for (int k = 1; k < 50; ++k) breaks.push_back(1 - std::ldexp(1, -k));
  breaks.push_back(1);
  return breaks;
}

Walk arc(double length, double bend) {
  return {[=](double x) { return bend * length * x; }, [=](double) { return length; },
          even_breaks(std::abs(bend) * length)};
}

/// Curvatures of one sign, x the fraction of ln(curvature): all is exponential in x. In long
/// double: over ratios up to e^1400 an exponent's last digit of a double would be 1e-13 of the
/// angle, and its exponential no double.
Walk one_sign(double alpha, double length, double k0, double k1) {
  const long double q = std::log(static_cast<long double>(k1) / k0);
  const long double y = -alpha * q, z = (1 - static_cast<long double>(alpha)) * q;
  const long double unit = length * (y == 0 ? 1 : y / std::expm1(y));
  Walk w;
  w.breaks =
      even_breaks(static_cast<double>(2 * std::max({std::abs(y), std::abs(z), std::abs(q)})));
  w.pace = [=](double x) { return static_cast<double>(unit * std::exp(y * x)); };
  w.angle = [=](double x) {
    return static_cast<double>(k0 * unit * (z == 0 ? x : std::expm1(z * x) / z));
  };
  return w;
}

/// Curvature k v^e, e = -1/alpha: from an inflection (alpha < 0) or a cusp (alpha > 1).
Walk from_limit(double alpha, double length, double k) {
  const double e = -1 / alpha;
  return {[=](double x) { return k * length * std::pow(x, e + 1) / (e + 1); },
          [=](double) { return length; }, graded_breaks()};
}

Walk backwards(const Walk& w) {
  Walk r;
  const double whole = w.angle(1);
  r.angle = [a = w.angle, whole](double x) { return whole - a(1 - x); };
  r.pace = [p = w.pace](double x) { return p(1 - x); };
  for (auto b = w.breaks.rbegin(); b != w.breaks.rend(); ++b) r.breaks.push_back(1 - *b);
  return r;
}

/// No panel turns by more than one radian.
void refine(Walk& w) {
  for (int round = 0; round < 40; ++round) {
    std::vector<double> finer{w.breaks[0]};
    for (std::size_t i = 1; i < w.breaks.size(); ++i) {
      const double a = w.breaks[i - 1], b = w.breaks[i];
      if (std::abs(w.angle(b) - w.angle(a)) > 1) finer.push_back((a + b) / 2);
      finer.push_back(b);
    }
    if (finer.size() == w.breaks.size()) return;
    w.breaks = std::move(finer);
  }
}

/// One piece may be two walks: it can inflect.
std::vector<Walk> walks_of(const json& piece) {
  const double alpha = piece.at("alpha"), length = piece.at("length");
  if (piece.contains("radius")) {
    const double r0 = piece["radius"][0], r1 = piece["radius"][1];
    if (r0 == 0) return {from_limit(alpha, length, 1 / r1)};
    if (r1 == 0) return {backwards(from_limit(alpha, length, 1 / r0))};
    return {one_sign(alpha, length, 1 / r0, 1 / r1)};
  }
  const double k0 = piece.at("curvature")[0], k1 = piece.at("curvature")[1];
  if (k0 == k1) return {arc(length, k0)};
  if (k0 * k1 > 0) return {one_sign(alpha, length, k0, k1)};
  if (k0 == 0) return {from_limit(alpha, length, k1)};
  if (k1 == 0) return {backwards(from_limit(alpha, length, k0))};
  const double zero = 1 / (1 + std::pow(std::abs(k1 / k0), -alpha));
  return {backwards(from_limit(alpha, length * zero, k0)),
          from_limit(alpha, length * (1 - zero), k1)};
}

void append(Track& track, Walk w) {
  refine(w);
  for (std::size_t i = 1; i < w.breaks.size(); ++i) {
    const double a = w.breaks[i - 1], b = w.breaks[i];
    const Place at = track.end();
    const Complex turn = std::polar(1.0, at.direction);
    const double before = w.angle(a);
    const auto velocity = [&](double x) {
      return turn * std::polar(1.0, w.angle(x) - before) * w.pace(x);
    };
    const Complex from(at.x, at.y);
    const Complex way = gauss(velocity, a, b);
    const double moment = gauss(
        [&](double x) {
          const Complex p = from + gauss(velocity, a, x);
          return std::imag(std::conj(p) * velocity(x));
        },
        a, b);
    track.area += moment / 2;
    track.length += gauss([&](double x) { return w.pace(x); }, a, b);
    const Complex to = from + way;
    track.places.push_back({to.real(), to.imag(), at.direction + w.angle(b) - before});
  }
}

double end_curvature(const json& piece, std::size_t i) {
  if (piece.contains("curvature")) return piece["curvature"][i];
  const double radius = piece["radius"][i];
  return radius == 0 ? std::numeric_limits<double>::infinity() : 1 / radius;
}

}  // namespace

Track walked(const json& curve) {
  Track track;
  track.places.push_back({0, 0, curve.at("direction")});
  track.joints.push_back(0);
  for (const json& piece : curve.at("pieces")) {
    for (const Walk& w : walks_of(piece)) append(track, w);
    track.joints.push_back(track.places.size() - 1);
  }
  const double x = curve.at("start")[0], y = curve.at("start")[1];
  for (Place& p : track.places) {
    p.x += x;
    p.y += y;
  }
  return track;
}

std::vector<std::string> faults(const json& curve) {
  std::vector<std::string> all;
  const json& pieces = curve.at("pieces");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const json& p = pieces[i];
    const double alpha = p["alpha"], k0 = end_curvature(p, 0), k1 = end_curvature(p, 1);
    const std::string where = " in piece " + std::to_string(i) + ": " + p.dump();
    if (!(p["length"] > 0.0)) all.push_back("no length" + where);
    if (std::isinf(k0) || std::isinf(k1)) {
      if (!(alpha > 1)) all.push_back("a cusp" + where);
    } else if (alpha >= 0 && !(k0 == 0 && k1 == 0) && !(k0 * k1 > 0)) {
      all.push_back("signs" + where);
    }
    if (i == 0) continue;
    const double before = end_curvature(pieces[i - 1], 1);
    if (std::abs(before - k0) > 1e-9 * (std::abs(before) + std::abs(k0)))
      all.push_back("curvature jumps" + where);
  }
  return all;
}

std::vector<std::string> holes(const json& value, const std::vector<std::string>& allowed) {
  std::vector<std::string> all;
  const auto add = [&](const json& inner, const std::string& step) {
    for (const std::string& path : holes(inner, allowed)) all.push_back(step + path);
  };
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      if (std::ranges::find(allowed, key) == allowed.end()) add(inner, "." + key);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) add(value[i], "[" + std::to_string(i) + "]");
  } else if (value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))) {
    all.emplace_back("");
  }
  return all;
}

double integral(const std::function<double(double)>& f, double from, double to) {
  const auto breaks = graded_breaks();
  double sum = 0;
  for (std::size_t i = 1; i < breaks.size(); ++i)
    sum += gauss(f, std::lerp(from, to, breaks[i - 1]), std::lerp(from, to, breaks[i]));
  return sum;
}

double greatest_chord_angle(double alpha, double theta) {
  if (alpha >= 0 && alpha <= 1) return theta;
  const double e = 1 / (alpha - 1);
  // alpha < 0: rho = w^e, w the share of the turning that is left, infinite at the end; in v = w^(1
  // + e) the integrand is smooth enough for graded panels.
  const auto share = [&](double v) { return alpha > 1 ? v : 1 - std::pow(v, 1 / (1 + e)); };
  const auto weight = [&](double v) { return alpha > 1 ? std::pow(v, e) : 1 / (1 + e); };
  const double x = integral([&](double v) { return weight(v) * std::cos(theta * share(v)); }, 0, 1);
  const double y = integral([&](double v) { return weight(v) * std::sin(theta * share(v)); }, 0, 1);
  const double angle = std::atan2(y, x);
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

namespace {

/// Curvature or torsion by the fraction of the length.
double law(double slope, double from, double to, double v) {
  if (from == to) return from;
  if (slope == 0) return from * std::pow(to / from, v);
  const auto power = [](double x, double e) { return std::copysign(std::pow(std::abs(x), e), x); };
  return power((1 - v) * power(from, -slope) + v * power(to, -slope), -1 / slope);
}

using Frame = std::array<double, 12>;

Frame moved(const Frame& y, const Frame& d, double by) {
  Frame at = y;
  for (std::size_t i = 0; i < at.size(); ++i) at[i] += by * d[i];
  return at;
}

}  // namespace

namespace {

/// 0, 1 and between them where curvature or torsion of a piece changes its sign: there their rates
/// may have no bound.
std::vector<double> changes_of(const json& p) {
  std::vector<double> at{0, 1};
  for (const auto& [slope, ends] : {std::pair{"alpha", "curvature"}, {"beta", "torsion"}}) {
    const double k0 = p[ends][0], k1 = p[ends][1];
    if (!(k0 * k1 < 0)) continue;
    const double power = -p[slope].get<double>();
    const double before = std::pow(std::abs(k0), power), after = std::pow(std::abs(k1), power);
    at.push_back(before / (before + after));
  }
  std::ranges::sort(at);
  return at;
}

}  // namespace

SpaceEnd integrated(const json& curve, int steps) {
  Frame y{};
  for (std::size_t i = 0; i < 3; ++i) y[i] = curve["start"][i];
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t i = 0; i < 3; ++i) y[3 + 3 * row + i] = curve["frame"][row][i];
  for (const json& p : curve["pieces"]) {
    const std::vector<double> breaks = changes_of(p);
    for (std::size_t k = 1; k < breaks.size(); ++k) {
      const double low = breaks[k - 1], wide = breaks[k] - low;
      // By x from 0 to 1, v = low + wide (10 x^3 - 15 x^4 + 6 x^5): steps shrink towards the
      // breaks.
      const auto rate = [&](const Frame& at, double x) {
        const double v = low + wide * x * x * x * (10 + x * (6 * x - 15));
        const double pace = p["length"].get<double>() * wide * 30 * x * x * (1 - x) * (1 - x);
        const double bend = pace * law(p["alpha"], p["curvature"][0], p["curvature"][1], v);
        const double twist = pace * law(p["beta"], p["torsion"][0], p["torsion"][1], v);
        Frame d{};
        for (std::size_t i = 0; i < 3; ++i) {
          d[i] = pace * at[3 + i];
          d[3 + i] = bend * at[6 + i];
          d[6 + i] = -bend * at[3 + i] + twist * at[9 + i];
          d[9 + i] = -twist * at[6 + i];
        }
        return d;
      };
      const double step = 1.0 / steps;
      for (int n = 0; n < steps; ++n) {
        const double x = n * step, half = x + step / 2;
        const Frame a = rate(y, x), b = rate(moved(y, a, step / 2), half);
        const Frame c = rate(moved(y, b, step / 2), half);
        const Frame d = rate(moved(y, c, step), x + step);
        for (std::size_t i = 0; i < y.size(); ++i)
          y[i] += step / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
      }
    }
  }
  return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}};
}

json answered(const json& request) {
  static std::map<std::string, int> asked;
  const std::string op = request.at("op");
  testing::Test::RecordProperty(op, ++asked[op]);
  return json::parse(operations::answer_line(request.dump(), {}));
}

json result_of(const json& request) {
  const json answer = answered(request);
  EXPECT_EQ(answer["ok"], true) << request << answer;
  return answer.value("result", json::object());
}

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

std::uint64_t seed(std::uint64_t kind) {
  const char* other = std::getenv("KEYLINE_SEED");
  return kind + (other ? 1000 * std::strtoull(other, nullptr, 10) : 0);
}

int requests(double share) {
  const char* many = std::getenv("KEYLINE_REQUESTS");
  const double all = many ? std::atof(many) : std::getenv("KEYLINE_FULL") ? 100000 : 2000;
  return std::max(1, static_cast<int>(all * share));
}

}  // namespace keyline::own
