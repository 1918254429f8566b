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

/// The command with its output files in the folder.
std::string redirected(const std::string& command, const Scratch& s) {
  const std::size_t at = command.find(" -o ");
  if (at == std::string::npos) return command;
  return command.substr(0, at + 4) + s.path(command.substr(at + 4));
}

TEST(Documentation, EveryCommandOfTheCurvePageRuns) {
  const auto commands = commands_of("log-aesthetic-curves.md");
  EXPECT_GE(commands.size(), 8U);
  for (const std::string& command : commands) {
    const Scratch s;
    const Outcome o = run_keyline(redirected(command, s));
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
    EXPECT_EQ(s.count(), 1U) << command;
  }
}

TEST(Documentation, EveryCommandOfTheClassAGuideRuns) {
  const auto commands = commands_of("guide/class-a.md");
  EXPECT_GE(commands.size(), 4U);
  for (const std::string& command : commands) {
    const Scratch s;
    const Outcome o = run_keyline(redirected(command, s), "cd " KEYLINE_SOURCE_DIR " && ");
    EXPECT_EQ(o.status, 0) << command << '\n' << o.err;
  }
}

}  // namespace
}  // namespace keyline::app_test
