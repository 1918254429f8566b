#pragma once

#include <optional>
#include <string_view>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bounding_box.h"

namespace keyline::exchange::detail {

/// (x, y) -> (a x + c y + e, b x + d y + f), in the order SVG's matrix() lists them.
struct Affine {
  double a = 1;
  double b = 0;
  double c = 0;
  double d = 1;
  double e = 0;
  double f = 0;
  friend bool operator==(const Affine&, const Affine&) = default;
};

core::Point2 apply(const Affine& m, core::Point2 p);
/// First `inner`, then `outer`.
Affine combined(const Affine& outer, const Affine& inner);
/// False for a map onto a line or a point, and for one that is not finite.
bool is_invertible(const Affine& m);
/// Exact for rational curves, too: affine maps keep the weights.
curve::Bezier2 transformed(const curve::Bezier2& piece, const Affine& m);

/// The `transform` attribute: any list of matrix, translate, scale, rotate, skewX, skewY. Empty
/// where the text is no such list.
std::optional<Affine> parse_svg_transform(std::string_view text);

/// What the `viewBox` attribute says; empty where it is no box of positive size.
struct SvgViewBox {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};
std::optional<SvgViewBox> parse_svg_view_box(std::string_view text);

/// Around that box, mapped.
curve::Box2 box_of(const SvgViewBox& box, const Affine& map);

/// The affine map that fits a viewBox into a box of this size at the origin, as the attribute
/// preserveAspectRatio says ("" is "xMidYMid meet").
Affine fit_view_box(const SvgViewBox& box, double width, double height, std::string_view aspect);

/// A length with its unit: mm for the physical units, px for the rest; an em counts 16 px. Empty
/// where the text is no length, or one in percent.
struct SvgLength {
  double value = 0;
  bool physical = false;  ///< mm, cm, in, pt, pc or Q were given
};
inline constexpr double kMillimetresPerPx = 25.4 / 96;
inline double in_px(SvgLength l) { return l.physical ? l.value / kMillimetresPerPx : l.value; }
inline double in_mm(SvgLength l) { return l.physical ? l.value : l.value * kMillimetresPerPx; }
std::optional<SvgLength> parse_svg_length(std::string_view text);

/// The outermost user space of a file.
struct SvgFrame {
  bool physical = false;           ///< its lengths come out in mm, else in px
  Affine map;                      ///< user units to them, y up
  std::optional<SvgViewBox> page;  ///< what the file shows, in user units; empty: not said
};

/// The frame of a root element of these sizes (positive where given). The page is the viewBox;
/// where both sizes are given and their aspect is another one, what lies beside it too, as
/// preserveAspectRatio says.
SvgFrame outermost_frame(const std::optional<SvgLength>& width,
                         const std::optional<SvgLength>& height,
                         const std::optional<SvgViewBox>& box, std::string_view aspect);

/// The frame where the root element has a transform of its own: that moves the whole page, in px
/// and about its middle, about the origin where the page is not known (CSS Transforms 1,
/// transform-origin).
SvgFrame moved(SvgFrame frame, const Affine& own);

}  // namespace keyline::exchange::detail
