#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/arc.h"
#include "keyline/exchange/cad_file.h"
#include "keyline/exchange/document_file.h"

#include "cad_fixture.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using document::Document;
using testing::HasSubstr;

using Cad = CadTest;

Document sample() {
  Document d;
  d.unit = "in";
  lac::Chain chain{{{0, 0}, 0.3}, {{-1, 50, 0, 0.03}, {-1, 20, 0.03, 0.03}}, false};
  d.paths.push_back({{"roof", "", ""}, {{{chain}}, false}, 0});
  d.paths.push_back(
      {{"quad", "", ""}, {{{curve::Bezier2{{{0, 0}, {10, 3}, {20, 0}}, {1, 0.5, 1}}}}, false}, 0});
  d.paths.push_back(
      {{"poly", "", ""}, {{{curve::Polyline2{{{0, 0}, {1, 1.0 / 3}, {2, 0}}}}}, false}, 0});
  curve::BSpline3 rail{2,
                       {0, 0, 0, 0.25, 1, 1, 1},
                       {{0, 0, 1}, {1, 2, 1.0 / 7}, {3, 1, 4}, {4, 4, 4}},
                       {1, 2, 1, 1}};
  d.space_curves.push_back({{"rail", "", ""}, {rail}});
  surface::BSplineSurface s{{2, 1}, {{{0, 0, 0, 1, 1, 1}, {0, 0, 2, 3, 3}}}, {3, 3, {}}, {}};
  for (int i = 0; i < 9; ++i) {
    const int row = i / 3;
    s.net.points.push_back({double(row), double(i % 3), std::sin(i)});
    s.weights.push_back(i == 4 ? 2 : 1);
  }
  d.surfaces.push_back({{"hood", "", ""}, s, 0});
  return d;
}

void expect_same(const Document& read) {
  const Document d = sample();
  EXPECT_EQ(read.unit, "in");
  ASSERT_EQ(read.paths.size(), 4U);
  EXPECT_EQ(read.paths[0].label.name, "roof");
  const auto& arc = std::get<lac::Chain>(read.paths[1].path.curves[0].value);
  EXPECT_NEAR(arc.pieces[0].curvature_start, 0.03, 1e-15);
  const auto& quad = std::get<curve::BSpline2>(read.paths[2].path.curves[0].value);
  EXPECT_EQ(quad.weights, (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(evaluate(read.paths[3].path, 1), (core::Point2{2, 0}));
  EXPECT_EQ(std::get<curve::BSpline2>(read.paths[3].path.curves[0].value).control[1],
            (core::Point2{1, 1.0 / 3}));
  ASSERT_EQ(read.space_curves.size(), 1U);
  EXPECT_EQ(std::get<curve::BSpline3>(read.space_curves[0].curve.value),
            std::get<curve::BSpline3>(d.space_curves[0].curve.value));
  ASSERT_EQ(read.surfaces.size(), 1U);
  EXPECT_EQ(read.surfaces[0].label.name, "hood");
  EXPECT_EQ(read.surfaces[0].trims, 0);
  EXPECT_EQ(std::get<surface::BSplineSurface>(read.surfaces[0].surface),
            std::get<surface::BSplineSurface>(d.surfaces[0].surface));
}

TEST_F(Cad, StepAndIgesReadBackToTheSameDoubles) {
  for (const char* name : {"a.step", "a.iges"}) {
    SCOPED_TRACE(name);
    const auto written = write_document(sample(), folder_ / name, {.tolerance = 1e-3});
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_GT(written->deviation, 0);
    EXPECT_LE(written->deviation, 1e-3);
    const auto read = read_document(folder_ / name);
    ASSERT_TRUE(read) << read.error().message;
    expect_same(*read);
  }
}

struct FileCase {
  const char* name;
  std::size_t curves;
  std::size_t surfaces;
  const char* unit;
};

// Faces and free curves by hand: ADVANCED_FACE and B_SPLINE_CURVE entities of the STEP files,
// entities 128 (and 100, 110, 126 outside them) of the IGES directories.
constexpr FileCase kFiles[] = {
    {"step/line_03.step", 1, 0, "mm"},  {"step/revolved_sphere.step", 0, 1, "mm"},
    {"step/screw.step", 0, 10, "mm"},   {"step/wigley.step", 0, 1, "m"},
    {"iges/line_03.iges", 1, 0, "mm"},  {"iges/DTMB-5415_bulbous_bow.iges", 0, 1, "m"},
    {"iges/test_pipe.iges", 0, 4, "m"}, {"iges/wigley.iges", 0, 1, "m"},
    {"iges/wing.iges", 0, 4, "m"},
};

TEST_F(Cad, ReadsTheSharedFiles) {
  const fs::path folder = KEYLINE_SHARED_DATA "/4_cad";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const FileCase& c : kFiles) {
    SCOPED_TRACE(c.name);
    const auto d = read_document(folder / c.name);
    ASSERT_TRUE(d) << d.error().message;
    EXPECT_EQ(d->paths.size() + d->space_curves.size(), c.curves);
    EXPECT_EQ(d->surfaces.size(), c.surfaces);
    EXPECT_EQ(d->unit, c.unit);
  }
  const auto a = read_document(folder / "step/wigley.step");
  const auto b = read_document(folder / "iges/wigley.iges");
  for (int i = 0; i <= 4; ++i)
    EXPECT_NEAR(distance(evaluate(a->surfaces[0].surface, i / 4.0, 0.3),
                         evaluate(b->surfaces[0].surface, i / 4.0, 0.3)),
                0, 1e-6);
  for (const auto& entry : fs::directory_iterator(folder / "nasty/step"))
    EXPECT_FALSE(read_document(entry.path())) << entry.path();
}

TEST_F(Cad, WhatBreaksTheReaderIsAFailureOfTheFile) {
  const fs::path program = folder_ / "cad";
  const auto answer = [&](const std::string& script, ChildLimits limits = {}) {
    std::ofstream(program) << "#!/bin/sh\n" << script << '\n';
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("KEYLINE_CAD", program.c_str(), 1);
    const auto read = read_cad("/dev/null", CadFormat::step, limits);
    EXPECT_FALSE(read);
    return read ? std::string() : read.error().message;
  };
  EXPECT_THAT(answer("kill -SEGV $$"), HasSubstr("broke down"));
  EXPECT_THAT(answer("exec sleep 60", {.seconds = 0.2}), HasSubstr("too long"));
  EXPECT_EQ(answer("echo 'no good; mend it' >&2; exit 1"), "no good");
  EXPECT_THAT(answer("echo '{'"), HasSubstr("not JSON"));
  ::setenv("KEYLINE_CAD", (folder_ / "none").c_str(), 1);
  EXPECT_EQ(read_cad("/dev/null", CadFormat::step, {}).error().code, core::ErrorCode::unsupported);
}

TEST(ChildProcess, TakesLargeInputAndOutput) {
  const std::string text(5'000'000, 'x');
  const auto child = run_child("/bin/cat", {}, text, {});
  ASSERT_TRUE(child);
  EXPECT_EQ(child->status, 0);
  EXPECT_EQ(child->output, text);
  const auto deaf = run_child("/bin/true", {}, text, {});
  ASSERT_TRUE(deaf);
  EXPECT_EQ(deaf->status, 0);
  EXPECT_NE(run_child("/nowhere/cat", {}, text, {})->status, 0);
}

TEST(ChildProcess, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's shadow memory is larger than any limit";
#endif
  const auto child = run_child("/bin/sh", {"-c", "head -c 300000000 /dev/zero | tail"}, {},
                               {.memory = std::size_t{100} << 20});
  ASSERT_TRUE(child);
  EXPECT_LT(child->output.size(), 300'000'000U);
}

}  // namespace
}  // namespace keyline::exchange
