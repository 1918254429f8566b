#include "keyline/sketch/binarize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>

#include "keyline/sketch/dark_rows.h"
#include "keyline/sketch/line_border.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

using Gray = Raster<std::uint16_t>;

constexpr int kBins = 256;            ///< of darkness
constexpr double kFaintest = 0.05;    ///< least darkness of ink whatever the noise
constexpr double kNoiseFactor = 4.5;  ///< ink is this many standard deviations off paper
constexpr double kWeakShare = 0.5;    ///< of the threshold: what may hang on to ink
constexpr double kBlotShare = 0.2;    ///< of the strongest region's contrast: less is no ink
constexpr double kBlur = 0.5;         ///< pixels: closes the grain of a pencil
constexpr double kNoisy = 0.02;       ///< noise in darkness from which more blur helps
constexpr double kStrongBlur = 0.85;  ///< pixels, in such noise

struct Histogram {
  std::array<double, kBins> weight{};
  double total = 0;
};

/// Darkness to bin: 0 at the paper, 1 black.
int bin_of(double depth) { return std::clamp(static_cast<int>(depth * kBins), 0, kBins - 1); }

struct Otsu {
  double threshold = 0;
  double separation = 0;
  double ink_weight = 0;
};

/// Threshold of largest variance between the classes ([Otsu 1979]).
Otsu otsu(const Histogram& h) {
  double sum = 0;
  for (int i = 0; i < kBins; ++i) sum += i * h.weight[static_cast<std::size_t>(i)];
  Otsu best;
  double best_variance = -1;
  double below = 0;
  double sum_below = 0;
  for (int i = 0; i + 1 < kBins; ++i) {
    below += h.weight[static_cast<std::size_t>(i)];
    sum_below += i * h.weight[static_cast<std::size_t>(i)];
    const double above = h.total - below;
    if (below <= 0 || above <= 0) continue;
    const double gap = (sum - sum_below) / above - sum_below / below;
    const double variance = below * above * gap * gap;
    if (variance <= best_variance) continue;
    best_variance = variance;
    best = {(sum_below / below + 0.5 * gap + 0.5) / kBins, gap / kBins, above};
  }
  return best;
}

struct Box {
  int x0, y0, x1, y1;
};

Box region_box(const Gray& g, int index) {
  const auto cut = [](int size, int i) { return part_start(size, kRegions, i); };
  const int r = index / kRegions;
  const int c = index % kRegions;
  return {cut(g.width, c), cut(g.height, r), cut(g.width, c + 1), cut(g.height, r + 1)};
}

constexpr std::size_t kBlock = 16;  ///< pixels whose edges are looked at together

/// Sum of the steps across a pixel, along its row and its column.
int step_at(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below,
            std::size_t x) {
  return std::abs(here[x + 1] - here[x - 1]) + std::abs(below[x] - above[x]);
}

/// Whether a step of so much along the row or the column can be in the block from x on.
bool any_step(const std::uint16_t* above, const std::uint16_t* here, const std::uint16_t* below,
              std::size_t x, std::uint16_t least) {
  const auto differ = [least](std::uint16_t a, std::uint16_t b) {
    const auto d = static_cast<std::uint16_t>(a > b ? a - b : b - a);
    return static_cast<std::uint16_t>(d >= least);
  };
  std::uint16_t any = 0;  // as wide as the pixels: the loop has no branches then
  for (std::size_t k = x; k < x + kBlock; ++k)
    any |= differ(here[k + 1], here[k - 1]) | differ(below[k], above[k]);
  return any != 0;
}

/// Darkness of pixels near edges, weighted by the edge's strength.
Histogram edge_histogram(const Gray& level, const DarknessTable& dark, const Box& box,
                         double floor) {
  Histogram h;
  const int x0 = std::max(box.x0, 1);
  const int y0 = std::max(box.y0, 1);
  const int x1 = std::min(box.x1, level.width - 1);
  const int y1 = std::min(box.y1, level.height - 1);
  if (x0 >= x1 || y0 >= y1) return h;
  // of two steps whose sum counts one is half of that
  const auto least = static_cast<std::uint16_t>(std::min(0.5 * floor, 1.0) * kBlack);
  const auto size = static_cast<std::size_t>(x1 - x0 + 2);  // and a pixel on either side
  std::array<std::vector<std::uint16_t>, 3> rows;
  for (auto& row : rows) row.resize(size);
  const auto read = [&](int y) {
    auto& row = rows[static_cast<std::size_t>(y) % 3];
    look_up_row(&level.at(x0 - 1, y), size, dark, row.data());
    return row.data();
  };
  const std::uint16_t* above = read(y0 - 1);
  const std::uint16_t* here = read(y0);
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* below = read(y + 1);
    const auto add = [&](std::size_t x) {
      const double edge = step_at(above, here, below, x) / kBlack;
      if (edge < floor) return;
      h.weight[static_cast<std::size_t>(bin_of(here[x] / kBlack))] += edge;
      h.total += edge;
    };
    std::size_t x = 1;
    for (; x + kBlock < size; x += kBlock) {
      if (!any_step(above, here, below, x, least)) continue;
      for (std::size_t k = x; k < x + kBlock; ++k) add(k);
    }
    for (; x + 1 < size; ++x) add(x);
    above = here;
    here = below;
  }
  return h;
}

struct Regions {
  std::array<double, kRegionCount> depth{};  ///< threshold as darkness
  std::array<bool, kRegionCount> empty{};
};

/// Empty regions take the mean of the others, nearer ones counting more.
void fill_empty(Regions& regions, double otherwise) {
  const Regions known = regions;
  for (int i = 0; i < kRegionCount; ++i) {
    if (!known.empty[static_cast<std::size_t>(i)]) continue;
    double weight = 0;
    double sum = 0;
    for (int j = 0; j < kRegionCount; ++j) {
      if (known.empty[static_cast<std::size_t>(j)]) continue;
      const double dx = i % kRegions - j % kRegions;
      const int rows = i / kRegions - j / kRegions;
      const double dy = rows;
      const double w = 1 / std::pow(dx * dx + dy * dy, 1.5);
      weight += w;
      sum += w * known.depth[static_cast<std::size_t>(j)];
    }
    regions.depth[static_cast<std::size_t>(i)] = weight > 0 ? sum / weight : otherwise;
  }
}

Regions automatic_regions(const Gray& level, const DarknessTable& dark, double faintest) {
  Regions regions;
  std::array<Otsu, kRegionCount> found;
  std::array<double, kRegionCount> separation{};
  numeric::parallel_for(kRegionCount, 0, [&](std::size_t k) {
    const Box box = region_box(level, static_cast<int>(k));
    const Histogram h = edge_histogram(level, dark, box, 1.2 * faintest);
    found[k] = otsu(h);
    // ten pixels' worth of edge are no ink yet
    regions.empty[k] = found[k].separation < 1.5 * faintest || h.total < 20 * found[k].separation ||
                       found[k].threshold < faintest;
    if (!regions.empty[k]) separation[k] = found[k].separation;
  });
  const double usual = *std::max_element(separation.begin(), separation.end());
  for (std::size_t k = 0; k < kRegionCount; ++k) {
    if (found[k].separation < kBlotShare * usual) regions.empty[k] = true;
    regions.depth[k] = found[k].threshold;
  }
  fill_empty(regions, std::numeric_limits<double>::infinity());
  return regions;
}

/// Thresholds of a row of pixels, blended bilinearly between the centres of the regions.
class Blend {
 public:
  Blend(const Regions& regions, int width, int height)
      : regions_(regions), width_(width), height_(height) {}

  void set_row(int y) {
    const double v = std::clamp((y + 0.5) * kRegions / height_ - 0.5, 0.0, kRegions - 1.0);
    const int r0 = static_cast<int>(v);
    const int r1 = std::min(r0 + 1, kRegions - 1);
    for (int c = 0; c < kRegions; ++c)
      row_[static_cast<std::size_t>(c)] = mix(at(r0, c), at(r1, c), v - r0);
  }
  double operator()(int x) const {
    const double u = std::clamp((x + 0.5) * kRegions / width_ - 0.5, 0.0, kRegions - 1.0);
    const auto c0 = static_cast<std::size_t>(u);
    const std::size_t c1 = std::min<std::size_t>(c0 + 1, kRegions - 1);
    return mix(row_[c0], row_[c1], u - static_cast<double>(c0));
  }

 private:
  static double mix(double a, double b, double u) { return u <= 0 ? a : (1 - u) * a + u * b; }
  double at(int r, int c) const {
    return regions_.depth[static_cast<std::size_t>(r) * kRegions + static_cast<std::size_t>(c)];
  }
  const Regions& regions_;
  int width_;
  int height_;
  std::array<double, kRegions> row_{};
};

constexpr std::uint8_t kPaper = 0;
constexpr std::uint8_t kWeak = 2;
constexpr std::uint8_t kStrong = 1;

/// What is marked beside what passes the threshold.
struct Marked {
  std::vector<std::size_t> weak;  ///< may hang on to it
  /// May be a border, or go on at the second pixel: a pale line's beside a darker one.
  std::vector<std::pair<std::size_t, std::size_t>> beside;
};

/// Marks what passes the threshold (kStrong) and what may hang on to it (kWeak). What else is
/// darker than paper, and no line's border, becomes faint. In grain every border may be one.
Marked mark(const Tone& tone, const DarknessTable& dark, const Regions& regions, double faintest,
            bool grainy, Binarized& result) {
  Binary& marks = result.ink;
  const int least = static_cast<int>(std::floor(faintest * kBlack));
  const double sigma = tone.noise / tone.gain > kNoisy ? kStrongBlur : kBlur;
  std::mutex adding;
  Marked marked;
  for_rows(0, marks.height, [&](int first, int last) {
    DarkRows rows(tone.level, dark, sigma, least);
    rows.read(first, last);
    const LineBorder border(rows.stride());
    Blend threshold(regions, marks.width, marks.height);
    Marked found;
    for (int y = first; y < last; ++y) {
      threshold.set_row(y);
      const std::uint16_t* row = rows.row(y);
      rows.visit(y, [&](int x) {
        if (row[x] < least) return;
        const double here = row[x] / kBlack;
        if (here < faintest) return;
        const double strong = std::max(threshold(x), faintest);
        const bool fades = here < std::max(kWeakShare * strong, faintest);
        if (border.has_darker(row + x)) {
          if (fades || grainy) return;
          border.visit_beyond(row + x, [&](int across, int down) {
            if (marks.contains(x + across, y + down))
              found.beside.emplace_back(marks.index(x, y), marks.index(x + across, y + down));
          });
          return;
        }
        if (fades) {
          result.faint.set(x, y);
          return;
        }
        marks.at(x, y) = here >= strong ? kStrong : kWeak;
        if (here < strong) found.weak.push_back(marks.index(x, y));
      });
    }
    const std::scoped_lock lock(adding);  // their order does not matter
    marked.weak.insert(marked.weak.end(), found.weak.begin(), found.weak.end());
    marked.beside.insert(marked.beside.end(), found.beside.begin(), found.beside.end());
  });
  return marked;
}

/// What goes on at what is marked is no border: it may hang on to ink, too.
void mark_beside(Marked& marked, Binary& marks) {
  std::erase_if(marked.beside, [&](const auto& b) { return marks.data[b.second] == kPaper; });
  for (const auto& [pixel, beyond] : marked.beside) {
    if (marks.data[pixel] != kPaper) continue;
    marks.data[pixel] = kWeak;
    marked.weak.push_back(pixel);
  }
}

/// Weak pixels connected to strong ones become ink, the others faint.
void keep_connected(const std::vector<std::size_t>& weak, Binarized& result) {
  Binary& marks = result.ink;
  std::vector<std::size_t> stack;
  const auto w = static_cast<std::size_t>(marks.width);
  // calls see(j) for the pixels around i that are marked so, until one says stop
  const auto any_around = [&](std::size_t i, std::uint8_t value, const auto& see) {
    const int x = static_cast<int>(i % w);
    const int y = static_cast<int>(i / w);
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u)
        if (marks.contains(u, v) && marks.at(u, v) == value && see(marks.index(u, v))) return true;
    return false;
  };
  const auto keep = [&](std::size_t i) {
    marks.data[i] = kStrong;
    stack.push_back(i);
    return false;
  };
  for (const std::size_t i : weak) {
    if (marks.data[i] != kWeak || !any_around(i, kStrong, [](std::size_t) { return true; }))
      continue;
    keep(i);
    while (!stack.empty()) {
      const std::size_t j = stack.back();
      stack.pop_back();
      any_around(j, kWeak, keep);
    }
  }
  for (const std::size_t i : weak) {
    if (marks.data[i] != kWeak) continue;
    marks.data[i] = kPaper;
    result.faint.set(static_cast<int>(i % w), static_cast<int>(i / w));
  }
}

/// Given thresholds over the automatic ones; levels y of the log picture outside, darkness inside.
void apply_given(const BinarizeOptions& options, double gain, Binarized& result, Regions& regions) {
  for (std::size_t i = 0; i < kRegionCount; ++i) {
    if (i < options.regions.size() && options.regions[i])
      regions.depth[i] = darkness_of(*options.regions[i], gain);
    result.thresholds[i] =
        std::isfinite(regions.depth[i])
            ? std::clamp(1 + gain * std::log(std::max(1 - regions.depth[i], 1e-9)), 0.0, 1.0)
            : 0;
    result.empty[i] = regions.empty[i];
  }
}

void plain_threshold(const Gray& level, double threshold, Binary& ink) {
  const double limit = threshold * Tone::kWhite;
  for (std::size_t i = 0; i < level.data.size(); ++i) ink.data[i] = level.data[i] < limit ? 1 : 0;
}

}  // namespace

Binarized binarize(const Tone& tone, const BinarizeOptions& options, bool grainy) {
  Binarized result;
  result.ink = Binary(tone.level.width, tone.level.height);
  if (options.threshold) {
    result.thresholds.fill(*options.threshold);
    plain_threshold(tone.level, *options.threshold, result.ink);
    return result;
  }
  const DarknessTable dark(tone);
  const double noise = tone.noise / tone.gain;
  const double faintest = std::max(kFaintest, kNoiseFactor * noise);
  Regions regions = automatic_regions(tone.level, dark, faintest);
  apply_given(options, tone.gain, result, regions);
  result.faint = FaintPixels(result.ink.width, result.ink.height);
  Marked marked = mark(tone, dark, regions, faintest, grainy, result);
  mark_beside(marked, result.ink);
  keep_connected(marked.weak, result);
  return result;
}

}  // namespace keyline::sketch
