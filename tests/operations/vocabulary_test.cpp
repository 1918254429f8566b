#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/fairing/fair.h"
#include "keyline/operations/json_form.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/schema.h"

namespace keyline::operations {
namespace {

using core::Type;
using nlohmann::json;

json example_of(const Operation& operation) { return json::parse(operation.examples.front()); }

/// All record types reachable from a type.
void gather(const Type& type, std::set<const Type*>& seen) {
  if (!seen.insert(&type).second) return;
  if (type.item) gather(type.item(), seen);
  for (std::size_t i = 0; i < type.alternative_count; ++i) gather(type.alternatives[i](), seen);
  if (type.kind == Type::Kind::record)
    for (const core::Field& field : type.fields()) gather(field.type(), seen);
}

TEST(Vocabulary, EveryExampleReadsAndWritesBackTheSame) {
  for (const Operation& operation : operations())
    for (const std::string& text : operation.examples) {
      const auto read = [&](const json& from) {
        auto record = operation.request->make();
        const Part part{operation.request, record.get()};
        const auto done = read_json(from, {&part, 1}, {}, operation.name);
        EXPECT_TRUE(done) << operation.name << (done ? "" : done.error().message);
        return record;
      };
      const auto first = write_json(*operation.request, read(json::parse(text)).get());
      ASSERT_TRUE(first) << operation.name;
      json again = *first;
      for (auto it = again.begin(); it != again.end();)  // numbers that stand for a rule: 0
        it = it->is_number() && *it == 0 && !json::parse(text).contains(it.key()) ? again.erase(it)
                                                                                  : std::next(it);
      const auto second = write_json(*operation.request, read(again).get());
      ASSERT_TRUE(second) << operation.name;
      EXPECT_EQ(*first, *second) << operation.name;
    }
}

TEST(Vocabulary, EveryFieldHasASentenceAndEveryRecordANameOfItsOwn) {
  std::set<const Type*> types;
  for (const Operation& operation : operations()) {
    gather(*operation.request, types);
    gather(*operation.result, types);
  }
  std::set<std::string_view> names;
  for (const Type* type : types) {
    if (type->kind != Type::Kind::record) continue;
    EXPECT_TRUE(names.insert(type->name).second) << type->name;
    for (const core::Field& field : type->fields())
      EXPECT_TRUE(field.flat || !field.text.empty()) << type->name << '.' << field.name;
  }
}

TEST(Vocabulary, NumbersBeyondTheirBoundsAreRefusedByName) {
  int tried = 0;
  for (const Operation& operation : operations())
    core::visit_fields(
        *operation.request, operation.request->make().get(), [&](const core::Field& field, void*) {
          const Type* type = &field.type();
          if (type->kind == Type::Kind::optional) type = &type->item();
          if (type->kind != Type::Kind::number && type->kind != Type::Kind::integer) return;
          const double low = std::nextafter(field.bounds.low - 1, -HUGE_VAL);
          const double high = std::nextafter(field.bounds.high + 1, HUGE_VAL);
          for (const double beyond : {low, high}) {
            if (!std::isfinite(beyond)) continue;
            json request = example_of(operation);
            request[std::string(field.name)] =
                type->kind == Type::Kind::integer ? json(std::llround(beyond)) : json(beyond);
            const auto result = perform(operation.name, request, {});
            ASSERT_FALSE(result) << operation.name << ' ' << field.name;
            EXPECT_EQ(result.error().path, field.name) << operation.name;
            EXPECT_EQ(result.error().code, core::ErrorCode::bad_input) << operation.name;
            EXPECT_FALSE(result.error().hint.empty());
            ++tried;
          }
        });
  EXPECT_GT(tried, 50);
}

TEST(Vocabulary, WrongKindsAreRefusedWithTheirPlace) {
  const json good{{"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", -1}};
  const auto path_of = [&](const char* field, json value) {
    json request = good;
    request[field] = std::move(value);
    const auto result = perform("lac.segment", request, {});
    return result ? "none" : result.error().path;
  };
  EXPECT_EQ(path_of("alpha", "one"), "alpha");
  EXPECT_EQ(path_of("alpha", nullptr), "alpha");
  EXPECT_EQ(path_of("points", {{0, 0}, {2, 0}}), "points");
  EXPECT_EQ(path_of("points", {{0, 0}, {2, 0}, {3, true}}), "points[2][1]");
  EXPECT_EQ(path_of("bezier", {{"tolerance", 0}}), "bezier.tolerance");
  EXPECT_EQ(path_of("bezier", {{"degree", 3}}), "bezier.tolerance");
  EXPECT_EQ(path_of("bezier", {{"tolerance", 1}, {"degree", 31}}), "bezier.degree");
  EXPECT_EQ(path_of("bezier", {{"tolerance", 1}, {"grade", 3}}), "bezier.grade");
}

/// The types docs/contract.md names for results, also where there is one member alone.
TEST(Vocabulary, CurvesOfResultsHaveTheTypeOfThePublicInterface) {
  const json quintic{{"type", "bezier"},
                     {"points", {{0, 0}, {1, 0.1}, {2, 0.4}, {3, 0.9}, {4, 1.6}, {5, 2.5}}}};
  const auto type_of = [](const char* operation, const json& request, const char* field) {
    const auto result = perform(operation, request, {});
    return result ? (*result)[field]["type"].get<std::string>() : result.error().message;
  };
  for (const json& curve : {quintic, json{{"type", "path"}, {"curves", {quintic}}}})
    EXPECT_EQ(type_of("fit.curvature", {{"curve", curve}, {"target", "smooth"}}, "curve"), "path");
  const json handles{{0, 0}, {2, 0}, {3, 1.5}};
  const json form{{"degree", 5}, {"tolerance", 0.1}};
  const json segment{{"points", handles}, {"alpha", -1}, {"bezier", form}, {"nurbs", form}};
  EXPECT_EQ(type_of("lac.segment", segment, "curve"), "log-aesthetic");
  EXPECT_EQ(type_of("lac.segment", segment, "bezier"), "path");
  EXPECT_EQ(type_of("lac.segment", segment, "nurbs"), "bspline");
  EXPECT_EQ(type_of("lac.quasi", {{"points", handles}, {"alpha", -1}}, "curve"), "bezier");
  EXPECT_EQ(type_of("fair", example_of(*find_operation("fair")), "curve"), "log-aesthetic");
}

TEST(Vocabulary, AMisspeltNameIsToldTheRightOne) {
  const auto result = perform("fair", {{"points", {{0, 0}, {1, 0}}}, {"tolerence", 1}}, {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().hint.find("\"tolerance\""), std::string::npos) << result.error().hint;
}

TEST(Vocabulary, DefaultsOfTheSchemaAreTheMembersOwn) {
  const json fair = request_schema(*find_operation("fair"))["properties"];
  EXPECT_EQ(fair["order"]["default"], fairing::FairOptions().spline.order);
  EXPECT_EQ(fair["order"]["minimum"], 4);  // narrower than fit.spline's
  EXPECT_FALSE(fair["tolerance"].contains("default"));
  const json fit = request_schema(*find_operation("fit.spline"))["properties"];
  EXPECT_EQ(fit["order"]["default"], fit::SplineFitOptions().order);
  EXPECT_EQ(fit["order"]["minimum"], 2);
}

struct Sample {
  double value = 0;
  std::vector<double> list{1, 2};
  static constexpr auto describe() {
    return core::fields(core::field<&Sample::value>("a number"),
                        core::field<&Sample::list>("a list"));
  }
};

TEST(Vocabulary, ANumberThatIsNotFiniteDoesNotLeave) {
  Sample sample;
  EXPECT_TRUE(write_json(core::type_of<Sample>(), &sample));
  sample.list[1] = NAN;
  const auto written = write_json(core::type_of<Sample>(), &sample);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().path, "list[1]");
  EXPECT_EQ(written.error().code, core::ErrorCode::internal);
}

TEST(Vocabulary, AListGivenReplacesItsDefault) {
  Sample sample;
  const Part part{&core::type_of<Sample>(), &sample};
  ASSERT_TRUE(read_json({{"list", {7}}}, {&part, 1}, {}, "sample"));
  EXPECT_EQ(sample.list, std::vector<double>{7});
}

}  // namespace
}  // namespace keyline::operations
