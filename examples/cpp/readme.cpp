#include <cstdio>

#include "keyline/lac/chain/chain.h"

int main() {
  using namespace keyline;
  // slope, length, curvature at both ends: a bonnet (radius 300 to 1600), then the hollow after it
  const lac::Chain chain{{{0, 20}, 0.62},
                         {{0.5, 395, -1.0 / 300, -1.0 / 1600}, {-1, 46, -1.0 / 1600, 1.0 / 55}}};
  for (const core::Point2 p : lac::sample(chain, 9)) std::printf("%8.3f %8.3f\n", p.x, p.y);
  std::printf("turns by %.4f rad; curvature jumps by %g at the joint\n", total_turning(chain),
              lac::largest_joint_gap(chain).curvature);
}
