#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/exchange/dxf/dxf_entity.h"

namespace keyline::exchange::detail {

/// One thing of a block or of the drawing, not yet placed.
struct DxfItem {
  std::string_view type;
  std::uint32_t place = 0;
  std::string name;  ///< ours; of an insert, else, its block's
  std::string layer;
  int color = 256;    ///< index; 0: of the insert, 256: of the layer
  std::string exact;  ///< true colour; empty: by index
  std::optional<DxfCurve> curve;
  std::string block;  ///< of an insert
  std::vector<Affine3> places;
};

struct DxfBlock {
  std::string name;
  core::Point3 base;
  bool external = false;  ///< it is another drawing (XREF)
  std::string file;       ///< of that
  bool paper = false;     ///< what stands on a layout
  bool placed = false;
  std::vector<DxfItem> items;
};

/// Blocks by their names, in which small and large letters are the same, as in all tables of a DXF.
class DxfBlocks {
 public:
  /// The block that begins with this entity, in place of an earlier one of its name.
  DxfBlock& start(const DxfEntity& entity);
  /// Null where there is none. Blocks stay where they are.
  DxfBlock* find(const std::string& name);
  /// An entity that is no curve: a dimension or table shows the block that it names.
  void take_other(const DxfEntity& entity);
  /// An insert on a layout, which is not read, shows its block there.
  void take_of_paper(const DxfEntity& insert);
  /// What stands in blocks that nothing shows.
  void tell(std::vector<std::string>& lines) const;

 private:
  std::set<std::string> all_shown() const;

  std::map<std::string, DxfBlock> blocks_;
  std::set<std::string> shown_;
};

}  // namespace keyline::exchange::detail
