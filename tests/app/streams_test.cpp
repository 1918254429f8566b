#include <cmath>
#include <csignal>
#include <optional>

#include <fcntl.h>
#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_keyline.h"
#include "started.h"

namespace keyline::app_test {
namespace {

/// Files of every kind that is read, made from an example.
std::vector<std::string> files_of_every_kind(const Scratch& s) {
  std::vector<std::string> files = {example("cubic.json"), example("outlines.csv"),
                                    example("car-cloud.xyz"), example("hull-waterline.tsv"),
                                    example("sketch.png")};
  for (const char* kind : {"svg", "svgz", "dxf", "step", "iges", "glif", "csv"}) {
    files.push_back(s.path(std::string("made.") + kind));
    EXPECT_EQ(run_keyline("convert " + example("cubic.json") + " -o " + files.back()).status, 0);
  }
  files.push_back(s.write("box.obj",
                          "# a tent\nv 0 0 0\nv 2 0 0\nv 1 0 2\nv 1 3 1\n"
                          "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\nl 1 2\n"));
  return files;
}

TEST(Streams, StandardInputAndPipesAreReadLikeFiles) {
  const Scratch s;
  for (const std::string& file : files_of_every_kind(s)) {
    SCOPED_TRACE(file);
    const Outcome named = run_keyline("list --json " + file);
    EXPECT_EQ(named.status, 0) << named.err;
    EXPECT_EQ(run_keyline("list --json -", "cat " + file + " |").out, named.out);
    ASSERT_EQ(::mkfifo(s.path("pipe").c_str(), 0600), 0);
    EXPECT_EQ(
        run_keyline("list --json " + s.path("pipe"), "cat " + file + " > " + s.path("pipe") + " &")
            .out,
        named.out);
    ::unlink(s.path("pipe").c_str());
  }
}

TEST(Streams, FailuresOfStandardInputNameIt) {
  expect_failure(run_keyline("list -", "printf '1,2\\n3,x\\n4,5\\n' |"), 2, "standard input:2: ");
  expect_failure(run_keyline("list -", "printf '' |"), 2, "standard input: is empty");
  expect_failure(run_keyline("list - </dev/zero"), 2, "is a device");
  expect_failure(run_keyline("list /dev/zero"), 2, "/dev/zero: is a device");
}

TEST(Streams, NothingIsLeftOfWhatCameIn) {
  const Scratch s;
  EXPECT_EQ(run_keyline("list -", "TMPDIR=" + s.path("") + " && export TMPDIR && cat " +
                                      example("cubic.json") + " |")
                .status,
            0);
  EXPECT_EQ(s.count(), 0U);
}

TEST(Streams, StandardOutputTakesEveryFormat) {
  const Scratch s;
  const std::string command = "convert " + example("cubic.json") + " -o ";
  for (const std::string kind : {"svg", "json", "dxf", "csv", "step", "pdf", "html"}) {
    SCOPED_TRACE(kind);
    ASSERT_EQ(run_keyline(command + s.path("a." + kind)).status, 0);
    const Outcome streamed = run_keyline(command + kind + ":-");
    EXPECT_EQ(streamed.status, 0) << streamed.err;
    // a STEP file tells its name and hour, a report its command
    if (kind != "step" && kind != "html") {
      EXPECT_EQ(streamed.out, slurp(s.path("a." + kind)));
    }
    EXPECT_FALSE(streamed.out.empty());
  }
  EXPECT_EQ(run_keyline("convert " + example("cubic.json") + " -o -").out, slurp(s.path("a.json")));
}

TEST(Streams, TablesGiveWayToAFileOnStandardOutput) {
  const std::string fair = "fair " + example("bonnet.csv");
  const Outcome shown = run_keyline(fair);
  const Outcome written = run_keyline(fair + " -o svg:-");
  EXPECT_TRUE(written.out.starts_with("<?xml")) << written.out.substr(0, 100);
  EXPECT_TRUE(written.out.ends_with("</svg>\n"));
  EXPECT_NE(written.err.find(shown.out.substr(0, shown.out.find('\n'))), std::string::npos);
  expect_failure(run_keyline(fair + " --json -o -"), 2, "standard output");
  expect_failure(run_keyline(fair + " -o - -o svg:-"), 2, "named twice");
}

TEST(Streams, RequestsKeepTheirOwnInput) {
  const Outcome batch = run_keyline(
      "batch",
      R"(printf '{"op":"document.read","file":"-","id":1}\n{"op":"lac.region","theta":1,"alpha":-1}\n' |)");
  EXPECT_NE(batch.out.find(R"("path":"file")"), std::string::npos) << batch.out;
  EXPECT_EQ(std::count(batch.out.begin(), batch.out.end(), '\n'), 2);
}

// A pipe nobody writes to: Ctrl-C ends the waiting.
TEST(Streams, WaitingForAPipeCanBeInterrupted) {
  const Scratch s;
  ASSERT_EQ(::mkfifo(s.path("p.svg").c_str(), 0600), 0);
  const std::string pipe = std::filesystem::canonical(s.path("p.svg"));
  const pid_t child = start_keyline({"list", pipe}, s.path("err"));
  ASSERT_GT(child, 0);
  ASSERT_TRUE(wait_for(child, [&] { return catches(child, SIGINT) && has_open(child, pipe); }));
  ::kill(child, SIGINT);
  EXPECT_EQ(status_of(child), 130);
  const std::string said = slurp(s.path("err"));
  EXPECT_TRUE(said.starts_with("keyline: ")) << said;
  EXPECT_TRUE(said.ends_with("cancelled while waiting for the input\n")) << said;
}

// The program that reads and writes STEP hangs: Ctrl-C ends both, and the old file stays.
TEST(Streams, ForeignFormatsCanBeInterrupted) {
  const Scratch s;
  // Interrupts whoever started it, as Ctrl-C does while it is at work.
  const std::string program = s.write("cad", "#!/bin/sh\nkill -INT $PPID\nexec sleep 60\n");
  ASSERT_EQ(::chmod(program.c_str(), 0700), 0);
  const std::string impatient = "KEYLINE_CAD=" + program + " timeout 60";
  expect_failure(run_keyline("list " + s.write("a.step", "ISO-10303-21;"), impatient), 130,
                 "cancelled");
  const std::string kept = s.write("b.step", "old");
  expect_failure(run_keyline("convert --quiet " + example("cubic.json") + " -o " + kept, impatient),
                 130, "cancelled");
  EXPECT_EQ(slurp(kept), "old");
  EXPECT_EQ(s.count(), 3U);
}

// A stray point, a missing coordinate: what is taken out is told by those who only hand on.
TEST(Streams, WhatIsTakenOutOfPointsIsTold) {
  const Scratch s;
  std::string text;
  for (int i = 0; i < 200; ++i)
    text += i == 70   ? "90,90\n"
            : i == 90 ? "1,nan\n"
                      : std::to_string(50 * std::cos(0.02 * i)) + "," +
                            std::to_string(30 * std::sin(0.02 * i)) + "\n";
  const std::string file = s.write("strays.csv", text);
  for (const std::string& said :
       {run_keyline("list " + file).out, run_keyline("convert " + file + " -o csv:-").err}) {
    EXPECT_NE(said.find("skipped: 1 point astray\n"), std::string::npos) << said;
    EXPECT_NE(said.find("skipped: 1 point without all coordinates\n"), std::string::npos) << said;
  }
}

/// A program on a terminal of its own, and what it says there.
struct OnTerminal {
  int status = -1;
  std::string shown;
};
/// Interrupted where the text shown has a sign. Nothing where the system has no terminals to give.
template <class Sign>
std::optional<OnTerminal> interrupted_at(Sign sign, const std::vector<std::string>& arguments) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0) return std::nullopt;
  if (child == 0) become_keyline(arguments);
  OnTerminal result;
  bool sent = false;
  char part[4096];
  for (ssize_t got = 0; (got = ::read(terminal, part, sizeof part)) > 0;) {
    result.shown.append(part, static_cast<std::size_t>(got));
    if (sent || !sign(result.shown)) continue;
    ::kill(child, SIGINT);
    sent = true;
  }
  result.status = status_of(child);
  ::close(terminal);
  return result;
}

/// Many key-lines, each some work.
std::string many_lines(int count) {
  std::string text = "id,x,y\n";
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < 80; ++i) {
      const double t = 0.03 * i;
      text += "c" + std::to_string(k) + "," + std::to_string((100 + k) * std::cos(t)) + "," +
              std::to_string(60 * std::sin(t)) + "\n";
    }
  return text;
}

/// "[####....]  12 %  analyzing 18 of 150: samples, 3 s left", or the seconds gone.
bool tells_which_and_how_long(const std::string& shown) {
  const char* line = "\\] +[0-9]+ %  ([^\r\n]* )?[0-9]+ of 150: [^\r\n]*, [0-9]+ s";
  return testing::Value(shown, testing::ContainsRegex(line));
}

TEST(Progress, TellsWhichOfHowManyAndHowLong) {
  const Scratch s;
  const std::string input = s.write("many.csv", many_lines(150));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"fair", input}, std::vector<std::string>{"analyze", input}}) {
    SCOPED_TRACE(command[0]);
    const auto run = interrupted_at(tells_which_and_how_long, command);
    if (!run) GTEST_SKIP() << "no pseudo terminal: is /dev/pts mounted?";
    EXPECT_EQ(run->status, 130);
    EXPECT_NE(run->shown.find(" of 150 done"), std::string::npos) << run->shown;
  }
}

// Boxes are of the curves, not of places on them: the top of a lone high arch among many low ones,
// 3/4 of its handles' height; in space, of the same arch stood upright.
TEST(List, BoxesReachTheExtremesOfEveryMember) {
  const Scratch s;
  std::string curves;
  for (int i = 0; i < 700; ++i)
    curves += (i == 0 ? "" : ",") + std::string(R"({"type":"bezier","points":[[)") +
              std::to_string(i) + ",0],[" + std::to_string(i) + (i == 251 ? ",8],[" : ",1],[") +
              std::to_string(i + 1) + (i == 251 ? ",8],[" : ",1],[") + std::to_string(i + 1) +
              ",0]]}";
  const std::string file = s.write("arches.json", R"({"type":"path","curves":[)" + curves + "]}");
  EXPECT_NE(run_keyline("list --json " + file).out.find(R"("high":[700.0,6.0,0.0])"),
            std::string::npos);
  const std::string upright = s.write(
      "upright.json", R"({"type":"bezier","points":[[0,0,0],[0,0.1,8],[1,0.1,8],[1,0,0]]})");
  const std::string listed = run_keyline("list --json " + upright).out;
  EXPECT_NE(listed.find(R"("high":[1.0,0.075)"), std::string::npos) << listed;
  EXPECT_NE(listed.find(",6.0]"), std::string::npos) << listed;
}

}  // namespace
}  // namespace keyline::app_test
