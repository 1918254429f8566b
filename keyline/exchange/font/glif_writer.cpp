#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/markup.h"
#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/font/glif.h"
#include "keyline/exchange/font/glyph_cubics.h"
#include "keyline/exchange/points/points_writer.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using curve::Bezier2;

constexpr double kSmooth = 1e-3;   // rad: handles that far from a line still meet smoothly
constexpr double kRounded = 0.05;  // rad: the same on the grid

struct Contour {
  std::vector<Bezier2> pieces;
  bool closed = false;
};

Point2 on_grid(Point2 p) { return {std::round(p.x), std::round(p.y)}; }

/// Handles on the exact horizontal or vertical of their node where they are there but for rounding.
void straighten(Bezier2& piece) {
  const auto align = [](Point2 node, Point2& handle) {
    const double reach = 1e-6 * distance(node, handle);
    if (std::abs(handle.x - node.x) <= reach) handle.x = node.x;
    if (std::abs(handle.y - node.y) <= reach) handle.y = node.y;
  };
  if (piece.control.size() != 4) return;
  align(piece.control[0], piece.control[1]);
  align(piece.control[3], piece.control[2]);
}

Contour contour_of(const document::Path& path, const GlifOptions& options, double& deviation) {
  Contour contour;
  for (const document::PlanarCurve& c : path.curves) {
    auto cubics = detail::glyph_cubics(c, options.tolerance);
    deviation = std::max(deviation, cubics.deviation);
    for (Bezier2& piece : cubics.pieces) {
      straighten(piece);
      if (options.grid) {
        for (Point2& p : piece.control) p = on_grid(p);
        deviation = std::max(deviation, detail::measured_deviation(piece, c));
      }
      if (piece.control.front() != piece.control.back() || piece.control.size() > 2)
        contour.pieces.push_back(std::move(piece));
    }
  }
  for (std::size_t i = 1; i < contour.pieces.size(); ++i)
    contour.pieces[i].control.front() = contour.pieces[i - 1].control.back();
  const bool chain = path.curves.size() == 1 &&
                     std::holds_alternative<lac::Chain>(path.curves[0].value) &&
                     std::get<lac::Chain>(path.curves[0].value).closed;
  contour.closed = (path.closed || chain) && contour.pieces.size() > 1;
  return contour;
}

std::string number(double value) { return shortest(value + 0.0); }

std::string point(Point2 p, const char* type, bool smooth) {
  std::string text = "      <point x=\"" + number(p.x) + "\" y=\"" + number(p.y) + "\"";
  if (*type != '\0') text += std::string(" type=\"") + type + "\"";
  if (smooth) text += " smooth=\"yes\"";
  return text + "/>\n";
}

bool is_smooth(const Bezier2& before, const Bezier2& after, bool grid) {
  const auto in = before.control.back() - before.control[before.control.size() - 2];
  const auto out = after.control[1] - after.control.front();
  return norm(in) > 0 && norm(out) > 0 &&
         std::abs(core::angle_between(in, out)) < (grid ? kRounded : kSmooth);
}

std::string contour_text(const Contour& contour, bool grid) {
  std::string text = "    <contour>\n";
  const auto& pieces = contour.pieces;
  if (!contour.closed) text += point(pieces.front().control.front(), "move", false);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& c = pieces[i].control;
    const bool last = i + 1 == pieces.size();
    const bool smooth =
        (!last || contour.closed) && is_smooth(pieces[i], pieces[last ? 0 : i + 1], grid);
    for (std::size_t k = 1; k + 1 < c.size(); ++k) text += point(c[k], "", false);
    const Point2 end = last && contour.closed ? pieces.front().control.front() : c.back();
    text += point(end, c.size() == 2 ? "line" : "curve", smooth);
  }
  return text + "    </contour>\n";
}

/// The largest jump of curvature at a smooth node, and the curvature it happens at.
struct Jump {
  double size = 0;
  double of = 0;
};

void take_jumps(Jump& jump, const Contour& contour, bool grid) {
  const auto& pieces = contour.pieces;
  for (std::size_t i = contour.closed ? 0 : 1; i < pieces.size(); ++i) {
    const Bezier2& before = pieces[i == 0 ? pieces.size() - 1 : i - 1];
    if (!is_smooth(before, pieces[i], grid)) continue;
    const double a = curvature(jet(before, 1));
    const double b = curvature(jet(pieces[i], 0));
    if (std::abs(a - b) > jump.size) jump = {std::abs(a - b), std::max(std::abs(a), std::abs(b))};
  }
}

/// Code point of a name that is one character, as hexadecimal digits; else empty.
std::string code_of(const std::string& name) {
  if (name.empty() || !core::is_utf8(name)) return {};
  std::size_t length = 0;
  const unsigned code = core::code_point(name, length);
  if (name.size() != length) return {};
  std::string digits;
  for (int shift = 20; shift >= 0; shift -= 4)
    if (shift < 16 || (code >> shift) != 0) digits += "0123456789ABCDEF"[(code >> shift) & 15];
  return digits;
}

}  // namespace

core::Result<Written> write_glif(const document::Document& document, const GlifOptions& options) {
  if (document.paths.empty())
    return core::fail(core::ErrorCode::bad_input, "a glyph needs a planar curve",
                      "give a document with one");
  Written written;
  const document::Label& label = document.paths.front().label;
  std::string name = label.layer.empty() ? label.name : label.layer;
  if (name.empty()) name = "glyph";
  const std::string safe = core::escape_markup(name);
  std::string& text = written.content;
  text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<glyph name=\"" + safe + "\" format=\"2\">\n";
  double right = 0;
  std::string outline;
  Jump jump;
  for (const auto& named : document.paths) {
    const Contour contour = contour_of(named.path, options, written.deviation);
    if (contour.pieces.empty()) continue;
    for (const Bezier2& piece : contour.pieces) right = std::max(right, piece.control.back().x);
    outline += contour_text(contour, options.grid);
    take_jumps(jump, contour, options.grid);
  }
  text += "  <advance width=\"" + number(std::ceil(right)) + "\"/>\n";
  if (const std::string code = code_of(name); !code.empty())
    text += "  <unicode hex=\"" + code + "\"/>\n";
  text += "  <outline>\n" + outline + "  </outline>\n</glyph>\n";
  if (std::isfinite(jump.size) && jump.size > 1e-9 * jump.of)
    written.notes.push_back("curvature jumps by at most " + core::number_text(jump.size, 3) +
                            " (of " + core::number_text(jump.of, 3) + ") at smooth nodes");
  const std::size_t left_out = document.space_curves.size() + document.surfaces.size();
  if (left_out > 0)
    written.notes.push_back(core::counted(left_out, "thing in space is", "things in space are") +
                            " not in the glyph");
  return written;
}

}  // namespace keyline::exchange
