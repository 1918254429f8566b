#include "keyline/exchange/pdf/pdf_document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "keyline/core/utf8.h"
#include "keyline/curve/bounding_box.h"
#include "keyline/document/color.h"
#include "keyline/exchange/svg/drawing_layers.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using core::Result;
using curve::Box2;

constexpr double kLargestPage = 14400;  // pt
constexpr double kPointsPerMillimetre = 72 / 25.4;

std::optional<Box2> box_of(const std::vector<SvgLayer>& layers) {
  std::optional<Box2> all;
  for (const SvgLayer& layer : layers)
    for (const SvgPath& path : layer.paths)
      for (const curve::Bezier2& piece : path.pieces) {
        const Box2 box = curve::bounding_box(piece);
        all = all ? curve::united(*all, box) : box;
      }
  return all;
}

/// PDF knows no exponents.
std::string decimal(double value, int decimals) {
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  std::string number(text.data(), end);
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

/// A text string in UTF-16.
std::string text_string(const std::string& name) {
  std::string text = "<FEFF";
  for (std::size_t at = 0; at < name.size();)
    text += detail::utf16_digits(core::code_point(name, at));
  return text + ">";
}

/// The page in points and how the drawing gets onto it.
struct Page {
  double width = 0;
  double height = 0;
  double scale = 1;   ///< points per unit of the drawing
  double stroke = 1;  ///< line width in the drawing's unit where none is given
  Point2 corner;      ///< of the page, in the drawing
  int decimals = 12;  ///< of coordinates
  int reduction = 0;  ///< power of ten
};

Result<Page> page_of(const document::Document& document, const std::vector<SvgLayer>& layers) {
  const auto drawn = document.page ? document.page : box_of(layers);
  const double unit = document.unit.empty() ? 1 : document::millimetres(document.unit);
  const double size = drawn ? std::max(curve::width(*drawn), curve::height(*drawn)) : 0;
  const double across = drawn ? size + std::max(std::hypot(drawn->low.x, drawn->low.y),
                                                std::hypot(drawn->high.x, drawn->high.y))
                              : 0;
  if (!(size > 0 && unit > 0 && across < 1e15 && size > 1e-12 * across))
    return core::fail(core::ErrorCode::bad_input, "the drawing has no size a page can have",
                      "give curves between 1e-12 and 1e15 of the unit");
  Page page;
  const SvgWriteOptions look;
  const double margin = document.page ? 0 : look.margin * size;
  page.scale = unit * kPointsPerMillimetre;
  for (; (size + 2 * margin) * page.scale > kLargestPage; page.scale /= 10) ++page.reduction;
  // Whole points: some programs shrink other pages to make them so.
  page.width = std::ceil((curve::width(*drawn) + 2 * margin) * page.scale);
  page.height = std::ceil((curve::height(*drawn) + 2 * margin) * page.scale);
  page.stroke = size / 400;
  const Point2 shown{page.width / page.scale, page.height / page.scale};
  page.corner = {(drawn->low.x + drawn->high.x - shown.x) / 2,
                 (drawn->low.y + drawn->high.y - shown.y) / 2};
  page.decimals = std::clamp(12 - static_cast<int>(std::ceil(std::log10(size))), 0, 300);
  return page;
}

class Content {
 public:
  explicit Content(const Page& page) : page_(page) {
    text_ =
        "q 1 J 1 j " + decimal(page.scale, 15) + " 0 0 " + decimal(page.scale, 15) + " 0 0 cm\n";
  }

  void add(const SvgLayer& layer, std::size_t index) {
    text_ += "/OC /L" + std::to_string(index) + " BDC\n";
    for (const SvgPath& path : layer.paths) add(path, layer);
    text_ += "EMC\n";
  }

  std::string finished() && { return std::move(text_) + "Q\n"; }

 private:
  void add(const SvgPath& path, const SvgLayer& layer) {
    const int rgb = document::color_value(path.color.empty() ? layer.color : path.color);
    for (const int shift : {16, 8, 0}) text_ += decimal((rgb >> shift & 255) / 255.0, 4) + " ";
    const double width = path.width > 0 ? path.width : layer.width * page_.stroke;
    text_ += "RG " + decimal(width, page_.decimals) + " w\n";
    const curve::Bezier2* last = nullptr;
    for (const curve::Bezier2& piece : path.pieces) {
      if (!last || last->control.back() != piece.control.front())
        point(piece.control.front(), "m\n");
      segment(piece.control);
      last = &piece;
    }
    text_ += path.closed ? "s\n" : "S\n";
  }

  void segment(const std::vector<Point2>& c) {
    if (c.size() == 2) return point(c[1], "l\n");
    if (c.size() == 3) {  // a parabola as a cubic
      point(c[0] + (c[1] - c[0]) * (2.0 / 3), "");
      point(c[2] + (c[1] - c[2]) * (2.0 / 3), "");
      return point(c[2], "c\n");
    }
    point(c[1], "");
    point(c[2], "");
    point(c[3], "c\n");
  }

  void point(Point2 p, const char* verb) {
    text_ += decimal(p.x - page_.corner.x, page_.decimals) + " " +
             decimal(p.y - page_.corner.y, page_.decimals) + " " + verb;
  }

  Page page_;
  std::string text_;
};

/// Objects 1, 2, … and what finds them.
std::string pdf_file(const std::vector<std::string>& objects) {
  std::string file = "%PDF-1.5\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    places.push_back(file.size());
    file += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::size_t table = file.size();
  const std::string count = std::to_string(objects.size() + 1);
  file += "xref\n0 " + count + "\n0000000000 65535 f \n";
  for (const std::size_t place : places) {
    const std::string digits = std::to_string(place);
    file +=
        std::string(10 - std::min<std::size_t>(10, digits.size()), '0') + digits + " 00000 n \n";
  }
  return file + "trailer\n<< /Size " + count + " /Root 1 0 R >>\nstartxref\n" +
         std::to_string(table) + "\n%%EOF\n";
}

std::string assembled(const std::vector<SvgLayer>& layers, const Page& page,
                      const std::string& content) {
  constexpr std::size_t kFirstLayer = 5;
  std::string groups;
  std::string properties;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string reference = std::to_string(kFirstLayer + i) + " 0 R";
    groups += (i > 0 ? " " : "") + reference;
    properties += "/L" + std::to_string(i) + " " + reference + " ";
  }
  std::vector<std::string> objects = {
      "<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [" + groups + "] /D << /Order [" +
          groups + "] >> >> >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + decimal(page.width, 6) + " " +
          decimal(page.height, 6) + "] /Contents 4 0 R /Resources << /Properties << " + properties +
          ">> >> >>",
      "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream"};
  for (const SvgLayer& layer : layers)
    objects.push_back("<< /Type /OCG /Name " + text_string(layer.name) + " >>");
  return pdf_file(objects);
}

}  // namespace

Result<Written> write_pdf_document(const document::Document& document, double tolerance) {
  Written written;
  const std::vector<SvgLayer> layers = drawing_layers(document, tolerance, written);
  const auto page = page_of(document, layers);
  if (!page) return std::unexpected(page.error());
  if (page->reduction > 0)
    written.notes.push_back("the page is at scale 1:1" +
                            std::string(static_cast<std::size_t>(page->reduction), '0') +
                            ": a PDF page is at most 5.08 m long");
  Content content(*page);
  for (std::size_t i = 0; i < layers.size(); ++i) content.add(layers[i], i);
  written.content = assembled(layers, *page, std::move(content).finished());
  return written;
}

}  // namespace keyline::exchange
