#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "keyline/fairing/turns.h"

/// Which waves are tried to be taken out next, and how many at once.
namespace keyline::fairing::detail {

/// Single waves that are tried. In a row that all stay, least first, twice as many as stood before
/// one that went on any measured profile: wider ones stay too. Of one curve, three times as many as
/// on any: more have only curves that follow their points' errors. Of bends as many, unmeasured.
inline constexpr int kInRow = 24;
inline constexpr int kTries = 100;

/// Swings that were tried and are not worth it.
class Refusals {
 public:
  void add(const Removal& swing) { sideways_.push_back(swing.sideways); }
  void clear() { sideways_.clear(); }
  /// Whether it is one of them again, to a thousandth.
  bool hold(const Removal& swing) const;

 private:
  std::vector<double> sideways_;
};

/// Waves that share no extremum and were not refused, least first, until one departs farther than
/// the tolerance or all of them fill what the mean square has to spare. A sine's mean square is
/// half that of its amplitude.
/// all: least first; extrema: how many there are.
std::vector<Removal> small_waves(const std::vector<Removal>& all, std::size_t extrema,
                                 double tolerance, double spare, const Refusals& refusals);

/// How many waves are taken at once: as many as there are; where that fails, half as many, and
/// where it succeeds, twice as many the next time.
class AtOnce {
 public:
  /// attempt(n): whether the first n of them can go; n is two at least.
  template <class Attempt>
  bool try_together(std::size_t count, Attempt&& attempt) {
    for (std::size_t n = std::min(count, most_); n > 1; n /= 2) {
      if (attempt(n)) {
        most_ = 2 * n;
        return true;
      }
      most_ = n / 2;
    }
    return false;
  }
  /// A single one went.
  void one_went() { most_ = std::max<std::size_t>(most_, 2); }

 private:
  std::size_t most_ = static_cast<std::size_t>(-1);
};

/// Single waves in the order in which they are tried, least first, until there are too many. One
/// that is wider than the band and stands on points cannot be taken out whatever it costs; between
/// points that stand apart nothing holds it.
class SingleWaves {
 public:
  /// tries: so many were tried of the curve before. Refers to the refusals.
  SingleWaves(std::vector<Removal> all, double tolerance, int tries, const Refusals& refusals)
      : all_(std::move(all)), tolerance_(tolerance), tries_(tries), refusals_(refusals) {}

  /// The next ones, as if each of them were refused; those given before have been.
  std::vector<Removal> next(std::size_t most);

  /// More of them might go: there were too many.
  bool too_many() const { return too_many_; }

 private:
  std::vector<Removal> all_;
  double tolerance_;
  int tries_;
  const Refusals& refusals_;
  std::size_t at_ = 0;
  int in_row_ = 0;
  bool too_many_ = false;
};

}  // namespace keyline::fairing::detail
