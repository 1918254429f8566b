#include "keyline/analysis/rhythm_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "keyline/core/interval.h"
#include "keyline/numeric/levenberg_marquardt.h"
#include "keyline/numeric/solve.h"

namespace keyline::analysis::detail {
namespace {

constexpr double kExact = 1e-9;      // a deviation that no other start will better
constexpr double kStraight = 1e-13;  // turning in all, radians, that is rounding
constexpr double kLeastBase = 1e-7;  // of 1 - alpha lambda x, before a cusp or an inflection

/// log(1 + z) / z, for z > -1.
double log_ratio(double z) { return std::abs(z) < 1e-8 ? 1 - z / 2 : std::log1p(z) / z; }
/// (e^w - 1) / w.
double exp_ratio(double w) { return std::abs(w) < 1e-8 ? 1 + w / 2 : std::expm1(w) / w; }

double slope_at(const LineModel& m, double s) { return s < m.anchor ? m.slope0 : m.slope1; }

/// A model without its curvature, at the ends of the cells: there the turning from the anchor is
/// the product of curvature, stretched and ratio.
struct Shape {
  LineModel model;
  std::vector<double> stretched;
  std::vector<double> ratio;
};

/// `known`: of another model; what the two share is taken from it.
Shape shape_of(const LineModel& m, int cells, const Shape* known) {
  Shape shape{m, std::vector<double>(cells + 1), std::vector<double>(cells + 1)};
  const bool near = known && known->model.rate == m.rate && known->model.anchor == m.anchor;
  for (int i = 0; i <= cells; ++i) {
    const double s = static_cast<double>(i) / cells;
    const double alpha = slope_at(m, s);
    if (near && slope_at(known->model, s) == alpha) {
      shape.stretched[i] = known->stretched[i];
      shape.ratio[i] = known->ratio[i];
      continue;
    }
    const double x = s - m.anchor;
    shape.stretched[i] = x * log_ratio(-alpha * m.rate * x);
    shape.ratio[i] = exp_ratio((1 - alpha) * m.rate * shape.stretched[i]);
  }
  return shape;
}

Eigen::VectorXd turning_of(const Shape& shape) {
  const auto from_anchor = [&](int i) {
    return shape.model.curvature * shape.stretched[i] * shape.ratio[i];
  };
  const int cells = static_cast<int>(shape.ratio.size()) - 1;
  Eigen::VectorXd turning(cells);
  double before = from_anchor(0);
  for (int i = 0; i < cells; ++i) {
    const double now = from_anchor(i + 1);
    turning[i] = now - before;
    before = now;
  }
  return turning;
}

/// Such a frame leaves a model nothing to tell: it has no curvature and any slope.
bool is_straight(const PieceFrame& frame) { return frame.turning().cwiseAbs().sum() < kStraight; }

LineFit straight_line(const PieceFrame& frame, double slope0, double slope1) {
  const double none = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd turning = Eigen::VectorXd::Zero(frame.cells());
  return {{0, 0, 0.5, slope0, slope1}, frame.displacement(turning).norm(), none, none};
}

/// Turnings of line models, by their parameters, in as many cells as the frame has.
class Lines {
 public:
  using Model = std::function<LineModel(const Eigen::VectorXd&)>;
  explicit Lines(Model model) : model_(std::move(model)) {}

  Eigen::VectorXd at(const Eigen::VectorXd& x, int cells) {
    last_ = shape_of(model_(x), cells, nullptr);
    return turning_of(last_);
  }
  /// Of parameters some of which are those asked for last.
  Eigen::VectorXd beside(const Eigen::VectorXd& x, int cells) const {
    return turning_of(shape_of(model_(x), cells, &last_));
  }

 private:
  Model model_;
  Shape last_;
};

/// Least squares of the frame's displacement by build.at(x) with a numeric Jacobian; returns the
/// distance.
template <class Build>
double minimize(const PieceFrame& frame, Build& build, Eigen::VectorXd& x, int iterations) {
  Eigen::VectorXd known_at;  // a step that is taken is asked for again, with its derivatives
  Eigen::VectorXd known;
  const auto displaced = [&](const Eigen::VectorXd& at) -> const Eigen::VectorXd& {
    if (known_at.size() == at.size() && known_at == at) return known;
    known = frame.displacement(build.at(at, frame.cells()));
    known_at = at;
    return known;
  };
  const auto residuals = [&](const Eigen::VectorXd& at, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r = displaced(at);
    if (!r.allFinite()) return false;
    if (!j) return true;
    j->resize(r.size(), at.size());
    for (int k = 0; k < at.size(); ++k) {
      const double step = 1e-7 * std::max(1.0, std::abs(at[k]));
      Eigen::VectorXd beside = at;
      beside[k] += step;
      j->col(k) = (frame.displacement(build.beside(beside, frame.cells())) - r) / step;
    }
    return j->allFinite();
  };
  numeric::LevenbergMarquardtOptions options;
  options.max_iterations = iterations;
  numeric::minimize_least_squares(residuals, x, options);
  return displaced(x).norm();
}

/// Standard deviations of x for residuals of standard deviation 1.
Eigen::VectorXd uncertainty(const PieceFrame& frame, Lines build, const Eigen::VectorXd& x) {
  const int cells = frame.cells();
  build.at(x, cells);
  Eigen::MatrixXd j(2 * (cells + 1), x.size());
  for (int k = 0; k < x.size(); ++k) {
    Eigen::VectorXd up = x;
    Eigen::VectorXd down = x;
    up[k] += 1e-5;
    down[k] -= 1e-5;
    j.col(k) = (frame.displacement(build.beside(up, cells)) -
                frame.displacement(build.beside(down, cells))) /
               2e-5;
  }
  const std::optional<Eigen::MatrixXd> inverse = numeric::inverse(j.transpose() * j);
  if (!inverse) {
    return Eigen::VectorXd::Constant(x.size(), std::numeric_limits<double>::infinity());
  }
  return inverse->diagonal().cwiseMax(0).cwiseSqrt();
}

/// One line through the mean curvature of both ends, with the right whole turning.
LineModel first_guess(const PieceFrame& frame, double slope) {
  const int cells = frame.cells();
  const int part = cells / 20;
  const double floor = 1e-3 * std::max(frame.mean_curvature(0, cells), 1e-12);
  const double start = std::max(frame.mean_curvature(0, part), floor);
  const double end = std::max(frame.mean_curvature(cells - part, cells), floor);
  const double q = std::log(end / start);
  LineModel m{1, q, 0.5, slope, slope};
  if (std::abs(slope) > 1e-6) m.rate = 2 / slope * std::tanh(slope * q / 2);
  m.rate = drawable_rate(m);
  m.curvature = frame.turning().sum() / turning_of(m, cells).sum();
  return m;
}

/// x folded back and forth into [low, high]: a bound that, unlike a clamp, never leaves the
/// minimiser without a gradient.
double folded(double x, double low, double high) {
  const double width = high - low;
  if (!(width > 0)) return low;
  const double phase = std::abs(std::remainder(x - low, 2 * width));
  return low + std::min(phase, width);
}

LineModel one_line(const Eigen::VectorXd& x, double low, double high) {
  const double slope = folded(x[2], low, high);
  LineModel m{std::exp(x[0]), x[1], 0.5, slope, slope};
  m.rate = drawable_rate(m);
  return m;
}

LineModel two_lines(const Eigen::VectorXd& x, const SlopeBounds& b) {
  LineModel m{std::exp(x[0]), x[1], folded(x[4], 0.05, 0.95), folded(x[2], b.low0, b.high0),
              folded(x[3], b.low1, b.high1)};
  m.rate = drawable_rate(m);
  return m;
}

}  // namespace

double drawable_rate(const LineModel& m) {
  core::Interval all{-HUGE_VAL, HUGE_VAL};
  for (const double most : {-m.slope0 * m.anchor, m.slope1 * (1 - m.anchor)}) {
    // 1 - most * rate must stay above kLeastBase
    if (most > 0) all.high = std::min(all.high, (1 - kLeastBase) / most);
    if (most < 0) all.low = std::max(all.low, (1 - kLeastBase) / most);
  }
  double rate = m.rate;
  if (rate > all.high) rate = 2 * all.high - rate;
  if (rate < all.low) rate = 2 * all.low - rate;
  return std::clamp(rate, all.low, all.high);
}

double curvature_at(const LineModel& m, double s) {
  const double x = s - m.anchor;
  const double stretched = x * log_ratio(-slope_at(m, s) * m.rate * x);
  return m.curvature * std::exp(m.rate * stretched);
}

Eigen::VectorXd turning_of(const LineModel& m, int cells) {
  return turning_of(shape_of(m, cells, nullptr));
}

LineFit fit_one_line(const PieceFrame& frame, double low, double high) {
  if (is_straight(frame)) {
    LineFit fit = straight_line(frame, (low + high) / 2, (low + high) / 2);
    if (!(high > low)) fit.slope_error0 = fit.slope_error1 = 0;
    return fit;
  }
  Lines build([&](const Eigen::VectorXd& x) { return one_line(x, low, high); });
  const double width = high - low;
  const PieceFrame few = frame.coarse();
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_x;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double wish : {-3.0, -0.5, 0.5, 3.0}) {
    const double start = std::clamp(wish, low + width / 50, high - width / 50);
    if (start == last || least < kExact) continue;
    last = start;
    const LineModel guess = first_guess(frame, start);
    Eigen::VectorXd x(3);
    x << std::log(std::max(guess.curvature, 1e-12)), guess.rate, start;
    const double deviation = minimize(few, build, x, 60);
    if (!(deviation < least)) continue;
    least = deviation;
    best_x = x;
  }
  LineFit best;
  if (best_x.size() == 0) {
    best.model = first_guess(frame, std::clamp(0.0, low, high));
    best.deviation = frame.displacement(turning_of(best.model, frame.cells())).norm();
    return best;
  }
  best.deviation = minimize(frame, build, best_x, 60);
  best.model = one_line(best_x, low, high);
  if (width > 0) {
    best_x[2] = best.model.slope0;
    const Lines free([](const Eigen::VectorXd& x) { return one_line(x, -99, 99); });
    best.slope_error0 = best.slope_error1 = uncertainty(frame, free, best_x)[2];
  }
  return best;
}

namespace {

/// Two lines near the one line m, meeting at the anchor, with slopes this far from its slope.
Eigen::VectorXd two_lines_guess(const LineModel& m, const SlopeBounds& b, double anchor,
                                double step0, double step1) {
  const double margin = 0.4;
  LineModel guess = m;
  guess.slope0 = std::clamp(m.slope0 + step0, b.low0 + margin, b.high0 - margin);
  guess.slope1 = std::clamp(m.slope0 + step1, b.low1 + margin, b.high1 - margin);
  guess.curvature = std::max(curvature_at(m, anchor), 1e-9);
  guess.rate = m.rate / std::max(1 - m.slope0 * m.rate * (anchor - m.anchor), 1e-3);
  guess.anchor = anchor;
  Eigen::VectorXd x(5);
  x << std::log(guess.curvature), drawable_rate(guess), guess.slope0, guess.slope1, anchor;
  return x;
}

}  // namespace

LineFit fit_two_lines(const PieceFrame& frame, const SlopeBounds& bounds, const LineModel& start) {
  if (is_straight(frame))
    return straight_line(frame, (bounds.low0 + bounds.high0) / 2, (bounds.low1 + bounds.high1) / 2);
  Lines build([&](const Eigen::VectorXd& x) { return two_lines(x, bounds); });
  const double way = bounds.low0 > bounds.low1 ? 1 : -1;
  const PieceFrame few = frame.coarse();
  Eigen::VectorXd best_x;
  double least = std::numeric_limits<double>::infinity();
  for (double anchor : {0.25, 0.5, 0.75}) {
    for (const auto& [step0, step1] : {std::pair{0.7, -0.7}, {2.0, -0.2}, {0.2, -2.0}}) {
      if (least < kExact) break;
      Eigen::VectorXd x = two_lines_guess(start, bounds, anchor, way * step0, way * step1);
      const double deviation = minimize(few, build, x, 30);
      if (!(deviation < least)) continue;
      least = deviation;
      best_x = x;
    }
  }
  LineFit fit;
  if (best_x.size() == 0) {
    fit.model = start;
    fit.deviation = frame.displacement(turning_of(start, frame.cells())).norm();
    return fit;
  }
  fit.deviation = minimize(frame, build, best_x, 100);
  fit.model = two_lines(best_x, bounds);
  best_x.segment(2, 3) << fit.model.slope0, fit.model.slope1, fit.model.anchor;
  const Lines free([](const Eigen::VectorXd& x) { return two_lines(x, {-99, 99, -99, 99}); });
  const Eigen::VectorXd errors = uncertainty(frame, free, best_x);
  fit.slope_error0 = errors[2];
  fit.slope_error1 = errors[3];
  return fit;
}

namespace {

/// Ends of the n parts of the cells that leave the least sum of squares about the parts' means.
std::vector<int> best_parts(const Eigen::VectorXd& v, int n) {
  const int cells = static_cast<int>(v.size());
  std::vector<double> sum(cells + 1, 0), square(cells + 1, 0);
  for (int i = 0; i < cells; ++i) {
    sum[i + 1] = sum[i] + v[i];
    square[i + 1] = square[i] + v[i] * v[i];
  }
  const auto cost = [&](int a, int b) {
    const double s = sum[b] - sum[a];
    return square[b] - square[a] - s * s / (b - a);
  };
  std::vector<std::vector<double>> least(n, std::vector<double>(cells + 1, 1e300));
  std::vector<std::vector<int>> from(n, std::vector<int>(cells + 1, 0));
  for (int i = 1; i <= cells; ++i) least[0][i] = cost(0, i);
  for (int k = 1; k < n; ++k) {
    for (int i = k + 1; i <= cells; ++i) {
      for (int j = k; j < i; ++j) {
        const double c = least[k - 1][j] + cost(j, i);
        if (c < least[k][i]) {
          least[k][i] = c;
          from[k][i] = j;
        }
      }
    }
  }
  std::vector<int> ends(n, cells);
  for (int k = n - 1; k > 0; --k) ends[k - 1] = from[k][ends[k]];
  return ends;
}

/// x holds n curvatures and then n - 1 breaks.
Eigen::VectorXd turning_of_arcs(const Eigen::VectorXd& x, int cells) {
  const int n = (static_cast<int>(x.size()) + 1) / 2;
  const auto turned = [&](double s) {  // up to s
    double angle = 0;
    double from = 0;
    for (int k = 0; k < n; ++k) {
      const double to = k + 1 < n ? std::clamp(x[n + k], from, 1.0) : 1.0;
      angle += x[k] * (std::clamp(s, from, to) - from);
      from = to;
    }
    return angle;
  };
  Eigen::VectorXd turning(cells);
  for (int i = 0; i < cells; ++i)
    turning[i] = turned((i + 1.0) / cells) - turned(static_cast<double>(i) / cells);
  return turning;
}

struct Arcs {
  Eigen::VectorXd at(const Eigen::VectorXd& x, int cells) const {
    return turning_of_arcs(x, cells);
  }
  Eigen::VectorXd beside(const Eigen::VectorXd& x, int cells) const {
    return turning_of_arcs(x, cells);
  }
};

}  // namespace

ArcsFit fit_arcs(const PieceFrame& frame, int n) {
  if (is_straight(frame)) {
    ArcsFit fit;
    fit.deviation = straight_line(frame, 0, 0).deviation;
    fit.curvatures.assign(static_cast<std::size_t>(n), 0.0);
    for (int k = 1; k < n; ++k) fit.breaks.push_back(static_cast<double>(k) / n);
    return fit;
  }
  const std::vector<int> ends = best_parts(frame.turning(), n);
  Eigen::VectorXd x(2 * n - 1);
  for (int k = 0; k < n; ++k) {
    x[k] = frame.mean_curvature(k == 0 ? 0 : ends[k - 1], ends[k]);
    if (k + 1 < n) x[n + k] = static_cast<double>(ends[k]) / frame.cells();
  }
  ArcsFit fit;
  const Arcs build;
  fit.deviation = minimize(frame, build, x, 100);
  fit.curvatures.assign(x.data(), x.data() + n);
  double from = 0;
  for (int k = 0; k + 1 < n; ++k) {
    from = std::clamp(x[n + k], from, 1.0);
    fit.breaks.push_back(from);
  }
  return fit;
}

}  // namespace keyline::analysis::detail
