#pragma once

#include <functional>
#include <string>

#include "keyline/document/document.h"

class TopoDS_Shape;

namespace keyline::exchange::occt {

/// Goes through a shape and adds its faces and free edges to a document. Labels come from
/// `own_label` (empty fields: none) and are handed down to parts that have none; a part of several
/// in something named is "name/face-1", one in something unnamed "face-1".
class ShapeWalk {
 public:
  using OwnLabel = std::function<document::Label(const TopoDS_Shape&)>;

  ShapeWalk(document::Document& document, OwnLabel own_label)
      : document_(document), own_label_(std::move(own_label)) {}

  void add(const TopoDS_Shape& shape, const document::Label& outer);
  /// Says what was met and is no curve or surface.
  void finish();

 private:
  void add_face(const TopoDS_Shape& shape, document::Label label);
  void add_edge(const TopoDS_Shape& shape, document::Label label);
  void skip(const std::string& name, const char* why);

  document::Document& document_;
  OwnLabel own_label_;
  int faces_ = 0;
  int edges_ = 0;
  int points_ = 0;
};

}  // namespace keyline::exchange::occt
