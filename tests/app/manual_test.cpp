#include <sstream>

#include <gmock/gmock.h>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using testing::HasSubstr;
using testing::Not;

Outcome run_command(const std::string& command) {
  const Scratch s;
  const int status =
      std::system(("(" + command + ") >" + s.path("out") + " 2>" + s.path("err")).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(s.path("out")), slurp(s.path("err"))};
}

/// What a shell says to its own script; empty where the shell is not installed.
Outcome shell(const std::string& name, const std::string& arguments) {
  return run_command("command -v " + name + " >/dev/null || exit 127; " + name + " " + arguments);
}

TEST(Manual, EveryShellTakesItsCompletion) {
  for (const std::string name : {"bash", "zsh", "fish"}) {
    const Scratch s;
    const Outcome made = run_keyline("completion " + name);
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("pieces")) << name;
    EXPECT_THAT(made.out, HasSubstr("lac.hermite")) << name;
    const Outcome read = shell(name, "-n " + s.write("script", made.out));
    EXPECT_TRUE(read.status == 0 || read.status == 127) << name << read.err;
  }
  expect_failure(run_keyline("completion tcsh"), 2, "ask for bash, zsh or fish");
  expect_failure(run_keyline("completion"), 2, "ask for bash, zsh or fish");
}

TEST(Manual, BashCompletesOptionsAndTheirWords) {
  const Scratch s;
  const std::string script = s.write("script", run_keyline("completion bash").out);
  const auto completed = [&](const std::string& words, int at) {
    return run_command("bash -c 'source " + script + "; COMP_WORDS=(" + words + "); COMP_CWORD=" +
                       std::to_string(at) + "; _keyline; echo \"${COMPREPLY[*]}\"'")
        .out;
  };
  EXPECT_EQ(completed("keyline fai", 1), "fair\n");
  EXPECT_EQ(completed("keyline fair --piec", 2), "--pieces\n");
  EXPECT_EQ(completed("keyline edit --joints \"\"", 3), "free G1 G2 zebra\n");
  EXPECT_EQ(completed("keyline complet", 1), "completion\n");
  EXPECT_EQ(completed("keyline completion \"\"", 2), "bash zsh fish\n");
  EXPECT_EQ(completed("keyline library f", 2), "find\n");
  EXPECT_EQ(completed("keyline man compa", 2), "compare\n");
  EXPECT_EQ(completed("keyline fair exam", 2), "\n");  // a file: the shell's own part
  EXPECT_EQ(completed("keyline library find --rhy", 3), "--rhythm\n");
  EXPECT_EQ(completed("keyline perform library.find --rhy", 3), "--rhythm\n");
  EXPECT_EQ(completed("keyline lac blend --order \"\"", 4), "G1 G2 G3\n");
  EXPECT_EQ(completed("keyline sketch tra", 2), "\n");  // its room has no second word
}

/// What fish offers at the end of the line; a line of two fields, the second what it means,
/// dropped.
TEST(Manual, FishCompletesSecondWordsAndTheirOptions) {
  if (run_command("command -v fish").status != 0) GTEST_SKIP() << "fish is not installed";
  const Scratch s;
  const std::string script = s.write("script", run_keyline("completion fish").out);
  const auto completed = [&](const std::string& line) {
    return run_command("cd " + s.path("") + "; HOME=" + s.path("") + " fish -N -c 'source " +
                       script + "; complete -C \"" + line + "\"' | cut -f 1")
        .out;
  };
  EXPECT_EQ(completed("keyline fai"), "fair\n");
  EXPECT_EQ(completed("keyline library fi"), "find\n");
  EXPECT_EQ(completed("keyline library find --rhy"), "--rhythm\n");
  EXPECT_EQ(completed("keyline library find --library fi"), "");
  EXPECT_EQ(completed("keyline perform lac.blend --order "), "G1\nG2\nG3\n");
  EXPECT_EQ(completed("keyline sketch tra"), "");
}

TEST(Manual, PagesTellEveryOptionAsTheHelpDoes) {
  const Scratch s;
  ASSERT_EQ(run_keyline("man --all " + s.path("man")).status, 0);
  const std::string page = slurp(s.path("man/keyline-fair.1"));
  EXPECT_EQ(page, run_keyline("man fair").out);
  EXPECT_THAT(page, testing::StartsWith(".TH KEYLINE\\-FAIR 1 "));
  std::istringstream help(run_keyline("fair --help").out);
  int options = 0;
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  --")) continue;
    std::string name = line.substr(2, line.find(' ', 2) - 2);
    for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2)
      name.insert(at, "\\");
    EXPECT_THAT(page, HasSubstr("\\fB" + name + "\\fR"));
    ++options;
  }
  EXPECT_GT(options, 20);
  const std::string all = slurp(s.path("man/keyline.1"));
  for (const char* command : {"fair", "blend", "studio", "lac.quasi"})
    EXPECT_THAT(all, HasSubstr(std::string("keyline\\-") + command)) << command;
  EXPECT_EQ(run_keyline("man library find").out, run_keyline("man library.find").out);
  expect_failure(run_keyline("man nonsense"), 2, "there is no command");
  expect_failure(run_keyline("man fair draw"), 2, "one command at a time");
}

TEST(Manual, ARoomListsItsOperations) {
  const Outcome o = run_keyline("library --help");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("library.add"));
  EXPECT_THAT(o.out, Not(HasSubstr("lac.segment")));
  expect_failure(run_keyline("library"), 2, "keyline library --help lists them");
  expect_failure(run_keyline("nonsense --help"), 2, "there is no command");
  expect_failure(run_keyline("library survey --library x"), 2, "no command \"library survey\"");
}

TEST(Manual, HelpIsThereWhereverOneAsks) {
  EXPECT_EQ(run_keyline("help draw").out, run_keyline("draw --help").out);
  EXPECT_THAT(run_keyline("man --help").out, HasSubstr("keyline man --all FOLDER"));
  EXPECT_THAT(run_keyline("completion --help").out, HasSubstr("source <(keyline completion bash)"));
  expect_failure(run_keyline("fairr x.csv"), 2, "did you mean fair? keyline --help lists them");
  expect_failure(run_keyline("surfaces"), 2, "did you mean surface? keyline --help lists them");
  expect_failure(run_keyline("preform"), 2, "did you mean perform? keyline --help lists them");
  expect_failure(run_keyline("perform"), 2, "an operation is missing behind it");
  expect_failure(run_keyline("library --bogus"), 2, "a command is missing behind it");
}

/// A line that begins with a dot or a quote would be taken for a request and vanish.
TEST(Manual, ManReadsEveryPageWithoutAWarning) {
  const Scratch s;
  ASSERT_EQ(run_keyline("man --all " + s.path("man")).status, 0);
  if (run_command("command -v groff").status != 0) GTEST_SKIP() << "groff is not installed";
  const Outcome o =
      run_command("groff -Kutf8 -man -Tutf8 -ww " + s.path("man") + "/*.1 >/dev/null");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
}

}  // namespace
}  // namespace keyline::app_test
