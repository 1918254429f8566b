#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPConstruct_Styles.hxx>
#include <STEPControl_Reader.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepBasic_ProductDefinitionRelationship.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_GeometricRepresentationItem.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_ColourRgb.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_OverRidingStyledItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_PresentationStyleByContext.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gp_XYZ.hxx>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "keyline/exchange/dxf/dxf_color.h"
#include "keyline/exchange/occt/part_labels.h"
#include "keyline/exchange/occt/reader.h"
#include "keyline/exchange/occt/shape_walk.h"
#include "keyline/exchange/occt/step_beside.h"
#include "keyline/exchange/occt/step_model.h"
#include "keyline/exchange/occt/value_check.h"

namespace keyline::exchange::occt {
namespace {

using document::Label;

std::string text(const Handle(TCollection_HAsciiString) & name) {
  if (name.IsNull()) return {};
  std::string text = name->ToCString();
  std::erase_if(text, [](char c) { return c == '\n' || c == '\r'; });  // lines broken within
  return text;
}

/// "NONE", blanks and what translators put where no name was given are no names.
std::string useful(const std::string& name) {
  const bool none = name.find_first_not_of(' ') == std::string::npos || name == "NONE" ||
                    name == "''" || name.starts_with("Open CASCADE STEP translator");
  if (none) return {};
  return name;
}

std::string hex(const Quantity_Color& color) {
  double r = 0;
  double g = 0;
  double b = 0;
  color.Values(r, g, b, Quantity_TOC_sRGB);
  const auto channel = [](double v) { return static_cast<int>(std::lround(255 * v)) & 255; };
  return detail::true_color(channel(r) << 16 | channel(g) << 8 | channel(b));
}

using Entities = std::set<const Standard_Transient*>;

bool is_intensity(double v) { return v >= 0 && v <= 1; }

/// Entities whose parameters are not those of their kind, which are told: OCCT takes nothing or 0
/// for what it cannot make out. Throws where that is geometry.
Entities unsound(const Handle(Interface_InterfaceModel) & model, document::Document& document) {
  Entities found;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    const auto check = model->Check(i, Standard_True);
    const auto color = Handle(StepVisual_ColourRgb)::DownCast(entity);
    std::string why;
    if (check->HasFailed())
      why = check->CFail(1);
    else if (!color.IsNull() && !(is_intensity(color->Red()) && is_intensity(color->Green()) &&
                                  is_intensity(color->Blue())))
      why = "a colour is three numbers from 0 to 1";
    if (why.empty()) continue;
    why = text(model->StringLabel(entity)) + ": " + why;
    if (entity->IsKind(STANDARD_TYPE(StepGeom_GeometricRepresentationItem)))
      throw std::runtime_error(why + "; mend the file");
    document.skipped.push_back(why);
    found.insert(entity.get());
  }
  return found;
}

/// Colours and layers by the entity they are given to.
class Looks {
 public:
  Looks(const Handle(XSControl_WorkSession) & session, const Entities& unsound)
      : unsound_(unsound) {
    STEPConstruct_Styles styles(session);
    std::vector<Style> all;
    if (styles.LoadStyles())
      for (int i = 1; i <= styles.NbStyles(); ++i) all.push_back(styles.Style(i));
    const auto model = session->Model();
    for (int i = 1; i <= model->NbEntities(); ++i)  // also where no representation has them
      if (const auto over = Handle(StepVisual_OverRidingStyledItem)::DownCast(model->Value(i));
          !over.IsNull())
        all.push_back(over);
    // One that goes over others is met before them: the first of an item is its own.
    std::ranges::stable_sort(all, std::greater{}, overridden);
    for (const Style& style : all) add(styles, style);
    for (int i = 1; i <= model->NbEntities(); ++i) add_layer(model->Value(i));
    for (int i = 1; i <= model->NbEntities(); ++i) add_placement(model->Value(i));
  }

  void complete(Label& label, const Handle(Standard_Transient) & entity) const {
    if (const auto at = colors_.find(entity.get()); at != colors_.end()) label.color = at->second;
    if (const auto at = layers_.find(entity.get()); at != layers_.end()) label.layer = at->second;
  }

 private:
  using Style = Handle(StepVisual_StyledItem);

  /// How many styles a style goes over, one over the other.
  static std::size_t overridden(Style style) {
    std::set<const Standard_Transient*> met;
    while (!style.IsNull() && met.insert(style.get()).second) {
      const auto over = Handle(StepVisual_OverRidingStyledItem)::DownCast(style);
      style = over.IsNull() ? Style() : over->OverRiddenStyle();
    }
    return met.size() - 1;
  }

  /// The placement a style by context speaks of; null for others.
  static const Standard_Transient* context_of(const Style& style) {
    for (int i = 1; i <= style->NbStyles(); ++i)
      if (const auto by =
              Handle(StepVisual_PresentationStyleByContext)::DownCast(style->StylesValue(i));
          !by.IsNull())
        return by->StyleContext().Representation().get();
    return nullptr;
  }

  void add(STEPConstruct_Styles& styles, const Style& style) {
    Handle(StepVisual_Colour) surface;
    Handle(StepVisual_Colour) border;
    Handle(StepVisual_Colour) curve;
    Handle(StepVisual_Colour) rendered;
    double transparency = 0;
    bool component = false;
    if (!styles.GetColors(style, surface, border, curve, rendered, transparency, component)) return;
    Quantity_Color color;
    for (const auto& found : {surface, curve, border, rendered})
      if (!found.IsNull() && !unsound_.contains(found.get()) &&
          STEPConstruct_Styles::DecodeColor(found, color)) {
        const Standard_Transient* context = context_of(style);
        colors_.emplace(context ? context : style->Item().get(), hex(color));
        return;
      }
  }

  /// A style of one placement stands in a representation defined for that placement.
  void add_placement(const Handle(Standard_Transient) & entity) {
    const auto defined = Handle(StepShape_ShapeDefinitionRepresentation)::DownCast(entity);
    if (defined.IsNull() || defined->UsedRepresentation().IsNull()) return;
    const auto color = colors_.find(defined->UsedRepresentation().get());
    if (color == colors_.end()) return;
    const auto shape = defined->Definition().PropertyDefinition();
    if (shape.IsNull()) return;
    const auto usage = shape->Definition().ProductDefinitionRelationship();
    if (!usage.IsNull()) colors_.emplace(usage.get(), color->second);
  }

  void add_layer(const Handle(Standard_Transient) & entity) {
    const auto layer = Handle(StepVisual_PresentationLayerAssignment)::DownCast(entity);
    if (layer.IsNull() || layer->AssignedItems().IsNull()) return;
    for (int i = 1; i <= layer->NbAssignedItems(); ++i)
      layers_.emplace(layer->AssignedItemsValue(i).Value().get(), text(layer->Name()));
  }

  const Entities& unsound_;
  std::map<const Standard_Transient*, std::string> colors_;
  std::map<const Standard_Transient*, std::string> layers_;
};

std::string name_of(const Handle(Standard_Transient) & entity) {
  if (const auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity))
    return useful(text(item->Name()));
  Handle(StepBasic_ProductDefinition) product =
      Handle(StepBasic_ProductDefinition)::DownCast(entity);
  if (const auto shape = Handle(StepShape_ShapeDefinitionRepresentation)::DownCast(entity))
    if (const auto property = shape->Definition().PropertyDefinition(); !property.IsNull())
      product = property->Definition().ProductDefinition();
  if (product.IsNull() || product->Formation().IsNull()) return {};
  return useful(text(product->Formation()->OfProduct()->Name()));
}

/// OCCT's name of the file's unit of length, and ours. A file without one is in mm, as OCCT takes
/// it, which is said.
std::pair<const char*, const char*> unit_of(STEPControl_Reader& reader,
                                            document::Document& document) {
  TColStd_SequenceOfAsciiString lengths;
  TColStd_SequenceOfAsciiString angles;
  TColStd_SequenceOfAsciiString solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  TCollection_AsciiString unit = lengths.IsEmpty() ? "" : lengths.First();
  if (unit.IsEmpty())
    document.skipped.emplace_back("a unit of length, which the file does not tell: taken as mm");
  unit.LowerCase();
  const std::string name = unit.ToCString();
  if (name == "inch" || name == "inches") return {"INCH", "in"};
  if (name == "foot" || name == "feet") return {"FT", "ft"};
  if (name == "metre" || name == "meter") return {"M", "m"};
  if (name == "centimetre" || name == "centimeter") return {"CM", "cm"};
  if (name == "kilometre" || name == "kilometer") return {"KM", "km"};
  return {"MM", "mm"};
}

/// OCCT places what a CARTESIAN_TRANSFORMATION_OPERATOR_3D maps, but neither scales nor mirrors it.
bool is_rigid(const StepGeom_CartesianTransformationOperator3d& map) {
  if (map.HasScale() && std::abs(map.Scale() - 1) > 1e-12) return false;
  if (!map.HasAxis1() || !map.HasAxis2() || !map.HasAxis3()) return true;
  const auto vector = [](const Handle(StepGeom_Direction) & d) {
    return d->NbDirectionRatios() < 3
               ? gp_XYZ(0, 0, 0)
               : gp_XYZ(d->DirectionRatiosValue(1), d->DirectionRatiosValue(2),
                        d->DirectionRatiosValue(3));
  };
  return vector(map.Axis1()).Crossed(vector(map.Axis2())).Dot(vector(map.Axis3())) >= 0;
}

void note_distorted(document::Document& document, const Handle(Interface_InterfaceModel) & model) {
  int count = 0;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto map =
            Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(model->Value(i));
        !map.IsNull() && !is_rigid(*map))
      ++count;
  if (count > 0)
    document.skipped.push_back("the scale or mirroring of " + std::to_string(count) +
                               (count == 1 ? " placement" : " placements") +
                               ": parts stand there in their own size and hand");
}

}  // namespace

document::Document read_step(const std::string& file) {
  const StepCheck values = check_step_values(text_of(file));
  if (!values.bad.empty()) throw std::runtime_error(values.bad + "; mend the file");
  STEPControl_Reader reader;
  std::istringstream mended(values.mended);
  if ((values.mended.empty() ? reader.ReadFile(file.c_str())
                             : reader.ReadStream(file.c_str(), mended)) != IFSelect_RetDone)
    throw std::runtime_error("this is no STEP file that can be read; check that it is complete");
  document::Document document;
  const Entities unsound_entities = unsound(reader.WS()->Model(), document);
  const auto [occt_unit, unit] = unit_of(reader, document);
  document.unit = unit;
  Interface_Static::SetCVal("xstep.cascade.unit", occt_unit);
  mend_step_model(reader.WS()->Model());
  const int roots = reader.NbRootsForTransfer();
  const int done = reader.TransferRoots();
  if (done < roots)
    document.skipped.push_back(std::to_string(roots - done) + " of " + std::to_string(roots) +
                               " things could not be made into shapes");
  const Looks looks(reader.WS(), unsound_entities);
  const PartLabels labels(reader.WS(), [&](const Handle(Standard_Transient) & entity) {
    EntityLabel own{{name_of(entity), {}, {}}, false};
    own.placement = !Handle(StepRepr_NextAssemblyUsageOccurrence)::DownCast(entity).IsNull();
    looks.complete(own.label, entity);
    return own;
  });
  ShapeWalk walk(document, labels);
  for (int i = 1; i <= reader.NbShapes(); ++i) walk.add(reader.Shape(i));
  walk.finish();
  note_distorted(document, reader.WS()->Model());
  tell_step_beside(reader.WS(), document.skipped);
  return document;
}

}  // namespace keyline::exchange::occt
