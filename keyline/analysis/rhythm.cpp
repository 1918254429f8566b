#include "keyline/analysis/rhythm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keyline/analysis/arcs_fit.h"
#include "keyline/analysis/rhythm_models.h"

namespace keyline::analysis {
namespace {

struct Entry {
  Rhythm rhythm;
  const char* name;
  const char* impression;
};

constexpr std::array<Entry, 8> kEntries = {{
    {Rhythm::straight, "straight", "straight"},
    {Rhythm::arc, "arc", "single R"},
    {Rhythm::arcs, "arcs", "single R joined to single R"},
    {Rhythm::minus, "minus", "sharp, forceful, accelerating"},
    {Rhythm::zero, "zero", "stable, static"},
    {Rhythm::plus, "plus", "convergent, decelerating"},
    {Rhythm::plus_minus, "plus+minus", "from accelerating to decelerating"},
    {Rhythm::minus_plus, "minus+plus", "from decelerating to accelerating"},
}};

constexpr double kUndetermined = 1000;  // error of a slope that the piece does not determine
constexpr double kExact = 1e-9;         // a deviation that rounding makes
constexpr double kSeenScore = 0.02;     // changes a plausibility by a hundredth

using detail::ArcsFit;
using detail::LineFit;
using detail::LineModel;
using detail::PieceFrame;

/// Fits the models to one piece and words the results.
class Reader {
 public:
  Reader(const CurvatureProfile& piece, const RhythmOptions& options)
      : frame_(piece), options_(options) {
    const double resolution = std::max(options.resolution, 1e-12);
    sigma_ = std::hypot(std::max(options.noise, 0.0) / frame_.length(), resolution);
    observations_ = std::max(options.observations, 2.0);
    seen_ = std::max(kExact, sigma_ * std::sqrt(kSeenScore / observations_));
  }

  Interpretation straight() const {
    Interpretation i = start(Rhythm::straight, 0);
    i.curvatures = {0, 0};
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(frame_.cells());
    return rated(i, frame_.displacement(none).norm());
  }

  Interpretation arcs(int n) const {
    const ArcsFit fit = detail::fit_arcs(frame_, n);
    Interpretation i = start(n == 1 ? Rhythm::arc : Rhythm::arcs, 2 * n - 1);
    i.curvatures = fit.curvatures;
    i.breaks = fit.breaks;
    return rated(outward(i), fit.deviation);
  }

  Interpretation best_arcs() const {
    Interpretation best = arcs(2);
    for (int n = 3; n <= options_.max_arcs && misfit(best) > price(2); ++n) {
      Interpretation more = arcs(n);
      if (more.score < best.score) best = std::move(more);
    }
    return best;
  }

  /// parameters: 3 with the slope free, 2 with it given.
  Interpretation one_line(Rhythm rhythm, double low, double high) const {
    const LineFit fit = detail::fit_one_line(frame_, low, high, seen_);
    Interpretation i = start(rhythm, high > low ? 3 : 2);
    i.slopes = {fit.model.slope0};
    i.slope_errors = {error_of(fit.slope_error0)};
    i.curvatures = {detail::curvature_at(fit.model, 0), detail::curvature_at(fit.model, 1)};
    return rated(outward(i), fit.deviation);
  }

  Interpretation minus() const {
    return one_line(Rhythm::minus, -options_.slope_limit, -options_.zero_band);
  }
  Interpretation plus() const {
    return one_line(Rhythm::plus, options_.zero_band, options_.slope_limit);
  }
  Interpretation zero() const {
    Interpretation exact = one_line(Rhythm::zero, 0, 0);
    if (!(options_.zero_band > 0)) return exact;
    Interpretation near = one_line(Rhythm::zero, -options_.zero_band, options_.zero_band);
    return near.score < exact.score ? near : exact;
  }

  Interpretation two_lines(Rhythm rhythm) const {
    const double band = options_.zero_band;
    const double limit = options_.slope_limit;
    detail::SlopeBounds bounds{-limit, 0, -limit, 0};
    if (rhythm == Rhythm::plus) bounds = {0, limit, 0, limit};
    if (rhythm == Rhythm::plus_minus) bounds = {band, limit, -limit, -band};
    if (rhythm == Rhythm::minus_plus) bounds = {-limit, -band, band, limit};
    const LineFit fit = detail::fit_two_lines(frame_, bounds, seen_);
    const LineModel& m = fit.model;
    Interpretation i = start(rhythm, 5);
    i.slopes = {m.slope0, m.slope1};
    i.slope_errors = {error_of(fit.slope_error0), error_of(fit.slope_error1)};
    i.breaks = {m.anchor};
    i.curvatures = {detail::curvature_at(m, 0), m.curvature, detail::curvature_at(m, 1)};
    return rated(outward(i), fit.deviation);
  }

  /// minus or plus with two slopes, where that is the best reading of all.
  void add_two_of_one_sign(std::vector<Interpretation>& list) const {
    const auto best = std::ranges::min_element(list, {}, &Interpretation::score);
    if (best->score <= price(5)) return;
    for (Rhythm rhythm : {Rhythm::minus, Rhythm::plus}) {
      Interpretation two = two_lines(rhythm);
      const auto beats = [&](const Interpretation& i) { return two.score < i.score; };
      if (std::ranges::all_of(list, beats)) list.push_back(std::move(two));
    }
  }

 private:
  /// What n parameters cost, and what a reading pays for not fitting.
  double price(int n) const { return n * std::log(observations_); }
  double misfit(const Interpretation& i) const { return i.score - price(i.parameters); }

  Interpretation start(Rhythm rhythm, int parameters) const {
    Interpretation i;
    i.rhythm = rhythm;
    i.parameters = parameters;
    return i;
  }

  double error_of(double unit_error) const {
    const double error = unit_error * sigma_ / std::sqrt(observations_);
    return error < kUndetermined ? error : kUndetermined;
  }

  Interpretation rated(Interpretation i, double deviation) const {
    i.deviation = deviation * frame_.length();
    const double ratio = deviation / sigma_;
    i.score = observations_ * std::log1p(ratio * ratio) + price(i.parameters);
    return i;
  }

  /// From the frame to the direction and size of the piece. Slopes stay along growing radius.
  Interpretation outward(Interpretation i) const {
    for (double& k : i.curvatures) k *= direction() / frame_.length();
    if (!frame_.reversed()) return i;
    std::ranges::reverse(i.curvatures);
    std::ranges::reverse(i.breaks);
    for (double& b : i.breaks) b = 1 - b;
    return i;
  }

  double direction() const { return frame_.sign(); }

  PieceFrame frame_;
  RhythmOptions options_;
  double sigma_ = 1;
  double observations_ = 100;
  double seen_ = kExact;  ///< a deviation that no other start of a fit will better
};

void rank(std::vector<Interpretation>& list) {
  std::ranges::stable_sort(list, {}, &Interpretation::score);
  double sum = 0;
  for (Interpretation& i : list) {
    i.plausibility = std::exp((list.front().score - i.score) / 2);
    sum += i.plausibility;
  }
  for (Interpretation& i : list) i.plausibility /= sum;
}

}  // namespace

const char* rhythm_name(Rhythm rhythm) {
  for (const Entry& e : kEntries) {
    if (e.rhythm == rhythm) return e.name;
  }
  return "";
}

std::optional<Rhythm> parse_rhythm(std::string_view name) {
  for (const Entry& e : kEntries) {
    if (name == e.name) return e.rhythm;
  }
  return std::nullopt;
}

const char* impression(Rhythm rhythm) {
  for (const Entry& e : kEntries) {
    if (e.rhythm == rhythm) return e.impression;
  }
  return "";
}

core::Result<RhythmReading> classify_rhythm(const CurvatureProfile& piece,
                                            const RhythmOptions& options) {
  const auto profile = complete(piece);
  if (!profile) return std::unexpected(profile.error());
  const Reader reader(*profile, options);
  RhythmReading reading;
  reading.interpretations = {reader.straight(),
                             reader.arcs(1),
                             reader.best_arcs(),
                             reader.minus(),
                             reader.zero(),
                             reader.plus(),
                             reader.two_lines(Rhythm::plus_minus),
                             reader.two_lines(Rhythm::minus_plus)};
  reader.add_two_of_one_sign(reading.interpretations);
  rank(reading.interpretations);
  return reading;
}

core::Result<Interpretation> interpret_with_slope(const CurvatureProfile& piece, double slope,
                                                  const RhythmOptions& options) {
  if (!std::isfinite(slope))
    return core::fail(core::ErrorCode::bad_input, "the slope is not finite");
  const auto profile = complete(piece);
  if (!profile) return std::unexpected(profile.error());
  const double band = options.zero_band;
  const Rhythm rhythm = std::abs(slope) <= band ? Rhythm::zero
                        : slope < 0             ? Rhythm::minus
                                                : Rhythm::plus;
  return Reader(*profile, options).one_line(rhythm, slope, slope);
}

}  // namespace keyline::analysis
