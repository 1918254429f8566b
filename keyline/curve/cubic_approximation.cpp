#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "keyline/core/polygon.h"
#include "keyline/curve/bernstein.h"
#include "keyline/curve/conversion.h"
#include "keyline/curve/cubic_fit.h"

namespace keyline::curve {

using core::Point2;
using detail::Coefficients;
using detail::Cubic;

namespace {

constexpr double kPanelShare = 0.02;   ///< of the tolerance, for the first step
constexpr double kCornerAngle = 1e-7;  ///< radians
constexpr double kGap = 1e-12;         ///< of the size, taken for rounding
constexpr double kUnits = 16;          ///< of the last place of coordinates, taken for it too
constexpr int kMaxDepth = 24;

/// A short cubic that stands for the curve over [t0, t1].
struct Panel {
  Cubic cubic;
  double t0, t1;
  bool joined = true;  ///< continues the one before without corner or gap
};

struct PanelFit {
  Cubic cubic;
  double error;
};

struct Panels {
  std::vector<Panel> list;
  double error = 0;
};

Cubic hermite(const Jet2& a, const Jet2& b, double width) {
  return {{a.point, a.point + (width / 3) * a.first, b.point - (width / 3) * b.first, b.point}};
}

/// Whether halving cannot help: the error of a short cubic is that of doubles, or of a curve whose
/// positions carry a little more than that, seen by halves no better than the whole.
bool is_rounding(const PanelFit& fit, double error_of_whole) {
  double largest = core::polygon_length(fit.cubic.control);
  for (const Point2& p : fit.cubic.control)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const double unit = std::numeric_limits<double>::epsilon() * largest;
  return fit.error <= 8 * unit || (fit.error <= 1e5 * unit && fit.error > 0.25 * error_of_whole);
}

using MakePanel = std::function<PanelFit(double t0, double t1)>;

/// Panels over [t0, t1], none with an error above `allowed` where halving can help.
void refine(const MakePanel& make, double t0, double t1, double allowed, int depth, Panels& out,
            double error_of_whole = std::numeric_limits<double>::infinity()) {
  const PanelFit fit = make(t0, t1);
  const double middle = 0.5 * (t0 + t1);
  if (!(fit.error > allowed) || is_rounding(fit, error_of_whole) || depth >= kMaxDepth ||
      !(t0 < middle && middle < t1)) {
    out.list.push_back({fit.cubic, t0, t1, true});
    out.error = std::max(out.error, fit.error);
    return;
  }
  refine(make, t0, middle, allowed, depth + 1, out, fit.error);
  refine(make, middle, t1, allowed, depth + 1, out, fit.error);
}

// ---- Panels of the kinds of curves --------------------------------------------------------

/// Error estimated at five places (see conversion.h).
Panels panels_of(const PlanarView& c, double allowed) {
  Panels out;
  const auto& breaks = c.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double end = breaks[i + 1];
    const MakePanel make = [&](double t0, double t1) {
      const double inner = t1 == end && end < 1 ? std::nextafter(t1, t0) : t1;
      PanelFit fit{hermite(c.jet_at(t0), c.jet_at(inner), t1 - t0), 0};
      for (const double u : {0.15, 0.37, 0.5, 0.66, 0.88}) {
        const double d = distance(detail::point_on(fit.cubic, u), c.point((1 - u) * t0 + u * t1));
        fit.error = std::max(fit.error, 1.5 * d);
      }
      return fit;
    };
    refine(make, breaks[i], end, allowed, 0, out);
  }
  return out;
}

/// Bound of |part(s) - cubic(s)|, both over [0, 1]: coefficients of the numerator over the least
/// weight.
double rigorous_error(const Bezier2& part, const Cubic& cubic) {
  const Point2 origin = cubic.control[0];
  Coefficients<double> x, y, w{1.0}, hx, hy;
  for (std::size_t i = 0; i < part.control.size(); ++i) {
    const double weight = is_rational(part) ? part.weights[i] : 1.0;
    x.push_back(weight * (part.control[i].x - origin.x));
    y.push_back(weight * (part.control[i].y - origin.y));
  }
  for (const Point2& p : cubic.control) {
    hx.push_back(p.x - origin.x);
    hy.push_back(p.y - origin.y);
  }
  double least = 1;
  if (is_rational(part)) {
    w = detail::scaled(Coefficients<double>(part.weights));
    least = *std::min_element(part.weights.begin(), part.weights.end());
  }
  const auto gap = [&](const Coefficients<double>& a, const Coefficients<double>& h) {
    return detail::unscaled(
        detail::combination(detail::scaled(a), -1, detail::product(detail::scaled(h), w)));
  };
  const auto dx = gap(x, hx);
  const auto dy = gap(y, hy);
  double largest = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) largest = std::max(largest, std::hypot(dx[i], dy[i]));
  return largest / least;
}

Cubic as_cubic(const Bezier2& c) {
  const Bezier2 raised = elevate_degree(c, 3 - degree(c));
  return {{raised.control[0], raised.control[1], raised.control[2], raised.control[3]}};
}

/// Panels of a Bézier curve that stands for [low, high] of the whole.
void add_panels(const Bezier2& c, double low, double high, double allowed, Panels& out) {
  if (!is_rational(c) && degree(c) <= 3) {
    out.list.push_back({as_cubic(c), low, high, true});
    return;
  }
  const MakePanel make = [&](double t0, double t1) {
    const Bezier2 part = subcurve(c, (t0 - low) / (high - low), (t1 - low) / (high - low));
    PanelFit fit{hermite(jet(part, 0), jet(part, 1), 1), 0};
    fit.cubic.control[0] = part.control.front();
    fit.cubic.control[3] = part.control.back();
    fit.error = rigorous_error(part, fit.cubic);
    return fit;
  };
  refine(make, low, high, allowed, 0, out);
}

// ---- Joining ------------------------------------------------------------------------------

/// The widest gap that is rounding: far from the origin for the curve's size that of coordinates.
double rounding_gap(const std::vector<Panel>& panels) {
  double size = 0;
  double farthest = 0;
  for (const Panel& p : panels)
    for (const Point2& q : p.cubic.control) {
      size = std::max(size, distance(q, panels.front().cubic.control[0]));
      farthest = std::max({farthest, std::abs(q.x), std::abs(q.y)});
    }
  return std::max(kGap * size, kUnits * std::numeric_limits<double>::epsilon() * farthest);
}

/// Drops panels without length, closes gaps that are rounding, marks corners and jumps.
void join(std::vector<Panel>& panels) {
  const double rounding = rounding_gap(panels);
  const Panel first = panels.front();
  std::erase_if(panels,
                [](const Panel& p) { return !(core::polygon_length(p.cubic.control) > 0); });
  if (panels.empty()) panels.push_back(first);
  panels.front().joined = false;
  for (std::size_t i = 1; i < panels.size(); ++i) {
    Cubic& before = panels[i - 1].cubic;
    const Cubic& after = panels[i].cubic;
    const bool touching = distance(before.control[3], after.control[0]) <= rounding;
    if (touching) before.control[3] = after.control[0];
    const double turn =
        core::angle_between(detail::end_tangent(before), detail::start_tangent(after));
    panels[i].joined = touching && std::abs(turn) <= kCornerAngle;
  }
}

// ---- Longest pieces first -----------------------------------------------------------------

/// A run of joined panels; places on it are counted in panels from its start.
class Run {
 public:
  Run(const Panel* panels, std::size_t count, double tolerance)
      : panels_(panels), count_(count), tolerance_(tolerance) {}

  /// Appends the pieces; returns the largest bound.
  double cover(std::vector<Bezier2>& pieces) {
    double largest = 0;
    double at = 0;
    double step = 1;
    while (at < static_cast<double>(count_)) {
      const Reach reach = furthest(at, step);
      auto b = reach.fit.cubic.control;
      if (at > 0) b[0] = pieces.back().control.back();
      pieces.push_back({{b.begin(), b.end()}, {}});
      largest = std::max(largest, reach.fit.bound);
      step = std::max(reach.end - at, 1e-3);
      at = reach.end;
    }
    return largest;
  }

 private:
  struct Reach {
    double end;
    detail::CubicFit fit;
  };

  /// The longest piece from `at`: growing steps from the length of the last one, then bisection,
  /// helped by the sixth-order growth of the distance with the length.
  Reach furthest(double at, double step) {
    const double last = static_cast<double>(count_);
    const double panel_end = std::min(std::floor(at) + 1, last);
    Reach best{panel_end, {clipped(at, panel_end), 0.0, 0.0}};  // part of one panel: exact
    Reach failed{std::numeric_limits<double>::infinity(), {}};
    for (double end = std::max(at + step, panel_end); best.end < last;) {
      const Reach reach = attempt(at, std::min(end, last));
      if (reach.fit.bound > tolerance_) {
        failed = reach;
        break;
      }
      if (reach.end >= best.end) best = reach;
      end = at + (end - at) * std::clamp(1.02 * affordable(reach.fit), 1.02, 2.0);
    }
    while (std::isfinite(failed.end) && failed.end - best.end > 1e-3 * (failed.end - at)) {
      const double gap = failed.end - best.end;
      double end = at + 0.998 * (failed.end - at) * affordable(failed.fit);
      if (!(end > best.end + 0.1 * gap && end < failed.end - 0.1 * gap)) end = best.end + 0.5 * gap;
      const Reach reach = attempt(at, end);
      (reach.fit.bound <= tolerance_ ? best : failed) = reach;
    }
    return best;
  }

  /// How many times longer the piece may be if its distance grows with the sixth power.
  double affordable(const detail::CubicFit& fit) const {
    return fit.distance > 0 ? std::pow(tolerance_ / fit.distance, 1.0 / 6) : 2.0;
  }

  Cubic clipped(double from, double to) const {
    const auto i = static_cast<std::size_t>(from);
    const double base = static_cast<double>(i);
    return detail::subcurve(panels_[i].cubic, from - base, to - base);
  }

  /// Cubic over [at, end] and its bound; exact where that is part of one panel.
  Reach attempt(double at, double end) {
    if (end <= std::floor(at) + 1) return {end, {clipped(at, end), 0.0, 0.0}};
    row_.clear();
    ends_.clear();
    const auto first = static_cast<std::size_t>(at);
    const auto last = std::min(static_cast<std::size_t>(std::ceil(end)), count_);
    const int parts = 1 + 7 / static_cast<int>(std::min<std::size_t>(last - first, 7));
    double width = 0;
    for (std::size_t i = first; i < last; ++i) {
      const double base = static_cast<double>(i);
      const double from = std::max(at, base) - base;
      const double to = std::min(end, base + 1) - base;
      for (int k = 0; k < parts; ++k) {
        const double share = (to - from) / parts;
        row_.push_back(detail::subcurve(panels_[i].cubic, from + k * share,
                                        k + 1 == parts ? to : from + (k + 1) * share));
        width += share * (panels_[i].t1 - panels_[i].t0);
        ends_.push_back(width);
      }
    }
    for (double& e : ends_) e /= width;
    return {end, detail::fit_cubic(row_, ends_, tolerance_)};
  }

  const Panel* panels_;
  std::size_t count_;
  double tolerance_;
  std::vector<Cubic> row_;
  std::vector<double> ends_;
};

PiecewiseBezier cover(Panels panels, double tolerance) {
  join(panels.list);
  PiecewiseBezier result;
  double bound = 0;
  if (panels.error > tolerance) {  // doubles cannot do it: nor can fewer pieces
    for (const Panel& p : panels.list)
      result.pieces.push_back({{p.cubic.control.begin(), p.cubic.control.end()}, {}});
    panels.list.clear();
  }
  for (std::size_t i = 0; i < panels.list.size();) {
    std::size_t next = i + 1;
    while (next < panels.list.size() && panels.list[next].joined) ++next;
    Run run(&panels.list[i], next - i, std::max(tolerance - panels.error, 0.5 * tolerance));
    bound = std::max(bound, run.cover(result.pieces));
    i = next;
  }
  result.deviation = bound + panels.error;
  return result;
}

void require_positive(double tolerance) {
  if (!(tolerance > 0)) throw core::InvalidInput("approximate_by_cubics: tolerance");
}

}  // namespace

PiecewiseBezier approximate_by_cubics(const Bezier2& c, double tolerance) {
  require_positive(tolerance);
  Panels panels;
  add_panels(c, 0, 1, kPanelShare * tolerance, panels);
  return cover(std::move(panels), tolerance);
}

PiecewiseBezier approximate_by_cubics(const BSpline2& c, double tolerance) {
  require_positive(tolerance);
  const auto pieces = to_beziers(c);
  const double n = static_cast<double>(pieces.size());
  const auto breaks = breakpoints(c);
  const bool even = breaks.size() != pieces.size() + 1;  // knots too close for t to tell apart
  Panels panels;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double k = static_cast<double>(i);
    add_panels(pieces[i], even ? k / n : breaks[i], even ? (k + 1) / n : breaks[i + 1],
               kPanelShare * tolerance, panels);
  }
  return cover(std::move(panels), tolerance);
}

PiecewiseBezier approximate_by_cubics(const Polyline2& c, double tolerance) {
  require_positive(tolerance);
  const auto t = breakpoints(c);
  Panels panels;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    add_panels({{c.points[i], c.points[i + 1]}, {}}, t[i], t[i + 1], tolerance, panels);
  return cover(std::move(panels), tolerance);
}

PiecewiseBezier approximate_by_cubics(const PlanarView& c, double tolerance) {
  require_positive(tolerance);
  return cover(panels_of(c, kPanelShare * tolerance), tolerance);
}

}  // namespace keyline::curve
