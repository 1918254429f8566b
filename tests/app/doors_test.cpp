#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "keyline/numeric/instruction_set.h"
#include "keyline/operations/curve_registry.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/schema.h"

#include "door_requests.h"
#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;
using operations::Operation;

const std::string kThere = "cd " KEYLINE_SOURCE_DIR " && ";

TEST(Doors, CommandLineAndBatchAnswerAlikeToTheLastBit) {
  const Scratch s;
  const std::vector<Case> all = cases();
  const Outcome batch = run_keyline("batch --quiet <" + s.write("requests", lines_of(all)), kThere);
  ASSERT_EQ(batch.status, 0) << batch.err;
  const std::vector<json> answers = answers_of(batch.out, all.size());
  std::size_t good = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const json& answer = answers[i];
    const std::string command = typed(*all[i].operation, all[i].request);
    const Outcome o = run_keyline(command, kThere);
    if (answer["ok"] == true) {
      EXPECT_EQ(o.out, answer["result"].dump() + "\n") << command;
      ++good;
    } else {
      EXPECT_NE(o.status, 0) << command;
      EXPECT_NE(o.err.find(answer["error"]["message"].get<std::string>()), std::string::npos)
          << command << '\n'
          << o.err << '\n'
          << answer;
    }
  }
  EXPECT_GT(good, all.size() / 2);  // most are answered, not refused
}

struct BothAnswers {
  std::vector<json> batch, door;
};

/// What batch and another door make of all requests. The door's command reads them, a line each,
/// and writes {"ok", "result" or "message"} for each.
BothAnswers both_answers(const std::string& door, const std::vector<Case>& all,
                         const std::string& environment = "") {
  const Scratch s;
  const std::string requests = s.write("requests", lines_of(all));
  const Outcome batch = run_keyline("batch --quiet <" + requests, kThere + environment);
  EXPECT_EQ(batch.status, 0) << batch.err;
  const std::string written = s.path("answers");
  EXPECT_EQ(std::system((kThere + door + " <" + requests + " >" + written).c_str()), 0);
  return {answers_of(batch.out, all.size()), answers_of(slurp(written), all.size())};
}

/// The door answers as batch does.
void expect_as_batch(const std::string& door, const std::vector<Case>& all) {
  const auto [answers, others] = both_answers(door, all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string asked = all[i].operation->name + " " + all[i].request.dump();
    ASSERT_EQ(others[i]["ok"], answers[i]["ok"]) << asked << others[i] << answers[i];
    if (answers[i]["ok"] == true) {
      EXPECT_EQ(others[i]["result"], answers[i]["result"]) << asked;
    } else {
      const std::string said = others[i]["message"].get<std::string>();
      EXPECT_NE(said.find(answers[i]["error"]["message"].get<std::string>()), std::string::npos)
          << said << answers[i];
    }
  }
}

/// The functions of the package, called by name; their objects turned back into values.
TEST(Doors, PythonAndBatchAnswerAlikeToTheLastBit) {
  if (std::string(KEYLINE_PYTHON).empty()) GTEST_SKIP() << "there is no Python package here";
  expect_as_batch(
      "PYTHONPATH=" KEYLINE_PYTHON_PATH " " KEYLINE_PYTHON " -B tests/app/python_door.py", cases());
}

TEST(Doors, StudioAndBatchAnswerAlikeToTheLastBit) {
  if (std::string(KEYLINE_STUDIO).empty()) GTEST_SKIP() << "there is no Keyline Studio here";
  std::vector<Case> all = cases();
  // A design library lies outside the folder the server keeps to; it says so.
  std::erase_if(all, [](const Case& c) { return c.operation->name.starts_with("library."); });
  expect_as_batch("python3 -B tests/app/studio_door.py " KEYLINE_PROGRAM " .", all);
}

/// The largest number in there.
double largest(const json& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double most = 0;
  if (value.is_structured())
    for (const json& part : value) most = std::max(most, largest(part));
  return most;
}

/// The first place where the answers differ by more than `tolerance` of the numbers around it (the
/// largest of an array and of the arrays within, 1 at least); empty where there is none.
std::string difference(const json& a, const json& b, double tolerance, double scale = 1,
                       const std::string& place = "") {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>();
    const double y = b.get<double>();
    return std::abs(x - y) <= tolerance * std::max({scale, std::abs(x), std::abs(y)})
               ? ""
               : place + ": " + a.dump() + " and " + b.dump();
  }
  if (a.type() != b.type() || a.size() != b.size() || !a.is_structured())
    return a == b ? "" : place + ": " + a.dump().substr(0, 200) + " and " + b.dump().substr(0, 200);
  if (a.is_array()) scale = std::max(scale, largest(a));
  for (const auto& [key, value] : a.items()) {
    const json* other = nullptr;
    if (a.is_array()) {
      other = &b[static_cast<std::size_t>(std::stoul(key))];
    } else if (const auto at = b.find(key); at != b.end()) {
      other = &*at;
    }
    if (!other) return place + "." + key + " is missing";
    if (auto found = difference(value, *other, tolerance, scale, place + "." + key); !found.empty())
      return found;
  }
  return "";
}

/// House rule: 1e-12. Torsion's slopes are measured on third differences of points; joints are made
/// G3 by a search that ends where its steps are small, in numbers that the joints leave free.
double tolerance_of(const std::string& operation) {
  if (operation == "lac.raise_joints") return 1e-8;
  return operation == "lac.space" ? 1e-9 : 1e-12;
}

/// What is compared of an answer. A fairing's descent ends where rounding lets it, so that its last
/// digits are not promised; only that there is an answer. Of the forms of a quasi curve that a
/// search fits the deviation is promised; how their points run along it is left to rounding.
json promised(const std::string& operation, json answer) {
  if (operation == "fair") return answer["ok"];
  if (operation != "lac.quasi" || answer["ok"] != true) return answer;
  const json form = answer["result"]["form"];
  if (form == "best" || form == "rational-cubic") {
    answer["result"].erase("curve");
    answer["result"].erase("lcg");
  }
  return answer;
}

TEST(Doors, EveryInstructionSetAnswersAlike) {
  const Scratch s;
  const std::vector<Case> all = cases();
  const std::string command = "batch --quiet <" + s.write("requests", lines_of(all));
  const auto with = [&](const std::string& set) {
    const Outcome o = run_keyline(command, kThere + "KEYLINE_SIMD=" + set);
    EXPECT_EQ(o.status, 0) << o.err;
    return answers_of(o.out, all.size());
  };
  const std::vector<json> plain = with("scalar");
  std::size_t changed = 0;
  for (const numeric::InstructionSet set : numeric::instruction_sets()) {
    if (set == numeric::InstructionSet::scalar) continue;
    const std::string name(numeric::instruction_set_name(set));
    const std::vector<json> other = with(name);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string& operation = all[i].operation->name;
      EXPECT_EQ(difference(promised(operation, plain[i]), promised(operation, other[i]),
                           tolerance_of(operation)),
                "")
          << name << ": " << operation << " " << all[i].request;
      if (plain[i] != other[i]) ++changed;
    }
  }
  // The switch does something: the sets' sums end in different digits.
  EXPECT_TRUE(changed > 0 || numeric::instruction_sets().size() == 1);
}

struct Looser {
  std::string_view operation;
  double tolerance;
  const char* why;
};

/// What a page's answers may differ by from the tool's: the C library's sines and logarithms round
/// otherwise, which searches and differences of differences make larger.
constexpr Looser kOnPages[] = {
    {"curve.analyze", 1e-5, "readings end where the steps of their search are small"},
    {"curve.diagrams", 1e-8, "so does the self-affinity's scale"},
    {"curve.offset", 1e-10, "fitted until it is near enough"},
    {"fit.curvature", 1e-10,
     "iterated until its squares fall by 1e-14 of themselves: known to 1e-7 of a shift of 1e-3"},
    {"lac.quasi", 1e-12, "the slope of its graph is measured on differences"},
    {"lac.raise_joints", 1e-8, "its search ends where its steps are small"},
    {"lac.space", 1e-9, "torsion's slopes are measured on third differences"},
};

double tolerance_on_pages(const std::string& operation) {
  for (const Looser& looser : kOnPages)
    if (looser.operation == operation) return looser.tolerance;
  return 1e-13;
}

/// Without what rounding decides: how many steps a search took, which of several places as far off
/// is named.
json without_ties(const std::string& operation, json answer) {
  if (!answer.is_object() || answer["ok"] != true) return answer;
  if (operation == "fit.curvature") answer["result"].erase("iterations");
  if (operation ==
      "curve.analyze")  // the best reading; what else is thinkable is hardly determined
    for (json& piece : answer["result"]["pieces"])
      if (json& readings = piece["interpretations"]; readings.size() > 1)
        readings.erase(readings.begin() + 1, readings.end());
  if (operation == "curve.compare")
    for (json& deviation : answer["result"]["deviation"]) {
      deviation.erase("at");
      deviation.erase("place");
    }
  return answer;
}

/// The operations compiled for a page (bindings/wasm), asked in Chromium; plain doubles on both
/// sides. ./dev wasm test builds the page and runs this.
TEST(Doors, PageWithoutServerAndBatchAnswerAlike) {
  const char* const page = std::getenv("KEYLINE_WASM_PAGE");
  if (!page) GTEST_SKIP() << "./dev wasm test runs this: it needs Emscripten";
  std::set<std::string> there;
  for (const Operation& operation : operations::curve_operations()) there.insert(operation.name);
  std::vector<Case> all = cases();
  std::erase_if(all, [&](const Case& c) { return !there.contains(c.operation->name); });
  const auto [answers, others] = both_answers(
      "node web/node_modules/vite-node/vite-node.mjs web/test/static/door.ts " + std::string(page),
      all, "KEYLINE_SIMD=scalar ");
  std::size_t absent = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& operation = all[i].operation->name;
    const json& other = others[i];
    if (other["ok"] == false &&
        other["message"].get<std::string>().ends_with("a page without a server")) {
      ++absent;
      continue;
    }
    json answer = answers[i];
    if (answer["ok"] == false) answer = {{"ok", false}, {"message", answer["error"]["message"]}};
    answer.erase("id");
    json said = other;
    said.erase("id");
    answer = without_ties(operation, promised(operation, std::move(answer)));
    said = without_ties(operation, promised(operation, std::move(said)));
    EXPECT_EQ(difference(answer, said, tolerance_on_pages(operation)), "")
        << operation << " " << all[i].request;
  }
  EXPECT_LT(absent, all.size() / 10);
}

TEST(Doors, AnInstructionSetTheProcessorHasNotIsRefused) {
  // Clothoids need none of the kernels, other slopes do.
  const Outcome o = run_keyline("perform lac.segment --points '[[0,0],[2,0],[3,1.5]]' --alpha=0.5",
                                "KEYLINE_SIMD=avx9");
  EXPECT_EQ(o.status, 2) << o.out;
  EXPECT_NE(o.err.find("avx9"), std::string::npos) << o.err;
}

/// One polyline as points, as a curve value, in a table and in a drawing: one curve through all.
TEST(Doors, TheSamePointsGiveTheSamePiecesWhateverHoldsThem) {
  const Scratch s;
  json points = json::array();
  std::string table;
  std::string drawing = "<svg xmlns='http://www.w3.org/2000/svg'><polyline fill='none' points='";
  for (int i = 0; i < 60; ++i) {
    const double x = std::round(1e4 * i / 59.0) / 100;
    const double y = std::round(1e4 * std::sin(0.05 * x)) / 100 * 0.2;
    points.push_back({x, y});
    table += json(x).dump() + "," + json(y).dump() + "\n";
    drawing += json(x).dump() + "," + json(-y).dump() + " ";
  }
  const json curve{{"type", "polyline"}, {"points", points}};
  const std::string lines = json{{"op", "fair"}, {"points", points}}.dump() + "\n" +
                            json{{"op", "fair"}, {"curve", curve}}.dump() + "\n";
  std::istringstream answers(run_keyline("batch --quiet <" + s.write("lines", lines)).out);
  std::vector<std::size_t> pieces;
  for (std::string line; std::getline(answers, line);)
    pieces.push_back(json::parse(line)["result"]["pieces"].size());
  for (const std::string& file :
       std::vector<std::string>{s.write("a.csv", table), s.write("a.json", curve.dump()),
                                s.write("a.svg", drawing + "'/></svg>")}) {
    const Outcome o = run_keyline("fair --quiet --json " + file);
    ASSERT_EQ(o.status, 0) << o.err;
    pieces.push_back(json::parse(o.out)["pieces"].size());
  }
  ASSERT_EQ(pieces.size(), 5U);
  for (const std::size_t n : pieces) EXPECT_EQ(n, pieces.front());
  EXPECT_LT(pieces.front(), 10U);
}

TEST(Tools, WorkOnCurvesOfAFile) {
  const Scratch s;
  const std::string file = example("cubic.json");
  const std::string reversed = s.path("reversed.json");
  EXPECT_EQ(run_keyline("reverse --quiet " + file + " -o " + reversed).status, 0);
  const Outcome o = run_keyline("compare --json " + file + " " + reversed);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_LT(json::parse(o.out)["largest"].get<double>(), 1e-9);
  EXPECT_GT(json::parse(o.out)["ends"][0].get<double>(), 0.1);
  const std::string halves = s.path("halves.json");
  EXPECT_EQ(run_keyline("split --quiet " + file + " --at 0.5 -o " + halves).status, 0);
  const Outcome listed = run_keyline("list --json " + halves);
  EXPECT_EQ(json::parse(listed.out)["things"].size(), 2U) << listed.err;
  const Outcome joined = run_keyline("join --json --tolerance 1e-6 " + halves);
  EXPECT_EQ(joined.status, 0) << joined.err;
  for (const char* command :
       {"trim --from 0.2 --to 0.6 ", "mirror --point 0,0 --direction 0 ",
        "transform --about 1,0 --turn 0.5 --scale 2 --shift 3,-1 ", "offset --distance=-0.01 "}) {
    const std::string out = s.path("out.svg");
    const Outcome done = run_keyline(std::string(command) + "--quiet " + file + " -o " + out);
    EXPECT_EQ(done.status, 0) << command << done.err;
    EXPECT_TRUE(std::filesystem::exists(out)) << command;
  }
}

}  // namespace
}  // namespace keyline::app_test
