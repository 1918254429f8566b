#include "keyline/exchange/file/child_process.h"

#include <csignal>
#include <string>

#include <gtest/gtest.h>

/// Programs run to their ends, by what POSIX' shell does.
namespace keyline::exchange {
namespace {

core::Result<ChildResult> shell(const char* script, std::string_view input = {},
                                const ChildLimits& limits = {}) {
  return run_child("/bin/sh", {"-c", script}, input, limits);
}

TEST(ChildProcess, TellsItsStatusAndWhatItSays) {
  const auto done = shell("echo out; echo err >&2; exit 3");
  ASSERT_TRUE(done);
  EXPECT_EQ(done->status, 3);
  EXPECT_EQ(done->signal, 0);
  EXPECT_EQ(done->output, "out\n");
  EXPECT_EQ(done->errors, "err\n");
  EXPECT_FALSE(done->out_of_time || done->cancelled);
}

TEST(ChildProcess, ASignalIsNoStatus) {
  const auto done = shell("kill -USR1 $$");
  ASSERT_TRUE(done);
  EXPECT_EQ(done->status, -1);
  EXPECT_EQ(done->signal, SIGUSR1);
}

// What cannot be started ends as the shell says of what it cannot find: 127.
TEST(ChildProcess, AProgramThatIsNotThereEndsWith127) {
  const auto done = run_child("/nowhere/at/all", {}, {}, {});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->status, 127);
  EXPECT_EQ(done->signal, 0);
}

TEST(ChildProcess, GetsItsInputAndNoMore) {
  const std::string much(300'000, 'x');
  const auto done = shell("wc -c; cat; echo end", much);
  ASSERT_TRUE(done);
  EXPECT_EQ(std::stol(done->output), 300'000);
  EXPECT_TRUE(done->output.ends_with("end\n"));
  const auto none = shell("cat");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->output, "");
}

TEST(ChildProcess, PassesNoLimit) {
  ChildLimits limits;
  limits.output = 1000;
  const auto loud = shell("while :; do echo 0123456789; done", {}, limits);
  ASSERT_TRUE(loud);
  EXPECT_EQ(loud->signal, SIGKILL);
  EXPECT_GT(loud->output.size(), 1000U);
  EXPECT_LE(loud->output.size(), 1000U + 65536);
  EXPECT_FALSE(loud->out_of_time);
  limits = {};
  limits.seconds = 0.3;
  const auto slow = shell("sleep 60", {}, limits);
  ASSERT_TRUE(slow);
  EXPECT_TRUE(slow->out_of_time);
  EXPECT_EQ(slow->signal, SIGKILL);
}

TEST(ChildProcess, ExactlyAsMuchAsIsAllowedIsKept) {
  ChildLimits limits;
  limits.output = 5;
  const auto done = shell("printf 12345", {}, limits);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->output, "12345");
  EXPECT_EQ(done->status, 0);
}

TEST(ChildProcess, NamesAreArguments) {
  const auto done = run_child("/bin/sh", {"-c", "echo \"$0 $1\"", "a b", "c"}, {}, {});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->output, "a b c\n");
}

}  // namespace
}  // namespace keyline::exchange
