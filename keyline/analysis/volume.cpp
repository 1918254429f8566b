#include "keyline/analysis/volume.h"

#include <array>
#include <cmath>

#include "keyline/analysis/integrate.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::analysis {
namespace {

using core::cross;

constexpr std::size_t kNodes = 8;  // of a panel
constexpr int kPanels = 16;        // at first, each halved at least once
constexpr int kMostDepth = 50;
constexpr double kTolerance = 1e-13;       // of what the curve sweeps
constexpr double kMostTurned = core::kPi;  // within a panel
constexpr double kRounding = 4e-15;        // of a place, by its coordinates and the way to it

/// Where the curve stands beside its chord: `side` has the sign of its distance, `approach` is the
/// distance's derivative times the chord.
struct Place {
  double t;
  double side;
  double approach;
};

/// What the line from the start sweeps along a part of the curve.
struct Panel {
  double low, high;
  double doubled = 0;  ///< area, twice
  double swept = 0;    ///< the same without its signs
  double turned = 0;   ///< by the tangent, without its signs
  double length = 0;
  std::array<Place, kNodes> places{};
};

/// A curve swept from its start, in panels in which it turns by no more than half a turn: so that
/// between two nodes it comes near its chord once at most.
class Sweep {
 public:
  Sweep(const CurveView& curve, core::Interval t)
      : curve_(curve),
        t_(t),
        start_(curve.jet_at(t.low).point),
        chord_(curve.jet_at(t.high).point - start_) {
    const std::vector<double> ends = detail::panel_ends(curve.breaks(), t, kPanels);
    std::vector<Panel> whole;
    double swept = 0, length = 0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      whole.push_back(measure(ends[i - 1], ends[i]));
      swept += whole.back().swept;
      length += whole.back().length;
    }
    rounding_ = kRounding * (length + distance(start_, core::Point2{}));
    halvings_ = 10'000 + 50 * static_cast<int>(whole.size());
    for (const Panel& p : whole)
      refine(p, kTolerance * swept / static_cast<double>(whole.size()), 0);
  }

  double signed_area() const {
    double sum = 0;
    for (const Panel& p : panels_) sum += p.doubled;
    return sum / 2;
  }

  /// The parts between the crossings of the chord, each for itself.
  double area() const {
    const std::vector<double> crossings = chord_crossings();
    double sum = 0, part = 0;
    auto crossing = crossings.begin();
    for (const Panel& p : panels_) {
      double from = p.low, left = p.doubled;
      for (; crossing != crossings.end() && *crossing < p.high; from = *crossing++) {
        const double before = measure(from, *crossing).doubled;
        sum += std::abs(part + before);
        part = 0;
        left -= before;
      }
      part += left;
    }
    return (sum + std::abs(part)) / 2;
  }

 private:
  Panel measure(double low, double high) const {
    constexpr const auto& rule = numeric::gauss_legendre<kNodes>;
    Panel p{low, high};
    for (std::size_t i = 0; i < kNodes; ++i) {
      const double t = low + (high - low) * rule.nodes[i];
      const double width = (high - low) * rule.weights[i];
      const curve::Jet2 j = curve_.jet_at(t);
      const double here = cross(j.point - start_, j.first);
      const double bend = std::abs(cross(j.first, j.second)) / dot(j.first, j.first);
      p.doubled += width * here;
      p.swept += width * std::abs(here);
      p.turned += std::isfinite(bend) ? width * bend : 0;
      p.length += width * norm(j.first);
      p.places[i] = {t, cross(chord_, j.point - start_), cross(chord_, j.first)};
    }
    return p;
  }

  void refine(const Panel& p, double allowed, int depth) {
    const double middle = (p.low + p.high) / 2;
    const Panel left = measure(p.low, middle), right = measure(middle, p.high);
    const double miss = std::abs(left.doubled + right.doubled - p.doubled);
    const bool done = !(miss > std::max(allowed, rounding_ * p.length)) &&
                      !(std::max(left.turned, right.turned) > kMostTurned);
    if (done || depth >= kMostDepth || --halvings_ < 0 || !(p.low < middle && middle < p.high)) {
      panels_.insert(panels_.end(), {left, right});
      return;
    }
    refine(left, allowed / 2, depth + 1);
    refine(right, allowed / 2, depth + 1);
  }

  /// All places beside the chord, in order. At the ends, which lie on it, the tangent tells the
  /// side.
  std::vector<Place> places() const {
    const double leaving = cross(chord_, curve_.jet_at(t_.low).first);
    const double coming = cross(chord_, curve_.jet_at(std::nextafter(t_.high, t_.low)).first);
    std::vector<Place> all{{t_.low, leaving, leaving}};
    for (const Panel& p : panels_) all.insert(all.end(), p.places.begin(), p.places.end());
    all.push_back({t_.high, -coming, coming});
    std::erase_if(all, [](const Place& p) { return p.side == 0; });
    return all;
  }

  /// Side of the chord over the distances from both ends, so that one crossed next to an end is
  /// not taken for the end.
  double side(double at) const {
    const curve::Jet2 j = curve_.jet_at(at);
    const double width = t_.high - t_.low;
    if (at == t_.low) return cross(chord_, j.first) / width;
    if (at == t_.high) return -cross(chord_, j.first) / width;
    return cross(chord_, j.point - start_) / ((at - t_.low) * (t_.high - at));
  }

  /// Parameters at which the curve crosses the line through its chord.
  std::vector<double> chord_crossings() const {
    std::vector<double> crossings;
    const auto look = [&](double low, double high) {
      const auto at = [this](double t) { return side(t); };
      if (const auto root = numeric::bracketed_root(at, low, high, 0)) crossings.push_back(*root);
    };
    const auto approach = [this](double t) { return cross(chord_, curve_.jet_at(t).first); };
    const std::vector<Place> all = places();
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Place &a = all[i - 1], &b = all[i];
      if (a.side * b.side < 0) {
        look(a.t, b.t);
      } else if (a.side * a.approach < 0 && b.side * b.approach > 0) {
        const auto nearest = numeric::bracketed_root(approach, a.t, b.t, 0);
        if (!nearest || !(side(*nearest) * a.side < 0)) continue;
        look(a.t, *nearest);
        look(*nearest, b.t);
      }
    }
    return crossings;
  }

  const CurveView& curve_;
  core::Interval t_;
  core::Point2 start_;
  core::Vector2 chord_;
  double rounding_ = 0;  ///< of the place of a point
  int halvings_ = 0;     ///< left: what is not a number agrees with no halves
  std::vector<Panel> panels_;
};

}  // namespace

double signed_volume(const CurveView& curve, core::Interval t) {
  // The chord runs through the start, so it adds nothing to the contour integral.
  return Sweep(curve, t).signed_area();
}

double volume(const CurveView& curve, core::Interval t) { return Sweep(curve, t).area(); }

}  // namespace keyline::analysis
