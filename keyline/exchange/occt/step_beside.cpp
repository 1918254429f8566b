#include "keyline/exchange/occt/step_beside.h"

#include <Interface_InterfaceModel.hxx>
#include <StepVisual_Invisibility.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_PresentationRepresentation.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <set>

#include "keyline/core/text.h"

namespace keyline::exchange::occt {
namespace {

/// What is not to be seen, by its layer; by itself under no name.
class Unseen {
 public:
  explicit Unseen(const Handle(XSControl_WorkSession) & session)
      : process_(session->TransferReader()->TransientProcess()) {
    const auto model = session->Model();
    for (int i = 1; i <= model->NbEntities(); ++i)
      if (const auto found = Handle(StepVisual_Invisibility)::DownCast(model->Value(i));
          !found.IsNull() && !found->InvisibleItems().IsNull())
        for (int k = 1; k <= found->NbInvisibleItems(); ++k) take(found->InvisibleItemsValue(k));
  }

  const std::map<std::string, std::set<const Standard_Transient*>>& by_layer() const {
    return by_layer_;
  }

 private:
  void take(const StepVisual_InvisibleItem& item) {
    if (const auto layer = item.PresentationLayerAssignment(); !layer.IsNull()) {
      const std::string name = layer->Name().IsNull() ? "" : layer->Name()->ToCString();
      if (layer->AssignedItems().IsNull()) return;
      for (int i = 1; i <= layer->NbAssignedItems(); ++i)
        add(name, layer->AssignedItemsValue(i).Value());
    } else if (const auto style = item.StyledItem(); !style.IsNull()) {
      add({}, style->Item());
    } else if (const auto all = item.PresentationRepresentation();
               !all.IsNull() && !all->Items().IsNull()) {
      for (int i = 1; i <= all->NbItems(); ++i)
        if (const auto of = Handle(StepVisual_StyledItem)::DownCast(all->ItemsValue(i));
            !of.IsNull())
          add({}, of->Item());
    }
  }

  void add(const std::string& layer, const Handle(Standard_Transient) & entity) {
    if (!entity.IsNull() && !TransferBRep::ShapeResult(process_, entity).IsNull())
      by_layer_[layer].insert(entity.get());
  }

  Handle(Transfer_TransientProcess) process_;
  std::map<std::string, std::set<const Standard_Transient*>> by_layer_;
};

}  // namespace

void tell_step_beside(const Handle(XSControl_WorkSession) & session,
                      std::vector<std::string>& lines) {
  const Unseen unseen(session);
  for (const auto& [layer, entities] : unseen.by_layer())
    lines.push_back("nothing, but not to be seen: " +
                    (layer.empty() ? "" : "layer " + core::on_one_line(layer) + ", ") +
                    core::counted(entities.size(), "entity", "entities"));
}

}  // namespace keyline::exchange::occt
