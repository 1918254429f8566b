#include "keyline/operations/subject.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "keyline/acquire/acquire.h"
#include "keyline/analysis/comb_figures.h"
#include "keyline/analysis/profile.h"
#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"
#include "keyline/curve/bspline.h"
#include "keyline/fairing/fair.h"
#include "keyline/operations/amount.h"
#include "keyline/operations/ends.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

constexpr int kCurveSamples = 801;

/// The vertices of a path that is one polyline or one straight edge, or is made of such edges that
/// turn as points of a curve do; else none.
std::vector<core::Point2> vertices_of(const document::Path& path) {
  if (path.curves.size() == 1) {
    if (const auto* line = std::get_if<curve::Polyline2>(&path.curves.front().value))
      return line->points;
    if (const auto* edge = std::get_if<curve::Bezier2>(&path.curves.front().value))
      if (edge->control.size() == 2) return edge->control;
  }
  std::vector<core::Point2> vertices;
  for (const document::PlanarCurve& c : path.curves) {
    const auto* line = std::get_if<curve::Polyline2>(&c.value);
    const auto* edge = std::get_if<curve::Bezier2>(&c.value);
    if (!line && !(edge && edge->control.size() == 2)) return {};
    for (const core::Point2 p : line ? line->points : edge->control)
      if (vertices.empty() || vertices.back() != p) vertices.push_back(p);
  }
  return are_points_of_a_curve(vertices) ? vertices : std::vector<core::Point2>{};
}

Result<acquire::KeyLine> acquired(const std::vector<core::Point2>& points, const Subject& subject,
                                  const core::CancellationToken& cancellation) {
  acquire::RawCurve raw;
  for (const core::Point2 p : points) raw.points.push_back({p.x, p.y, 0});
  raw.weights = subject.weights;
  acquire::AcquireOptions options = acquire_options(subject.acquiring, cancellation);
  if (subject.curve) {
    options.ordered = true;
    if (subject.curve->closed && !options.closed) options.closed = true;
  }
  auto line = acquire::acquire_key_line(raw, options);
  if (!line && line.error().path.empty()) line.error().path = subject.curve ? "curve" : "points";
  return line;
}

/// The speed of a rational curve goes by 1 / weight^2. Where weights rise far above those of its
/// ends, parts of it pass in less of the parameter than the panels of its length see. With weights
/// up to 1e4 apart the lengths of 240 random curves were right to 1e-8; up to 1e6, six of 40 wrong.
bool runs_unseen(const curve::Bezier2& c) {
  constexpr double kRise = 1e4;
  if (!curve::is_rational(c)) return false;
  return std::ranges::max(c.weights) > kRise * std::min(c.weights.front(), c.weights.back());
}

/// Of a curve that runs so, the weights; else null.
const std::vector<double>* hiding_weights(const document::PlanarCurve& c) {
  if (const auto* bezier = std::get_if<curve::Bezier2>(&c.value))
    return runs_unseen(*bezier) ? &bezier->weights : nullptr;
  const auto* spline = std::get_if<curve::BSpline2>(&c.value);
  if (!spline || !curve::is_rational(*spline)) return nullptr;
  return std::ranges::any_of(curve::to_beziers(*spline), runs_unseen) ? &spline->weights : nullptr;
}

Result<void> check_weights(const document::Path& path) {
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const std::vector<double>* weights = hiding_weights(path.curves[i]);
    if (!weights) continue;
    const auto largest = std::ranges::max_element(*weights) - weights->begin();
    const std::string of = path.curves.size() == 1 ? "" : ".curves[" + std::to_string(i) + "]";
    return fail(ErrorCode::bad_input,
                "the weight is more than 10000 times that of an end of its span: much of the curve "
                "lies in too little of its parameter",
                "give weights nearer to each other",
                "curve" + of + ".weights[" + std::to_string(largest) + "]");
  }
  return {};
}

}  // namespace

Result<void> check_extent(const document::Path& path) {
  const core::Point2 start = evaluate(path, 0);
  const auto stays = [start](const std::vector<core::Point2>& points) {
    return std::ranges::all_of(points, [start](core::Point2 p) { return p == start; });
  };
  const bool still = std::ranges::all_of(path.curves, [&](const document::PlanarCurve& c) {
    if (const auto* line = std::get_if<curve::Polyline2>(&c.value)) return stays(line->points);
    if (const auto* bezier = std::get_if<curve::Bezier2>(&c.value)) return stays(bezier->control);
    if (const auto* spline = std::get_if<curve::BSpline2>(&c.value)) return stays(spline->control);
    return false;  // pieces have a length
  });
  if (!still) return check_weights(path);
  return fail(ErrorCode::bad_input, "the curve has no length", "give it two different points",
              "curve");
}

acquire::AcquireOptions acquire_options(const Acquiring& told,
                                        const core::CancellationToken& cancellation) {
  acquire::AcquireOptions options;
  options.cancellation = cancellation;
  options.closed = told.closed;
  if (told.keep_order) options.ordered = true;
  options.remove_outliers = !told.keep_strays;
  options.noise = told.noise;
  options.detail = told.detail;
  return options;
}

bool are_points_of_a_curve(const std::vector<core::Point2>& vertices) {
  constexpr std::size_t kFewest = 5;          // for a spline
  constexpr double kOctagon = core::kPi / 4;  // its turn at a vertex: polygons of fewer sides
  if (vertices.size() < kFewest) return false;
  double turning = 0;
  for (std::size_t i = 2; i < vertices.size(); ++i)
    turning += std::abs(
        core::angle_between(vertices[i - 1] - vertices[i - 2], vertices[i] - vertices[i - 1]));
  return turning <= kOctagon * static_cast<double>(vertices.size() - 2);
}

namespace {

/// Smallest and largest curvature of a curve at so many places.
double curvature_range(const analysis::CurveView& view, int places) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (int i = 0; i <= places; ++i) {
    const double kappa = curve::curvature(view.jet_at(static_cast<double>(i) / places));
    if (!std::isfinite(kappa)) continue;
    low = std::min(low, kappa);
    high = std::max(high, kappa);
  }
  return std::max(0.0, high - low);
}

/// Where a curve's direction jumps.
struct Kink {
  double at = 0;                 ///< arc length
  double angle = 0;              ///< of the jump, radians
  double before = 0, after = 0;  ///< curvatures beside it
};

std::vector<Kink> kinks_of(const analysis::CurveView& view, const analysis::ArcLengthTable& table,
                           bool closed) {
  constexpr double kSmooth = 0.02;  // radians
  std::vector<Kink> kinks;
  const auto look = [&](double at, const curve::Jet2& end, const curve::Jet2& start) {
    const double angle =
        std::abs(core::wrap_angle(curve::tangent_angle(start) - curve::arriving_angle(end)));
    if (!(angle <= kSmooth))
      kinks.push_back({at, angle, curve::curvature(end), curve::curvature(start)});
  };
  if (closed) look(0, view.jet_at(1), view.jet_at(0));
  for (std::size_t k = 1; k + 1 < view.breaks().size(); ++k) {
    const double t = view.breaks()[k];
    look(table.length_at(t), view.jet_at(std::nextafter(t, 0.0)), view.jet_at(t));
  }
  return kinks;
}

/// Whether a kink is a corner. Within the tolerance d a kink of t is hidden by a step of curvature
/// there that comes earlier or later by t / step: d = t^2 / (2 step); or by an arc of curvature
/// t^2 / (8 d), where the curve on either side is bent more, and that is no wave.
bool is_corner(const Kink& kink, double tolerance, double range) {
  if (!std::isfinite(kink.before) || !std::isfinite(kink.after)) return true;
  const double square = kink.angle * kink.angle;
  if (square <= 2 * tolerance * std::abs(kink.after - kink.before)) return false;
  const double unseen =
      std::min({std::abs(kink.before), std::abs(kink.after), analysis::kSeenWave * range});
  return square > 8 * tolerance * unseen;
}

constexpr double kOnePlace = 1e-9;  // of the length: points this near are one

/// The path without members that stay in one place, as an arc leaves one where it should close:
/// their direction is that of a rounding, and no corner.
document::Path without_specks(document::Path path, double length) {
  if (path.curves.size() < 2) return path;
  std::erase_if(path.curves, [&](const document::PlanarCurve& member) {
    const document::Path alone{{member}};
    return analysis::ArcLengthTable(analysis::view(alone)).length() < kOnePlace * length;
  });
  return path;
}

}  // namespace

Result<acquire::KeyLine> sampled_line(const document::Path& path, double tolerance) {
  const analysis::CurveView view = analysis::view(path);
  const analysis::ArcLengthTable table(view);
  const double length = table.length();
  if (!(length > 0) || !std::isfinite(length))
    return fail(ErrorCode::bad_input, "the curve has no length", "give a curve with extent",
                "curve");
  const document::Path sound = without_specks(path, length);
  if (sound.curves.size() < path.curves.size()) return sampled_line(sound, tolerance);
  acquire::KeyLine line;
  line.length = length;
  line.closed = path.closed && meet(evaluate(path, 0), evaluate(path, 1), length);
  const int n = std::max<int>(kCurveSamples, 40 * static_cast<int>(path.curves.size()) + 1);
  if (!(tolerance > 0))
    tolerance = fairing::default_tolerance(0, length, static_cast<std::size_t>(n));
  const std::vector<Kink> kinks = kinks_of(view, table, line.closed);
  const double range = kinks.empty() ? 0 : curvature_range(view, n);
  std::vector<double> corners;
  for (const Kink& kink : kinks)
    if (is_corner(kink, tolerance, range)) corners.push_back(kink.at);
  std::vector<double> at;
  for (int i = 0; i < n; ++i) at.push_back(length * i / (n - 1));
  at.insert(at.end(), corners.begin(), corners.end());
  std::sort(at.begin(), at.end());
  for (const double s : at) {
    const core::Point2 p = evaluate(view, table.parameter_at(s));
    if (!line.points.empty() && core::distance(line.points.back(), p) < kOnePlace * length)
      continue;
    line.points.push_back(p);
    const bool corner = std::any_of(corners.begin(), corners.end(),
                                    [&](double c) { return std::abs(c - s) < kOnePlace * length; });
    if (corner) line.corners.push_back(line.points.size() - 1);
  }
  if (line.closed) line.points.pop_back();
  return line;
}

Result<std::optional<acquire::KeyLine>> measured_line(const Subject& subject,
                                                      const core::CancellationToken& cancellation) {
  using Line = std::optional<acquire::KeyLine>;
  if ((subject.points ? 1 : 0) + (subject.curve ? 1 : 0) + (subject.line ? 1 : 0) != 1)
    return fail(ErrorCode::bad_input, "either \"points\" or \"curve\" is wanted",
                "give one of the two, or a \"line\"", "points");
  if (subject.line) return Line{subject.line};
  const std::vector<core::Point2> points =
      subject.points ? *subject.points : vertices_of(*subject.curve);
  if (points.empty()) {
    if (auto few = check_amount(*subject.curve); !few) {
      few.error().path = "curve";
      return std::unexpected(few.error());
    }
    return Line{};
  }
  auto line = acquired(points, subject, cancellation);
  if (!line) return std::unexpected(line.error());
  return Line{std::move(*line)};
}

}  // namespace keyline::operations
