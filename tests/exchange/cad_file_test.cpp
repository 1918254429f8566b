#include "keyline/exchange/step/cad_file.h"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/file/read_file.h"

#include "cad_fixture.h"

/// What is given to the program that knows STEP and IGES, and what is made of its answers.
namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using document::Document;
using testing::HasSubstr;

class CadFile : public CadTest {
 protected:
  /// Another program in its place.
  void answer_by(const std::string& script) const {
    const fs::path program = folder_ / "cad";
    std::ofstream(program) << "#!/bin/sh\n" << script << '\n';
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("KEYLINE_CAD", program.c_str(), 1);
  }

  /// How a failure of its reader reads: "place: message | hint".
  std::string failure_of(const std::string& script, CadFormat format = CadFormat::step) const {
    answer_by(script);
    const auto read = read_cad("/dev/null", format, ChildLimits{.seconds = 20});
    if (read) return "none";
    EXPECT_EQ(read.error().code, core::ErrorCode::bad_input);
    return read.error().path + ": " + read.error().message + " | " + read.error().hint;
  }
};

TEST_F(CadFile, IsNamedByFormatAndWholePath) {
  const std::string tell = "echo \"$# $1 $2 $3\" >&2; exit 1";
  EXPECT_EQ(failure_of(tell), ": 3 read step /dev/null | check the file");
  EXPECT_EQ(failure_of(tell, CadFormat::iges), ": 3 read iges /dev/null | check the file");
  const fs::path here = fs::current_path();
  fs::current_path(folder_);
  const auto read = read_cad("a/b.step", CadFormat::step, ChildLimits{});
  fs::current_path(here);
  EXPECT_EQ(read.error().message, "3 read step " + (folder_ / "a/b.step").string());
}

// "line N: message; hint", of which place and hint may be missing.
TEST_F(CadFile, FailuresHaveTheirPlaceAndHint) {
  const auto of = [this](const std::string& text) {
    return failure_of("echo '" + text + "' >&2; exit 1");
  };
  EXPECT_EQ(of("line 12: one; two; three"), "line 12: one | two; three");
  EXPECT_EQ(of("line 12: a: b"), "line 12: a: b | check the file");
  EXPECT_EQ(of("it ends: early; mend it"), ": it ends: early | mend it");
  EXPECT_EQ(of("line of a curve that has no end: 3"),
            ": line of a curve that has no end: 3 | check the file");
  EXPECT_EQ(failure_of("exit 3", CadFormat::iges),
            ": the reader of IGES files gave up | check the file");
  EXPECT_EQ(failure_of("exit 1"), ": the reader of STEP files gave up | check the file");
}

// POSIX: 1 is SIGHUP.
TEST_F(CadFile, SignalsAreNamed) {
  for (const int signal : {SIGHUP, SIGABRT, SIGSEGV})
    EXPECT_THAT(failure_of("kill -" + std::to_string(signal) + " $$"),
                HasSubstr("broke down on it (" + std::string(::strsignal(signal)) + ")"));
}

TEST_F(CadFile, FoldersAndTextsAreNoPrograms) {
  ::setenv("KEYLINE_CAD", folder_.c_str(), 1);
  EXPECT_EQ(cad_program(), fs::path());
  ::setenv("KEYLINE_CAD", "", 1);
  EXPECT_EQ(cad_program(), fs::path());
  const auto none = read_cad("/dev/null", CadFormat::iges, ChildLimits{});
  EXPECT_EQ(none.error().code, core::ErrorCode::unsupported);
  EXPECT_THAT(none.error().message, HasSubstr("IGES files need the program keyline-cad"));
}

// Run from bin/tests: beside the running program, else in ../libexec/keyline from there.
TEST_F(CadFile, TheProgramStandsBesideTheOneThatAsks) {
  if (::getenv("KEYLINE_CAD_ASKED")) {
    ::unsetenv("KEYLINE_CAD");
    FAIL() << "cad_program: " << cad_program().string() << '\n';
  }
  const fs::path self = fs::read_symlink("/proc/self/exe");
  const fs::path root = self.parent_path() / ("cad-file-" + std::to_string(::getpid()));
  const auto told = [&] {
    const auto child = run_child("/bin/sh",
                                 {"-c", "KEYLINE_CAD_ASKED=1 exec \"$0\" --gtest_filter=\"$1\"",
                                  (root / "bin/tests").string(), "CadFile.TheProgram*"},
                                 {}, {});
    const std::string& output = child->output;
    const std::size_t at = output.find("cad_program: ");
    if (at == output.npos) return output;
    return output.substr(at + 13, output.find('\n', at) - at - 13);
  };
  const auto make = [&](const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "#!/bin/sh\n";
    return file.string();
  };
  fs::create_directories(root / "bin");
  fs::create_hard_link(self, root / "bin/tests");
  const std::string under = make(root / "libexec/keyline/keyline-cad");
  EXPECT_EQ(told(), under);
  const std::string beside = make(root / "bin/keyline-cad");
  EXPECT_EQ(told(), beside);
  fs::remove_all(root);
}

// A minute and 4 s per MB; 1 GB and 30 times the size.
TEST(CadLimits, GrowWithTheFile) {
  const std::size_t gigabyte = std::size_t{1} << 30;
  EXPECT_EQ(cad_limits(0).seconds, 60);
  EXPECT_EQ(cad_limits(0).memory, gigabyte);
  EXPECT_NEAR(cad_limits(5'000'000).seconds, 80, 1e-9);
  EXPECT_EQ(cad_limits(5'000'000).memory, gigabyte + 150'000'000);
}

TEST_F(CadFile, IsReadUpToTheLargestSize) {
  answer_by("echo read >&2; exit 1");
  const fs::path file = folder_ / "large.step";
  std::ofstream(file) << "";
  fs::resize_file(file, kLargestFile);  // without a byte on the disk
  EXPECT_EQ(read_cad(file, CadFormat::step).error().message, "read");
  fs::resize_file(file, kLargestFile + 1);
  EXPECT_EQ(read_cad(file, CadFormat::step).error().message, "the file is larger than 512 MB");
}

Document lines(const std::vector<std::pair<core::Point2, core::Point2>>& ends) {
  Document d;
  d.unit = "mm";
  document::Path path;
  for (const auto& [a, b] : ends) path.curves.push_back({curve::Bezier2{{a, b}, {}}});
  d.paths.push_back({{}, path});
  return d;
}

// A path whose parts meet is one thing, of others every part is.
TEST_F(CadFile, PartsThatDoNotMeetAreWrittenByThemselves) {
  for (const CadFormat format : {CadFormat::step, CadFormat::iges}) {
    const auto back = [&](const Document& d) {
      const fs::path file = folder_ / (format == CadFormat::step ? "a.step" : "a.iges");
      std::ofstream(file) << write_cad(d, format, 1e-3)->content;
      return read_document(file).value_or(Document{});
    };
    const Document one = back(lines({{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}, {{4, 3}, {7, 7}}}));
    ASSERT_EQ(one.paths.size(), 1U);
    EXPECT_EQ(one.paths[0].path.curves.size(), 3U);
    const Document apart = back(lines({{{0, 0}, {4, 0}}, {{5, 0}, {5, 3}}}));
    ASSERT_EQ(apart.paths.size(), 2U);
    EXPECT_EQ(evaluate(apart.paths[0].path, 1), (core::Point2{4, 0}));
    EXPECT_EQ(evaluate(apart.paths[1].path, 0), (core::Point2{5, 0}));
    EXPECT_EQ(back(lines({{{0, 0}, {4, 0}}})).paths.size(), 1U);
  }
}

// What is written of curves in space that are no splines is within the deviation it tells.
TEST_F(CadFile, SpaceCurvesAreWithinTheDeviation) {
  const lac::SpaceChain chain{{{0, 0, 0}}, {{-1, -1, 10, 0.05, 0.2, 0.02, 0.1}}};
  Document d;
  d.unit = "mm";
  d.space_curves.push_back({{}, {chain}});
  const auto written = write_cad(d, CadFormat::step, 1e-3);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_GT(written->deviation, 0);
  EXPECT_LE(written->deviation, 1e-3);
  const fs::path file = folder_ / "a.step";
  std::ofstream(file) << written->content;
  const auto read = read_document(file);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->space_curves.size(), 1U);
  for (const double t : {0.0, 1.0})
    EXPECT_LT(distance(evaluate(read->space_curves[0].curve, t),
                       evaluate(document::SpaceCurve{chain}, t)),
              1e-9);
  std::vector<core::Point3> places;
  for (int k = 0; k <= 2000; ++k)
    places.push_back(evaluate(document::SpaceCurve{chain}, k / 2000.0));
  double farthest = 0;
  for (int i = 0; i <= 50; ++i) {
    const auto p = evaluate(read->space_curves[0].curve, i / 50.0);
    double near = HUGE_VAL;
    for (const core::Point3& q : places) near = std::min(near, distance(p, q));
    farthest = std::max(farthest, near);
  }
  EXPECT_LT(farthest, std::hypot(written->deviation, 0.0025));  // half a step of the chain
}

TEST_F(CadFile, NothingIsWrittenOnceStopped) {
  const auto token = core::CancellationToken::make();
  token.request_stop();
  const auto written = write_cad(lines({{{0, 0}, {4, 0}}}), CadFormat::step, 1e-3, token);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, core::ErrorCode::cancelled);
  answer_by("exec sleep 20");
  const auto read = read_cad("/dev/null", CadFormat::step, ChildLimits{}, token);
  EXPECT_EQ(read.error().code, core::ErrorCode::cancelled);
}

}  // namespace
}  // namespace keyline::exchange
