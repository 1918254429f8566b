#pragma once

#include <string>

#include "keyline/document/document.h"
#include "keyline/exchange/occt/part_labels.h"

class TopLoc_Location;
class TopoDS_Shape;

namespace keyline::exchange::occt {

/// Goes through a shape and adds its faces and free edges to a document, in place. Labels are
/// handed down to parts that have none of their own; a part of several in something named is
/// "name/face-1" or "name/edge-1"; in something unnamed a face is "face-1", and a curve has no
/// name. The colour of a placement goes over those of the part placed.
class ShapeWalk {
 public:
  ShapeWalk(document::Document& document, const PartLabels& labels)
      : document_(document), labels_(labels) {}

  void add(const TopoDS_Shape& shape);
  /// Says what was met and is no curve or surface.
  void finish();

 private:
  struct Outer {
    document::Label label;
    std::string color;  ///< of the outermost placement that has one
  };

  /// `shape` with its location in what is around it, which stands at `location`.
  void add(const TopoDS_Shape& shape, const TopLoc_Location& location, Outer outer);
  void add_face(const TopoDS_Shape& shape, document::Label label);
  void add_edge(const TopoDS_Shape& shape, document::Label label);
  void add_wire(const TopoDS_Shape& shape, document::Label label);
  /// What the next edge is called in what is told.
  std::string next_edge(const document::Label& label) const;
  /// Counts one more and gives it its number where its label is that of several.
  /// Returns: what it is called in what is told.
  std::string number_edge(document::Label& label);
  void add_edges(const TopoDS_Shape& wire, const document::Label& label);
  void add_trims(const TopoDS_Shape& face, document::NamedSurface& named);
  void skip(const std::string& name, const std::string& why);
  void tell_deviation(const std::string& name, const char* what, double deviation);

  document::Document& document_;
  const PartLabels& labels_;
  int faces_ = 0;
  int edges_ = 0;
  int points_ = 0;
  int chains_in_space_ = 0;
};

}  // namespace keyline::exchange::occt
