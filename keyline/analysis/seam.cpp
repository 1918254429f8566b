#include "keyline/analysis/seam.h"

#include <algorithm>
#include <cmath>

namespace keyline::analysis {
namespace {

constexpr double kAtSeam = 1e-6;  // of the parameter: as near, an event is the seam's

/// A curve that comes back begun at another parameter, its seam a breakpoint. Models
/// curve::PlanarCurve.
class BegunElsewhere {
 public:
  /// Precondition: 0 < begin < 1.
  BegunElsewhere(const CurveView& curve, double begin) : curve_(&curve), begin_(begin) {
    std::vector<double> ends = curve.breaks();
    ends.insert(std::ranges::lower_bound(ends, begin), begin);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto first = std::ranges::find(ends, begin);
    for (auto end = first; end + 1 != ends.end(); ++end) go_on({*end, *(end + 1)});
    for (auto end = ends.begin(); end != first; ++end) go_on({*end, *(end + 1)});
    breaks_.push_back(1);
  }

  double seam() const { return 1 - begin_; }
  const std::vector<double>& breaks() const { return breaks_; }
  /// The curve's own parameter; before a breakpoint, by however little, it is before the curve's.
  double own(double t) const {
    const auto next = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
    const auto i = static_cast<std::size_t>(next - breaks_.begin()) - 1;
    const double last = std::nextafter(from_[i].high, 0.0);
    if (t >= std::nextafter(*next, 0.0)) return last;
    return std::min(from_[i].low + (t - breaks_[i]), last);
  }
  const CurveView& curve() const { return *curve_; }

 private:
  /// With a stretch of the curve, unless rounding leaves nothing of it here.
  void go_on(const core::Interval& own) {
    const double low = own.low >= begin_ ? own.low - begin_ : own.low + seam();
    if (!(low + length(own) > low) || low == 1) return;
    from_.push_back(own);
    breaks_.push_back(low);
  }

  const CurveView* curve_;
  double begin_;
  std::vector<core::Interval> from_;  ///< stretches of the curve, in this one's order
  std::vector<double> breaks_;
};

core::Point2 evaluate(const BegunElsewhere& c, double t) { return c.curve().point(c.own(t)); }
curve::Jet2 jet(const BegunElsewhere& c, double t) { return c.curve().jet_at(c.own(t)); }
std::vector<double> breakpoints(const BegunElsewhere& c) { return c.breaks(); }

/// Where to begin: not inside an arc, which would be two then.
double between_pieces(const Split& split) {
  return split.pieces.size() > 1 ? split.pieces[split.pieces.size() / 2].t.low : 0.5;
}

/// Apart along the curve, which may be over its seam.
double apart(double t, double u) {
  const double d = std::abs(t - u);
  return std::min(d, 1 - d);
}

}  // namespace

void add_events_at_seam(const CurveView& curve, const ArcLengthTable& table,
                        const SplitOptions& options, Split& split) {
  const BegunElsewhere turned(curve, between_pieces(split));
  const Split found = split_monotone(turned, options);
  const auto add = [&](const std::vector<CurvatureEvent>& from, std::vector<CurvatureEvent>& to) {
    for (CurvatureEvent e : from) {
      if (e.flat.low > turned.seam() + kAtSeam || e.flat.high < turned.seam() - kAtSeam) continue;
      const bool flat = e.flat.low < e.flat.high;
      e.flat = flat ? core::Interval{turned.own(e.flat.low), turned.own(e.flat.high)}
                    : core::Interval{0, 0};
      e.t = flat ? turned.own(e.t) : 0;
      e.arc_length = table.length_at(e.t);
      const bool known = std::ranges::any_of(to, [&](const CurvatureEvent& k) {
        return k.kind == e.kind && apart(k.t, e.t) < kAtSeam;
      });
      if (!known) to.push_back(e);
    }
    std::ranges::stable_sort(to, {}, &CurvatureEvent::t);
  };
  add(found.corners, split.corners);
  add(found.extrema, split.extrema);
  add(found.inflections, split.inflections);
}

}  // namespace keyline::analysis
