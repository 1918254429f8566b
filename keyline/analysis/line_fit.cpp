#include "keyline/analysis/line_fit.h"

#include <cmath>

namespace keyline::analysis::detail {
namespace {

constexpr double kBeside = 0.05;  // of the last rate

/// All parameters but the second, the rate.
Eigen::VectorXd without_rate(const Eigen::VectorXd& x) {
  Eigen::VectorXd rest(x.size() - 1);
  rest << x[0], x.tail(x.size() - 2);
  return rest;
}
Eigen::VectorXd with_rate(const Eigen::VectorXd& rest, double rate) {
  Eigen::VectorXd x(rest.size() + 1);
  x << rest[0], rate, rest.tail(rest.size() - 1);
  return x;
}

}  // namespace

double fit(const PieceFrame& frame, const LineModels& lines, Eigen::VectorXd& x, int iterations) {
  Lines build(lines.model);
  return minimize(frame, build, lines.bounds, x, iterations);
}

double settle_at_last_rate(const PieceFrame& frame, const LineModels& lines, double deviation,
                           Eigen::VectorXd& x) {
  const LineModel found = lines.model(x);
  const core::Interval rates = drawable_rates(found);
  const bool at_high = found.rate > rates.high - kBeside * std::abs(rates.high);
  const bool at_low = found.rate < rates.low + kBeside * std::abs(rates.low);
  if (!at_high && !at_low) return deviation;
  const auto along = [&](const Eigen::VectorXd& rest) {
    LineModel m = lines.model(with_rate(rest, 0));
    m.rate = at_high ? drawable_rates(m).high : drawable_rates(m).low;
    return m;
  };
  const LineModels border{along, {without_rate(lines.bounds.low), without_rate(lines.bounds.high)}};
  Eigen::VectorXd rest = without_rate(x);
  const double settled = fit(frame, border, rest, 60);
  if (!(settled < deviation)) return deviation;
  x = with_rate(rest, along(rest).rate);
  return settled;
}

}  // namespace keyline::analysis::detail
