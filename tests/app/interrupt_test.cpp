#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

/// Starts `keyline fair --quiet` on a file, with its standard error in another.
pid_t started(const std::string& input, const std::string& output, const std::string& errors,
              const char* threads) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int file = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::dup2(file, 2);
  ::execl(KEYLINE_PROGRAM, "keyline", "fair", "--quiet", "--threads", threads, "--tolerance",
          "1e-5", input.c_str(), "-o", output.c_str(), nullptr);
  std::_Exit(127);
}

/// Waits until a process catches SIGINT: from then on it must end by itself.
void wait_for_handler(pid_t child) {
  const std::string status = "/proc/" + std::to_string(child) + "/status";
  for (int i = 0; i < 20000; ++i) {
    const std::string text = slurp(status);
    const std::size_t at = text.find("SigCgt:");
    if (at != std::string::npos &&
        (std::stoull(text.substr(at + 7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL() << "nobody catches the signal";
}

/// A closed curve no few pieces follow: fairing it takes many seconds.
std::string long_work() {
  std::string text;
  for (int i = 0; i < 60000; ++i) {
    const double t = 0.0004 * i;
    text += std::to_string(100 * std::cos(t) + 3 * std::sin(7 * t)) + "," +
            std::to_string(60 * std::sin(t) + 2 * std::cos(5 * t)) + "\n";
  }
  return text;
}

// Twenty moments: the program ends by itself, with status 130, one line, and the old file
// or, where there is something to keep already, a whole new one.
TEST(Interrupt, AtAnyMomentLeavesOneWholeFile) {
  const Scratch s;
  const std::string input = s.write("long.csv", long_work());
  const std::string output = s.write("out.svg", "old");
  for (int moment = 1; moment <= 20; ++moment) {
    SCOPED_TRACE(moment);
    const pid_t child = started(input, output, s.path("err"), "1");
    ASSERT_GT(child, 0);  // a signal to -1 would end everything
    wait_for_handler(child);
    std::this_thread::sleep_for(std::chrono::milliseconds(25 * (moment - 1)));
    ::kill(child, SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << "killed by the signal: nobody caught it";
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const std::string said = slurp(s.path("err"));
    EXPECT_TRUE(said.starts_with("keyline: ")) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    // Nothing yet: the old file. The best found: a whole new one, and it is said.
    const std::string now = slurp(output);
    const bool kept = said.find("the best found was kept") != std::string::npos;
    EXPECT_EQ(now == "old", !kept) << said;
    if (kept) {
      EXPECT_TRUE(now.ends_with("</svg>\n")) << now.size();
      s.write("out.svg", "old");
    }
    EXPECT_EQ(s.count(), 3U);
  }
}

/// Forty spirals with names, each the work of some hundredths of a second.
std::string many_spirals() {
  std::string text;
  for (int name = 0; name < 40; ++name)
    for (int i = 0; i < 120; ++i) {
      const double t = 0.05 * i;
      const double r = 1 + 0.1 * t + 0.002 * std::sin(3.0 * t + name);
      text += "spiral" + std::to_string(name) + "," + std::to_string(r * std::cos(t)) + "," +
              std::to_string(r * std::sin(t)) + "\n";
    }
  return text;
}

// What the headline counts is in the file, in the order of the input, and no more than what was at
// work beside it.
TEST(Interrupt, TellsHowManyOfManyAreDone) {
  const Scratch s;
  const std::string input = s.write("many.csv", many_spirals());
  int kept = 0;
  for (int moment = 1; moment <= 5; ++moment) {
    SCOPED_TRACE(moment);
    const std::string output = s.write("out.json", "old");
    const pid_t child = started(input, output, s.path("err"), "2");
    ASSERT_GT(child, 0);  // a signal to -1 would end everything
    wait_for_handler(child);
    std::this_thread::sleep_for(std::chrono::milliseconds(120 * moment));
    ::kill(child, SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WEXITSTATUS(status) == 0) break;  // a quick machine was through
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const std::string said = slurp(s.path("err"));
    if (said.ends_with("many.csv: cancelled\n")) continue;  // while it was read
    int done = -1;
    ASSERT_EQ(std::sscanf(said.c_str(), "keyline: cancelled, %d of 40 done", &done), 1) << said;
    const std::string now = slurp(output);
    if (now == "old") continue;
    ++kept;
    int last = -1;
    int held = 0;
    for (int name = 0; name < 40; ++name) {
      const std::size_t at = now.find("\"spiral" + std::to_string(name) + "\"");
      if (at == std::string::npos) continue;
      EXPECT_GT(static_cast<int>(at), last);
      last = static_cast<int>(at);
      ++held;
    }
    EXPECT_GE(held, done + 1) << said;
    EXPECT_LE(held, done + 2) << said;
  }
  EXPECT_GT(kept, 0) << "none was cut short with a best until then";
}

}  // namespace
}  // namespace keyline::app_test
