#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kTwoPaths = R"(<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">
<path fill="none" stroke="black" d="M0 0 C5 10 15 10 20 0"/>
<path fill="none" stroke="black" d="M20 0 C25 9 35 12 40 0"/></svg>)";

/// Of several without names, what is told says which it tells of; a name stays what it was in what
/// is written.
TEST(Called, CurvesWithoutNamesByTheirPlace) {
  const Scratch scratch;
  const std::string two = scratch.write("two.svg", kTwoPaths);
  const std::string written = scratch.path("faired.json");
  const Outcome faired = run_keyline("fair " + two + " --json -o " + written);
  EXPECT_THAT(faired.err, HasSubstr("keyline: curve 1: comb: "));
  EXPECT_THAT(faired.err, HasSubstr("keyline: curve 2: comb: "));
  EXPECT_EQ(nlohmann::json::parse(faired.out)["curves"][1]["id"], "curve 2");
  EXPECT_THAT(slurp(written), Not(HasSubstr("curve 2")));

  EXPECT_THAT(run_keyline("analyze " + two).out, HasSubstr("curve 2\nlength "));
  EXPECT_THAT(run_keyline("edit " + two).out, HasSubstr("curve 2\n"));
  EXPECT_THAT(run_keyline("offset " + two + " --distance 1").out, HasSubstr("curve 2\n"));
}

TEST(Called, OneAloneByNothing) {
  const Scratch scratch;
  const std::string two = scratch.write("two.svg", kTwoPaths);
  EXPECT_THAT(run_keyline("fair " + two + " --select 2").err, Not(HasSubstr("curve 2")));
}

}  // namespace
}  // namespace keyline::app_test
