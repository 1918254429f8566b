#include "keyline/sketch/ink_measure.h"

#include <algorithm>
#include <atomic>

#include "keyline/sketch/rows.h"

namespace keyline::sketch {

InkMeasure measure_ink(const Binary& ink) {
  std::atomic<long> all_area = 0;
  std::atomic<long> all_border = 0;
  for_rows(0, ink.height, [&](int first, int last) {
    long area = 0;
    long border = 0;
    for (int y = first; y < last; ++y)
      for (int x = 0; x < ink.width; ++x) {
        if (!ink.at(x, y)) continue;
        ++area;
        if (x == 0 || y == 0 || x + 1 == ink.width || y + 1 == ink.height || !ink.at(x - 1, y) ||
            !ink.at(x + 1, y) || !ink.at(x, y - 1) || !ink.at(x, y + 1))
          ++border;
      }
    all_area += area;
    all_border += border;
  });
  const auto area = static_cast<double>(all_area);
  const auto border = static_cast<double>(all_border);
  return {border > 0 ? std::max(1.0, 2 * area / border) : 1, border};
}

}  // namespace keyline::sketch
