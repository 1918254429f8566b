#include "keyline/exchange/occt/part_labels.h"

#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <climits>

namespace keyline::exchange::occt {
namespace {

using document::Label;

/// Fills the fields that are still empty.
void complete(Label& label, const Label& more) {
  if (label.name.empty()) label.name = more.name;
  if (label.layer.empty()) label.layer = more.layer;
  if (label.color.empty()) label.color = more.color;
}

template <class Map, class Key>
Label found(const Map& map, const Key& key) {
  const auto at = map.find(key);
  return at == map.end() ? Label{} : at->second;
}

}  // namespace

PartLabels::Placed PartLabels::placed(const TopoDS_Shape& shape) {
  return {static_cast<std::size_t>(shape.Location().HashCode(INT_MAX)), shape.TShape().get()};
}

PartLabels::PartLabels(const Handle(XSControl_WorkSession) & session, const OfEntity& of_entity) {
  const auto process = session->TransferReader()->TransientProcess();
  if (process.IsNull()) return;
  // Roots are mapped before what they hold: the name of a product comes before that of its body.
  for (int i = 1; i <= process->NbMapped(); ++i) {
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process->MapItem(i));
    if (shape.IsNull()) continue;
    const EntityLabel own = of_entity(process->Mapped(i));
    if (own.placement)
      complete(placements_[placed(shape)], own.label);
    else
      complete(parts_[shape.TShape().get()], own.label);
  }
}

Label PartLabels::of_part(const TopoDS_Shape& shape) const {
  return found(parts_, static_cast<const void*>(shape.TShape().get()));
}

Label PartLabels::of_placement(const TopoDS_Shape& shape) const {
  return found(placements_, placed(shape));
}

}  // namespace keyline::exchange::occt
