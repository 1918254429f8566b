#include <sstream>

#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

/// `count` requests, of a different slope each, some of them wrong.
std::string requests(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (i % 97 == 13) text += "\n";  // a blank line gets no answer
    if (i % 61 == 7)
      text += "{\"op\":\"lac.segment\",\"id\":" + std::to_string(i) + "}\n";
    else
      text += R"({"op":"lac.segment","points":[[0,0],[2,0],[3,1.5]],"alpha":)" +
              std::to_string(-2 + 0.001 * i) + ",\"id\":" + std::to_string(i) + "}\n";
  }
  return text;
}

TEST(Batch, AnswersComeInOrderWhateverTheNumberOfProcesses) {
  const Scratch s;
  const std::string file = s.write("requests", requests(3000));
  const Outcome one = run_keyline("batch --quiet --threads 1 <" + file);
  const Outcome three = run_keyline("batch --quiet --threads 3 <" + file);
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, three.out);
  std::istringstream lines(one.out);
  int id = 0;
  for (std::string line; std::getline(lines, line); ++id)
    ASSERT_EQ(json::parse(line)["id"], id) << line;
  EXPECT_EQ(id, 3000);
}

TEST(Batch, ALineSentAloneIsAnsweredBeforeTheNext) {
  const Scratch s;
  const std::string script = s.write(
      "talk.sh", std::string("coproc K { ") + KEYLINE_PROGRAM +
                     " batch --quiet; }\n"
                     "echo '{\"op\":\"lac.region\",\"theta\":1,\"alpha\":-1,\"id\":1}' >&${K[1]}\n"
                     "read -t 20 -u ${K[0]} first && echo \"$first\" >" +
                     s.path("first") + "\n");
  EXPECT_EQ(WEXITSTATUS(std::system(("bash " + script).c_str())), 0);
  EXPECT_EQ(json::parse(slurp(s.path("first")))["id"], 1);
}

TEST(Batch, ALineThatTakesTooLongHarmsNoOther) {
  const Scratch s;
  std::string slow = R"({"op":"fit.spline","id":"slow","trials":100000,"points":[)";
  for (int i = 0; i < 400; ++i)
    slow += (i ? ",[" : "[") + std::to_string(i) + "," + std::to_string((i * 7919) % 101) + "]";
  const std::string file = s.write("requests", requests(5) + slow + "]}\n" + requests(5));
  const Outcome o = run_keyline("batch --quiet --time-limit 2 --threads 2 <" + file);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(std::count(o.out.begin(), o.out.end(), '\n'), 11);
  EXPECT_NE(o.out.find("\"id\":\"slow\",\"ok\":false"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("\"code\":\"cancelled\""), std::string::npos) << o.out;
}

TEST(Batch, ALineThatKillsItsWorkerHarmsNoOther) {
  // A worker is brought down from outside while it answers: its lines are asked again.
  const Scratch s;
  const std::string file = s.write("requests", requests(60000));
  const std::string command = std::string(KEYLINE_PROGRAM) + " batch --quiet --threads 2 <" + file +
                              " >" + s.path("out") + " & parent=$!; sleep 0.3; " +
                              "kill -9 $(pgrep -P $parent | head -1); wait $parent";
  EXPECT_EQ(WEXITSTATUS(std::system(("bash -c '" + command + "'").c_str())), 0);
  EXPECT_EQ(slurp(s.path("out")), run_keyline("batch --quiet <" + file).out);
}

TEST(Batch, ResumedAfterKillItIsAsUninterrupted) {
  const Scratch s;
  const std::string file = s.write("requests", requests(40000));
  const std::string whole = run_keyline("batch --quiet <" + file).out;
  const std::string answers = s.path("answers");
  for (int i = 0; i < 5; ++i) {
    const std::string command = std::string(KEYLINE_PROGRAM) + " batch --quiet --resume " +
                                answers + " <" + file + " & sleep 0." + std::to_string(1 + i) +
                                "; kill -9 $! 2>/dev/null; wait";
    std::system(("bash -c '" + command + "' 2>/dev/null").c_str());
    EXPECT_TRUE(whole.starts_with(slurp(answers).substr(0, slurp(answers).rfind('\n') + 1)));
  }
  EXPECT_EQ(run_keyline("batch --quiet --resume " + answers + " <" + file).status, 0);
  EXPECT_EQ(slurp(answers), whole);
}

TEST(Batch, SeedAndToleranceStandForWhatIsLeftOut) {
  const Scratch s;
  std::string points = "[";
  for (int i = 0; i < 30; ++i)
    points += (i ? ",[" : "[") + std::to_string(i) + "," + std::to_string(0.01 * i * i) + "]";
  const std::string fair = R"({"op":"fair","points":)" + points + "]";
  const std::string file =
      s.write("requests", fair + "}\n" + fair + R"(,"tolerance":0.25})" + "\n" +
                              R"({"op":"lac.region","theta":1,"alpha":-1})" + "\n");
  const Outcome o = run_keyline("batch --quiet --tolerance 0.125 <" + file);
  std::istringstream lines(o.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(json::parse(line)["result"]["tolerance"], 0.125);
  std::getline(lines, line);
  EXPECT_EQ(json::parse(line)["result"]["tolerance"], 0.25);
  std::getline(lines, line);
  EXPECT_EQ(json::parse(line)["ok"], true);  // it takes none
}

}  // namespace
}  // namespace keyline::app_test
