#include <sstream>
#include <vector>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

/// The lines "keyline …" of the page's shell blocks.
std::vector<std::string> commands_of(const std::string& page) {
  std::istringstream lines(slurp(std::string(KEYLINE_SOURCE_DIR "/docs/") + page));
  std::vector<std::string> commands;
  std::string line;
  bool shell = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("```")) shell = line == "```sh";
    if (shell && line.starts_with("keyline ")) commands.push_back(line.substr(8));
  }
  return commands;
}

/// For `before`: as written, among the examples, with what it writes in the folder.
std::string within(const Scratch& s) {
  return "cd " + s.path("") + " && ln -s " KEYLINE_SOURCE_DIR "/examples examples && ";
}

TEST(Documentation, EveryCommandOfTheCurvePageRuns) {
  const auto commands = commands_of("log-aesthetic-curves.md");
  EXPECT_GE(commands.size(), 10U);
  const Scratch s;
  std::string before = within(s);  // one folder: what one command writes another reads
  std::size_t there = 1;           // the examples
  for (const std::string& command : commands) {
    const Outcome o = run_keyline(command, before);
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
    EXPECT_GT(s.count(), there) << command;
    there = s.count();
    before = "cd " + s.path("") + " && ";
  }
}

TEST(Documentation, EveryCommandOfTheExchangeGuideRuns) {
  const auto commands = commands_of("guide/exchange.md");
  EXPECT_GE(commands.size(), 7U);
  for (const std::string& command : commands) {
    const bool cad = command.find(".step") != std::string::npos;
    if (cad && std::string(KEYLINE_CAD).empty()) continue;
    const Scratch s;
    const Outcome o = run_keyline(command, within(s));
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
    EXPECT_EQ(s.count(), 2U) << command;
  }
}

TEST(Documentation, EveryCommandOfTheClassAGuideRuns) {
  const auto commands = commands_of("guide/class-a.md");
  EXPECT_GE(commands.size(), 4U);
  const Scratch s;
  std::string before = within(s);  // one folder: what one command writes another reads
  for (const std::string& command : commands) {
    const Outcome o = run_keyline(command, before);
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
    before = "cd " + s.path("") + " && ";
  }
}

TEST(Documentation, EveryCommandOfTheLibraryGuideRuns) {
  const auto commands = commands_of("guide/library.md");
  EXPECT_GE(commands.size(), 6U);
  const Scratch s;
  std::string before = within(s);
  for (const std::string& command : commands) {
    const Outcome o = run_keyline(command, before);
    if (o.err.find("no design library") != std::string::npos) GTEST_SKIP() << o.err;
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
    before = "cd " + s.path("") + " && ";
  }
}

#ifdef KEYLINE_HAS_SKETCH
TEST(Documentation, EveryCommandOfTheSketchGuideRuns) {
  const auto commands = commands_of("guide/sketch.md");
  EXPECT_GE(commands.size(), 5U);
  for (const std::string& command : commands) {
    const Scratch s;
    const Outcome o = run_keyline(command, within(s));
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
  }
}
#endif

TEST(Documentation, EveryCommandAndRequestOfTheSurfaceGuideRuns) {
  const auto commands = commands_of("guide/surfaces.md");
  EXPECT_GE(commands.size(), 5U);
  for (const std::string& command : commands) {
    const Scratch s;
    const Outcome o = run_keyline(command, within(s));
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
  }
  std::istringstream lines(slurp(KEYLINE_SOURCE_DIR "/docs/guide/surfaces.md"));
  std::string requests;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("{\"op\"") && line.find("\u2026") == std::string::npos)
      requests += line + "\n";
  EXPECT_EQ(std::count(requests.begin(), requests.end(), '\n'), 3);
  const Scratch s;
  const Outcome o = run_keyline("batch --quiet <" + s.write("requests", requests));
  EXPECT_EQ(o.out.find("\"ok\":false"), std::string::npos) << o.out;
}

}  // namespace
}  // namespace keyline::app_test
