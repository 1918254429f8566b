#include "keyline/exchange/json_curve.h"
#include "keyline/operations/class_a_json.h"
#include "keyline/operations/class_a_request.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

core::Result<json> run(const json& request, const Context&) {
  const auto options = edit_options(request);
  if (!options) return std::unexpected(options.error());
  const auto subject = class_a_subject(request);
  if (!subject) return std::unexpected(subject.error());
  if (!subject->planar)
    return core::fail(core::ErrorCode::unsupported, "a curve in space is not edited",
                      "lay it into its plane first", "curve");
  const auto edited = classa::edit(subject->planar->curve, *options);
  if (!edited) return std::unexpected(edited.error());
  return class_a_edit_json(*edited, *subject->planar, *options);
}

}  // namespace

Operation curve_edit_operation() {
  using Type = Field::Type;
  std::vector<Field> fields = class_a_fields();
  fields.push_back(
      {"target", Type::any, false, "{alpha, s} to move to; the minimum-energy point unless given"});
  fields.push_back(
      {"hold", Type::string, false, "for a target: ends-and-tangent (default), ends or start"});
  fields.push_back({"amount", Type::number, false, "0 the given curve to 1 the target (default)"});
  return {"curve.edit",
          "Slides a curve to its minimum-energy point or to a given place of the alpha-s plane; "
          "start point, start tangent and end stay.",
          std::move(fields),
          run,
          {{"curve", {{"type", "bezier"}, {"points", {{0, 0}, {1, 2}, {0, 4}, {-2, 5}}}}},
           {"amount", 0.5}}};
}

}  // namespace keyline::operations
