#include "keyline/surface/border.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "keyline/numeric/newton_bracket.h"

namespace keyline::surface {

using core::dot;
using core::Point3;
using core::Vector3;

namespace {

constexpr int kCoarse = 64;
constexpr std::size_t kMostSpans = 2048;

std::vector<double> inner_knots(const Surface& s, Edge e) {
  std::vector<double> all = is_u_edge(e) ? breakpoints_v(s) : breakpoints_u(s);
  std::erase_if(all, [](double t) { return !(t > 0 && t < 1); });
  return all;
}

std::vector<double> stations_of(const std::vector<double>& knots) {
  std::vector<double> all;
  if (knots.empty()) return all;
  const std::size_t step = knots.size() / kMostSpans + 1;
  double before = 0;
  for (std::size_t i = step - 1; i < knots.size(); i += step) {
    all.insert(all.end(), {0.5 * (before + knots[i]), knots[i]});
    before = knots[i];
  }
  all.push_back(0.5 * (before + 1));
  return all;
}

}  // namespace

struct Border::EdgeJet {
  Point3 point;
  Vector3 first, second;  ///< by `along`
};

Border::Border(const Surface& s, Edge e)
    : surface_(&s), edge_(e), knots_(inner_knots(s, e)), stations_(stations_of(knots_)) {
  std::vector<double> even;
  for (int i = 0; i <= kCoarse; ++i) even.push_back(static_cast<double>(i) / kCoarse);
  std::ranges::set_union(even, stations_, std::back_inserter(at_));
  for (const double along : at_) points_.push_back(point(along));
}

Point3 Border::point(double along) const {
  const auto [u, v] = edge_parameters(edge_, along);
  return evaluate(*surface_, u, v);
}

SurfaceJet Border::jet_at(double along) const {
  const auto [u, v] = edge_parameters(edge_, along);
  return jet(*surface_, u, v);
}

double Border::length() const {
  double length = 0;
  for (std::size_t i = 1; i < points_.size(); ++i)
    length += core::distance(points_[i - 1], points_[i]);
  return length;
}

double Border::nearest(const Point3& p) const {
  std::size_t best = 0;
  double least = core::distance(points_[0], p);
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (const double d = core::distance(points_[i], p); d < least) {
      best = i;
      least = d;
    }
  numeric::NewtonBracket between{at_[best > 0 ? best - 1 : 0],
                                 at_[std::min(best + 1, at_.size() - 1)]};
  double t = at_[best];
  for (int step = 0; step < 60 && between.high - between.low > 1e-15; ++step) {
    const EdgeJet j = edge_jet(t);
    const Vector3 d = j.point - p;
    const double bend = dot(j.first, j.first) + dot(d, j.second);
    const double next = between.next(t, dot(d, j.first), bend);
    if (std::abs(next - t) < 1e-15) break;
    t = next;
  }
  return t;
}

bool Border::has_knot(double along, double reach) const {
  const auto next = std::ranges::lower_bound(knots_, along - reach);
  return next != knots_.end() && *next <= along + reach;
}

Border::EdgeJet Border::edge_jet(double along) const {
  const SurfaceJet j = jet_at(along);
  return is_u_edge(edge_) ? EdgeJet{j.point, j.v, j.vv} : EdgeJet{j.point, j.u, j.uu};
}

}  // namespace keyline::surface
