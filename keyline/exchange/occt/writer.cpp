#include "keyline/exchange/occt/writer.h"

#include <IGESAppli_LevelFunction.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESGraph_Color.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPConstruct_Styles.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepGeom_CompositeCurve.hxx>
#include <StepGeom_CompositeCurveSegment.hxx>
#include <StepGeom_HArray1OfCompositeCurveSegment.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_GeometricSetSelect.hxx>
#include <StepShape_HArray1OfGeometricSetSelect.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_HArray1OfLayeredItem.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_MechanicalDesignGeometricPresentationRepresentation.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_PresentationStyleAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TColStd_SequenceOfTransient.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <TransferBRep_ShapeMapper.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <sstream>
#include <stdexcept>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/document/color.h"
#include "keyline/exchange/occt/shapes.h"

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
  for (const auto& named : document.paths) add(shape_of(named.path), named.label);
  for (const auto& named : document.space_curves) add(edge_of(named.curve), named.label);
  for (const auto& named : document.surfaces) add(face_of(named.surface), named.label);
}

/// In what is told.
std::string called(const document::Label& label) {
  return label.name.empty() ? "a thing without a name" : "\"" + label.name + "\"";
}

Handle(TCollection_HAsciiString) one_line(const std::string& text) {
  return new TCollection_HAsciiString(core::on_one_line(text).c_str());
}

/// What became of a shape in the file; null where nothing did.
Handle(StepRepr_RepresentationItem)
    item_of(const STEPControl_Writer& writer, const TopoDS_Shape& shape) {
  const auto process = writer.WS()->TransferWriter()->FinderProcess();
  const Handle(TransferBRep_ShapeMapper) mapper = TransferBRep::ShapeMapper(process, shape);
  Handle(StepRepr_RepresentationItem) item;
  process->FindTypedTransient(mapper, STANDARD_TYPE(StepRepr_RepresentationItem), item);
  return item;
}

/// Makes one composite curve of the curves OCCT wrote of a wire behind the first `before` entities;
/// null where there is no set of curves.
Handle(StepRepr_RepresentationItem)
    composite(const Handle(Interface_InterfaceModel) & model, int before, bool closed) {
  for (int i = before + 1; i <= model->NbEntities(); ++i) {
    const auto set = Handle(StepShape_GeometricSet)::DownCast(model->Value(i));
    if (set.IsNull()) continue;
    const int count = set->NbElements();
    Handle(StepGeom_HArray1OfCompositeCurveSegment) segments =
        new StepGeom_HArray1OfCompositeCurveSegment(1, count);
    for (int k = 1; k <= count; ++k) {
      Handle(StepGeom_CompositeCurveSegment) segment = new StepGeom_CompositeCurveSegment;
      segment->Init(k < count || closed ? StepGeom_tcContinuous : StepGeom_tcDiscontinuous, true,
                    set->ElementsValue(k).Curve());
      segments->SetValue(k, segment);
    }
    Handle(StepGeom_CompositeCurve) curve = new StepGeom_CompositeCurve;
    curve->Init(new TCollection_HAsciiString(""), segments, StepData_LUnknown);
    StepShape_GeometricSetSelect only;
    only.SetValue(curve);
    Handle(StepShape_HArray1OfGeometricSetSelect) elements =
        new StepShape_HArray1OfGeometricSetSelect(1, 1);
    elements->SetValue(1, only);
    set->SetElements(elements);
    Handle(StepData_StepModel)::DownCast(model)->AddWithRefs(curve);
    return curve;
  }
  return {};
}

/// OCCT numbers the products it makes; here every thing has its own name, or none.
void name_products(const Handle(Interface_InterfaceModel) & model, int before,
                   const std::string& name) {
  for (int i = before + 1; i <= model->NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i))) {
      product->SetId(one_line(name));
      product->SetName(one_line(name));
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

namespace {

/// Colours and layers of the things of a STEP file.
class StepLooks {
 public:
  explicit StepLooks(STEPControl_Writer& writer) : writer_(writer), styles_(writer.WS()) {}

  void add(const TopoDS_Shape& shape, const Handle(StepRepr_RepresentationItem) & item,
           const document::Label& label) {
    if (item.IsNull()) return;
    if (!label.layer.empty()) layers_[label.layer].Append(item);
    const int rgb = document::color_value(label.color);
    if (rgb < 0) return;
    const Quantity_Color color((rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0,
                               (rgb & 255) / 255.0, Quantity_TOC_sRGB);
    const Handle(StepVisual_Colour) none;
    const Handle(StepVisual_Colour) own = STEPConstruct_Styles::EncodeColor(color);
    const bool curve = shape.ShapeType() == TopAbs_EDGE || shape.ShapeType() == TopAbs_WIRE;
    styles_.ClearStyles();
    styles_.AddStyle(
        item, styles_.MakeColorPSA(item, curve ? none : own, curve ? own : none, none, 0), {});
    Handle(StepVisual_MechanicalDesignGeometricPresentationRepresentation) picture;
    if (styles_.CreateMDGPR(styles_.FindContext(shape), picture))
      writer_.Model()->AddWithRefs(picture);
  }

  void finish() {
    for (auto& [name, items] : layers_) {
      const Handle(StepVisual_HArray1OfLayeredItem) all =
          new StepVisual_HArray1OfLayeredItem(1, items.Length());
      for (int i = 1; i <= items.Length(); ++i) all->ChangeValue(i).SetValue(items(i));
      Handle(StepVisual_PresentationLayerAssignment) layer =
          new StepVisual_PresentationLayerAssignment;
      layer->Init(one_line(name), new TCollection_HAsciiString("visible"), all);
      writer_.Model()->AddWithRefs(layer);
    }
  }

 private:
  STEPControl_Writer& writer_;
  STEPConstruct_Styles styles_;
  std::map<std::string, TColStd_SequenceOfTransient> layers_;
};

}  // namespace

namespace {

/// As ISO 10303-21 writes what is not ASCII in strings.
void append_code_point(std::string& text, unsigned code) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  const bool wide = code > 0xffff;
  text += wide ? "\\X4\\" : "\\X2\\";
  for (int shift = wide ? 28 : 12; shift >= 0; shift -= 4) text += kDigits[code >> shift & 15];
  text += "\\X0\\";
}

/// OCCT breaks lines within strings, even within a character, and writes UTF-8 bytes: strings are
/// put on one line again and into the escapes of the standard.
std::string with_standard_strings(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  bool inside = false;
  std::string string;
  for (const char c : text) {
    if (c == '\'') {
      for (std::size_t at = 0; at < string.size();) {
        const unsigned code = core::code_point(string, at);
        if (code < 0x80)
          result += static_cast<char>(code);
        else
          append_code_point(result, code);
      }
      string.clear();
      inside = !inside;
      result += c;
    } else if (!inside) {
      result += c;
    } else if (c != '\n') {
      string += c;
    }
  }
  return result;
}

}  // namespace

std::string write_step(const document::Document& document) {
  const char* unit = occt_unit(document.unit);
  Interface_Static::SetCVal("xstep.cascade.unit", unit);
  Interface_Static::SetCVal("write.step.unit", unit);
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  STEPControl_Writer writer;
  StepLooks looks(writer);
  for_each_shape(document, [&](const TopoDS_Shape& shape, const document::Label& label) {
    const int before = writer.Model()->NbEntities();
    const bool wire = shape.ShapeType() == TopAbs_WIRE;
    const auto mode = wire ? STEPControl_GeometricCurveSet : STEPControl_AsIs;
    // Without the graph of the whole model, which nobody asks: it would be made anew every time.
    if (writer.Transfer(shape, mode, Standard_False) != IFSelect_RetDone)
      throw std::runtime_error(called(label) + " cannot be written as STEP");
    const auto item =
        wire ? composite(writer.Model(), before, shape.Closed()) : item_of(writer, shape);
    if (!item.IsNull()) item->SetName(one_line(label.name));
    name_products(writer.Model(), before, label.name);
    looks.add(shape, item, label);
  });
  looks.finish();
  return with_standard_strings(printed<StepData_StepWriter, StepData_Protocol, StepData_StepModel>(
      writer.Model(), writer.WS()));
}

namespace {

/// Names, colours and levels of the things of an IGES file.
class IgesLooks {
 public:
  explicit IgesLooks(IGESControl_Writer& writer) : writer_(writer) {}

  /// Labels the geometry added to the model behind the first `before` entities.
  void add(int before, const document::Label& label) {
    const auto model = writer_.Model();
    Handle(IGESBasic_Name) name;
    if (!label.name.empty()) {
      name = new IGESBasic_Name;
      name->Init(1, one_line(label.name));
    }
    const Handle(IGESGraph_Color) color = color_of(document::color_value(label.color));
    const int level = level_of(label.layer);
    for (int i = before + 1; i <= model->NbEntities(); ++i) {
      const auto entity = Handle(IGESData_IGESEntity)::DownCast(model->Value(i));
      constexpr int kTransformation = 124;
      if (entity.IsNull() || entity->TypeNumber() >= 200 || entity->TypeNumber() == kTransformation)
        continue;
      if (!name.IsNull()) entity->AddProperty(name);
      looks_.push_back({entity, color, level});
    }
    if (!name.IsNull()) writer_.AddEntity(name);
  }

  /// Levels are numbers in the file: what they are called is said beside.
  void finish() {
    for (const auto& [layer, level] : levels_) {
      if (layer == std::to_string(level)) continue;
      Handle(IGESAppli_LevelFunction) named = new IGESAppli_LevelFunction;
      named->Init(2, 0, one_line(layer));
      writer_.AddEntity(named);
      looks_.push_back({named, {}, level});
    }
    writer_.ComputeModel();  // takes them away from properties and composite curves
    for (const Look& look : looks_) {
      if (!look.color.IsNull()) look.entity->InitColor(look.color);
      if (look.level > 0) look.entity->InitLevel({}, look.level);
    }
  }

 private:
  struct Look {
    Handle(IGESData_IGESEntity) entity;
    Handle(IGESGraph_Color) color;
    int level = 0;
  };

  Handle(IGESGraph_Color) color_of(int rgb) {
    if (rgb < 0) return {};
    Handle(IGESGraph_Color)& color = colors_[rgb];
    if (color.IsNull()) {
      const auto percent = [rgb](int shift) { return (rgb >> shift & 255) / 2.55; };
      color = new IGESGraph_Color;
      color->Init(percent(16), percent(8), percent(0), {});
      writer_.AddEntity(color);
    }
    return color;
  }

  /// A layer that is a number keeps it; others get the next ones above a thousand.
  int level_of(const std::string& layer) {
    if (layer.empty()) return 0;
    const auto known = levels_.find(layer);
    if (known != levels_.end()) return known->second;
    constexpr int kNamed = 1000;
    int level = core::parse_whole<int>(layer).value_or(0);
    if (level <= 0 || level > kNamed || layer != std::to_string(level))
      level = kNamed + 1 + static_cast<int>(levels_.size());
    return levels_[layer] = level;
  }

  IGESControl_Writer& writer_;
  std::map<int, Handle(IGESGraph_Color)> colors_;
  std::map<std::string, int> levels_;
  std::vector<Look> looks_;
};

}  // namespace

std::string write_iges(const document::Document& document) {
  const char* unit = occt_unit(document.unit);
  Interface_Static::SetCVal("xstep.cascade.unit", unit);
  IGESControl_Writer writer(unit, 0);
  const double millimetres = document::millimetres(document.unit);
  writer.Model()->ChangeGlobalSection().SetCascadeUnit(millimetres > 0 ? millimetres : 1);
  IgesLooks looks(writer);
  for_each_shape(document, [&](const TopoDS_Shape& shape, const document::Label& label) {
    const int before = writer.Model()->NbEntities();
    if (!writer.AddShape(shape))
      throw std::runtime_error(called(label) + " cannot be written as IGES");
    looks.add(before, label);
  });
  looks.finish();
  Handle(XSControl_WorkSession) session = new XSControl_WorkSession;
  session->SelectNorm("IGES");
  return printed<IGESData_IGESWriter, IGESData_Protocol, IGESData_IGESModel>(writer.Model(),
                                                                             session);
}

}  // namespace keyline::exchange::occt
