#include "keyline/sketch/margins.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

using Gray = Raster<std::uint16_t>;

constexpr double kDark = 0.5;        ///< of the paper's luminance
constexpr int kShortest = 8;         ///< part of a side that a margin has at least
constexpr int kSoft = 3;             ///< pixels beyond its dark part that a margin's border takes
constexpr double kMost = 0.5;        ///< share of the picture that margins have at most
constexpr int kBeside = 32;          ///< pixels to either side from which the paper is told
constexpr double kPaperShare = 0.7;  ///< of those so many are no lighter than the paper

/// The picture seen from one of its sides: `along` it and so `deep` into the picture.
struct Side {
  int index;  ///< left, top, right, bottom
  int length;
  int depth;

  Side(const Gray& picture, int which)
      : index(which),
        length(which % 2 == 0 ? picture.height : picture.width),
        depth(which % 2 == 0 ? picture.width : picture.height) {}

  std::size_t at(const Gray& picture, int along, int deep) const {
    switch (index) {
      case 0:
        return picture.index(deep, along);
      case 1:
        return picture.index(along, deep);
      case 2:
        return picture.index(picture.width - 1 - deep, along);
      default:
        return picture.index(along, picture.height - 1 - deep);
    }
  }
};

/// Calls see(first, last) for the runs of an eighth of the side and more in which `is` holds.
template <class Is, class See>
void visit_runs(const Side& side, const Is& is, const See& see) {
  const int shortest = std::max(1, side.length / kShortest);
  for (int i = 0; i < side.length;) {
    int end = i;
    while (end < side.length && is(end)) ++end;
    if (end - i >= shortest) see(i, end);
    i = end + 1;
  }
}

/// How deep the margin on a side is at every place along it.
std::vector<int> depths_of(const Gray& picture, const Side& side, double darkest_paper) {
  const auto dark = [&](int along, int deep) {
    return picture.data[side.at(picture, along, deep)] < darkest_paper;
  };
  std::vector<int> depth(static_cast<std::size_t>(side.length), 0);
  const auto reach = [&](int deep) {
    bool any = false;
    visit_runs(
        side, [&](int i) { return depth[static_cast<std::size_t>(i)] == deep && dark(i, deep); },
        [&](int first, int last) {
          if (deep == 0 && first > 0 && last < side.length) return;  // clear of the corners
          any = true;
          std::fill(depth.begin() + first, depth.begin() + last, deep + 1);
        });
    return any;
  };
  for (int deep = 0; deep < side.depth && reach(deep); ++deep) {
  }
  return depth;
}

/// The paper's luminance beside a margin, around a place along its side.
std::uint16_t paper_beside(const Gray& picture, const Side& side, const std::vector<int>& depth,
                           int around, std::uint16_t otherwise) {
  std::vector<std::uint16_t> sample;
  const int last = std::min(side.length - 1, around + kBeside);
  for (int i = std::max(0, around - kBeside); i <= last; ++i) {
    const int deep = depth[static_cast<std::size_t>(i)];
    if (deep < side.depth) sample.push_back(picture.data[side.at(picture, i, deep)]);
  }
  return sample.empty() ? otherwise : core::value_at(sample, kPaperShare);
}

/// The soft border of a margin is part of it, also where it ends along the side.
std::vector<int> with_border(const std::vector<int>& depth, int most) {
  std::vector<int> wide(depth.size(), 0);
  const int n = static_cast<int>(depth.size());
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - kSoft); j <= std::min(n - 1, i + kSoft); ++j) {
      const int deep = depth[static_cast<std::size_t>(j)];
      int& here = wide[static_cast<std::size_t>(i)];
      if (deep > 0) here = std::max(here, std::min(most, deep + kSoft));
    }
  return wide;
}

}  // namespace

Margins clear_margins(Gray& luminance, double paper) {
  Margins found;
  std::array<std::vector<int>, 4> depths;
  double area = 0;
  for (int k = 0; k < 4; ++k) {
    const Side side(luminance, k);
    auto& depth = depths[static_cast<std::size_t>(k)];
    depth = depths_of(luminance, side, kDark * paper);
    found.deepest[static_cast<std::size_t>(k)] = *std::ranges::max_element(depth);
    for (const int d : depth) area += d;
    depth = with_border(depth, side.depth);
  }
  area /= static_cast<double>(luminance.data.size());
  if (!(area > 0) || area > kMost) return {};
  found.share = area;
  const auto usual = static_cast<std::uint16_t>(paper);
  for (int k = 0; k < 4; ++k) {
    const Side side(luminance, k);
    const auto& depth = depths[static_cast<std::size_t>(k)];
    for (int i = 0; i < side.length; ++i) {
      const int deep = depth[static_cast<std::size_t>(i)];
      if (deep == 0) continue;
      const std::uint16_t light = paper_beside(luminance, side, depth, i, usual);
      for (int d = 0; d < deep; ++d) luminance.data[side.at(luminance, i, d)] = light;
    }
  }
  return found;
}

}  // namespace keyline::sketch
