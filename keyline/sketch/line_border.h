#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "keyline/sketch/dark_rows.h"

namespace keyline::sketch {

/// Tells the borders of lines by the darkness of the pixels around, in rows that lie `stride`
/// apart.
class LineBorder {
 public:
  explicit LineBorder(std::ptrdiff_t stride) {
    const auto half = [](int way) { return (way + (way > 0 ? 1 : -1)) / 2; };
    for (int y = -kRadius; y <= kRadius; ++y) {
      const int across = static_cast<int>(std::lround(std::sqrt(kRadius * kRadius - y * y)));
      for (int x = -across; x <= across; ++x) {
        away_.push_back(y * stride + x);
        if (std::hypot(x, y) > kRadius - 1)
          ways_.push_back({x, y, y * stride + x, half(y) * stride + half(x)});
      }
    }
  }

  /// Whether some pixel is so much darker that a faint one may be its line's edge.
  bool has_darker(const std::uint16_t* here) const {
    const double than = *here / kShare;
    if (!(than < kBlack)) return false;  // nothing is
    return std::ranges::any_of(away_, [&](std::ptrdiff_t step) { return here[step] > than; });
  }

  /// Calls see(x, y) for the steps to places opposite to what is darker than both them and the
  /// pixel, where that is rather even than a border. A border is log-concave: from share s of what
  /// is darker it falls to s of itself as far away again, and to √s halfway.
  template <class See>
  void visit_beyond(const std::uint16_t* here, const See& see) const {
    const double rather = std::sqrt(kShare);
    const auto is_even = [here](std::uint16_t beyond, double share) {
      return beyond > share * *here && share * beyond < *here;
    };
    for (const Way& way : ways_)
      if (is_even(here[-way.end], rather) && is_even(here[-way.halfway], std::sqrt(rather)) &&
          kShare * here[way.end] > std::max(*here, here[-way.end]))
        see(-way.x, -way.y);
  }

 private:
  static constexpr int kRadius = DarkRows::kMargin;
  static constexpr double kShare = 0.45;  ///< of the darkest pixel nearby: the edge of a line

  /// To a pixel at the rim.
  struct Way {
    int x, y;
    std::ptrdiff_t end, halfway;
  };

  std::vector<std::ptrdiff_t> away_;  ///< in the row of all pixels
  std::vector<Way> ways_;
};

}  // namespace keyline::sketch
