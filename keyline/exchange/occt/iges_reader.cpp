#include <IGESAppli_LevelFunction.hxx>
#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_ColorEntity.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGraph_Color.hxx>
#include <Interface_Static.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "keyline/core/text.h"
#include "keyline/exchange/dxf/dxf_color.h"
#include "keyline/exchange/occt/iges_beside.h"
#include "keyline/exchange/occt/iges_model.h"
#include "keyline/exchange/occt/part_labels.h"
#include "keyline/exchange/occt/reader.h"
#include "keyline/exchange/occt/shape_walk.h"
#include "keyline/exchange/occt/value_check.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::occt {
namespace {

using document::Label;

std::string trimmed(const Handle(TCollection_HAsciiString) & name) {
  if (name.IsNull()) return {};
  std::string text = name->ToCString();
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string color_of(const Handle(IGESData_IGESEntity) & entity) {
  // IGES 5.3, section 2.2.4.4.13: numbers 1 to 8.
  static constexpr int kColors[] = {0,        0x000000, 0xff0000, 0x00ff00, 0x0000ff,
                                    0xffff00, 0xff00ff, 0x00ffff, 0xffffff};
  const int rank = entity->RankColor();
  if (rank >= 1 && rank <= 8) return detail::true_color(kColors[rank]);
  const auto color = Handle(IGESGraph_Color)::DownCast(entity->Color());
  if (color.IsNull()) return {};
  double r = 0;
  double g = 0;
  double b = 0;
  color->RGBIntensity(r, g, b);
  const auto channel = [](double v) { return static_cast<int>(std::lround(2.55 * v)) & 255; };
  return detail::true_color(channel(r) << 16 | channel(g) << 8 | channel(b));
}

using Levels = std::map<int, std::string>;

/// What the file calls its levels.
Levels levels_of(const Handle(Interface_InterfaceModel) & model) {
  Levels levels;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto named = Handle(IGESAppli_LevelFunction)::DownCast(model->Value(i)))
      levels.emplace(named->Level(), trimmed(named->FuncDescription()));
  return levels;
}

Label label_of(const Handle(IGESData_IGESEntity) & entity, const Levels& levels) {
  Label label;
  label.name = entity->HasName() ? trimmed(entity->NameValue()) : std::string();
  if (label.name.empty() && entity->HasShortLabel()) label.name = trimmed(entity->ShortLabel());
  if (label.name.ends_with("(0)")) label.name.resize(label.name.size() - 3);  // no subscript
  if (const int level = entity->Level(); level > 0) {
    const auto named = levels.find(level);
    label.layer = named == levels.end() ? std::to_string(level) : named->second;
  }
  label.color = color_of(entity);
  return label;
}

constexpr int kByName = 3;

/// Our name of the unit flag.
const char* unit_of(int flag) {
  switch (flag) {
    case 1:
      return "in";
    case 4:
      return "ft";
    case 6:
      return "m";
    case 7:
      return "km";
    case 10:
      return "cm";
    default:
      return "mm";
  }
}

/// Flag of the unit, in which 3 leaves it to the name (IGES 5.3, 2.2.4.3.14 and 15): then that of
/// the name, and still 3 where the table has no such name.
int unit_flag(int flag, const std::string& name) {
  static const std::map<std::string, int> kNames = {{"in", 1}, {"inch", 1}, {"mm", 2},  {"ft", 4},
                                                    {"mi", 5}, {"m", 6},    {"km", 7},  {"mil", 8},
                                                    {"um", 9}, {"cm", 10},  {"uin", 11}};
  if (flag != kByName) return flag;
  const auto named = kNames.find(detail::lower_case(name));
  return named == kNames.end() ? kByName : named->second;
}

/// Says which roots became no shapes, by label and entity type.
void note_unread(IGESControl_Reader& reader, document::Document& document) {
  constexpr int kMost = 1000;
  const auto process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= std::min(reader.NbRootsForTransfer(), kMost); ++i) {
    const auto root = Handle(IGESData_IGESEntity)::DownCast(reader.RootForTransfer(i));
    if (root.IsNull() || !TransferBRep::ShapeResult(process, root).IsNull()) continue;
    const std::string name = label_of(root, {}).name;
    const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(root);
    const bool scaled =
        !instance.IsNull() && instance->HasScaleFactor() && instance->ScaleFactor() != 1;
    document.skipped.push_back(
        (name.empty() ? "a thing" : name) + " (IGES entity " + std::to_string(root->TypeNumber()) +
        "): " +
        (scaled ? "scaled instances are not read" : "no curve or surface that can be read"));
  }
}

}  // namespace

document::Document read_iges(const std::string& file) {
  const std::string text = text_of(file);
  std::string bad = bad_iges_value(text);
  const std::string odd = odd_iges_line(text);
  if (bad.empty() && odd.empty()) bad = unordered_iges_line(text);
  if (!bad.empty()) throw std::runtime_error(bad + "; mend the file");
  IGESControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
    throw std::runtime_error("this is no IGES file that can be read; check that it is complete");
  document::Document document;
  IGESData_GlobalSection global = reader.IGESModel()->GlobalSection();
  const std::string unit = trimmed(global.UnitName());
  global.SetUnitFlag(unit_flag(global.UnitFlag(), unit));
  document.unit = unit_of(global.UnitFlag());
  if (global.UnitFlag() == kByName)
    document.skipped.push_back("the unit \"" + core::on_one_line(unit) +
                               "\", which IGES does not know: its numbers are taken for mm");
  // Shapes in the file's own unit: the kernel's unit is made that of the file.
  global.SetCascadeUnit(document::millimetres(document.unit));
  reader.IGESModel()->SetGlobalSection(global);
  Interface_Static::SetIVal("read.iges.bspline.continuity", 0);  // splines stay whole
  mend_iges_model(reader.IGESModel());
  const int roots = reader.NbRootsForTransfer();
  const int done = reader.TransferRoots();
  if (done < roots) note_unread(reader, document);
  const Levels levels = levels_of(reader.IGESModel());
  const PartLabels labels(reader.WS(), [&](const Handle(Standard_Transient) & entity) {
    const auto own = Handle(IGESData_IGESEntity)::DownCast(entity);
    if (own.IsNull()) return EntityLabel{};
    constexpr int kInstance = 408;
    return EntityLabel{label_of(own, levels), own->TypeNumber() == kInstance};
  });
  ShapeWalk walk(document, labels);
  const IgesBeside beside(reader);
  for (int i = 1; i <= reader.NbShapes(); ++i)
    if (!beside.holds(reader.Shape(i))) walk.add(reader.Shape(i));
  walk.finish();
  beside.tell(document.skipped);
  for (const std::string& lost : {odd, missing_iges_end(text), endless_iges_lines(text)})
    if (!lost.empty()) document.skipped.push_back(lost);
  return document;
}

}  // namespace keyline::exchange::occt
