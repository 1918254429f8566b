#pragma once

#include <optional>
#include <string>

#include "keyline/exchange/dxf/dxf_tags.h"

namespace keyline::exchange::detail {

/// What the header says of the whole drawing.
class DxfHeader {
 public:
  /// A group of it. Returns what is wrong with it; empty where nothing is.
  std::string take(const DxfTag& tag, const std::string& place);

  const std::string& unit() const { return unit_; }            ///< ours; empty: none
  double scale() const { return scale_; }                      ///< from the drawing's unit to ours
  const std::string& code_page() const { return code_page_; }  ///< of text that is not UTF-8

 private:
  std::string variable_;
  std::string code_page_;
  std::optional<int> given_;  ///< $INSUNITS
  std::string unit_;
  double scale_ = 1;
};

}  // namespace keyline::exchange::detail
