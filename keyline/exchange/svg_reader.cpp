#include "keyline/exchange/svg_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <unordered_map>
#include <utility>

#include "keyline/exchange/svg_shapes.h"
#include "keyline/exchange/svg_transform.h"
#include "keyline/exchange/utf8.h"

namespace keyline::exchange {

namespace {

using core::ErrorCode;
using detail::Affine;
using detail::local_name;

/// The encoding an XML declaration states, in lower case.
std::string declared_encoding(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.find("?>"), 300));
  const std::size_t word = head.find("encoding");
  if (word == std::string_view::npos) return {};
  const std::size_t at = head.find_first_of("\"'", word);
  if (at == std::string_view::npos) return {};
  const std::size_t end = head.find(head[at], at + 1);
  if (end == std::string_view::npos) return {};
  std::string name(head.substr(at + 1, end - at - 1));
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

core::Result<pugi::xml_encoding> encoding_of(std::string_view bytes) {
  if (bytes.substr(0, 2) == "\x1F\x8B")
    return core::fail(ErrorCode::bad_input, "the SVG file is compressed",
                      "uncompress it first (gunzip)");
  if (bytes.find('\0') != std::string_view::npos)
    return core::fail(ErrorCode::unsupported, "the SVG file is not in UTF-8",
                      "save it with the encoding UTF-8");
  if (is_utf8(bytes)) return pugi::encoding_utf8;
  const std::string name = declared_encoding(bytes);
  if (name == "iso-8859-1" || name == "latin1") return pugi::encoding_latin1;
  return core::fail(ErrorCode::unsupported,
                    "the SVG file is not in UTF-8" + (name.empty() ? "" : " but in " + name),
                    "save it with the encoding UTF-8");
}

int line_of(std::string_view bytes, std::ptrdiff_t offset) {
  const auto end = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
  const auto head = bytes.substr(0, end);
  return 1 + static_cast<int>(std::count(head.begin(), head.end(), '\n'));
}

/// Where an element is met: the map to the outermost user space, and its surroundings.
struct Place {
  Affine map;
  std::string layer;
  int depth = 0;
  int use_depth = 0;
};

class SvgReader {
 public:
  SvgReader(std::string_view bytes, const SvgReadLimits& limits) : bytes_(bytes), limits_(limits) {
    for (std::size_t i = bytes.find('\n'); i != bytes.npos; i = bytes.find('\n', i + 1))
      ends_.push_back(i);
  }

  core::Result<SvgContents> read(const pugi::xml_node& root) {
    find_ids(root);
    if (bytes_.find("<!ENTITY") != std::string_view::npos)
      skip(0, "entities of the document type are not expanded");
    Place place;
    place.map = outermost(root);
    read_children(root, place);
    for (const auto& [name, count] : ignored_)
      skip(count.first, name + ": " + std::to_string(count.second) +
                            (count.second == 1 ? " element" : " elements") + " without curves");
    sort_skipped();
    return std::move(contents_);
  }

 private:
  void skip(int line, std::string what) {
    constexpr std::size_t kMost = 1000;
    if (contents_.skipped.size() < kMost) contents_.skipped.push_back({line, std::move(what)});
  }

  /// By line; what stands on one line stays in the order met.
  void sort_skipped() {
    std::map<int, std::vector<SvgSkipped>> by_line;
    for (SvgSkipped& item : contents_.skipped) by_line[item.line].push_back(std::move(item));
    contents_.skipped.clear();
    for (auto& [number, items] : by_line)
      for (SvgSkipped& item : items) contents_.skipped.push_back(std::move(item));
  }

  int line(const pugi::xml_node& node) const {
    const auto end = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    return 1 + static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), end) - ends_.begin());
  }

  /// First element of every id, found without recursion.
  void find_ids(const pugi::xml_node& root) {
    pugi::xml_node node = root;
    while (node) {
      if (const char* id = node.attribute("id").value(); *id) ids_.emplace(id, node);
      if (node.first_child()) {
        node = node.first_child();
        continue;
      }
      while (node && node != root && !node.next_sibling()) node = node.parent();
      node = node && node != root ? node.next_sibling() : pugi::xml_node();
    }
  }

  /// User units to mm or px, y up.
  Affine outermost(const pugi::xml_node& root) {
    auto width = detail::parse_svg_length(root.attribute("width").value());
    auto height = detail::parse_svg_length(root.attribute("height").value());
    for (auto* size : {&width, &height})
      if (*size && !((*size)->value > 0)) {
        skip(line(root), "a size of the page that is not positive is ignored");
        size->reset();
      }
    const bool physical = (width && width->physical) || (height && height->physical);
    contents_.unit = physical ? "mm" : "px";
    const auto in_unit = [physical](detail::SvgLength l) { return physical ? in_mm(l) : in_px(l); };
    double x = physical ? detail::kMillimetresPerPx : 1;
    double y = x;
    if (const auto box = detail::parse_svg_view_box(root.attribute("viewBox").value())) {
      if (width) x = in_unit(*width) / box->width;
      if (height) y = in_unit(*height) / box->height;
      if (!width && height) x = y;
      if (width && !height) y = x;
      const bool none = std::strcmp(root.attribute("preserveAspectRatio").value(), "none") == 0;
      if (!width && !height) x = y = 1;
      if (!none) x = y = std::min(x, y);
    }
    return {x, 0, 0, -y, 0, 0};
  }

  void read_children(const pugi::xml_node& parent, const Place& place) {
    if (place.depth > limits_.depth) {
      skip(line(parent), "elements nested deeper than " + std::to_string(limits_.depth));
      return;
    }
    for (const pugi::xml_node& child : parent.children())
      if (child.type() == pugi::node_element && !full_) read_element(child, place);
  }

  void read_element(const pugi::xml_node& node, const Place& outer) {
    if (++visited_ > limits_.elements) return fill_up(node, "elements");
    const std::string_view name = local_name(node);
    if (name == "metadata") return read_metadata(node);
    const bool shape = detail::is_svg_shape(name);
    const bool group = name == "g" || name == "a" || name == "switch";
    const bool use = name == "use";
    if (!shape && !group && !use && name != "svg") return ignore(node, name);
    Place place = outer;
    ++place.depth;
    if (!add_transform(node, place)) return;
    if (shape) return read_shape(node, place);
    open_.push_back(node);
    if (use) {
      read_use(node, place);
    } else {
      if (const std::string own = name_of(node); !own.empty()) place.layer = own;
      if (name == "svg") place.map = combined(place.map, viewport_of(node, node));
      read_children(node, place);
    }
    open_.pop_back();
  }

  bool add_transform(const pugi::xml_node& node, Place& place) {
    if (const pugi::xml_attribute attribute = node.attribute("transform")) {
      const auto own = detail::parse_svg_transform(attribute.value());
      if (own)
        place.map = combined(place.map, *own);
      else
        skip(line(node), describe(node) + ": a transform that cannot be read is ignored");
    }
    if (is_invertible(place.map)) return true;
    skip(line(node), describe(node) + ": its transform leaves no area");
    return false;
  }

  static std::string name_of(const pugi::xml_node& node) {
    for (const char* attribute : {"inkscape:label", "data-name", "id"})
      if (const char* value = node.attribute(attribute).value(); *value) return value;
    return {};
  }

  static std::string describe(const pugi::xml_node& node) {
    const std::string name = name_of(node);
    return std::string(local_name(node)) + (name.empty() ? "" : " \"" + name + "\"");
  }

  void read_shape(const pugi::xml_node& node, const Place& place) {
    SvgPathData data = detail::svg_shape(node);
    if (!data.error.empty())
      skip(line(node), describe(node) + ": " + data.error +
                           (local_name(node) == "path"
                                ? " (at byte " + std::to_string(data.error_at) + " of its data)"
                                : std::string()));
    const std::string name = name_of(node);
    std::size_t number = 0;
    for (const SvgSubpath& subpath : data.subpaths) {
      ++number;
      SvgCurve curve{number == 1 ? name : name + '#' + std::to_string(number),
                     place.layer,
                     {},
                     subpath.closed};
      for (const curve::Bezier2& piece : subpath.pieces)
        curve.pieces.push_back(transformed(piece, place.map));
      keep(node, std::move(curve));
      if (full_) return;
    }
  }

  void keep(const pugi::xml_node& node, SvgCurve curve) {
    for (const curve::Bezier2& piece : curve.pieces)
      for (const core::Point2& p : piece.control)
        if (!core::is_finite(p)) {
          skip(line(node), describe(node) + ": its coordinates are too large");
          return;
        }
    pieces_ += curve.pieces.size();
    if (pieces_ > limits_.pieces) return fill_up(node, "pieces of curves");
    contents_.curves.push_back(std::move(curve));
  }

  void fill_up(const pugi::xml_node& node, const std::string& what) {
    if (!full_) skip(line(node), "the rest of the file: it holds too many " + what);
    full_ = true;
  }

  /// What x, y, width, height and viewBox of a nested <svg> or a <symbol> do; the size may come
  /// from the <use> that shows it.
  static Affine viewport_of(const pugi::xml_node& node, const pugi::xml_node& sized) {
    Affine map;
    const double x = detail::svg_length(node, "x", 0);
    const double y = detail::svg_length(node, "y", 0);
    if (std::isfinite(x) && std::isfinite(y)) map = {1, 0, 0, 1, x, y};
    const auto box = detail::parse_svg_view_box(node.attribute("viewBox").value());
    const double w = detail::svg_length(sized, "width", detail::svg_length(node, "width", NAN));
    const double h = detail::svg_length(sized, "height", detail::svg_length(node, "height", NAN));
    if (!box || !(w > 0 && h > 0)) return map;
    const double scale = std::min(w / box->width, h / box->height);
    const Affine fit{scale,
                     0,
                     0,
                     scale,
                     w / 2 - scale * (box->x + box->width / 2),
                     h / 2 - scale * (box->y + box->height / 2)};
    return combined(map, fit);
  }

  void read_use(const pugi::xml_node& node, Place place) {
    std::string target = node.attribute("href").value();
    if (target.empty()) target = node.attribute("xlink:href").value();
    const auto found =
        target.size() > 1 && target[0] == '#' ? ids_.find(target.substr(1)) : ids_.end();
    if (found == ids_.end()) return skip(line(node), describe(node) + ": points at nothing here");
    const pugi::xml_node shown = found->second;
    if (++place.use_depth > limits_.use_depth ||
        std::find(open_.begin(), open_.end(), shown) != open_.end())
      return skip(line(node), describe(node) + ": shows itself, or is nested too deep");
    const double x = detail::svg_length(node, "x", 0);
    const double y = detail::svg_length(node, "y", 0);
    if (std::isfinite(x) && std::isfinite(y))
      place.map = combined(place.map, Affine{1, 0, 0, 1, x, y});
    if (local_name(shown) != "symbol") return read_element(shown, place);
    place.map = combined(place.map, viewport_of(shown, node));
    open_.push_back(shown);
    read_children(shown, place);
    open_.pop_back();
  }

  void read_metadata(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children())
      if (std::strcmp(child.name(), "keyline:document") == 0 && contents_.metadata.empty())
        contents_.metadata = child.text().get();
  }

  /// Definitions and descriptions are silent; anything else is counted under its name.
  void ignore(const pugi::xml_node& node, std::string_view name) {
    for (const char* silent : {"defs", "title", "desc", "style", "namedview", "symbol", "clipPath",
                               "mask", "marker", "pattern", "linearGradient", "radialGradient",
                               "filter", "script", "i18n", "guide", "perspective", "pgf"})
      if (name == silent) return;
    auto& count = ignored_[std::string(name)];
    if (count.second++ == 0) count.first = line(node);
  }

  std::string_view bytes_;
  SvgReadLimits limits_;
  std::vector<std::size_t> ends_;  ///< of lines
  SvgContents contents_;
  std::unordered_map<std::string, pugi::xml_node> ids_;
  std::vector<pugi::xml_node> open_;                    ///< elements being read, outermost first
  std::map<std::string, std::pair<int, int>> ignored_;  ///< name: first line, count
  std::size_t visited_ = 0;
  std::size_t pieces_ = 0;
  bool full_ = false;
};

}  // namespace

core::Result<SvgContents> read_svg(std::string_view bytes, const SvgReadLimits& limits) {
  if (bytes.size() > limits.bytes)
    return core::fail(ErrorCode::bad_input, "the SVG file is too large",
                      "it may hold " + std::to_string(limits.bytes >> 20) + " MB");
  const auto encoding = encoding_of(bytes);
  if (!encoding) return std::unexpected(encoding.error());
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(
      bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_ws_pcdata_single, *encoding);
  if (!parsed)
    return core::fail(
        ErrorCode::bad_input, std::string("the SVG file is no XML: ") + parsed.description(),
        "check that the file is complete", "line " + std::to_string(line_of(bytes, parsed.offset)));
  const pugi::xml_node root = document.document_element();
  if (local_name(root) != "svg")
    return core::fail(ErrorCode::bad_input, "the file holds XML but no SVG", {}, "line 1");
  return SvgReader(bytes, limits).read(root);
}

}  // namespace keyline::exchange
