#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A curve in the plane y = `depth`, its second point at this height.
std::string side(const std::string& name, const std::string& depth, const std::string& height) {
  return R"({"name":")" + name + R"(","curve":{"type":"polyline","points":[[0,)" + depth +
         ",0],[10," + depth + "," + height + "],[20," + depth + ",5],[30," + depth + ",0]]}}";
}

// The two sides of a plate are one curve in their planes: the answer is one too, which is told and
// is what each of them has by itself. What differs by more than rounding has its own.
TEST(Copies, AreAnsweredOnceAndSaySo) {
  const Scratch s;
  const std::string file =
      s.write("plate.json", R"({"curves":[)" + side("near", "2", "5") + "," +
                                side("far", "9", "5") + "," + side("last", "9", "5.000001") + "]}");
  const Outcome o = run_keyline("fair --json " + file);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("keyline: far: in its plane the same curve as near: its answer\n"));
  EXPECT_THAT(o.err, Not(HasSubstr("keyline: last: in its plane the same")));
  const json curves = json::parse(o.out)["curves"];
  ASSERT_EQ(curves.size(), 3U);
  EXPECT_EQ(curves[1]["id"], "far");
  const json alone = json::parse(run_keyline("fair --json --quiet --select far " + file).out);
  EXPECT_EQ(curves[1]["curve"], alone["curve"]);
  EXPECT_NE(curves[2]["curve"], alone["curve"]);
}

}  // namespace
}  // namespace keyline::app_test
