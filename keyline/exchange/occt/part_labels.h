#pragma once

#include <functional>
#include <map>

#include "keyline/document/document.h"

namespace opencascade {
template <class T>
class handle;
}
class Standard_Transient;
class TopLoc_Location;
class TopoDS_Shape;
class XSControl_WorkSession;

namespace keyline::exchange::occt {

/// What an entity of a file says of the shapes made from it.
struct EntityLabel {
  document::Label label;
  bool placement = false;  ///< speaks of one placement of a shared part, over what the part says
};

/// Labels of shapes by the entities they were made from. A shape is found wherever it is placed.
class PartLabels {
 public:
  using OfEntity = std::function<EntityLabel(const opencascade::handle<Standard_Transient>&)>;

  /// Looks at every entity the session has transferred.
  PartLabels(const opencascade::handle<XSControl_WorkSession>& session, const OfEntity& of_entity);

  /// What the file says of the shape itself; empty fields where it says nothing.
  document::Label of_part(const TopoDS_Shape& shape) const;
  /// What it says of this placement, the location being that within the shape around it.
  document::Label of_placement(const TopoDS_Shape& shape) const;

 private:
  struct Placed {
    std::size_t hash = 0;
    const void* part = nullptr;
    auto operator<=>(const Placed&) const = default;
  };
  static Placed placed(const TopoDS_Shape& shape);

  std::map<const void*, document::Label> parts_;
  std::map<Placed, document::Label> placements_;
};

}  // namespace keyline::exchange::occt
