#include "keyline/analysis/line_borders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/analysis/frame_fit.h"

namespace keyline::analysis::detail {
namespace {

constexpr double kBorder = 0.05;  // of a range, next to its border

/// A parameter that a fit has left next to a border of its fold, held there.
struct Held {
  int at;
  double value;
};

/// The borders x has ended next to. The rate's border follows from the other parameters: its value
/// says which of the two.
std::vector<Held> borders_beside(const std::vector<Fold>& folds, const LineModel& m,
                                 const Eigen::VectorXd& x) {
  std::vector<Held> all;
  for (const auto& [at, range] : folds) {
    const double width = range.high - range.low;
    const double share = (folded(x[at], range.low, range.high) - range.low) / width;
    if (share < kBorder) all.push_back({at, range.low});
    if (share > 1 - kBorder) all.push_back({at, range.high});
  }
  const core::Interval rates = drawable_rates(m);
  if (m.rate > rates.high - kBorder * std::abs(rates.high)) all.push_back({kRate, 1});
  if (m.rate < rates.low + kBorder * std::abs(rates.low)) all.push_back({kRate, -1});
  return all;
}

/// Least squares of the parameters that are not held; x and the distance are replaced where that
/// makes it smaller.
void fit_along(const PieceFrame& frame, const Lines::Model& model, const std::vector<Held>& held,
               double& deviation, Eigen::VectorXd& x) {
  Eigen::VectorXd all = x;
  std::vector<int> free(x.size());
  std::iota(free.begin(), free.end(), 0);
  double rate_border = 0;
  for (const auto& [at, value] : held) {
    std::erase(free, at);
    if (at == kRate)
      rate_border = value;
    else
      all[at] = value;
  }
  const auto put = [&](const Eigen::VectorXd& y) {
    all(free) = y;
    LineModel m = model(all);
    if (rate_border > 0) m.rate = drawable_rates(m).high;
    if (rate_border < 0) m.rate = drawable_rates(m).low;
    all[kRate] = rate_border == 0 ? all[kRate] : m.rate;
    return m;
  };
  Lines build(put);
  Eigen::VectorXd y = all(free);
  const double along = minimize(frame, build, y, 60);
  if (!(along < deviation)) return;
  put(y);
  x = all;
  deviation = along;
}

}  // namespace

double folded(double x, double low, double high) {
  const double width = high - low;
  if (!(width > 0)) return low;
  const double phase = std::abs(std::remainder(x - low, 2 * width));
  return low + std::min(phase, width);
}

double settle_at_borders(const PieceFrame& frame, const Lines::Model& model,
                         const std::vector<Fold>& folds, double deviation, Eigen::VectorXd& x) {
  const std::vector<Held> held = borders_beside(folds, model(x), x);
  if (held.empty()) return deviation;
  const Eigen::VectorXd start = x;
  fit_along(frame, model, held, deviation, x);
  if (held.size() == 1) return deviation;
  for (const Held& one : held) {
    Eigen::VectorXd other = start;
    const double before = deviation;
    fit_along(frame, model, {one}, deviation, other);
    if (deviation < before) x = other;
  }
  return deviation;
}

}  // namespace keyline::analysis::detail
