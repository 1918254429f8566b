#include "keyline/exchange/svg/svg_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/svg/svg_shapes.h"
#include "keyline/exchange/svg/svg_style.h"
#include "keyline/exchange/svg/svg_text.h"
#include "keyline/exchange/svg/svg_transform.h"
#include "keyline/exchange/svg/svg_unseen.h"
#include "keyline/exchange/svg/svg_viewport.h"
#include "keyline/exchange/svg/xml_oddities.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using detail::Affine;
using detail::describe;
using detail::local_name;
using detail::name_of;

/// Where an element is met: the map to the outermost user space, and its surroundings.
struct Place {
  Affine map;
  std::string layer;
  bool in_layer = false;  ///< of Inkscape; groups within are no layers
  detail::SvgPaint paint;
  detail::SvgViewport viewport;
  int depth = 0;
  int use_depth = 0;
};

class SvgReader {
 public:
  SvgReader(std::string_view bytes, const SvgReadLimits& limits)
      : bytes_(bytes), limits_(limits), room_(limits.memory + 17 * bytes.size()) {
    for (std::size_t i = bytes.find('\n'); i != bytes.npos; i = bytes.find('\n', i + 1))
      ends_.push_back(i);
  }

  core::Result<SvgContents> read(const pugi::xml_node& root) {
    find_ids(root);
    Place place;
    place.map = outermost(root);
    place.viewport = detail::viewport_in(root, {});
    take_paint(root, place);
    if (is_invertible(place.map))
      read_children(root, place);
    else
      skip(line(root), describe(root) + ": its transform leaves no area");
    for (const auto& [name, count] : ignored_)
      skip(count.first, name + ": " + core::counted(count.second, "element") + " without curves");
    if (styles_.passed() > 0)
      skip(line(root), core::counted(styles_.passed(), "rule") +
                           " of its style sheets: only plain selectors are followed");
    if (!full_)
      for (auto& [node, what] : unseen_.told(root)) skip(line(node), std::move(what));
    for (auto& [node, what] : detail::xml_oddities(root)) skip(line(node), std::move(what));
    sort_skipped();
    return std::move(contents_);
  }

 private:
  void skip(int line, std::string what) {
    constexpr std::size_t kMost = 1000;
    if (contents_.skipped.size() < kMost) contents_.skipped.push_back({line, std::move(what)});
  }

  /// By line; what stands on one line stays in the order met.
  void sort_skipped() { std::ranges::stable_sort(contents_.skipped, {}, &SvgSkipped::line); }

  int line(const pugi::xml_node& node) const {
    const auto end = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    return 1 + static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), end) - ends_.begin());
  }

  /// First element of every id, found without recursion.
  void find_ids(const pugi::xml_node& root) {
    const auto enter = [this](const pugi::xml_node& node) {
      if (const char* id = node.attribute("id").value(); *id) ids_.emplace(id, node);
      if (local_name(node) == "style") styles_.add_sheet(node);
    };
    detail::walk_svg(root, enter, [](const pugi::xml_node&) {});
  }

  /// A side of the page in a unit; empty where there is none, or a share of the window.
  std::optional<detail::SvgLength> page_size(const pugi::xml_node& root, const char* name) {
    const std::string_view text = root.attribute(name).value();
    const auto length = detail::parse_svg_length(text);
    if (!length && !text.empty() && text != "auto" && !text.ends_with('%'))
      skip(line(root), std::string("the ") + name + " of the page, which is no length: \"" +
                           std::string(core::whole_characters(text, 40)) + "\"");
    return length;
  }

  /// The attributes of an element that are there but no lengths are said.
  void check_lengths(const pugi::xml_node& node, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (node.attribute(name) && std::strcmp(node.attribute(name).value(), "auto") != 0 &&
          std::isnan(detail::svg_length(node, name, 0, {1, 1})))
        skip(line(node), describe(node) + ": its " + name + " is no length");
  }

  void check_view_box(const pugi::xml_node& node) {
    const char* text = node.attribute("viewBox").value();
    if (*text != '\0' && !detail::parse_svg_view_box(text))
      skip(line(node), describe(node) + ": a viewBox that cannot be read is ignored");
  }

  /// User units to mm or px, y up.
  Affine outermost(const pugi::xml_node& root) {
    auto width = page_size(root, "width");
    auto height = page_size(root, "height");
    for (auto* size : {&width, &height})
      if (*size && !((*size)->value > 0)) {
        skip(line(root), "a size of the page that is not positive is ignored");
        size->reset();
      }
    check_view_box(root);
    detail::SvgFrame frame = detail::outermost_frame(
        width, height, detail::parse_svg_view_box(root.attribute("viewBox").value()),
        root.attribute("preserveAspectRatio").value());
    if (const Affine own = transform_of(root); own != Affine{}) {
      frame = moved(frame, own);
      if (!frame.page && own != Affine{1, 0, 0, 1, own.e, own.f})
        skip(line(root), describe(root) + ": turned about the origin, as it has no middle");
    }
    contents_.unit = frame.physical ? "mm" : "px";
    if (const auto& page = frame.page) {
      const curve::Box2 box = detail::box_of(*page, frame.map);
      const bool seen = curve::width(box) > 0 && curve::height(box) > 0;
      if (seen && core::is_finite(box.low) && core::is_finite(box.high)) contents_.page = box;
    }
    return frame.map;
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
    if (++visited_ > limits_.elements + bytes_.size() / 4) return fill_up(node, "elements");
    const std::string_view name = local_name(node);
    if (name == "metadata") return read_metadata(node);
    const bool shape = detail::is_svg_shape(name);
    const bool group = name == "g" || name == "a" || name == "switch";
    const bool use = name == "use";
    if (!shape && !group && !use && name != "svg") return ignore(node, name);
    Place place = outer;
    ++place.depth;
    if (!add_transform(node, place)) return;
    take_paint(node, place);
    if (shape) return read_shape(node, place);
    open_.push_back(node);
    if (use) {
      read_use(node, place);
    } else {
      enter_layer(node, place);
      if (name == "svg") {
        check_lengths(node, {"x", "y", "width", "height"});
        check_view_box(node);
        detail::enter_viewport(node, node, place.map, place.viewport);
      }
      if (name == "switch")
        read_switch(node, place);
      else
        read_children(node, place);
    }
    open_.pop_back();
  }

  static void enter_layer(const pugi::xml_node& node, Place& place) {
    const std::string own = name_of(node);
    const bool layer = std::strcmp(node.attribute("inkscape:groupmode").value(), "layer") == 0;
    if (own.empty() || (place.in_layer && !layer)) return;
    place.layer = own;
    place.in_layer = layer;
  }

  /// The first child that may be shown.
  void read_switch(const pugi::xml_node& node, const Place& place) {
    bool shown = false;
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const bool other = shown || !detail::may_switch_to(child);
      if (other) unseen_.take_alternative(child);
      if (other) continue;
      shown = true;
      read_element(child, place);
    }
  }

  /// By its attribute; what cannot be followed is told.
  Affine transform_of(const pugi::xml_node& node) {
    if (styles_.moves(node))
      skip(line(node), describe(node) + ": what CSS turns or shifts it by is ignored");
    const auto own = detail::parse_svg_transform(node.attribute("transform").value());
    if (!own) skip(line(node), describe(node) + ": a transform that cannot be read is ignored");
    return own.value_or(Affine{});
  }

  bool add_transform(const pugi::xml_node& node, Place& place) {
    const Affine own = transform_of(node);
    if (own != Affine{}) place.map = combined(place.map, own);
    if (is_invertible(place.map)) return true;
    skip(line(node), describe(node) + ": its transform leaves no area");
    return false;
  }

  /// Its style; what of it is not followed is told, a colour or width that is none known once.
  void take_paint(const pugi::xml_node& node, Place& place) {
    if (styles_.clips(node)) skip(line(node), describe(node) + ": is not clipped, whole here");
    place.paint = styles_.paint(node, place.paint);
    for (const std::string& what : place.paint.unread())
      if (unread_styles_.insert(what).second) skip(line(node), describe(node) + ": " + what);
  }

  void read_shape(const pugi::xml_node& node, const Place& place) {
    if (!place.paint.seen())
      unseen_.take_hidden(node);
    else if (!place.paint.painted())
      unseen_.take_unpainted(node);
    if (place.use_depth > 0) unseen_.take_used(node);
    check_lengths(node, {"rx", "ry"});
    SvgPathData data = detail::svg_shape(node, place.viewport);
    if (!data.error.empty())
      skip(line(node), describe(node) + ": " + data.error +
                           (local_name(node) == "path"
                                ? " (at byte " + std::to_string(data.error_at) + " of its data)"
                                : std::string()));
    const std::string name = name_of(node);
    std::size_t number = 0;
    for (SvgSubpath& subpath : data.subpaths) {
      ++number;
      SvgCurve curve{number == 1 ? name : name + '#' + std::to_string(number),
                     place.layer,
                     std::move(subpath.pieces),
                     subpath.closed,
                     place.paint.color(),
                     width_of(place),
                     number};
      curve.pieces.shrink_to_fit();
      for (curve::Bezier2& piece : curve.pieces) piece = transformed(piece, place.map);
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
    memory_ += memory_of(curve);
    if (memory_ > room_) return fill_up(node, "curves for its size");
    contents_.curves.push_back(std::move(curve));
  }

  /// Bytes a curve takes here and in a document together, about.
  static std::size_t memory_of(const SvgCurve& curve) {
    std::size_t bytes = 400;
    for (const curve::Bezier2& piece : curve.pieces)
      bytes += piece.control.size() == 2 ? 100 : 150 + 20 * piece.control.size();
    return bytes;
  }

  void fill_up(const pugi::xml_node& node, const std::string& what) {
    if (!full_) skip(line(node), "the rest of the file: it holds too many " + what);
    full_ = true;
  }

  /// Of the stroke: it grows as lengths do on the whole, or counts px of the page (SVG 2, 8.13).
  double width_of(const Place& place) const {
    if (place.paint.stroke.empty()) return 0;
    const double px = contents_.unit == "mm" ? detail::kMillimetresPerPx : 1;
    const Affine& m = place.map;
    const double scale = place.paint.fixed_width ? px : std::sqrt(std::abs(m.a * m.d - m.b * m.c));
    return place.paint.width * scale;
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
    check_lengths(node, {"x", "y", "width", "height"});
    const double x = detail::svg_length(node, "x", 0, place.viewport);
    const double y = detail::svg_length(node, "y", 0, place.viewport);
    if (std::isfinite(x) && std::isfinite(y))
      place.map = combined(place.map, Affine{1, 0, 0, 1, x, y});
    if (local_name(shown) != "symbol") return read_element(shown, place);
    if (!add_transform(shown, place)) return;
    take_paint(shown, place);
    detail::enter_viewport(shown, node, place.map, place.viewport);
    open_.push_back(shown);
    read_children(shown, place);
    open_.pop_back();
  }

  void read_metadata(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children())
      if (std::strcmp(child.name(), "keyline:document") == 0 && contents_.metadata.empty())
        contents_.metadata = child.text().get();
  }

  /// Descriptions are silent, definitions told by their shapes; anything else is counted under its
  /// name.
  void ignore(const pugi::xml_node& node, std::string_view name) {
    if (detail::is_svg_definition(name)) return;
    for (const char* silent :
         {"title", "desc", "style", "namedview", "linearGradient", "radialGradient", "filter",
          "script", "i18n", "guide", "perspective", "pgf"})
      if (name == silent) return;
    auto& count = ignored_[std::string(name)];
    if (count.second++ == 0) count.first = line(node);
  }

  std::string_view bytes_;
  SvgReadLimits limits_;
  std::vector<std::size_t> ends_;  ///< of lines
  SvgContents contents_;
  std::unordered_map<std::string, pugi::xml_node> ids_;
  detail::SvgStyles styles_;
  detail::SvgUnseen unseen_;
  std::vector<pugi::xml_node> open_;                    ///< elements being read, outermost first
  std::map<std::string, std::pair<int, int>> ignored_;  ///< name: first line, count
  std::size_t visited_ = 0;
  std::set<std::string> unread_styles_;
  std::size_t memory_ = 0;
  std::size_t room_;  ///< for the curves
  bool full_ = false;
};

}  // namespace

core::Result<SvgContents> read_svg(std::string_view bytes, const SvgReadLimits& limits) {
  if (bytes.size() > limits.bytes)
    return core::fail(ErrorCode::bad_input, "the SVG file is too large",
                      "it may hold " + std::to_string(limits.bytes >> 20) + " MB");
  auto text = detail::svg_text(bytes, limits.bytes);
  if (!text) return std::unexpected(text.error());
  bytes = text->in(bytes);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(
      bytes.data(), bytes.size(),
      pugi::parse_default | pugi::parse_ws_pcdata_single | pugi::parse_pi, pugi::encoding_utf8);
  if (!parsed)
    return core::fail(ErrorCode::bad_input,
                      std::string("the SVG file is no XML: ") + parsed.description(),
                      "check that the file is complete",
                      "line " + std::to_string(detail::line_of(bytes, parsed.offset)));
  const pugi::xml_node root = document.document_element();
  if (local_name(root) != "svg")
    return core::fail(ErrorCode::bad_input, "the file holds XML but no SVG",
                      "export the drawing as SVG, or a part as STEP", "line 1");
  auto contents = SvgReader(bytes, limits).read(root);
  if (contents)
    for (std::string& note : text->notes) contents->skipped.push_back({1, std::move(note)});
  return contents;
}

}  // namespace keyline::exchange
