#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "run_keyline.h"
#include "started.h"

namespace keyline::app_test {
namespace {

/// Starts `keyline fair --quiet` on a file, with its standard error in another, and waits until it
/// catches SIGINT.
pid_t started(const std::string& input, const std::string& output, const std::string& errors,
              const std::string& threads) {
  const pid_t child = start_keyline(
      {"fair", "--quiet", "--threads", threads, "--tolerance", "1e-5", input, "-o", output},
      errors);
  if (child > 0 && !wait_for(child, [&] { return catches(child, SIGINT); })) {
    ADD_FAILURE() << "nobody catches the signal";
  }
  return child;
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
    std::this_thread::sleep_for(std::chrono::milliseconds(25 * (moment - 1)));
    ::kill(child, SIGINT);
    ASSERT_EQ(status_of(child), 130) << "-1: killed by the signal, nobody caught it";
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

/// How many of forty the headline counts; what is in the file is in the order of the input, and
/// no more than what was at work beside it. None where the interrupt came before a best.
std::optional<int> done_of_forty(const std::string& said, const std::string& now) {
  if (said.ends_with("many.csv: cancelled\n")) return std::nullopt;  // while it was read
  int done = -1;
  EXPECT_EQ(std::sscanf(said.c_str(), "keyline: cancelled, %d of 40 done", &done), 1) << said;
  if (now == "old") return std::nullopt;
  std::size_t last = 0;
  int held = 0;
  for (int name = 0; name < 40; ++name) {
    const std::size_t at = now.find("\"spiral" + std::to_string(name) + "\"");
    if (at == std::string::npos) continue;
    EXPECT_GT(at, last);
    last = at;
    ++held;
  }
  EXPECT_GE(held, done + 1) << said;
  EXPECT_LE(held, done + 2) << said;
  return done;
}

// How long a machine takes for some of many is not known before: halved where all was done before
// the interrupt came, doubled where there was nothing yet, until three were cut short.
TEST(Interrupt, TellsHowManyOfManyAreDone) {
  const Scratch s;
  const std::string input = s.write("many.csv", many_spirals());
  double early = 0;
  double late = 0;
  double wait = 0.1;
  for (int kept = 0, time = 0; kept < 3; ++time) {
    ASSERT_LT(time, 60) << "none is cut short with a best until then";
    const std::string output = s.write("out.json", "old");
    const pid_t child = started(input, output, s.path("err"), "2");
    ASSERT_GT(child, 0);
    std::this_thread::sleep_for(std::chrono::duration<double>(wait));
    ::kill(child, SIGINT);
    const int status = status_of(child);
    if (status == 0) {
      late = wait;
      if (early >= 0.9 * late) early = 0;  // the machine became quicker
    } else {
      EXPECT_EQ(status, 130);
      if (done_of_forty(slurp(s.path("err")), slurp(output))) {
        ++kept;
        continue;
      }
      early = wait;
      if (early >= 0.9 * late) late = 0;  // and slower
    }
    wait = late > 0 ? 0.5 * (early + late) : 2 * wait;
  }
}

}  // namespace
}  // namespace keyline::app_test
