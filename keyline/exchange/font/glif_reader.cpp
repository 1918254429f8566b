#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/font/glif.h"
#include "keyline/exchange/svg/svg_transform.h"
#include "keyline/exchange/svg/xml_oddities.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/byte_lines.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::Point2;
using core::Result;
using curve::Bezier2;
using document::Document;

enum class Kind { handle, move, line, curve, qcurve };

struct Node {
  Point2 at;
  Kind kind = Kind::handle;
};

/// What of contours is read otherwise than it stands, or not at all.
struct Oddities {
  std::size_t unknown = 0;  ///< points of no known type
  std::size_t unused = 0;   ///< handles that belong to no curve
  std::size_t curves = 0;   ///< of one handle, or more than two
  std::size_t moves = 0;    ///< behind the first point
};

Kind kind_of(std::string_view type, Oddities& odd) {
  if (type == "move") return Kind::move;
  if (type == "line") return Kind::line;
  if (type == "curve") return Kind::curve;
  if (type == "qcurve") return Kind::qcurve;
  odd.unknown += !type.empty() && type != "offcurve";
  return Kind::handle;
}

/// Quadratics between nodes that are implied halfway between handles.
void add_quadratics(std::vector<Bezier2>& pieces, Point2 from, const std::vector<Point2>& handles,
                    Point2 to) {
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const bool last = i + 1 == handles.size();
    const Point2 end = last ? to : core::mix(handles[i], handles[i + 1], 0.5);
    pieces.push_back({{from, handles[i], end}, {}});
    from = end;
  }
}

void add_piece(std::vector<Bezier2>& pieces, Point2 from, const std::vector<Point2>& handles,
               const Node& to, Oddities& odd) {
  odd.moves += to.kind == Kind::move;
  if (handles.empty() || to.kind == Kind::line) {
    odd.unused += handles.size();
    if (from != to.at) pieces.push_back({{from, to.at}, {}});
  } else if (to.kind == Kind::curve && handles.size() == 2) {
    pieces.push_back({{from, handles[0], handles[1], to.at}, {}});
  } else {
    odd.curves += to.kind == Kind::curve;
    add_quadratics(pieces, from, handles, to.at);
  }
}

/// A contour that consists of handles alone has its nodes halfway between them.
std::vector<Bezier2> handle_contour(const std::vector<Node>& nodes) {
  std::vector<Point2> handles;
  for (const Node& node : nodes) handles.push_back(node.at);
  const Point2 start = core::mix(handles.back(), handles.front(), 0.5);
  std::vector<Bezier2> pieces;
  add_quadratics(pieces, start, handles, start);
  return pieces;
}

document::Path path_of(std::vector<Node> nodes, Oddities& odd) {
  document::Path path;
  const bool open = nodes.front().kind == Kind::move;
  path.closed = !open;
  const auto first = std::find_if(nodes.begin(), nodes.end(),
                                  [](const Node& n) { return n.kind != Kind::handle; });
  std::vector<Bezier2> pieces;
  if (first == nodes.end()) {
    pieces = handle_contour(nodes);
  } else {
    std::rotate(nodes.begin(), first, nodes.end());
    if (!open) nodes.push_back(nodes.front());
    Point2 at = nodes.front().at;
    std::vector<Point2> handles;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      if (nodes[i].kind == Kind::handle) {
        handles.push_back(nodes[i].at);
        continue;
      }
      add_piece(pieces, at, handles, nodes[i], odd);
      handles.clear();
      at = nodes[i].at;
    }
    odd.unused += handles.size();
  }
  for (Bezier2& piece : pieces) path.curves.push_back({std::move(piece)});
  return path;
}

std::optional<double> number(const pugi::xml_node& node, const char* name) {
  const char* text = node.attribute(name).value();
  return core::parse_number(text);
}

/// A glyph being read with the components it is made of.
class GlifReader {
 public:
  explicit GlifReader(const fs::path& folder) : folder_(folder) {}

  Result<Document> read(std::string_view bytes) {
    pugi::xml_document xml;
    const auto glyph = parse(xml, bytes);
    if (!glyph) return std::unexpected(glyph.error());
    name_ = glyph->attribute("name").as_string("glyph");
    if (auto done = add(*glyph, bytes, {}, 0); !done) return std::unexpected(done.error());
    tell_odd();
    if (glyph->child("image")) document_.skipped.emplace_back("an image");
    tell_unread(*glyph, bytes);
    if (anchors_ > 0)
      document_.skipped.insert(document_.skipped.begin(), core::counted(anchors_, "anchor"));
    return std::move(document_);
  }

 private:
  void tell_unread(const pugi::xml_node& glyph, std::string_view bytes) {
    const auto tell = [&](const pugi::xml_node& node, const std::string& what) {
      const int line =
          static_cast<int>(detail::line_of(bytes, static_cast<std::size_t>(node.offset_debug())));
      document_.skipped.push_back("line " + std::to_string(line) + ": " + what);
    };
    for (const auto& [node, what] : detail::xml_oddities(glyph)) tell(node, what);
    if (const auto second = glyph.child("outline").next_sibling("outline"))
      tell(second, "a second outline");
    const std::string_view format = glyph.attribute("format").value();
    if (!format.empty() && format != "1" && format != "2")
      tell(glyph, "what is new in format " + std::string(core::whole_characters(format, 30)) +
                      " of glyphs, read as format 2");
  }

  void tell_odd() {
    const auto tell = [this](std::size_t count, const char* one, const char* many,
                             const char* what) {
      if (count > 0) document_.skipped.push_back(core::counted(count, one, many) + what);
    };
    tell(odd_.unknown, "point of an unknown type, taken for a handle",
         "points of unknown types, taken for handles", "");
    tell(odd_.unused, "handle", "handles", " that no curve of a contour uses");
    tell(odd_.curves, "curve", "curves", " of one or more than two handles, taken for quadratics");
    tell(odd_.moves, "point", "points",
         " of type move within a contour, taken for the end of a line");
  }

  static Result<pugi::xml_node> parse(pugi::xml_document& xml, std::string_view bytes) {
    const auto parsed = xml.load_buffer(bytes.data(), bytes.size(), pugi::parse_default);
    if (!parsed)
      return core::fail(ErrorCode::bad_input,
                        std::string("the glyph is no XML: ") + parsed.description(),
                        "check that the file is complete",
                        "line " + std::to_string(detail::line_of(bytes, parsed.offset)));
    const pugi::xml_node glyph = xml.child("glyph");
    if (!glyph)
      return core::fail(ErrorCode::bad_input, "the file holds XML but no glyph",
                        "give a .glif file", "line 1");
    return glyph;
  }

  Result<void> add(const pugi::xml_node& glyph, std::string_view bytes, const detail::Affine& map,
                   int depth) {
    for (const pugi::xml_node& contour : glyph.child("outline").children("contour")) {
      std::vector<Node> nodes;
      for (const pugi::xml_node& point : contour.children("point")) {
        const auto x = number(point, "x");
        const auto y = number(point, "y");
        if (!x || !y)
          return core::fail(ErrorCode::bad_input, "a point needs the numbers x and y", "mend it",
                            "line " + std::to_string(detail::line_of(bytes, point.offset_debug())));
        nodes.push_back({apply(map, {*x, *y}), kind_of(point.attribute("type").value(), odd_)});
      }
      add_contour(std::move(nodes));
    }
    for (const pugi::xml_node& component : glyph.child("outline").children("component"))
      add_component(component, map, depth);
    return {};
  }

  void add_contour(std::vector<Node> nodes) {
    if (nodes.size() < 2) {
      ++anchors_;
      return;
    }
    document::Path path = path_of(std::move(nodes), odd_);
    if (path.curves.empty()) {
      document_.skipped.push_back("a contour without extent");
      return;
    }
    if (const auto sound = validate(path); !sound) {
      document_.skipped.push_back("a contour: " + sound.error().message);
      return;
    }
    const std::size_t count = document_.paths.size() + 1;
    const std::string own = count == 1 ? name_ : name_ + "#" + std::to_string(count);
    document_.paths.push_back({{own, name_, {}}, std::move(path), 0});
  }

  void add_component(const pugi::xml_node& component, const detail::Affine& outer, int depth) {
    constexpr int kDeepest = 8;
    constexpr std::size_t kMost = 10'000;
    const std::string base = component.attribute("base").value();
    const auto skip = [&](const char* why) {
      if (document_.skipped.size() < kMost)
        document_.skipped.push_back("component " + base + ": " + why);
    };
    if (folder_.empty()) return skip("it lies in another file");
    if (depth == kDeepest || ++components_ > kMost || document_.paths.size() > kMost)
      return skip("components within components without end");
    const auto bytes = read_file(folder_ / file_of(base), kLargest);
    if (!bytes) return skip("its file cannot be read");
    read_ += bytes->size();
    if (read_ > 4 * kLargest) return skip("components of too much text");
    pugi::xml_document xml;
    const auto glyph = parse(xml, *bytes);
    if (!glyph) return skip("its file is no glyph");
    bool readable = true;
    const auto value = [&](const char* name, double fallback) {
      if (!component.attribute(name)) return fallback;
      const auto given = number(component, name);
      readable = readable && given.has_value();
      return given.value_or(fallback);
    };
    const detail::Affine own{value("xScale", 1), value("xyScale", 0), value("yxScale", 0),
                             value("yScale", 1), value("xOffset", 0), value("yOffset", 0)};
    if (!readable) return skip("its place or scale is no number");
    if (!add(*glyph, *bytes, combined(outer, own), depth + 1)) skip("its file is broken");
  }

  /// A name without folders, as contents.plist gives it.
  fs::path file_of(const std::string& base) {
    if (!contents_) {
      contents_.emplace();
      const auto bytes = read_file(folder_ / "contents.plist", kLargest);
      pugi::xml_document xml;
      if (bytes && xml.load_buffer(bytes->data(), bytes->size()))
        for (const pugi::xml_node& key : xml.child("plist").child("dict").children("key"))
          contents_->emplace(key.text().get(), key.next_sibling("string").text().get());
    }
    const auto found = contents_->find(base);
    return fs::path(found == contents_->end() ? base + ".glif" : found->second).filename();
  }

  static constexpr std::uintmax_t kLargest = std::uintmax_t{16} << 20;

  fs::path folder_;
  Document document_;
  std::string name_;
  std::optional<std::map<std::string, std::string>> contents_;
  std::size_t components_ = 0;
  std::uintmax_t read_ = 0;  ///< bytes of components
  int anchors_ = 0;
  Oddities odd_;
};

}  // namespace

Result<Document> read_glif(std::string_view bytes, const fs::path& folder) {
  return GlifReader(folder).read(bytes);
}

}  // namespace keyline::exchange
