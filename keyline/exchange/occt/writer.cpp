#include "keyline/exchange/occt/writer.h"

#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <TransferBRep_ShapeMapper.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <sstream>
#include <stdexcept>

#include "keyline/exchange/occt/geometry.h"

namespace keyline::exchange::occt {
namespace {

const char* occt_unit(const std::string& unit) {
  if (unit == "in") return "INCH";
  if (unit == "ft") return "FT";
  if (unit == "cm") return "CM";
  if (unit == "m") return "M";
  if (unit == "km") return "KM";
  return "MM";
}

/// Calls add(shape, label) for everything in the document.
template <class Add>
void for_each_shape(const document::Document& document, Add&& add) {
  for (const auto& named : document.paths)
    for (const auto& c : named.path.curves) add(edge_of(c), named.label);
  for (const auto& named : document.space_curves) add(edge_of(named.curve), named.label);
  for (const auto& named : document.surfaces) add(face_of(named.surface), named.label);
}

void name_item(const STEPControl_Writer& writer, const TopoDS_Shape& shape,
               const std::string& name) {
  const auto process = writer.WS()->TransferWriter()->FinderProcess();
  const Handle(TransferBRep_ShapeMapper) mapper = TransferBRep::ShapeMapper(process, shape);
  Handle(StepRepr_RepresentationItem) item;
  if (process->FindTypedTransient(mapper, STANDARD_TYPE(StepRepr_RepresentationItem), item))
    item->SetName(new TCollection_HAsciiString(name.c_str()));
}

/// OCCT numbers the products it makes; here every thing has its own name.
void name_products(const Handle(Interface_InterfaceModel) & model, int before,
                   const std::string& name) {
  for (int i = before + 1; i <= model->NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i))) {
      product->SetId(new TCollection_HAsciiString(name.c_str()));
      product->SetName(new TCollection_HAsciiString(name.c_str()));
    }
}

/// The model as text with all digits a double has, in place of twelve or nine decimals.
template <class FileWriter, class Protocol, class Model>
std::string printed(const Handle(Model) & model, const Handle(XSControl_WorkSession) & session) {
  FileWriter file(model);
  file.FloatWriter().SetFormat("%.16E");
  file.SendModel(Handle(Protocol)::DownCast(session->Protocol()));
  std::ostringstream text;
  if (!file.Print(text)) throw std::runtime_error("the file cannot be put into text");
  return text.str();
}

}  // namespace

std::string write_step(const document::Document& document) {
  const char* unit = occt_unit(document.unit);
  Interface_Static::SetCVal("xstep.cascade.unit", unit);
  Interface_Static::SetCVal("write.step.unit", unit);
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  STEPControl_Writer writer;
  for_each_shape(document, [&](const TopoDS_Shape& shape, const document::Label& label) {
    const std::string name = label.name.empty() ? "keyline" : label.name;
    const int before = writer.Model()->NbEntities();
    const auto mode =
        shape.ShapeType() == TopAbs_EDGE ? STEPControl_GeometricCurveSet : STEPControl_AsIs;
    if (writer.Transfer(shape, mode) != IFSelect_RetDone)
      throw std::runtime_error("\"" + name + "\" cannot be written as STEP");
    name_item(writer, shape, name);
    name_products(writer.Model(), before, name);
  });
  return printed<StepData_StepWriter, StepData_Protocol, StepData_StepModel>(writer.Model(),
                                                                             writer.WS());
}

std::string write_iges(const document::Document& document) {
  const char* unit = occt_unit(document.unit);
  Interface_Static::SetCVal("xstep.cascade.unit", unit);
  IGESControl_Writer writer(unit, 0);
  const double millimetres = document::millimetres(document.unit);
  writer.Model()->ChangeGlobalSection().SetCascadeUnit(millimetres > 0 ? millimetres : 1);
  const auto name = [&](int before, const document::Label& label) {
    if (label.name.empty()) return;
    const auto model = writer.Model();
    Handle(IGESBasic_Name) property = new IGESBasic_Name;
    property->Init(1, new TCollection_HAsciiString(label.name.c_str()));
    for (int i = before + 1; i <= model->NbEntities(); ++i) {
      const auto entity = Handle(IGESData_IGESEntity)::DownCast(model->Value(i));
      constexpr int kTransformation = 124;
      if (!entity.IsNull() && entity->TypeNumber() < 200 && entity->TypeNumber() != kTransformation)
        entity->AddProperty(property);
    }
    writer.AddEntity(property);
  };
  for_each_shape(document, [&](const TopoDS_Shape& shape, const document::Label& label) {
    const int before = writer.Model()->NbEntities();
    if (!writer.AddShape(shape))
      throw std::runtime_error("\"" + label.name + "\" cannot be written as IGES");
    name(before, label);
  });
  writer.ComputeModel();
  Handle(XSControl_WorkSession) session = new XSControl_WorkSession;
  session->SelectNorm("IGES");
  return printed<IGESData_IGESWriter, IGESData_Protocol, IGESData_IGESModel>(writer.Model(),
                                                                             session);
}

}  // namespace keyline::exchange::occt
