#include "keyline/sketch/light_lines.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "keyline/sketch/ink_measure.h"

namespace keyline::sketch {
namespace {

constexpr int kLeastOpaque = 65535 / 16;  ///< what is less so is not looked at
constexpr double kOnNothing = 0.75;       ///< of a light line's border: midway from rim to line

/// Pixels of one light piece and what surrounds it.
struct Piece {
  std::vector<std::uint32_t> pixels;  ///< 64 megapixels are the most
  double opaque = 0;                  ///< pixels, by how opaque they are
  double nothing = 0;                 ///< sides of pixels that have nothing beyond them
  double ink = 0;                     ///< sides of pixels that have something dark beyond them

  bool is_line(const Image& image) const {
    return nothing > kOnNothing * (nothing + ink) &&
           !is_broad(2 * opaque / nothing, image.width(), image.height());
  }
};

/// What is drawn in a picture over both grounds, piece by piece.
class Drawn {
 public:
  explicit Drawn(const Image& image) : image_(image), seen_(image.width(), image.height()) {}

  /// What a ground of white lacks beyond what one of black has, 0 … 65535.
  int opaque(std::size_t i) const {
    return std::clamp(65535 - image_.luminance.data[i] + image_.over_black.data[i], 0, 65535);
  }
  bool is_light(std::size_t i) const {
    return opaque(i) >= kLeastOpaque && 2 * image_.over_black.data[i] >= opaque(i);
  }
  bool is_new(std::size_t i) const { return seen_.data[i] == 0; }
  bool is_paper(std::size_t i) const { return seen_.data[i] == kPaper; }
  void call_paper(const Piece& piece) {
    for (const std::size_t i : piece.pixels) seen_.data[i] = kPaper;
  }

  /// The light piece that a pixel belongs to.
  Piece piece_at(std::size_t first) {
    Piece piece;
    visit(first, piece);
    for (std::size_t k = 0; k < piece.pixels.size(); ++k) look_around(piece.pixels[k], piece);
    return piece;
  }

 private:
  void visit(std::size_t i, Piece& piece) {
    seen_.data[i] = kSeen;
    piece.pixels.push_back(static_cast<std::uint32_t>(i));
    piece.opaque += opaque(i) / 65535.0;
  }

  void look_around(std::size_t i, Piece& piece) {
    const auto width = static_cast<std::size_t>(image_.width());
    const int x = static_cast<int>(i % width);
    const int y = static_cast<int>(i / width);
    static constexpr std::array<std::array<int, 2>, 4> kSides = {
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& [dx, dy] : kSides) {
      if (!seen_.contains(x + dx, y + dy)) {
        ++piece.nothing;
        continue;
      }
      const std::size_t beside = seen_.index(x + dx, y + dy);
      if (!is_light(beside))
        ++(opaque(beside) < kLeastOpaque ? piece.nothing : piece.ink);
      else if (is_new(beside))
        visit(beside, piece);
    }
  }

  static constexpr std::uint8_t kSeen = 1;
  static constexpr std::uint8_t kPaper = 2;
  const Image& image_;
  Raster<std::uint8_t> seen_;
};

}  // namespace

LightShare darken_light_lines(Image& image, Polarity wanted) {
  if (image.over_black.data.empty()) return {};
  if (wanted != Polarity::automatic) {
    image.on_black = wanted == Polarity::light_on_dark;
    if (image.on_black) image.luminance = std::move(image.over_black);
    image.over_black = {};
    return {};
  }
  Drawn drawn(image);
  LightShare light;
  double all = 0;
  for (std::size_t i = 0; i < image.luminance.data.size(); ++i) {
    all += drawn.opaque(i) / 65535.0;
    if (!drawn.is_new(i) || !drawn.is_light(i)) continue;
    const Piece piece = drawn.piece_at(i);
    const bool line = piece.is_line(image);
    (line ? light.lines : light.rest) += piece.opaque;
    if (!line) drawn.call_paper(piece);
  }
  if (light.lines > 0)
    for (std::size_t i = 0; i < image.luminance.data.size(); ++i)
      if (!drawn.is_paper(i))
        image.luminance.data[i] = static_cast<std::uint16_t>(65535 - drawn.opaque(i));
  image.over_black = {};
  return {light.lines / all, light.rest / all};
}

}  // namespace keyline::sketch
