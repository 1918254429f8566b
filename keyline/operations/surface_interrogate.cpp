#include <cmath>

#include "keyline/operations/registry.h"
#include "keyline/operations/values.h"
#include "keyline/surface/curvature.h"
#include "keyline/surface/interrogate.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

constexpr int kMostValues = 1'048'576;

struct InterrogateRequest {
  surface::Surface surface;
  surface::FieldKind kind = surface::FieldKind::gaussian;
  std::vector<int> grid{65, 65};
  std::optional<core::Point3> view;
  std::optional<core::Point3> light;
  std::optional<core::Point3> stripes;
  surface::Lighting lighting;
  bool points = false;
  bool normals = false;
  static constexpr auto describe() {
    using Request = InterrogateRequest;
    using Light = surface::Lighting;
    return core::fields(
        core::field<&Request::surface>("a Bezier or B-spline surface").needed(),
        core::field<&Request::kind>(
            "gaussian, mean, principal (pairs, larger first), zebra (white where the fraction is "
            "below 1/2), isophote (cosine to the light), reflection (light lines, in spacings) or "
            "highlight (distance of the normal line from the light line)")
            .needed(),
        core::field<&Request::grid>("points along u and v, at most 1048576 in all")
            .count(1, 2)
            .within(core::from_to(2, kMostValues / 2))
            .or_bare_item(),
        core::field<&Request::view>("direction to the eye; the mean normal unless given"),
        core::field<&Request::light>(
            "direction to the light (isophote) or of the light line (highlight)"),
        core::field<&Request::stripes>("direction the stripes are stacked in (zebra, reflection)"),
        core::field<&Request::lighting, &Light::origin>(
            "a point of the first light line (reflection, highlight)"),
        core::field<&Request::lighting, &Light::stripe_count>(
            "zebra: black and white pairs on a sphere")
            .within(core::kPositive),
        core::field<&Request::lighting, &Light::spacing>(
            "reflection: of the light lines; a twelfth of the extent unless given")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::points>("also the points of the grid"),
        core::field<&Request::normals>("also the unit normals there"));
  }
};

using Value = std::optional<double>;
using Pair = std::array<Value, 2>;

struct InterrogateAnswer {
  surface::FieldKind kind = surface::FieldKind::gaussian;
  std::array<int, 2> grid{};
  std::vector<std::vector<std::variant<Value, Pair>>> values;
  core::Interval range;
  core::Point3 view;
  core::Point3 stripes;
  std::optional<std::vector<std::vector<core::Point3>>> points;
  std::optional<std::vector<std::vector<core::Point3>>> normals;
  static constexpr auto describe() {
    using Answer = InterrogateAnswer;
    return core::fields(
        core::field<&Answer::kind>("as asked for"), core::field<&Answer::grid>("rows and columns"),
        core::field<&Answer::values>(
            "in rows along u; pairs for principal; null where there is no normal or a ray misses"),
        core::field<&Answer::range>("of the values"),
        core::field<&Answer::view>("direction to the eye, as used"),
        core::field<&Answer::stripes>("direction the stripes are stacked in, as used"),
        core::field<&Answer::points>("of the grid, where asked for"),
        core::field<&Answer::normals>(
            "of the grid, where asked for; [0, 0, 0] where there is none"));
  }
};

Value finite(double x) { return std::isfinite(x) ? Value(x) : Value(); }

std::vector<std::vector<std::variant<Value, Pair>>> values_of(const surface::Field& field) {
  std::vector<std::vector<std::variant<Value, Pair>>> rows(static_cast<std::size_t>(field.rows));
  std::size_t at = 0;
  for (auto& row : rows)
    for (int j = 0; j < field.columns; ++j, ++at) {
      if (field.second.empty())
        row.emplace_back(finite(field.values[at]));
      else
        row.emplace_back(Pair{finite(field.values[at]), finite(field.second[at])});
    }
  return rows;
}

surface::Lighting lighting_of(const InterrogateRequest& request) {
  surface::Lighting lighting = request.lighting;
  const auto vector = [](const std::optional<core::Point3>& p) {
    return p ? std::optional(*p - core::Point3{}) : std::nullopt;
  };
  lighting.view = vector(request.view);
  lighting.light = vector(request.light);
  lighting.stripes = vector(request.stripes);
  return lighting;
}

template <class Of>
std::vector<std::vector<core::Point3>> on_grid(const surface::JetGrid& grid, const Of& of) {
  std::vector<std::vector<core::Point3>> rows(static_cast<std::size_t>(grid.rows));
  for (int i = 0; i < grid.rows; ++i)
    for (int j = 0; j < grid.columns; ++j)
      rows[static_cast<std::size_t>(i)].push_back(of(grid.at(i, j)));
  return rows;
}

core::Point3 normal_of(const surface::SurfaceJet& jet) {
  const auto frame = surface::frame_of(jet);
  return frame ? core::Point3{} + frame->normal : core::Point3{};
}

Result<InterrogateAnswer> run(const InterrogateRequest& request, const Context& context) {
  const int rows = request.grid.front();
  const int columns = request.grid.back();
  if (static_cast<std::int64_t>(rows) * columns > kMostValues)
    return core::fail(ErrorCode::bad_input, "the grid is out of range",
                      "give whole numbers [along u, along v] from 2, at most 1048576 points",
                      "grid");
  const surface::JetGrid grid =
      surface::sample_grid(request.surface, rows, columns, context.threads);
  const surface::Lighting lighting = lighting_of(request);
  const auto field = surface::interrogate(grid, request.kind, lighting);
  if (!field) return std::unexpected(field.error());
  const surface::Lighting used = surface::completed(lighting, grid);
  InterrogateAnswer answer;
  answer.kind = request.kind;
  answer.grid = {field->rows, field->columns};
  answer.values = values_of(*field);
  answer.range = field->range;
  answer.view = core::Point3{} + *used.view;
  answer.stripes = core::Point3{} + *used.stripes;
  if (request.points)
    answer.points = on_grid(grid, [](const surface::SurfaceJet& jet) { return jet.point; });
  if (request.normals) answer.normals = on_grid(grid, normal_of);
  return answer;
}

}  // namespace

Operation surface_interrogate_operation() {
  return declare<run>(
      {.name = "surface.interrogate",
       .summary = "A field over a surface on a grid of equal steps in u (rows) and v (columns): "
                  "curvature, or what light shows of it. null where the surface has no normal or a "
                  "ray misses.",
       .examples = {R"({"surface":{"type":"bezier-surface",
           "points":[[[0,0,0],[0,1,0.2]],[[1,0,0.3],[1,1,0.1]]]},"kind":"gaussian","grid":[3,3]})"},
       .long_running = true});
}

}  // namespace keyline::operations
