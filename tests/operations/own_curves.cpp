#include "own_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "own_gauss.h"

namespace keyline::own {
namespace {

using Four = std::array<double, 4>;

Four mixed(const Four& a, const Four& b, double t) {
  Four m{};
  for (std::size_t i = 0; i < 4; ++i) m[i] = (1 - t) * a[i] + t * b[i];
  return m;
}

Four casteljau(Bezier b, double t) {
  for (std::size_t level = b.size() - 1; level > 0; --level)
    for (std::size_t i = 0; i < level; ++i) b[i] = mixed(b[i], b[i + 1], t);
  return b[0];
}

/// Control points of the derivative, homogeneous coordinates each for themselves.
Bezier derivative(const Bezier& b) {
  if (b.size() < 2) return {Four{}};
  Bezier d;
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    Four f{};
    for (std::size_t c = 0; c < 4; ++c)
      f[c] = static_cast<double>(b.size() - 1) * (b[i + 1][c] - b[i][c]);
    d.push_back(f);
  }
  return d;
}

Vec front(const Four& a) { return {a[0], a[1], a[2]}; }

Four homogeneous(const json& point, double weight) {
  const Vec p = vec(point);
  return {weight * p[0], weight * p[1], weight * p[2], weight};
}

Bezier control_of(const json& points, const json* weights) {
  Bezier all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.push_back(homogeneous(points[i], weights ? (*weights)[i].get<double>() : 1));
  return all;
}

/// The blossom of a spline on [knots[k], knots[k + 1]] at as many arguments as its degree.
Four blossom(const Bezier& control, const std::vector<double>& knots, std::size_t k,
             const std::vector<double>& at) {
  const std::size_t p = at.size();
  Bezier d(control.begin() + static_cast<std::ptrdiff_t>(k - p),
           control.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = knots[j + k - p], high = knots[j + 1 + k - r];
      d[j] = mixed(d[j - 1], d[j], (at[r - 1] - low) / (high - low));
    }
  return d[p];
}

std::vector<Bezier> cut(const Bezier& control, const std::vector<double>& knots, std::size_t p) {
  std::vector<Bezier> all;
  for (std::size_t k = p; k < control.size(); ++k) {
    if (!(knots[k] < knots[k + 1])) continue;
    Bezier piece;
    for (std::size_t i = 0; i <= p; ++i) {
      std::vector<double> at(p - i, knots[k]);
      at.insert(at.end(), i, knots[k + 1]);
      piece.push_back(blossom(control, knots, k, at));
    }
    all.push_back(std::move(piece));
  }
  return all;
}

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
    double from = 0;
    for (int k = 1; k <= kSteps; ++k) {
      double low = (k - 1.0) / kSteps, high = k / double{kSteps};
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

Patches patches_of(const json& surface) {
  const json* weights = surface.contains("weights") ? &surface["weights"] : nullptr;
  std::vector<Bezier> net;
  for (std::size_t i = 0; i < surface.at("points").size(); ++i) {
    const json row_weights = weights ? (*weights)[i] : json();
    net.push_back(control_of(surface["points"][i], weights ? &row_weights : nullptr));
  }
  if (surface.at("type") == "bezier-surface") return {{Patch{net}}, 1};
  // Along v every row, then along u every column of each.
  std::vector<std::vector<Bezier>> strips;  // [column of patches][row of the net]
  for (const Bezier& row : net) {
    const auto pieces = cut(row, surface["knots"][1], surface["degree"][1]);
    strips.resize(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) strips[k].push_back(pieces[k]);
  }
  Patches all;
  all.columns = strips.size();
  std::vector<std::vector<Patch>> by_column;
  for (const std::vector<Bezier>& strip : strips) {
    std::vector<Patch> column;
    for (std::size_t j = 0; j < strip[0].size(); ++j) {
      Bezier line;
      for (const Bezier& row : strip) line.push_back(row[j]);
      const auto pieces = cut(line, surface["knots"][0], surface["degree"][0]);
      column.resize(pieces.size());
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        column[k].rows.resize(pieces[k].size());
        for (std::size_t i = 0; i < pieces[k].size(); ++i)
          column[k].rows[i].push_back(pieces[k][i]);
      }
    }
    by_column.push_back(std::move(column));
  }
  for (std::size_t k = 0; k < by_column[0].size(); ++k)
    for (const auto& column : by_column) all.patches.push_back(column[k]);
  return all;
}

SurfaceSpot spot(const Patch& patch, double u, double v) {
  // Along v the points and derivatives of every row, in homogeneous coordinates; then along u.
  Bezier at, d, dd;
  for (const Bezier& row : patch.rows) {
    at.push_back(casteljau(row, v));
    d.push_back(casteljau(derivative(row), v));
    dd.push_back(casteljau(derivative(derivative(row)), v));
  }
  const Four a = casteljau(at, u), av = casteljau(d, u), avv = casteljau(dd, u);
  const Four au = casteljau(derivative(at), u), auu = casteljau(derivative(derivative(at)), u);
  const Four auv = casteljau(derivative(d), u);
  const double w = a[3];
  SurfaceSpot s;
  s.place = (1 / w) * front(a);
  s.u = (1 / w) * (front(au) - au[3] * s.place);
  s.v = (1 / w) * (front(av) - av[3] * s.place);
  s.uu = (1 / w) * (front(auu) - 2 * au[3] * s.u - auu[3] * s.place);
  s.vv = (1 / w) * (front(avv) - 2 * av[3] * s.v - avv[3] * s.place);
  s.uv = (1 / w) * (front(auv) - au[3] * s.v - av[3] * s.u - auv[3] * s.place);
  return s;
}

namespace {

struct Foot {
  double distance = INFINITY, u = 0, v = 0;
};

/// Compass search, a step that does not help halved; then Gauss's and Newton's steps.
double closed_in(const Patch& patch, const Vec& point, Foot at, double step) {
  const auto try_at = [&](double u, double v) {
    u = std::clamp(u, 0.0, 1.0);
    v = std::clamp(v, 0.0, 1.0);
    const double d = distance(spot(patch, u, v).place, point);
    if (!(d < at.distance)) return false;
    at = {d, u, v};
    return true;
  };
  for (; step > 1e-4; step /= 2)
    for (bool better = true; better;) {
      better = false;
      for (const int a : {-1, 0, 1})
        for (const int b : {-1, 0, 1})
          if (a != 0 || b != 0) better = try_at(at.u + a * step, at.v + b * step) || better;
    }
  for (int n = 0; n < 20; ++n) {
    const SurfaceSpot s = spot(patch, at.u, at.v);
    const Vec away = s.place - point;
    const double e = dot(s.u, s.u), f = dot(s.u, s.v), g = dot(s.v, s.v);
    const double a = dot(away, s.u), b = dot(away, s.v), area = e * g - f * f;
    // On a border the step along it alone.
    if (!(area > 1e-12 * e * g)) break;
    const bool moved = try_at(at.u - (g * a - f * b) / area, at.v - (e * b - f * a) / area);
    const bool along_u = try_at(at.u - a / e, at.v), along_v = try_at(at.u, at.v - b / g);
    if (!moved && !along_u && !along_v) break;
  }
  return at.distance;
}

}  // namespace

double distance_from(const Patches& surface, const Vec& point) {
  constexpr int kPlaces = 16;
  double best = INFINITY;
  for (const Patch& patch : surface.patches) {
    std::vector<Foot> feet;
    for (int i = 0; i <= kPlaces; ++i)
      for (int j = 0; j <= kPlaces; ++j) {
        const double u = i / double{kPlaces}, v = j / double{kPlaces};
        feet.push_back({distance(spot(patch, u, v).place, point), u, v});
      }
    // From the nearest that do not neighbour each other.
    std::ranges::sort(feet, {}, &Foot::distance);
    std::vector<Foot> starts;
    for (const Foot& f : feet) {
      const bool apart = std::ranges::all_of(starts, [&](const Foot& s) {
        return std::max(std::abs(s.u - f.u), std::abs(s.v - f.v)) > 2.5 / kPlaces;
      });
      if (apart && starts.size() < 4) starts.push_back(f);
    }
    for (const Foot& f : starts) {
      if (best == 0) break;
      best = std::min(best, closed_in(patch, point, f, 1.0 / kPlaces));
    }
  }
  return best;
}

}  // namespace keyline::own
