#include "keyline/analysis/lcg.h"

#include <algorithm>
#include <cmath>

namespace keyline::analysis {
namespace {

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0;
  for (double v : values) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  }
  return largest;
}

void fit_line(Lcg& graph) {
  const double n = static_cast<double>(graph.points.size());
  double mean_x = 0;
  double mean_y = 0;
  for (const LcgPoint& p : graph.points) {
    mean_x += p.log_radius / n;
    mean_y += p.log_rate / n;
  }
  double xx = 0;
  double xy = 0;
  for (const LcgPoint& p : graph.points) {
    xx += (p.log_radius - mean_x) * (p.log_radius - mean_x);
    xy += (p.log_radius - mean_x) * (p.log_rate - mean_y);
  }
  if (!(xx > 1e-16 * n)) return;  // the radius changes by less than one part in 1e8
  graph.defined = true;
  graph.slope = xy / xx;
  graph.intercept = mean_y - graph.slope * mean_x;
  for (const LcgPoint& p : graph.points) {
    const double miss = p.log_rate - graph.intercept - graph.slope * p.log_radius;
    graph.variance += miss * miss / n;
  }
}

}  // namespace

Lcg logarithmic_curvature_graph(const CurvatureProfile& profile, double cutoff) {
  Lcg graph;
  if (profile.curvature_rate.size() != profile.curvature.size()) return graph;
  const double least_curvature = cutoff * largest_magnitude(profile.curvature);
  const double least_rate = cutoff * largest_magnitude(profile.curvature_rate);
  for (std::size_t i = 0; i < profile.curvature.size(); ++i) {
    const double curvature = std::abs(profile.curvature[i]);
    const double rate = std::abs(profile.curvature_rate[i]);
    if (!std::isfinite(curvature) || !std::isfinite(rate)) continue;
    if (!(curvature > least_curvature) || !(rate > least_rate)) continue;
    const double x = -std::log(curvature);
    graph.points.push_back({x, -x - std::log(rate)});
  }
  if (graph.points.size() >= 3) fit_line(graph);
  return graph;
}

}  // namespace keyline::analysis
