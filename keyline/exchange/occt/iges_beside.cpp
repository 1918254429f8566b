#include "keyline/exchange/occt/iges_beside.h"

#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>

#include "keyline/core/text.h"

namespace keyline::exchange::occt {
namespace {

/// Whether a matrix keeps lengths and angles. Files round its numbers, to six digits at the least.
bool is_rigid(const IGESGeom_TransformationMatrix& matrix) {
  constexpr double kRounding = 1e-5;
  for (int i = 1; i <= 3; ++i)
    for (int j = i; j <= 3; ++j) {
      double product = 0;
      for (int k = 1; k <= 3; ++k) product += matrix.Data(k, i) * matrix.Data(k, j);
      if (!(std::abs(product - (i == j ? 1 : 0)) <= kRounding)) return false;
    }
  return true;
}

/// Whether its range is narrower than its knots (IGES 5.3, 4.24). OCCT 7.6 gives what the file has
/// second for VMin and what it has third for UMax; other versions may put that right.
bool is_part(const IGESGeom_BSplineSurface& s) {
  const double u1 = s.KnotU(0), u2 = s.KnotU(s.UpperIndexU() - s.DegreeU() + 1);
  const double v1 = s.KnotV(0), v2 = s.KnotV(s.UpperIndexV() - s.DegreeV() + 1);
  const auto is_whole = [&](double u_max, double v_min) {
    return s.UMin() <= u1 && u_max >= u2 && v_min <= v1 && s.VMax() >= v2;
  };
  return !is_whole(s.VMin(), s.UMax()) && !is_whole(s.UMax(), s.VMin());
}

constexpr int kAnnotation = 1;  // use flags, IGES 5.3, 2.2.4.4.9.3
constexpr int kInParameters = 5;
constexpr int kConstruction = 6;

}  // namespace

IgesBeside::IgesBeside(IGESControl_Reader& reader)
    : scale_(reader.IGESModel()->GlobalSection().Scale()) {
  const auto process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= reader.NbRootsForTransfer(); ++i) {
    const auto root = Handle(IGESData_IGESEntity)::DownCast(reader.RootForTransfer(i));
    if (root.IsNull() || root->UseFlag() != kInParameters) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, root);
    if (!shape.IsNull()) in_parameters_.insert(shape.TShape().get());
  }
  const auto model = reader.IGESModel();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(IGESData_IGESEntity) entity = model->Entity(i);
    const auto matrix = Handle(IGESGeom_TransformationMatrix)::DownCast(entity);
    scaled_ += !matrix.IsNull() && !is_rigid(*matrix);
    if (!TransferBRep::ShapeResult(process, entity).IsNull()) take(*entity);
  }
}

void IgesBeside::take(const IGESData_IGESEntity& entity) {
  // Of parts of another entity, that one counts; surfaces under faces are told as these are.
  if ((entity.SubordinateStatus() & 1) != 0) return;
  const auto* surface = dynamic_cast<const IGESGeom_BSplineSurface*>(&entity);
  parts_ += surface && is_part(*surface);
  unseen_ += entity.BlankStatus() == 1;
  annotation_ += entity.UseFlag() == kAnnotation;
  construction_ += entity.UseFlag() == kConstruction;
}

bool IgesBeside::holds(const TopoDS_Shape& root) const {
  return in_parameters_.contains(root.TShape().get());
}

void IgesBeside::tell(std::vector<std::string>& lines) const {
  const auto entities = [](std::size_t n) { return core::counted(n, "entity", "entities"); };
  if (unseen_ > 0) lines.push_back("nothing, but not to be seen: " + entities(unseen_));
  if (annotation_ > 0) lines.push_back("nothing, but annotation: " + entities(annotation_));
  if (construction_ > 0)
    lines.push_back("nothing, but for construction alone: " + entities(construction_));
  if (!in_parameters_.empty())
    lines.push_back(core::counted(in_parameters_.size(), "curve") +
                    " in the parameters of a surface");
  if (parts_ > 0)
    lines.push_back("the range of " + core::counted(parts_, "surface") +
                    ": all that the knots span is here");
  if (scaled_ > 0)
    lines.push_back(
        "nothing, but " +
        core::counted(scaled_, "matrix that scales or distorts", "matrices that scale or distort") +
        ", which IGES forbids: what is placed so may lie elsewhere");
  if (scale_ > 0 && scale_ != 1)
    lines.push_back("the scale of the model, " + core::number_text(scale_, 6) +
                    ": lengths are those of the model");
}

}  // namespace keyline::exchange::occt
