#include "keyline/exchange/json_space.h"
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
  if (subject->space) {
    const auto edited = classa::edit(*subject->space, *options);
    if (!edited) return std::unexpected(edited.error());
    return json{{"curve", exchange::to_json(edited->curve)},
                {"before", curve_value_json(edited->flat.before)},
                {"after", curve_value_json(edited->flat.after)},
                {"target", {{"alpha", edited->flat.target.alpha}, {"s", edited->flat.target.s}}}};
  }
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
