#include "keyline/exchange/dxf/dxf_block.h"

#include "keyline/core/text.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {

DxfBlock& DxfBlocks::start(const DxfEntity& entity) {
  constexpr int kExternal = 4 | 8;  // a reference, or one that is laid over
  DxfBlock block;
  block.name = text(entity.tags, 2);
  block.base = point(entity.tags, 10);
  block.external = (integer(entity.tags, 70) & kExternal) != 0;
  block.file = text(entity.tags, 1);
  const std::string key = lower_case(block.name);
  // *Paper_Space is the layout in front, whose things stand in the drawing; others are counted.
  block.paper = key.starts_with("*paper_space") || key == "$paper_space";
  return blocks_[key] = std::move(block);
}

DxfBlock* DxfBlocks::find(const std::string& name) {
  const auto found = blocks_.find(lower_case(name));
  return found == blocks_.end() ? nullptr : &found->second;
}

void DxfBlocks::take_other(const DxfEntity& entity) {
  if (entity.type.ends_with("DIMENSION") || entity.type == "ACAD_TABLE")
    shown_.insert(lower_case(text(entity.tags, 2)));
}

void DxfBlocks::take_of_paper(const DxfEntity& insert) {
  shown_.insert(lower_case(text(insert.tags, 2)));
}

/// What is shown beside the curves, with the blocks that stand in it.
std::set<std::string> DxfBlocks::all_shown() const {
  std::set<std::string> shown = shown_;
  std::vector<std::string> open(shown.begin(), shown.end());
  while (!open.empty()) {
    const auto block = blocks_.find(open.back());
    open.pop_back();
    if (block == blocks_.end()) continue;
    for (const DxfItem& item : block->second.items)
      if (!item.block.empty() && shown.insert(lower_case(item.block)).second)
        open.push_back(lower_case(item.block));
  }
  return shown;
}

void DxfBlocks::tell(std::vector<std::string>& lines) const {
  constexpr std::size_t kNamed = 3;
  const std::set<std::string> shown = all_shown();
  std::size_t blocks = 0, entities = 0;
  std::string names;
  for (const auto& [key, block] : blocks_) {
    if (block.placed || block.items.empty() || shown.contains(key)) continue;
    entities += block.items.size();
    if (++blocks <= kNamed) names += (blocks > 1 ? ", " : "") + block.name;
  }
  if (blocks == 0) return;
  lines.push_back(core::counted(entities, "entity", "entities") + " of " +
                  core::counted(blocks, "block") + " that nothing inserts: " + names +
                  (blocks > kNamed ? " and others" : ""));
}

}  // namespace keyline::exchange::detail
