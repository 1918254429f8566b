#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/curve/bezier.h"

namespace keyline::exchange {

/// One run of a path between two "moveto"s; end to end.
struct SvgSubpath {
  std::vector<curve::Bezier2> pieces = {};
  bool closed = false;
};

/// What a path's data say, and how far they could be read.
struct SvgPathData {
  std::vector<SvgSubpath> subpaths = {};
  std::string error = {};    ///< empty: everything was read
  std::size_t error_at = 0;  ///< byte at which reading stopped
};

/// Reads the `d` of an SVG path (SVG 1.1, chapter 8): every command, absolute and relative, with
/// repeated arguments, numbers without separators and arc flags run together.
///
/// - Lines become degree 1, quadratics 2, cubics 3; elliptical arcs become rational quadratics of
///   at most a quarter turn each: exact, no approximation. Coordinates stay as they are (y down).
/// - Data with an error are read up to it, as browsers draw them.
/// - Pieces without any extent are left out, and subpaths without pieces, too. Closing adds a line
///   only where the gap is larger than 1e-9 of the coordinates.
SvgPathData parse_svg_path(std::string_view d);

namespace detail {

/// The arc of SVG's A command as rational quadratics; a line where a radius is 0; nothing where the
/// ends agree. Radii too small for the ends are enlarged (SVG 1.1, F.6.6).
std::vector<curve::Bezier2> svg_arc(core::Point2 from, core::Point2 to, double rx, double ry,
                                    double x_axis_degrees, bool large, bool sweep);

/// Reads numbers as SVG writes them, independent of the locale.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : text_(text) {}

  void skip_space();
  /// White space with at most one comma.
  void skip_separator();
  bool at_end() const { return position_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[position_]; }
  char take() { return text_[position_++]; }
  std::size_t position() const { return position_; }
  std::string_view rest() const { return text_.substr(position_); }
  /// False, and nothing is consumed, where no finite number stands.
  bool number(double& value);
  /// A single 0 or 1.
  bool flag(bool& value);
  /// True where a number could start.
  bool number_ahead() const;

 private:
  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace detail

}  // namespace keyline::exchange
