#include "keyline/analysis/split.h"

#include <algorithm>
#include <cmath>

#include "keyline/analysis/integrate.h"
#include "keyline/analysis/waves.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::analysis {
namespace {

using detail::Sample;
using Kind = CurvatureEvent::Kind;

constexpr int kLeastSamples = 16;  // of a stretch between breaks, however short

/// A stretch, or several in a row, of one curvature: samples [first, last].
struct Flat {
  std::size_t first;
  std::size_t last;
};

class Splitter {
 public:
  Splitter(const CurveView& curve, const SplitOptions& options) : curve_(curve), options_(options) {
    result_.threshold = options.noise;
    take_samples();
    add_turns();
    find_flats();
  }

  Split run() {
    std::size_t from = 0;
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
      if (samples_[i].stretch == samples_[i + 1].stretch ||
          !is_corner(curve_, samples_[i].t, options_.corner))
        continue;
      const double t = samples_[i + 1].t;
      const double before = curve::curvature(curve_.jet_at(std::nextafter(t, 0.0)));
      result_.corners.push_back({Kind::corner, t, samples_[i].s, before, {t, t}});
      cuts_.push_back(t);
      split_run(from, i);
      from = i + 1;
    }
    split_run(from, samples_.size() - 1);
    make_pieces();
    return std::move(result_);
  }

 private:
  void take_samples() {
    const std::vector<double> ends =
        detail::panel_ends(curve_.breaks(), {0, 1}, options_.samples, kLeastSamples);
    const auto speed = [&](double t) { return curve::speed(curve_.jet_at(t)); };
    int stretch = 0;
    double s = 0;
    std::size_t next = 1;  // breakpoint to come
    samples_.push_back({ends[0], 0, curvature_at(ends[0]), 0});
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double step = numeric::integrate_gauss<8>(speed, ends[i - 1], ends[i]);
      s += std::isfinite(step) ? step : 0;
      const bool at_break = next < curve_.breaks().size() && ends[i] >= curve_.breaks()[next];
      const double before = at_break ? std::nextafter(ends[i], 0.0) : ends[i];
      samples_.push_back({ends[i], s, curvature_at(before, -1), stretch});
      if (!at_break) continue;
      ++next;
      ++stretch;
      if (i + 1 < ends.size()) samples_.push_back({ends[i], s, curvature_at(ends[i]), stretch});
    }
    length_ = s;
    rounding_ = {options_.rounding,
                 length_ > 0 ? std::max(options_.rounding * mean_bend(), 1e-9 / length_) : 0};
  }

  /// Mean of |curvature| along the curve, of two neighbours the lesser: a cusp is a short way.
  double mean_bend() const {
    double sum = 0;
    for (std::size_t i = 1; i < samples_.size(); ++i)
      sum += (samples_[i].s - samples_[i - 1].s) *
             std::min(std::abs(samples_[i - 1].curvature), std::abs(samples_[i].curvature));
    return sum / length_;
  }

  /// A sample where curvature turns between two others, as its rate at both says: a turn in the
  /// panel beside a breakpoint or an end shows in no other way.
  void add_turns() {
    const auto rate = [&](double t) { return curve::curvature_rate(curve_.jet_at(t)); };
    std::vector<Sample> all{samples_.front()};
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const Sample &a = samples_[i - 1], &b = samples_[i];
      const double last = std::nextafter(b.t, 0.0);
      if (a.stretch == b.stretch && rate(a.t) * rate(last) < 0) {
        const double t = zero_of(rate, a.t, last, a.t);
        const double kappa = curvature_at(t);
        const auto [low, high] = std::minmax(a.curvature, b.curvature);
        if (kappa < low - rounding_.of(low, kappa) || kappa > high + rounding_.of(high, kappa))
          all.push_back({t, arc_length_at(t, i - 1), kappa, a.stretch});
      }
      all.push_back(b);
    }
    samples_ = std::move(all);
  }

  /// Curvature; at a cusp, where it is infinite, that of a place close by on the side asked for.
  double curvature_at(double t, double sense = 1) const {
    constexpr double kBeside = 1e-7;
    const double kappa = curve::curvature(curve_.jet_at(t));
    if (std::isfinite(kappa)) return kappa;
    const double beside = curve::curvature(curve_.jet_at(t + sense * kBeside));
    return std::isfinite(beside) ? beside : 0;
  }

  void find_flats() {
    for (std::size_t first = 0; first < samples_.size();) {
      std::size_t last = first;
      double low = samples_[first].curvature;
      double high = low;
      while (last + 1 < samples_.size() && samples_[last + 1].stretch == samples_[first].stretch) {
        ++last;
        low = std::min(low, samples_[last].curvature);
        high = std::max(high, samples_[last].curvature);
      }
      if (high - low <= rounding_.of(low, high) && last > first) {
        const double before = first > 0 ? samples_[first - 1].curvature : low;
        const bool same = !flats_.empty() && flats_.back().last + 1 == first &&
                          std::abs(before - low) <= 2 * rounding_.of(before, low);
        if (same) {
          flats_.back().last = last;
        } else {
          flats_.push_back({first, last});
        }
      }
      first = last + 1;
    }
  }

  const Flat* flat_around(std::size_t i) const {
    for (const Flat& f : flats_) {
      if (f.first <= i && i <= f.last) return &f;
    }
    return nullptr;
  }

  void split_run(std::size_t from, std::size_t to) {
    if (to <= from) return;
    const auto turns =
        detail::significant_turns(samples_, from, to, options_.noise, rounding_, result_.merged);
    for (std::size_t k = 1; k + 1 < turns.size(); ++k) {
      const double rise = samples_[turns[k]].curvature - samples_[turns[k - 1]].curvature;
      add_extremum(turns[k], rise > 0 ? Kind::maximum : Kind::minimum);
    }
    std::vector<std::size_t> crossings;
    for (std::size_t k = 1; k < turns.size(); ++k) find_crossing(turns[k - 1], turns[k], crossings);
    for (std::size_t i : detail::significant_crossings(samples_, from, to, crossings,
                                                       options_.noise, rounding_, result_.merged))
      add_inflection(i);
    cut_at_flats(from, to);
  }

  void add(CurvatureEvent event, const Flat* flat) {
    if (flat) {
      event.flat = {samples_[flat->first].t, samples_[flat->last].t};
      event.t = (event.flat.low + event.flat.high) / 2;
      event.arc_length = (samples_[flat->first].s + samples_[flat->last].s) / 2;
      cuts_.push_back(event.flat.low);
      cuts_.push_back(event.flat.high);
    } else {
      event.flat = {event.t, event.t};
      cuts_.push_back(event.t);
    }
    (event.kind == Kind::inflection ? result_.inflections : result_.extrema).push_back(event);
  }

  void add_extremum(std::size_t i, Kind kind) {
    const Sample& here = samples_[i];
    double t = here.t;
    const bool inside = i > 0 && i + 1 < samples_.size() &&
                        samples_[i - 1].stretch == here.stretch &&
                        samples_[i + 1].stretch == here.stretch;
    const Flat* flat = flat_around(i);
    if (!flat && inside) {
      t = turn_within(kind, samples_[i - 1].t, samples_[i + 1].t, t);
    } else if (!flat) {  // the turn may lie just beside the breakpoint, inside the stretch
      t = refine_beside(kind, i);
    }
    double kappa = inside ? curvature_at(t) : here.curvature;
    if (!inside && t == here.t) {  // at a breakpoint, from the stretch's side; a cusp's is infinite
      const bool last = i > 0 && samples_[i - 1].stretch == here.stretch;
      kappa = curve::curvature(curve_.jet_at(last ? std::nextafter(t, 0.0) : t));
    }
    add({kind, t, arc_length_at(t, i), kappa, {t, t}}, flat);
  }

  double refine_beside(Kind kind, std::size_t i) const {
    const Sample& here = samples_[i];
    if (i > 0 && samples_[i - 1].stretch == here.stretch)
      return turn_within(kind, samples_[i - 1].t, here.t, here.t);
    if (i + 1 < samples_.size() && samples_[i + 1].stretch == here.stretch)
      return turn_within(kind, here.t, samples_[i + 1].t, here.t);
    return here.t;
  }

  /// Where curvature turns within a stretch from low up to high, which may be its end; `otherwise`
  /// where it turns the other way first, as beside a kink that is the turn itself.
  double turn_within(Kind kind, double low, double high, double otherwise) const {
    const auto rate = [&](double at) { return curve::curvature_rate(curve_.jet_at(at)); };
    const double first = rate(low);
    const bool towards = kind == Kind::maximum ? first > 0 : first < 0;
    return towards ? zero_of(rate, low, std::nextafter(high, 0.0), otherwise) : otherwise;
  }

  /// The zero of f in [low, high], or `otherwise` where f does not change sign.
  template <class F>
  double zero_of(const F& f, double low, double high, double otherwise) const {
    return numeric::bracketed_root(f, low, high, 0).value_or(otherwise);
  }

  double arc_length_at(double t, std::size_t near) const {
    const auto speed = [&](double at) { return curve::speed(curve_.jet_at(at)); };
    const double step = numeric::integrate_gauss<8>(speed, samples_[near].t, t);
    return samples_[near].s + (std::isfinite(step) ? step : 0);
  }

  int sign_of(std::size_t i) const {
    const double kappa = samples_[i].curvature;
    return std::abs(kappa) <= rounding_.least ? 0 : kappa > 0 ? 1 : -1;
  }

  /// The middle one of the sign changes between two turning points, if there is one in sum: the
  /// last sample that surely has the first sign.
  void find_crossing(std::size_t from, std::size_t to, std::vector<std::size_t>& crossings) const {
    std::vector<std::size_t> found;
    int sign = 0;
    std::size_t last_sure = from;
    for (std::size_t i = from; i <= to; ++i) {
      const int now = sign_of(i);
      if (now == 0) continue;
      if (sign != 0 && now != sign) found.push_back(last_sure);
      sign = now;
      last_sure = i;
    }
    if (found.size() % 2 == 1) crossings.push_back(found[found.size() / 2]);
  }

  void add_inflection(std::size_t i) {
    std::size_t next = i + 1;
    while (next + 1 < samples_.size() && sign_of(next) == 0) ++next;
    const std::size_t middle = (i + next) / 2;
    const Flat* flat = sign_of(middle) == 0 ? flat_around(middle) : nullptr;
    double t = samples_[middle].t;
    if (!flat && samples_[i].stretch == samples_[next].stretch) {
      const auto kappa = [&](double at) { return curve::curvature(curve_.jet_at(at)); };
      t = zero_of(kappa, samples_[i].t, std::nextafter(samples_[next].t, 0.0), t);
    }
    add({Kind::inflection, t, arc_length_at(t, middle), 0, {t, t}}, flat);
  }

  /// Cuts where an exact arc or straight stretch meets curvature that flows on, and where a
  /// straight stretch ends; not between arcs.
  void cut_at_flats(std::size_t from, std::size_t to) {
    for (const Flat& f : flats_) {
      if (f.last < from || f.first > to) continue;
      const bool straight = sign_of(f.first) == 0;
      const bool arc_before = f.first > 0 && flat_around(f.first - 1);
      const bool arc_after = f.last + 1 < samples_.size() && flat_around(f.last + 1);
      if (f.first > from && (straight || !arc_before)) cuts_.push_back(samples_[f.first].t);
      if (f.last < to && (straight || !arc_after)) cuts_.push_back(samples_[f.last].t);
    }
  }

  void make_pieces() {
    cuts_.push_back(0);
    cuts_.push_back(1);
    std::ranges::sort(cuts_);
    std::vector<double> ends = {0};
    for (double c : cuts_) {
      if (c - ends.back() > 1e-12 && (1 - c > 1e-12 || c == 1)) ends.push_back(c);
    }
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double a = ends[i - 1];
      const double b = ends[i];
      result_.pieces.push_back({{a, b},
                                {length_at(a), length_at(b)},
                                curve::curvature(curve_.jet_at(a)),
                                curve::curvature(curve_.jet_at(std::nextafter(b, 0.0)))});
    }
    for (auto* events : {&result_.extrema, &result_.inflections})
      std::ranges::sort(*events, {}, &CurvatureEvent::t);
    std::ranges::sort(result_.merged, {}, [](const MergedWave& w) { return w.t.low; });
  }

  double length_at(double t) const {
    const auto it = std::ranges::upper_bound(samples_, t, {}, &Sample::t);
    const std::size_t i =
        it == samples_.begin() ? 0 : static_cast<std::size_t>(it - samples_.begin()) - 1;
    return arc_length_at(t, i);
  }

  const CurveView& curve_;
  SplitOptions options_;
  std::vector<Sample> samples_;
  std::vector<Flat> flats_;
  std::vector<double> cuts_;
  Split result_;
  double length_ = 0;
  detail::Rounding rounding_;
};

}  // namespace

bool is_corner(const CurveView& curve, double t, double angle) {
  const double before = curve::tangent_angle(curve.jet_at(std::nextafter(t, 0.0)));
  const double after = curve::tangent_angle(curve.jet_at(t));
  return std::abs(core::wrap_angle(after - before)) > angle;
}

Split split_monotone(const CurveView& curve, const SplitOptions& options) {
  return Splitter(curve, options).run();
}

}  // namespace keyline::analysis
