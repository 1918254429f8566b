#include "keyline/lac/space/two_slopes.h"

#include <cmath>

#include "keyline/lac/chain/extend.h"
#include "keyline/lac/space/space_ride.h"
#include "keyline/lac/space/space_shooting.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail::space {

double TwoSlopes::rate(double drawn) const {
  const int piece = grown(drawn);
  if (!(slope[piece] > 0)) return drawn;
  return drawn * numeric::expm1_over(-std::abs(drawn) * slope[piece] * length(piece));
}

double TwoSlopes::rate_by(double drawn) const {
  const int piece = grown(drawn);
  return slope[piece] > 0 ? std::exp(-std::abs(drawn) * slope[piece] * length(piece)) : 1;
}

std::optional<double> TwoSlopes::drawn(double rate) const {
  const int piece = grown(rate);
  const double part = std::abs(rate) * slope[piece] * length(piece);  // of the bound
  if (!(part > 0)) return rate;
  if (!(part < 1)) return std::nullopt;
  return rate * std::log1p(-part) / -part;
}

double TwoSlopes::drawn_to(int piece, double high) const {
  const double log = std::log(high);
  const double along = slope[piece] > 0 ? log : log * numeric::expm1_over(-slope[piece] * log);
  return (piece == 0 ? -1 : 1) * along / length(piece);
}

std::optional<std::array<double, 2>> TwoSlopes::ends(double drawn) const {
  const int grows = grown(drawn), falls = 1 - grows;
  const double steep = std::abs(rate(drawn));
  const auto high = slope[grows] > 0 ? std::exp(std::abs(drawn) * length(grows))
                                     : curvature_continued(slope[grows], 1, steep, length(grows));
  const auto low = curvature_continued(slope[falls], 1, -steep, length(falls));
  if (!high || !low) return std::nullopt;
  std::array<double, 2> ends{};
  ends[grows] = *high;
  ends[falls] = *low;
  return ends;
}

double TwoSlopes::at(double rate, double t) const {
  return carried(1, slope[t < share ? 0 : 1], -rate * (t - share));
}

double TwoSlopes::by_rate(double value, double t) const {
  return (t - share) * bounded_power(value, 1 + slope[t < share ? 0 : 1]);
}

LawRun TwoSlopes::run(double rate, int piece) const {
  const double along = rate * length(piece);
  LawRun run{HUGE_VAL, slope[piece], along};
  if (slope[piece] != 0 && along != 0)
    run.place = 1 / (slope[piece] * along) + (piece == 0 ? 1 : 0);
  return run;
}

}  // namespace keyline::lac::detail::space
