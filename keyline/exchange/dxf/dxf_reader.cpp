#include "keyline/exchange/dxf/dxf_reader.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/document/units.h"
#include "keyline/exchange/dxf/dxf_beside.h"
#include "keyline/exchange/dxf/dxf_block.h"
#include "keyline/exchange/dxf/dxf_color.h"
#include "keyline/exchange/dxf/dxf_entity.h"
#include "keyline/exchange/dxf/dxf_header.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange {
namespace {

using core::Result;
using detail::Affine3;
using detail::DxfBlock;
using detail::DxfEntity;
using detail::DxfItem;
using detail::DxfTag;
using document::Document;

/// What an insert hands down to the things of its block.
struct Outer {
  Affine3 map;
  std::string layer;
  std::string color;
  std::string name;
  int depth = 0;
};

class DxfReader {
 public:
  DxfReader(std::string_view bytes, const DxfReadLimits& limits)
      : tags_(bytes), limits_(limits), most_points_(limits.points + bytes.size() / 2) {}

  Result<Document> read() {
    while (true) {
      const auto tag = tags_.next();
      if (!tag) return broken(tag.error());
      if (!*tag) {
        cut_off();
        break;
      }
      if ((*tag)->code == 0) {
        finish_entity();
        if ((*tag)->text == "EOF") break;
        start(**tag);
      } else {
        take(**tag);
      }
    }
    finish_entity();
    if (!seen_section_)
      return core::fail(core::ErrorCode::bad_input, "this is no DXF file",
                        "it has to hold a SECTION", "line 1");
    return finish();
  }

 private:
  Result<Document> broken(const core::Failure& failure) {
    if (size(document_) == 0) return std::unexpected(failure);
    drop_entity();
    problems_.push_back("the rest of the file from " + failure.path + ": " + failure.message);
    return finish();
  }

  /// The file stopped before its EOF: what is open may be half of what was written.
  void cut_off() {
    if (!seen_section_) return;
    const bool whole = section_.empty() && !entity_ && !polyline_;
    drop_entity();
    problems_.push_back(whole ? "nothing, but the file has no EOF at its end"
                              : "the rest of the file: it is cut off before its EOF");
  }

  void drop_entity() {
    for (const auto* open : {&polyline_, &entity_})
      if (*open) problems_.push_back(describe(**open) + ": the file ends within it");
    polyline_.reset();
    entity_.reset();
  }

  Result<Document> finish() {
    for (const DxfItem& item : items_) place(item, Outer{});
    if (!full_) blocks_.tell(problems_);
    beside_.tell(problems_);
    document_.skipped = std::move(problems_);
    document_.unit = header_.unit();
    if (header_.scale() != 1) return document::scaled(std::move(document_), header_.scale());
    return std::move(document_);
  }

  void problem(std::string what) {
    constexpr std::size_t kMost = 1000;
    if (problems_.size() < kMost) problems_.push_back(std::move(what));
  }

  /// Group 0: what comes next.
  void start(const DxfTag& tag) {
    if (tag.text == "SECTION") {
      seen_section_ = naming_section_ = true;
      return;
    }
    if (tag.text == "ENDSEC") {
      section_.clear();
      return;
    }
    if (tag.text == "SEQEND") return close_polyline();
    if (tag.text == "VERTEX" && polyline_) {
      polyline_->vertices.emplace_back();
      return;
    }
    if (polyline_) problem(describe(*polyline_) + ": it has no SEQEND, maybe not all its vertices");
    close_polyline();
    entity_ = DxfEntity{tag.text, tag.place, {}, {}};
  }

  void take(const DxfTag& tag) {
    if (naming_section_ && tag.code == 2) {
      section_ = std::string(tag.text);
      naming_section_ = false;
    } else if (section_ == "HEADER" || (section_.empty() && seen_section_)) {
      if (auto wrong = header_.take(tag, tags_.place(tag)); !wrong.empty())
        problem(std::move(wrong));
    } else if (polyline_) {
      auto& vertices = polyline_->vertices;
      (vertices.empty() ? polyline_->tags : vertices.back()).push_back(tag);
    } else if (entity_) {
      entity_->tags.push_back(tag);
    }
  }

  void close_polyline() {
    if (!polyline_) return;
    const DxfEntity entity = std::move(*polyline_);
    polyline_.reset();
    finish(entity);
  }

  void finish_entity() {
    if (!entity_) return;
    DxfEntity entity = std::move(*entity_);
    entity_.reset();
    if (entity.type == "POLYLINE") {
      close_polyline();
      polyline_ = std::move(entity);
      return;
    }
    finish(entity);
  }

  void finish(const DxfEntity& entity) {
    if (section_ == "TABLES") return add_layer(entity);
    if (section_ == "BLOCKS" && entity.type == "BLOCK") return start_block(entity);
    if (section_ == "BLOCKS" && entity.type == "ENDBLK") {
      block_ = nullptr;
      return;
    }
    if (section_ == "ENTITIES" || (section_ == "BLOCKS" && block_)) add_entity(entity);
  }

  void start_block(const DxfEntity& entity) {
    block_ = nullptr;
    if (!is_readable(entity)) return;
    const std::string name = detail::text(entity.tags, 2);
    if (blocks_.find(name))
      problem(describe(entity) + ": an earlier block of its name, \"" + name + '"');
    block_ = &blocks_.start(entity);
  }

  void add_layer(const DxfEntity& entity) {
    if (entity.type != "LAYER") return;
    const int exact = color_number(entity, 420, -1);
    const int index = std::abs(color_number(entity, 62, 7));
    const std::string name = detail::text(entity.tags, 2);
    layer_colors_[detail::lower_case(name)] =
        exact >= 0 ? detail::true_color(exact) : detail::aci_color(index);
    beside_.take_layer(entity, name);
  }

  void add_entity(const DxfEntity& entity) {
    const bool insert = entity.type == "INSERT";
    if (!insert && !detail::is_dxf_curve(entity.type)) {
      blocks_.take_other(entity);
      return beside_.take_other(entity);
    }
    if (block_ ? block_->paper : detail::integer(entity.tags, 67) == 1) {
      if (insert) blocks_.take_of_paper(entity);
      return beside_.take_of_paper();
    }
    if (!is_readable(entity)) return;
    DxfItem item = labelled(entity);
    if (insert) {
      item.block = detail::text(entity.tags, 2);
      if (item.name.empty()) item.name = item.block;
      item.places = places_of(entity);
    } else {
      auto curve = detail::dxf_curve_of(entity);
      if (!curve) return problem(describe(entity) + ": " + curve.error().message);
      if (curve->apart) beside_.take_apart();
      item.curve = std::move(*curve);
    }
    beside_.take(entity, item.layer);
    if (block_) return block_->items.push_back(std::move(item));
    // Blocks may stand behind the drawing.
    const bool later = insert && !blocks_.find(item.block);
    if (later) return items_.push_back(std::move(item));
    place(item, Outer{});
  }

  /// False, and said, where a number of its geometry cannot be read, is not there or is two.
  bool is_readable(const DxfEntity& entity) {
    std::string wrong;
    if (const DxfTag* tag = detail::unreadable(entity))
      wrong = '"' + std::string(core::whole_characters(detail::text_of(*tag), 40)) + "\" at " +
              tags_.place(*tag) + " is no number";
    else if (const auto missing = detail::missing_group(entity))
      wrong = "group " + std::to_string(*missing) + " is missing";
    else if (const auto twice = detail::ambiguous_group(entity))
      wrong = "group " + std::to_string(*twice) + " has two values";
    if (wrong.empty()) return true;
    problem(describe(entity) + ": " + wrong);
    return false;
  }

  /// A colour as it is written; what cannot be read is said and counts as absent.
  int color_number(const DxfEntity& entity, int code, int absent) {
    for (const DxfTag& tag : entity.tags)
      if (tag.code == code) {
        const auto value = detail::integer_of(tag);
        if (!value) problem(describe(entity) + ": a colour that is no number");
        return value.value_or(absent);
      }
    return absent;
  }

  /// Of an entity or an item.
  std::string describe(const auto& thing) const {
    return tags_.place({.place = thing.place}) + ": " + std::string(thing.type);
  }

  DxfItem labelled(const DxfEntity& entity) {
    DxfItem item;
    item.type = entity.type;
    item.place = entity.place;
    item.layer = detail::text(entity.tags, 8);
    item.color = color_number(entity, 62, 256);
    const int exact = color_number(entity, 420, -1);
    if (exact >= 0) item.exact = detail::true_color(exact);
    bool ours = false;
    for (const DxfTag& tag : entity.tags) {
      if (tag.code == 8 || tag.code == 2) check_letters(tag);
      if (tag.code == 1001) ours = tag.text == "KEYLINE";
      if (tag.code == 1000 && ours) item.name = detail::text_of(tag);
    }
    return item;
  }

  /// Says once that letters beyond ASCII are of a code page that is not known here.
  void check_letters(const DxfTag& name) {
    const bool known = header_.code_page().empty() || header_.code_page() == "ANSI_1252";
    if (known || core::is_utf8(name.text) || std::exchange(said_letters_, true)) return;
    problem("letters of names beyond ASCII, which are in " + header_.code_page() +
            ": they come out wrong");
  }

  /// One map for every cell of an insert's array: block coordinates less base to outer ones.
  std::vector<Affine3> places_of(const DxfEntity& entity) {
    const auto& t = entity.tags;
    const double angle = std::fmod(detail::real(t, 50), 360) * core::kPi / 180;
    const core::Vector3 x{std::cos(angle), std::sin(angle), 0};
    const core::Vector3 y{-x.y, x.x, 0};
    const Affine3 frame = detail::extrusion_frame(detail::vector(t, 210, {0, 0, 1}));
    const core::Point3 at = detail::point(t, 10);
    const int columns = std::clamp(detail::integer(t, 70, 1), 1, 30000);
    const int rows = std::clamp(detail::integer(t, 71, 1), 1, 30000);
    std::vector<Affine3> places;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        if (++cells_ > most_points_ / 8) {
          problem(describe(entity) + ": the rest of too large an array");
          return places;
        }
        const core::Vector3 cell = c * detail::real(t, 44) * x + r * detail::real(t, 45) * y;
        places.push_back(
            detail::combined(frame, {detail::real(t, 41, 1) * x, detail::real(t, 42, 1) * y,
                                     core::Vector3{0, 0, detail::real(t, 43, 1)}, at + cell}));
      }
    return places;
  }

  std::string color_of(const DxfItem& item, const Outer& outer, const std::string& layer) const {
    if (!item.exact.empty()) return item.exact;
    if (item.color == 0) return outer.color;
    if (item.color != 256) return detail::aci_color(std::abs(item.color));
    const auto found = layer_colors_.find(detail::lower_case(layer));
    return found == layer_colors_.end() ? std::string() : found->second;
  }

  void place(const DxfItem& item, const Outer& outer) {
    if (full_) return;
    const bool inherits = item.layer == "0" && outer.depth > 0;
    const std::string& layer = inherits ? outer.layer : item.layer;
    const std::string color = color_of(item, outer, layer);
    const bool both = !outer.name.empty() && !item.name.empty();
    const std::string name = outer.name + (both ? "/" : "") + item.name;
    if (!item.curve) return place_block(item, outer, layer, color, name);
    const detail::DxfShape shape =
        outer.depth == 0 ? item.curve->shape : detail::mapped(item.curve->shape, outer.map);
    made_points_ += detail::point_count(shape);
    if (made_points_ > most_points_ || size(document_) >= limits_.curves) {
      full_ = true;
      return problem("the rest of the drawing: its inserts make too many curves");
    }
    if (!detail::is_finite(shape)) return problem(describe(item) + ": its numbers are too large");
    const auto added =
        detail::add_shape(document_, shape, item.curve->closed, {name, layer, color});
    if (!added) problem(describe(item) + ": " + added.error().message);
  }

  void place_block(const DxfItem& item, const Outer& outer, const std::string& layer,
                   const std::string& color, const std::string& name) {
    DxfBlock* const block = blocks_.find(item.block);
    if (!block) return problem(describe(item) + ": there is no block \"" + item.block + "\"");
    block->placed = true;
    if (block->external && block->items.empty())
      return problem(describe(item) + ": block \"" + item.block + "\" is another file, \"" +
                     block->file + '"');
    if (outer.depth >= limits_.depth)
      return problem(describe(item) + ": blocks within blocks, deeper than " +
                     std::to_string(limits_.depth) + " or without end");
    for (const Affine3& cell : item.places) {
      Outer inner{detail::combined(outer.map, cell), layer, color, name, outer.depth + 1};
      const core::Point3 base = block->base;
      inner.map.origin = detail::apply(inner.map, core::Point3{-base.x, -base.y, -base.z});
      for (const DxfItem& part : block->items) {
        if (full_ || ++visits_ > most_points_) {
          if (!full_) problem("the rest of the drawing: too many inserts");
          full_ = true;
          return;
        }
        place(part, inner);
      }
    }
  }

  detail::DxfTags tags_;
  DxfReadLimits limits_;
  std::size_t most_points_;
  Document document_;
  std::string section_;
  detail::DxfHeader header_;
  bool said_letters_ = false;
  bool naming_section_ = false;
  bool seen_section_ = false;
  std::optional<DxfEntity> entity_;
  std::optional<DxfEntity> polyline_;  ///< its vertices are being read
  detail::DxfBlocks blocks_;
  DxfBlock* block_ = nullptr;
  std::vector<DxfItem> items_;
  std::unordered_map<std::string, std::string> layer_colors_;
  detail::DxfBeside beside_;
  std::vector<std::string> problems_;
  std::size_t made_points_ = 0;
  std::size_t cells_ = 0;
  std::size_t visits_ = 0;
  bool full_ = false;
};

}  // namespace

Result<Document> read_dxf(std::string_view bytes, const DxfReadLimits& limits) {
  return DxfReader(bytes, limits).read();
}

}  // namespace keyline::exchange
