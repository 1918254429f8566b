#include "keyline/operations/sampled_comb.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/analysis/lddc.h"
#include "keyline/analysis/profile.h"
#include "keyline/analysis/split.h"
#include "keyline/core/angle.h"
#include "keyline/document/cusped.h"
#include "keyline/lac/chain/chain_sampler.h"

namespace keyline::operations {
namespace {

using core::Point2;
using core::Result;

constexpr int kLeastOfPiece = 24;  // samples, so that a short piece still shows how it turns
constexpr int kDense = 2001;       // samples of the diagram and the measures
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFlat = 1e-9;  // curvature or its rate below this share of its largest: none

/// Everything there is to say of places in order along the curve.
struct Places {
  std::vector<double> s, angle, curvature, rate;
  std::vector<Point2> point;
  std::vector<int> joints;

  void add(double at, Point2 p, double direction, double k, double dk) {
    s.push_back(at);
    point.push_back(p);
    angle.push_back(direction);
    curvature.push_back(k);
    rate.push_back(dk);
  }
  void joint() {
    if (!s.empty()) joints.push_back(static_cast<int>(s.size()));
  }
};

double length_of(const document::PlanarCurve& c) {
  if (const auto* chain = std::get_if<lac::Chain>(&c.value)) return lac::arc_length(*chain);
  return analysis::ArcLengthTable(analysis::view(c)).length();
}

void add_chain(Places& places, const lac::Chain& chain, double from, double per_length) {
  for (const lac::Segment& segment : lac::segments(chain)) {
    places.joint();
    const int n = std::max(kLeastOfPiece, static_cast<int>(segment.length * per_length)) + 1;
    const std::vector<Point2> points = lac::sample(segment, n);
    for (int i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / (n - 1);
      places.add(from + t * segment.length, points[static_cast<std::size_t>(i)],
                 lac::tangent_angle(segment, t), lac::curvature(segment, t),
                 lac::curvature_rate(segment, t));
    }
    from += segment.length;
  }
}

void add_polyline(Places& places, const curve::Polyline2& line, double from) {
  const auto& p = line.points;
  places.joint();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const core::Vector2 along = i + 1 < p.size() ? p[i + 1] - p[i] : p[i] - p[i - 1];
    if (i > 0) from += core::distance(p[i - 1], p[i]);
    places.add(from, p[i], core::direction_of(along), 0, 0);
  }
}

/// Of one smooth curve; values at its end are those from inside.
void add_smooth(Places& places, const document::PlanarCurve& c, double from, double per_length) {
  const document::Path path{{c}, false};
  const document::CuspedPath cusped(path);
  const analysis::CurveView view(cusped);
  const analysis::ArcLengthTable table(view);
  places.joint();
  const int n = std::max(kLeastOfPiece, static_cast<int>(table.length() * per_length)) + 1;
  for (int i = 0; i < n; ++i) {
    const double s = table.length() * i / (n - 1);
    const double t = i + 1 == n ? std::nextafter(1.0, 0.0) : i == 0 ? 0 : table.parameter_at(s);
    const curve::Jet2 jet = view.jet_at(t);
    places.add(from + s, jet.point, curve::tangent_angle(jet), curve::curvature(jet),
               curve::curvature_rate(jet));
  }
}

/// Values that are not finite (cusps) are those of the nearest place that has one.
void make_finite(std::vector<double>& values) {
  double last = 0;
  for (const double v : values)
    if (std::isfinite(v)) {
      last = v;
      break;
    }
  for (double& v : values) last = v = std::isfinite(v) ? v : last;
}

Places places_along(const document::Path& path, double length, int samples) {
  Places places;
  const double per_length = (samples - 1) / length;
  double from = 0;
  for (const document::PlanarCurve& c : path.curves) {
    if (const auto* chain = std::get_if<lac::Chain>(&c.value))
      add_chain(places, *chain, from, per_length);
    else if (const auto* line = std::get_if<curve::Polyline2>(&c.value))
      add_polyline(places, *line, from);
    else
      add_smooth(places, c, from, per_length);
    from = places.s.back();
  }
  make_finite(places.curvature);
  make_finite(places.rate);
  return places;
}

/// Curvature at many places, for the diagram and the measures.
analysis::CurvatureProfile dense_profile(const document::Path& path, double length) {
  const auto* chain =
      path.curves.size() == 1 ? std::get_if<lac::Chain>(&path.curves[0].value) : nullptr;
  if (!chain) {
    Places places = places_along(path, length, kDense);
    return {std::move(places.s), std::move(places.curvature), std::move(places.rate), {}};
  }
  analysis::CurvatureProfile dense;
  dense.arc_length.resize(kDense);
  for (int i = 0; i < kDense; ++i)
    dense.arc_length[static_cast<std::size_t>(i)] = length * i / (kDense - 1);
  dense.curvature.resize(kDense);
  dense.curvature_rate.resize(kDense);
  const lac::ChainSampler sampler(*chain);
  sampler.curvatures(dense.arc_length, dense.curvature);
  sampler.curvature_rates(dense.arc_length, dense.curvature_rate);
  make_finite(dense.curvature);
  make_finite(dense.curvature_rate);
  return dense;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

double integral_of_squares(const std::vector<double>& s, const std::vector<double>& f) {
  double sum = 0;
  for (std::size_t i = 1; i < s.size(); ++i)
    sum += 0.5 * (s[i] - s[i - 1]) * (f[i] * f[i] + f[i - 1] * f[i - 1]);
  return sum;
}

/// A chain's pieces are monotone: its extrema lie at joints, its inflections at breakpoints.
std::vector<CombEvent> events_of(const lac::Chain& chain) {
  std::vector<CombEvent> events;
  const lac::PlacedChain placed(chain);
  const double whole = placed.length();
  const auto add = [&](CombEventKind kind, double s, double curvature) {
    events.push_back({kind, s, curvature, lac::evaluate(placed, s / whole)});
  };
  double sense = 0;
  double side = 0;
  double s = 0;
  for (const lac::Piece& piece : chain.pieces) {
    const double change = piece.curvature_end - piece.curvature_start;
    if (sense * change < 0)
      add(sense > 0 ? CombEventKind::maximum : CombEventKind::minimum, s, piece.curvature_start);
    if (change != 0) sense = change;
    s += piece.length;
  }
  const std::vector<double> breaks = lac::breakpoints(chain);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double k = lac::curvature(placed, 0.5 * (breaks[i - 1] + breaks[i]));
    if (side * k < 0) add(CombEventKind::inflection, breaks[i - 1] * whole, 0);
    if (k != 0) side = k;
  }
  std::ranges::sort(events, {}, &CombEvent::arc_length);
  return events;
}

std::vector<CombEvent> events_of(const document::Path& path) {
  if (path.curves.size() == 1)
    if (const auto* chain = std::get_if<lac::Chain>(&path.curves[0].value))
      return events_of(*chain);
  using EventKind = analysis::CurvatureEvent::Kind;
  const document::CuspedPath cusped(path);
  const analysis::CurveView view(cusped);
  const analysis::Split split = analysis::split_monotone(view);
  std::vector<CombEvent> events;
  const auto add = [&](const std::vector<analysis::CurvatureEvent>& found) {
    for (const analysis::CurvatureEvent& e : found) {
      const CombEventKind kind = e.kind == EventKind::maximum      ? CombEventKind::maximum
                                 : e.kind == EventKind::minimum    ? CombEventKind::minimum
                                 : e.kind == EventKind::inflection ? CombEventKind::inflection
                                                                   : CombEventKind::corner;
      events.push_back({kind, e.arc_length, {}, view.point(e.t)});
      if (std::isfinite(e.curvature)) events.back().curvature = e.curvature;
    }
  };
  add(split.extrema);
  add(split.inflections);
  add(split.corners);
  std::ranges::sort(events, {}, &CombEvent::arc_length);
  return events;
}

/// The diagram's tops, and for every place in the graphs which of them it counts in.
void add_diagram(CombGraphs& graphs, const Places& shown, const analysis::CurvatureProfile& dense,
                 double length) {
  const analysis::Lddc diagram = analysis::curvature_distribution_diagram(dense);
  for (const analysis::LddcTop& top : diagram.tops) graphs.lddc.push_back({top.x, top.y});
  if (diagram.has_gradient) graphs.lddc_gradient = diagram.gradient;
  for (const int i : graphs.samples) {
    const double x = -std::log10(std::abs(shown.curvature[static_cast<std::size_t>(i)]) * length);
    const auto top = std::ranges::find_if(diagram.tops, [x](const analysis::LddcTop& t) {
      return std::abs(x - t.x) <= 0.5 * analysis::kLddcBarWidth;
    });
    graphs.bars.push_back(top == diagram.tops.end() ? -1
                                                    : static_cast<int>(top - diagram.tops.begin()));
  }
}

analysis::CombFigures figures_of(const document::Path& path,
                                 const analysis::CurvatureProfile& dense) {
  analysis::CombFigures figures = analysis::comb_figures({dense.arc_length, dense.curvature});
  if (document::has_cusp(document::stops_of(path))) figures.energy = figures.jolt = kInfinity;
  return figures;
}

/// Where a curve stops, curvature goes at least as the root of the arc length goes to 0; at a cusp
/// of a chain as its (-1 / alpha)-th power.
bool bends_without_bound(const document::Path& path) {
  return std::ranges::any_of(path.curves, [](const document::PlanarCurve& c) {
    const auto* chain = std::get_if<lac::Chain>(&c.value);
    if (!chain) return document::has_cusp(document::stops_of({{c}, false}));
    return std::ranges::any_of(chain->pieces, [](const lac::Piece& p) {
      return p.alpha <= 2 && (std::isinf(p.curvature_start) || std::isinf(p.curvature_end));
    });
  });
}

CombGraphs graphs_of(const document::Path& path, const Places& shown, double length) {
  CombGraphs graphs;
  const double least_curvature = kFlat * largest(shown.curvature);
  const double least_rate = kFlat * largest(shown.rate);
  for (std::size_t i = 0; i < shown.s.size(); ++i) {
    const double k = shown.curvature[i];
    const double rate = std::abs(shown.rate[i]);
    if (!(std::abs(k) > least_curvature && rate > least_rate)) continue;
    const core::Vector2 left{-std::sin(shown.angle[i]), std::cos(shown.angle[i])};
    graphs.samples.push_back(static_cast<int>(i));
    graphs.lcg.push_back({-std::log(std::abs(k)), std::log(std::abs(k)) - std::log(rate)});
    const Point2 center = shown.point[i] + (1 / k) * left;
    graphs.centers.push_back({center.x, center.y});
  }
  const analysis::CurvatureProfile dense = dense_profile(path, length);
  add_diagram(graphs, shown, dense, length);
  graphs.events = events_of(path);
  graphs.bending = bends_without_bound(path)
                       ? kInfinity
                       : length * integral_of_squares(dense.arc_length, dense.curvature);
  graphs.figures = figures_of(path, dense);
  return graphs;
}

double length_of(const document::Path& path) {
  double length = 0;
  for (const document::PlanarCurve& c : path.curves) length += length_of(c);
  return length;
}

}  // namespace

analysis::CombFigures comb_figures_of(const document::Path& path) {
  const double length = length_of(path);
  if (!(length > 0 && std::isfinite(length))) return {};
  return figures_of(path, dense_profile(path, length));
}

Result<SampledComb> sampled_comb(const document::Path& path, const CombForm& form) {
  if (auto sound = document::validate(path); !sound) return std::unexpected(sound.error());
  SampledComb comb;
  comb.length = length_of(path);
  if (!(comb.length > 0 && std::isfinite(comb.length)))
    return core::fail(core::ErrorCode::bad_input, "the curve has no length", "give another curve");
  Places places = places_along(path, comb.length, form.samples);
  for (const double angle : places.angle)
    comb.normals.push_back({-std::sin(angle), std::cos(angle)});
  if (form.graphs) comb.graphs = graphs_of(path, places, comb.length);
  comb.points = std::move(places.point);
  comb.arc_length = std::move(places.s);
  comb.curvature = std::move(places.curvature);
  comb.joints = std::move(places.joints);
  return comb;
}

}  // namespace keyline::operations
