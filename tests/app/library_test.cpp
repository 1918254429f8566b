#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

/// Empty where the build has no SQLite.
bool has_library() {
  const Scratch s;
  return run_keyline("library stats --library " + s.path("none.kl")).status == 3;
}

std::string turned_and_grown() {
  // the control points of examples/cubic.json, doubled, turned by a quarter and run backwards
  json cubic = json::parse(slurp(example("cubic.json")));
  json turned = cubic;
  const std::size_t n = cubic["points"].size();
  for (std::size_t i = 0; i < n; ++i) {
    const json& p = cubic["points"][n - 1 - i];
    turned["points"][i] = {-2 * p[1].get<double>() + 7, 2 * p[0].get<double>()};
  }
  return turned.dump();
}

TEST(LibraryCommand, AddsFindsShowsAndExports) {
  if (!has_library()) GTEST_SKIP() << "built without SQLite";
  const Scratch s;
  const std::string library = " --library " + s.path("l.kl");
  const auto added = run_keyline("library add " + example("cubic.json") + " " +
                                 example("clothoid-truth.json") + library + " --json");
  ASSERT_EQ(added.status, 0) << added.err;
  EXPECT_EQ(json::parse(added.out)["size"], 2);
  const std::string twin = s.write("twin.json", turned_and_grown());
  const auto found = run_keyline("library find --like " + twin + library + " --json");
  ASSERT_EQ(found.status, 0) << found.err;
  const json nearest = json::parse(found.out)["found"][0];
  EXPECT_EQ(nearest["id"], 1);
  EXPECT_LT(nearest["match"]["distance"], 1e-5);
  EXPECT_EQ(nearest["match"]["reversed"], true);
  const auto slopes = run_keyline(
      "library find --slope '-1±0.2' --rhythm accelerating --self-affinity '<0.002'" + library);
  ASSERT_EQ(slopes.status, 0) << slopes.err;
  EXPECT_NE(slopes.out.find("clothoid-truth.json"), std::string::npos) << slopes.out;
  EXPECT_EQ(slopes.out.find("cubic.json"), std::string::npos) << slopes.out;
  const auto shown = run_keyline("library show --number 1 --json" + library);
  EXPECT_EQ(json::parse(shown.out)["curve"]["points"],
            json::parse(slurp(example("cubic.json")))["points"]);
  const auto written =
      run_keyline("library export --numbers 2 --file " + s.path("x.svg") + library);
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_NE(slurp(s.path("x.svg")).find("<svg"), std::string::npos);
}

TEST(LibraryCommand, TellsWhatIsWrong) {
  const Scratch s;
  if (!has_library()) {
    expect_failure(run_keyline("library add " + example("cubic.json")), 1, "no design library");
    return;
  }
  expect_failure(run_keyline("library find --library " + s.path("none.kl")), 3, "no such library");
  expect_failure(run_keyline("library stats --library " + example("cubic.json")), 2,
                 "no design library");
  EXPECT_EQ(s.count(), 0u);
}

TEST(LibraryCommand, WithoutANameItIsTheUsersOwn) {
  if (!has_library()) GTEST_SKIP() << "built without SQLite";
  const Scratch s;
  const std::string home = "HOME=" + s.path("") + " XDG_DATA_HOME= KEYLINE_LIBRARY=";
  ASSERT_EQ(run_keyline("library add " + example("cubic.json"), home).status, 0);
  EXPECT_TRUE(std::filesystem::exists(s.path(".local/share/keyline/library.kl")));
  EXPECT_EQ(run_keyline("library show --number 1", home).status, 0);
  const std::string other = "KEYLINE_LIBRARY=" + s.path("other.kl");
  expect_failure(run_keyline("library show --number 1", other), 3, "no such library");
}

}  // namespace
}  // namespace keyline::app_test
