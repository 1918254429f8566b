#include "keyline/core/similarity.h"
#include "keyline/document/planar_curve.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

/// A curve put elsewhere, as a hand does it: the operation curve.transform.
namespace keyline::operations {
namespace {

using core::Point2;
using core::Result;

struct TransformRequest {
  document::Path curve;
  Point2 about;
  double turn = 0;
  double scale = 1;
  Point2 shift;
  static constexpr auto describe() {
    using Request = TransformRequest;
    return core::fields(
        core::field<&Request::curve>("any planar curve or path").needed(),
        core::field<&Request::about>("stays where it is in turning and scaling; the origin unless "
                                     "given"),
        core::field<&Request::turn>("counter-clockwise").in("radian"),
        core::field<&Request::scale>("factor of every length").within(core::kPositive),
        core::field<&Request::shift>("along x and y, after turning and scaling").in("length"));
  }
};

struct TransformedCurve {
  MadeCurve curve;
  static constexpr auto describe() {
    return core::fields(core::flattened<&TransformedCurve::curve>());
  }
};

Result<TransformedCurve> run(const TransformRequest& request, const Context&) {
  core::Similarity2 map{request.scale, request.turn, {}};
  map.offset =
      request.about - apply(map, request.about) + core::Vector2{request.shift.x, request.shift.y};
  const document::Path moved = transform(request.curve, map);
  if (!validate(moved))
    return core::fail(core::ErrorCode::bad_input, "the curve would leave the range of numbers",
                      "give a scale nearer 1, or a smaller shift", "scale");
  TransformedCurve answer;
  answer.curve.curve = simplest(moved);
  return answer;
}

}  // namespace

Operation curve_transform_operation() {
  return declare<run>(
      {.name = "curve.transform",
       .summary = "Turns and scales a curve about a point, then shifts it; its type stays.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[1,2],[3,2],[4,0]]},
                        "about":[2,0],"turn":0.5,"scale":1.5,"shift":[10,0]})"}});
}

}  // namespace keyline::operations
