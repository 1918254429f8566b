#pragma once

#include <algorithm>
#include <cmath>

/// Levenberg and Marquardt's iteration without its equations: those who know theirs (dense, of two
/// unknowns, of a chain's stages) take the steps, what a step came to moves the damping.
namespace keyline::numeric {

enum class StepEnd {
  unsolved,  ///< the damped equations have no solution
  refused,   ///< nothing is gained; the unknowns are as before
  taken,
  settled  ///< taken, or nothing more to take: the last
};

struct StepOutcome {
  StepEnd end = StepEnd::refused;
  double gain = 1;  ///< of a step taken: decrease over the decrease expected
};

/// Damping that changes by fixed factors.
struct FactorDamping {
  double value = 1e-6;
  double raise = 10;
  double lower = 0.1;
  double least = 1e-15;
  double most = 1e9;           ///< a step as short as this makes is not tried
  bool after_refusal = false;  ///< the first step taken after a refused one leaves it as it is
  bool refused = false;

  bool on_unsolved() {
    value = std::max(10 * value, 1e-8);
    return value <= most;
  }
  bool on_refused() {
    value *= raise;
    refused = true;
    return value < most;
  }
  void on_taken(double /*gain*/) {
    if (!after_refusal || !refused) value = std::max(value * lower, least);
    refused = false;
  }
};

/// Damping by what the steps gain (Nielsen 1999): raised faster and faster while they fail, lowered
/// as far as the last one was foreseen.
struct GainDamping {
  double value = 1e-3;
  double growth = 2;

  bool on_unsolved() { return on_refused(); }
  bool on_refused() {
    value *= growth;
    growth *= 2;
    return value <= 1e16;
  }
  void on_taken(double gain) {
    value = std::max(1e-15, value * std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)));
    growth = 2;
  }
};

struct DescentEnd {
  int steps = 0;
  bool exhausted = false;  ///< no step is short enough any more
  bool settled = false;
};

/// Takes up to `most` steps, StepOutcome step(double damping), until one settles or none is short
/// enough.
template <class Damping, class Step>
DescentEnd damped_descent(Damping& damping, int most, Step&& step) {
  DescentEnd end;
  while (end.steps < most && !end.settled && !end.exhausted) {
    ++end.steps;
    const StepOutcome outcome = step(damping.value);
    if (outcome.end == StepEnd::unsolved)
      end.exhausted = !damping.on_unsolved();
    else if (outcome.end == StepEnd::refused)
      end.exhausted = !damping.on_refused();
    else
      damping.on_taken(outcome.gain);
    end.settled = outcome.end == StepEnd::settled;
  }
  return end;
}

}  // namespace keyline::numeric
