#include <algorithm>
#include <cmath>

#include "own_bezier.h"
#include "own_curves.h"

namespace keyline::own {

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

/// How far the surface goes within half a step of a place either way, were it as steep as there.
double reach(const Patch& patch, const Foot& at, double step) {
  const SurfaceSpot s = spot(patch, at.u, at.v);
  return 0.5 * step * (size(s.u) + size(s.v)) +
         0.125 * step * step * (size(s.uu) + 2 * size(s.uv) + size(s.vv));
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
    // From the nearest that do not neighbour each other; then from every place that a nearer one
    // may lie beside: where a surface folds back, both sheets pass within a few places of the
    // nearest.
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
    for (const Foot& f : feet)
      if (f.distance - reach(patch, f, 1.0 / kPlaces) < best - 1e-12 * f.distance)
        best = std::min(best, closed_in(patch, point, f, 0.5 / kPlaces));
  }
  return best;
}

}  // namespace keyline::own
