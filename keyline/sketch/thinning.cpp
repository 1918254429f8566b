#include "keyline/sketch/thinning.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace keyline::sketch {
namespace {

/// A copy with a rim of paper, so that neighbours need no check.
struct Padded {
  int stride = 0;
  std::vector<std::uint8_t> data;

  explicit Padded(const Binary& binary)
      : stride(binary.width + 2),
        data(static_cast<std::size_t>(stride) * static_cast<std::size_t>(binary.height + 2)) {
    for (int y = 0; y < binary.height; ++y) {
      const std::uint8_t* row = &binary.at(0, y);
      std::transform(row, row + binary.width, &data[begin_of(y)],
                     [](std::uint8_t v) -> std::uint8_t { return v ? 1 : 0; });
    }
  }

  /// Of row y of the picture.
  std::size_t begin_of(int y) const {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(stride) + 1;
  }

  /// The next place from i on that is not paper; the end where there is none.
  std::size_t next(std::size_t i) const {
    std::uint64_t word = 0;
    for (; i + sizeof word <= data.size(); i += sizeof word) {
      std::memcpy(&word, &data[i], sizeof word);
      if (word != 0) break;
    }
    while (i < data.size() && data[i] == 0) ++i;
    return i;
  }

  std::array<std::size_t, 8> around(std::size_t i) const {
    const auto s = static_cast<std::size_t>(stride);
    return {i - s, i - s + 1, i + 1, i + s + 1, i + s, i + s - 1, i - 1, i - s - 1};
  }
  unsigned neighbours(std::size_t i) const {
    unsigned bits = 0;
    const auto a = around(i);
    for (unsigned k = 0; k < 8; ++k) bits |= static_cast<unsigned>(data[a[k]] & 1U) << k;
    return bits;
  }
};

constexpr std::uint8_t kInk = 1;
constexpr std::array<std::uint8_t, 2> kQueued = {2, 4};

/// Guo & Hall's condition for either half of a pass.
bool may_go(unsigned n, int half) {
  const auto p = [n](int k) { return static_cast<int>((n >> k) & 1U); };
  const int crossings = ((p(0) == 0) & (p(1) | p(2))) + ((p(2) == 0) & (p(3) | p(4))) +
                        ((p(4) == 0) & (p(5) | p(6))) + ((p(6) == 0) & (p(7) | p(0)));
  if (crossings != 1) return false;
  const int n1 = (p(7) | p(0)) + (p(1) | p(2)) + (p(3) | p(4)) + (p(5) | p(6));
  const int n2 = (p(0) | p(1)) + (p(2) | p(3)) + (p(4) | p(5)) + (p(6) | p(7));
  const int least = n1 < n2 ? n1 : n2;
  if (least < 2 || least > 3) return false;
  const int side =
      half == 0 ? ((p(4) | p(5) | (p(7) == 0)) & p(6)) : ((p(0) | p(1) | (p(3) == 0)) & p(2));
  return side == 0;
}

struct Tables {
  std::array<std::array<bool, 256>, 2> go{};
  std::array<bool, 256> simple{};
  Tables() {
    for (unsigned n = 0; n < 256; ++n) {
      go[0][n] = may_go(n, 0);
      go[1][n] = may_go(n, 1);
      simple[n] = is_simple(n);
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

/// One half pass over the queued pixels; whoever is near a pixel that went is queued for the next
/// two halves. Returns how many went.
std::size_t half_pass(Padded& image, std::array<std::vector<std::size_t>, 2>& queues, int half) {
  const auto& go = tables().go[static_cast<std::size_t>(half)];
  std::vector<std::size_t> current;
  current.swap(queues[static_cast<std::size_t>(half)]);
  std::vector<std::size_t> gone;
  for (const std::size_t i : current) {
    image.data[i] =
        static_cast<std::uint8_t>(image.data[i] & ~kQueued[static_cast<std::size_t>(half)]);
    if ((image.data[i] & kInk) && go[image.neighbours(i)]) gone.push_back(i);
  }
  for (const std::size_t i : gone) image.data[i] = 0;
  for (const std::size_t i : gone)
    for (const std::size_t j : image.around(i)) {
      if (!(image.data[j] & kInk)) continue;
      for (std::size_t q = 0; q < 2; ++q)
        if (!(image.data[j] & kQueued[q])) {
          image.data[j] |= kQueued[q];
          queues[q].push_back(j);
        }
    }
  return gone.size();
}

/// Takes out, one after the other, corners of staircases: pixels with ink beside and ink above or
/// below that are not needed for connections.
void clean_staircases(Padded& image) {
  constexpr unsigned kUpDown = 0b00010001;
  constexpr unsigned kBeside = 0b01000100;
  for (std::size_t i = image.next(0); i < image.data.size(); i = image.next(i + 1)) {
    const unsigned n = image.neighbours(i);
    if ((n & kUpDown) && (n & kBeside) && tables().simple[n]) image.data[i] = 0;
  }
}

}  // namespace

unsigned neighbours_of(const Binary& binary, int x, int y) {
  static constexpr std::array<int, 8> kX = {0, 1, 1, 1, 0, -1, -1, -1};
  static constexpr std::array<int, 8> kY = {-1, -1, 0, 1, 1, 1, 0, -1};
  unsigned bits = 0;
  if (x > 0 && y > 0 && x + 1 < binary.width && y + 1 < binary.height) {
    const std::uint8_t* here = &binary.data[binary.index(x, y)];
    for (unsigned k = 0; k < 8; ++k)
      bits |= (here[kY[k] * static_cast<std::ptrdiff_t>(binary.width) + kX[k]] ? 1U : 0U) << k;
    return bits;
  }
  for (unsigned k = 0; k < 8; ++k)
    if (binary.contains(x + kX[k], y + kY[k]) && binary.at(x + kX[k], y + kY[k])) bits |= 1U << k;
  return bits;
}

bool is_simple(unsigned n) {
  // Yokoi's number of 8-connected ink around the pixel, 1 where it is a simple border pixel
  const auto paper = [n](unsigned k) { return ((n >> (k % 8)) & 1U) == 0 ? 1 : 0; };
  int number = 0;
  for (unsigned k = 0; k < 8; k += 2) number += paper(k) - paper(k) * paper(k + 1) * paper(k + 2);
  return number == 1;
}

Binary thin(const Binary& ink) {
  Padded image(ink);
  std::array<std::vector<std::size_t>, 2> queues;
  for (std::size_t i = image.next(0); i < image.data.size(); i = image.next(i + 1))
    if (image.neighbours(i) != 255)
      for (std::size_t q = 0; q < 2; ++q) {
        image.data[i] |= kQueued[q];
        queues[q].push_back(i);
      }
  int quiet = 0;
  for (int half = 0; quiet < 2; half = 1 - half)
    quiet = half_pass(image, queues, half) == 0 ? quiet + 1 : 0;
  clean_staircases(image);
  Binary lines(ink.width, ink.height);
  for (int y = 0; y < ink.height; ++y) {
    const std::uint8_t* row = &image.data[image.begin_of(y)];
    std::transform(row, row + ink.width, &lines.at(0, y),
                   [](std::uint8_t v) -> std::uint8_t { return v & kInk; });
  }
  return lines;
}

}  // namespace keyline::sketch
