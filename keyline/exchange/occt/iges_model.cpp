#include "keyline/exchange/occt/iges_model.h"

#include <IGESGeom_ConicArc.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <Interface_InterfaceModel.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <cmath>
#include <gp_Pnt2d.hxx>
#include <gp_XY.hxx>
#include <set>
#include <stdexcept>

#include "keyline/exchange/occt/conic.h"

namespace keyline::exchange::occt {
namespace {

using Matrix = Handle(IGESGeom_TransformationMatrix);
using Numbers = Handle(TColStd_HArray2OfReal);

Matrix matrix_of(const IGESData_IGESEntity& entity) { return Matrix::DownCast(entity.Transf()); }

/// First `inner`, then `outer`.
Numbers product(const IGESGeom_TransformationMatrix& outer, const Numbers& inner) {
  const Numbers made = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 4; ++j) {
      double sum = j == 4 ? outer.Data(i, 4) : 0;
      for (int k = 1; k <= 3; ++k) sum += outer.Data(i, k) * inner->Value(k, j);
      made->SetValue(i, j, sum);
    }
  return made;
}

Numbers numbers_of(const IGESGeom_TransformationMatrix& matrix) {
  const Numbers made = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 4; ++j) made->SetValue(i, j, matrix.Data(i, j));
  return made;
}

/// Makes a matrix the product of all that place it.
void fold(const Matrix& matrix) {
  std::set<const Standard_Transient*> met{matrix.get()};
  Numbers numbers = numbers_of(*matrix);
  for (Matrix outer = matrix_of(*matrix); !outer.IsNull(); outer = matrix_of(*outer)) {
    if (!met.insert(outer.get()).second)
      throw std::runtime_error("a matrix (IGES entity 124) is placed by itself; mend the file");
    numbers = product(*outer, numbers);
  }
  matrix->Init(numbers);
  matrix->InitTransf({});
}

/// The matrix of a frame in z = 0, turned over where its axes are so.
Numbers numbers_of(core::Vector2 x, core::Vector2 y, core::Point2 origin) {
  const Numbers made = new TColStd_HArray2OfReal(1, 3, 1, 4, 0);
  made->SetValue(1, 1, x.x);
  made->SetValue(1, 2, y.x);
  made->SetValue(1, 4, origin.x);
  made->SetValue(2, 1, x.y);
  made->SetValue(2, 2, y.y);
  made->SetValue(2, 4, origin.y);
  made->SetValue(3, 3, cross(x, y) > 0 ? 1 : -1);
  return made;
}

/// What the form says (IGES 5.3, 4.4), or the coefficients where they are those of a parabola: in
/// place of form 0 OCCT puts one of its own.
ConicKind stated_kind(const IGESGeom_ConicArc& arc, const Conic& conic) {
  if (arc.FormNumber() == 3) return ConicKind::parabola;
  const ConicKind kind = kind_of(conic);
  if (kind == ConicKind::parabola) return kind;
  return arc.FormNumber() == 1 ? ConicKind::ellipse : ConicKind::hyperbola;
}

void straighten(const Handle(IGESGeom_ConicArc) & arc) {
  const Matrix outer = matrix_of(*arc);
  if (arc->HasTransf() && outer.IsNull()) return;
  Conic q;
  arc->Equation(q.a, q.b, q.c, q.d, q.e, q.f);
  const core::Point2 first{arc->StartPoint().X(), arc->StartPoint().Y()};
  const core::Point2 last{arc->EndPoint().X(), arc->EndPoint().Y()};
  const auto made = standard_conic(q, stated_kind(*arc, q), first, last);
  if (!made) return;
  const Numbers frame = numbers_of(made->x, made->y, made->origin);
  const Matrix matrix = new IGESGeom_TransformationMatrix;
  matrix->Init(outer.IsNull() ? frame : product(*outer, frame));
  const auto xy = [&](core::Point2 p) { return gp_XY(made->local(p).x, made->local(p).y); };
  q = made->conic;
  arc->Init(q.a, q.b, q.c, q.d, q.e, q.f, arc->ZPlane() * frame->Value(3, 3), xy(first), xy(last));
  arc->OwnCorrect();  // its form
  arc->InitTransf(matrix);
}

}  // namespace

void mend_iges_model(const opencascade::handle<Interface_InterfaceModel>& model) {
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto matrix = Matrix::DownCast(model->Value(i)); !matrix.IsNull()) fold(matrix);
  constexpr int kOfParameters = 5;  // a curve in the parameters of a surface
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto arc = Handle(IGESGeom_ConicArc)::DownCast(model->Value(i));
        !arc.IsNull() && arc->UseFlag() != kOfParameters)
      straighten(arc);
}

}  // namespace keyline::exchange::occt
