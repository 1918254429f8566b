#pragma once

#include <map>
#include <string>
#include <vector>

#include "keyline/exchange/dxf/dxf_entity.h"

namespace keyline::exchange::detail {

/// What a drawing holds beside its curves, and what it says of them that they do not: thickness and
/// width, and that they are not to be seen.
class DxfBeside {
 public:
  void take_layer(const DxfEntity& layer, const std::string& name);
  /// An entity that becomes a curve.
  void take(const DxfEntity& entity, const std::string& layer);
  /// One of a type that is no curve.
  void take_other(const DxfEntity& entity);
  void take_of_paper() { ++paper_; }
  /// A spline that is said to be closed and is not.
  void take_apart() { ++apart_; }
  /// A line for each kind there was.
  void tell(std::vector<std::string>& lines) const;

 private:
  struct UnseenLayer {
    std::string name;
    std::size_t entities = 0;
  };
  std::map<std::string, UnseenLayer> unseen_;  ///< by the name in small letters
  std::map<std::string, std::size_t> others_;
  std::size_t unread_ = 0;  ///< of a visibility that is no number
  std::size_t unread_layers_ = 0;
  std::size_t paper_ = 0;
  std::size_t invisible_ = 0;
  std::size_t fitted_ = 0;
  std::size_t apart_ = 0;
  std::size_t thick_ = 0;
  std::size_t wide_ = 0;
};

}  // namespace keyline::exchange::detail
