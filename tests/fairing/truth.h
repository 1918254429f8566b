#pragma once

#include <cstdint>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

/// Chains made up at random, and how near an answer comes to one.
namespace keyline::fairing::testing {

/// 1 to 5 log-aesthetic pieces, slopes in [-3, 3], below 0 beside an inflection; curvature changes
/// by a factor of at least 2 over a piece; at most two pieces per monotone run, their slopes at
/// least 0.5 apart (two pieces of one slope are one piece).
lac::Chain random_chain(std::uint64_t seed);

/// Evenly spaced points of it, each moved by normal errors of standard deviation
/// `noise` x length in x and y, rounded to `decimals` of the length (0: not).
std::vector<core::Point2> measure(const lac::Chain& chain, int count, double noise,
                                  std::uint64_t seed, int decimals = 0);

acquire::KeyLine line_through(const std::vector<core::Point2>& points);

/// How far an answer is from the truth; lengths as parts of the length.
struct Difference {
  bool same_count = false;
  int surplus = 0;    ///< pieces more than the truth has
  double joints = 0;  ///< largest distance of a joint, where counts agree
  double slopes = 0;  ///< largest difference of a slope, where counts agree
  double largest = 0;
  double rms = 0;  ///< of the distances of the truth's points from the answer
};
Difference compare(const lac::Chain& truth, const FairResult& result);

}  // namespace keyline::fairing::testing
