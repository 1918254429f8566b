#pragma once

#include <memory>
#include <vector>

class Standard_Transient;
class TopoDS_Shape;
class XSControl_WorkSession;

namespace keyline::exchange::occt {

/// Which entities of a file a shape was made from, by one pass over all that were transferred in
/// the session. OCCT's own XSControl_TransferReader::EntityFromShapeResult() searches the whole
/// file for every shape.
class ShapeOrigins {
 public:
  using Entities = std::vector<const Standard_Transient*>;

  explicit ShapeOrigins(const XSControl_WorkSession& session);
  ~ShapeOrigins();

  /// Those of the shape where it stands; if there are none, those of the same shape unmoved. They
  /// live as long as the session.
  const Entities& of(const TopoDS_Shape& shape) const;

 private:
  struct Map;
  std::unique_ptr<Map> map_;
};

}  // namespace keyline::exchange::occt
