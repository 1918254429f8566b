#include "keyline/exchange/occt/shape_origins.h"

#include <NCollection_DataMap.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

namespace keyline::exchange::occt {

struct ShapeOrigins::Map {
  NCollection_DataMap<TopoDS_Shape, Entities, TopTools_ShapeMapHasher> entities;
};

ShapeOrigins::ShapeOrigins(const XSControl_WorkSession& session) : map_(std::make_unique<Map>()) {
  const auto process = session.TransferReader()->TransientProcess();
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const Handle(Transfer_Binder) binder = process->MapItem(i);
    if (binder.IsNull()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(binder);
    if (shape.IsNull()) continue;
    if (Entities* known = map_->entities.ChangeSeek(shape))
      known->push_back(process->Mapped(i).get());
    else
      map_->entities.Bind(shape, {process->Mapped(i).get()});
  }
}

ShapeOrigins::~ShapeOrigins() = default;

const ShapeOrigins::Entities& ShapeOrigins::of(const TopoDS_Shape& shape) const {
  static const Entities none;
  if (const Entities* found = map_->entities.Seek(shape)) return *found;
  const Entities* unmoved = map_->entities.Seek(shape.Located(TopLoc_Location()));
  return unmoved ? *unmoved : none;
}

}  // namespace keyline::exchange::occt
