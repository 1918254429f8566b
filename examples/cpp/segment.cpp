#include <cstdio>

#include "keyline/lac/hermite/hermite.h"

int main() {
  using namespace keyline;
  const auto solved = lac::solve_g1({0, 0}, {2, 0}, {3, 1.5}, -1);  // handles, slope
  if (!solved) {  // why, and the nearest that can be drawn
    std::printf("%s; %s\n", solved.error().message.c_str(), solved.error().hint.c_str());
    return 1;
  }
  const core::Point2 middle = evaluate(solved->segment, 0.5);  // half the length
  std::printf("%.6f %.6f\n", middle.x, middle.y);
}
