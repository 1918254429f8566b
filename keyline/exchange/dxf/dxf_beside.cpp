#include "keyline/exchange/dxf/dxf_beside.h"

#include <algorithm>
#include <initializer_list>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

using Tags = std::vector<DxfTag>;

/// Whether one of the groups is there and not 0, which one that is no number may not be either.
bool has(const Tags& tags, std::initializer_list<int> codes) {
  return std::ranges::any_of(tags, [&](const DxfTag& tag) {
    return std::ranges::find(codes, tag.code) != codes.end() && number_of(tag) != 0;
  });
}

bool is_unread(const Tags& tags, int code) {
  return std::ranges::any_of(
      tags, [code](const DxfTag& tag) { return tag.code == code && !number_of(tag); });
}

bool is_given(const Tags& tags, int code) {
  return std::ranges::find(tags, code, &DxfTag::code) != tags.end();
}

bool is_wide(const DxfEntity& entity) {
  if (entity.type == "LWPOLYLINE") return has(entity.tags, {40, 41, 43});
  const auto wide = [](const Tags& tags) { return has(tags, {40, 41}); };
  return entity.type == "POLYLINE" &&
         (wide(entity.tags) || std::ranges::any_of(entity.vertices, wide));
}

}  // namespace

void DxfBeside::take_layer(const DxfEntity& layer, const std::string& name) {
  constexpr int kFrozen = 1;
  unread_layers_ += is_unread(layer.tags, 70);
  const bool off = integer(layer.tags, 62) < 0;
  if (off || (integer(layer.tags, 70) & kFrozen) != 0) unseen_[lower_case(name)] = {name};
}

void DxfBeside::take(const DxfEntity& entity, const std::string& layer) {
  if (const auto unseen = unseen_.find(lower_case(layer)); unseen != unseen_.end())
    ++unseen->second.entities;
  invisible_ += integer(entity.tags, 60) == 1;
  unread_ += is_unread(entity.tags, 60);
  thick_ += has(entity.tags, {39});
  wide_ += is_wide(entity);
  fitted_ += entity.type == "SPLINE" && !is_given(entity.tags, 10) && is_given(entity.tags, 11);
}

void DxfBeside::take_other(const DxfEntity& entity) {
  if (entity.type != "SEQEND" && entity.type != "VIEWPORT" && entity.type != "VERTEX")
    ++others_[std::string(core::whole_characters(entity.type, 40))];
}

void DxfBeside::tell(std::vector<std::string>& lines) const {
  const auto entities = [](std::size_t n) { return core::counted(n, "entity", "entities"); };
  if (paper_ > 0) lines.push_back(entities(paper_) + " in paper space");
  for (const auto& [type, count] : others_) lines.push_back(type + ": " + entities(count));
  for (const auto& [key, layer] : unseen_)
    if (layer.entities > 0)
      lines.push_back("nothing, but off or frozen: layer " + layer.name + ", " +
                      entities(layer.entities));
  if (invisible_ > 0) lines.push_back("nothing, but not to be seen: " + entities(invisible_));
  const auto unread = [&lines](const std::string& whose) {
    lines.push_back("the visibility of " + whose + ", which is no number");
  };
  if (unread_layers_ > 0) unread(core::counted(unread_layers_, "layer"));
  if (unread_ > 0) unread(entities(unread_));
  if (fitted_ > 0)
    lines.push_back("nothing, but a cubic through the fit points stands for " +
                    core::counted(fitted_, "spline") + " without control points");
  if (apart_ > 0)
    lines.push_back("nothing, but open: " + core::counted(apart_, "spline") +
                    " said to be closed whose ends lie apart");
  if (thick_ > 0) lines.push_back("the thickness of " + entities(thick_));
  if (wide_ > 0) lines.push_back("the width of " + core::counted(wide_, "polyline"));
}

}  // namespace keyline::exchange::detail
