#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/sanitized.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/step/cad_file.h"

#include "cad_fixture.h"
#include "step_text.h"
#include "tests/shared_data.h"

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
  ASSERT_EQ(read.paths.size(), 3U);
  EXPECT_EQ(read.paths[0].label.name, "roof");
  ASSERT_EQ(read.paths[0].path.curves.size(), 2U);  // a chain stays one
  const auto& arc = std::get<lac::Chain>(read.paths[0].path.curves[1].value);
  EXPECT_NEAR(arc.pieces[0].curvature_start, 0.03, 1e-15);
  const auto& quad = std::get<curve::BSpline2>(read.paths[1].path.curves[0].value);
  EXPECT_EQ(quad.weights, (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(std::get<curve::Polyline2>(read.paths[2].path.curves[0].value).points,
            (std::vector<core::Point2>{{0, 0}, {1, 1.0 / 3}, {2, 0}}));
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

TEST_F(Cad, AUnitThatNobodyGaveIsTold) {
  Document d = sample();
  for (const char* extension : {".step", ".stp", ".iges", ".igs"}) {
    d.unit = "";
    const auto told = testing::Contains("no unit is given: the numbers are written as mm");
    EXPECT_THAT(format_document(d, extension).value().notes, told) << extension;
    d.unit = "in";
    EXPECT_THAT(format_document(d, extension).value().notes, testing::Not(told)) << extension;
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
  KEYLINE_NEEDS_SHARED_DATA(fs::exists(folder), folder);
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
    if (read) return std::string();
    const core::Failure& why = read.error();
    return why.path + (why.path.empty() ? "" : ": ") + why.message + " | " + why.hint;
  };
  EXPECT_THAT(answer("kill -SEGV $$"), HasSubstr("broke down"));
  EXPECT_THAT(answer("exec sleep 60", {.seconds = 0.2}), HasSubstr("too long"));
  EXPECT_EQ(answer("echo 'no good; mend it' >&2; exit 1"), "no good | mend it");
  EXPECT_EQ(answer("echo 'line 7: no good; mend it' >&2; echo more >&2; exit 1"),
            "line 7: no good | mend it");
  EXPECT_EQ(answer("echo 'no good' >&2; echo more >&2; exit 1"), "no good | check the file");
  EXPECT_THAT(answer("exit 1"), HasSubstr("the reader of STEP files gave up"));
  EXPECT_THAT(answer("echo '{'"), HasSubstr("not JSON"));
  ::setenv("KEYLINE_CAD", (folder_ / "none").c_str(), 1);
  EXPECT_EQ(read_cad("/dev/null", CadFormat::step, ChildLimits{}).error().code,
            core::ErrorCode::unsupported);
  EXPECT_EQ(read_cad(folder_ / "missing.step", CadFormat::step).error().code, core::ErrorCode::io);
}

// Without the last line, section T, or without parameter lines that it counts, the file says so.
TEST_F(Cad, IgesCutOffIsNotWhole) {
  document::Document document;
  document.unit = "mm";
  for (const double x : {0.0, 1.0, 2.0})
    document.paths.push_back({{}, {{{curve::Bezier2{{{x, 0}, {x, 5}}, {}}}}, false}, 0});
  const auto written = write_cad(document, CadFormat::iges, 1e-3);
  ASSERT_TRUE(written) << written.error().message;
  const fs::path file = folder_ / "cut.iges";
  const auto skipped_of = [&](const std::string& text) {
    std::ofstream(file) << text;
    const auto read = read_cad(file, CadFormat::iges);
    return read ? read->skipped : std::vector<std::string>{read.error().message};
  };
  const std::string& text = written->content;
  EXPECT_THAT(skipped_of(text), testing::IsEmpty());
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  EXPECT_THAT(skipped_of(text.substr(0, last)), testing::Contains(HasSubstr("cut off")));
  const std::size_t before = text.rfind('\n', last - 2) + 1;
  EXPECT_THAT(skipped_of(text.substr(0, before) + text.substr(last)),
              testing::Contains(HasSubstr("not in the file")));
}

// The last of three lines that go on from each other is moved a unit off in the file's text.
TEST_F(Cad, ChainsThatAreNotEndToEndAreTold) {
  document::Document document;
  document.unit = "mm";
  const auto line = [](core::Point2 a, core::Point2 b) {
    return document::PlanarCurve{curve::Bezier2{{a, b}, {}}};
  };
  document.paths.push_back(
      {{}, {{line({0, 0}, {4, 0}), line({4, 0}, {4, 3}), line({4, 3}, {0, 7})}, false}, 0});
  const auto written = write_cad(document, CadFormat::iges, 1e-3);
  ASSERT_TRUE(written) << written.error().message;
  const fs::path file = folder_ / "gap.iges";
  const auto read = [&](const std::string& text) {
    std::ofstream(file) << text;
    return read_cad(file, CadFormat::iges).value_or(document::Document{});
  };
  EXPECT_THAT(read(written->content).skipped, testing::IsEmpty());
  std::string text = written->content;
  const std::string start = "110,4.0000000000000000E+00,3.0000000000000000E+00,";
  const std::size_t at = text.find(start);
  ASSERT_NE(at, std::string::npos);
  text[at + start.size() - 23] = '4';
  const document::Document apart = read(text);
  EXPECT_EQ(apart.paths.size(), 3U);
  EXPECT_THAT(apart.skipped, testing::Contains(HasSubstr("part 3 of its chain begins 1 away")));
}

// Asked to stop, the work of the other process ends at once, and what Ctrl-C sends to it too does
// not look like a broken file.
TEST(ChildProcess, EndsWhereTheCallerAsks) {
  const auto token = core::CancellationToken::make();
  std::jthread impatient([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    token.request_stop();
  });
  const auto began = std::chrono::steady_clock::now();
  const auto child =
      run_child("/bin/sh", {"-c", "kill -INT $$; kill -TERM $$; exec sleep 60"}, {}, {}, token);
  ASSERT_TRUE(child);
  EXPECT_TRUE(child->cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20));
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
#ifdef KEYLINE_SHADOWED
  GTEST_SKIP() << "the sanitizer's shadow memory is larger than any limit";
#endif
  const auto child = run_child("/bin/sh", {"-c", "head -c 300000000 /dev/zero | tail"}, {},
                               {.memory = std::size_t{100} << 20});
  ASSERT_TRUE(child);
  EXPECT_LT(child->output.size(), 300'000'000U);
}

/// A whole cylinder of radius 3 and height 5 whose seam stands at an angle; written by hand after
/// ISO 10303-42.
std::string cylinder(double seam) {
  const auto at = [seam](double z) {
    std::ostringstream text;
    text.precision(17);
    text << "CARTESIAN_POINT('',(" << 3 * std::cos(seam) << ',' << 3 * std::sin(seam) << ',' << z
         << ".))";
    return text.str();
  };
  return step_file(
      "MANIFOLD_SURFACE_SHAPE", "#20",
      "#20=SHELL_BASED_SURFACE_MODEL('',(#21));\n#21=OPEN_SHELL('',(#22));\n"
      "#22=ADVANCED_FACE('',(#23),#30,.T.);\n#23=FACE_BOUND('',#24,.T.);\n"
      "#24=EDGE_LOOP('',(#25,#26,#27,#28));\n#25=ORIENTED_EDGE('',*,*,#40,.F.);\n"
      "#26=ORIENTED_EDGE('',*,*,#41,.T.);\n#27=ORIENTED_EDGE('',*,*,#40,.T.);\n"
      "#28=ORIENTED_EDGE('',*,*,#42,.F.);\n#30=CYLINDRICAL_SURFACE('',#14,3.);\n"
      "#31=VERTEX_POINT('',#32);\n#32=" +
          at(0) + ";\n#33=VERTEX_POINT('',#34);\n#34=" + at(5) +
          ";\n#40=EDGE_CURVE('',#31,#33,#43,.T.);\n#41=EDGE_CURVE('',#31,#31,#46,.T.);\n"
          "#42=EDGE_CURVE('',#33,#33,#47,.T.);\n#43=LINE('',#32,#44);\n#44=VECTOR('',#18,1.);\n"
          "#46=CIRCLE('',#14,3.);\n#47=CIRCLE('',#48,3.);\n"
          "#48=AXIS2_PLACEMENT_3D('',#49,#18,#19);\n#49=CARTESIAN_POINT('',(0.,0.,5.));\n");
}

// A seam a rounding away from the axis once made OCCT fail on the conversion, or give a sliver.
TEST_F(Cad, WholeCylindersAreReadWhereverTheirSeamStands) {
  for (const double seam : {0.0, 1e-12, -1e-11, -1e-10, -1e-9, 1e-9, -1e-8, 0.5, 3.0, -3.0}) {
    SCOPED_TRACE(seam);
    std::ofstream(folder_ / "tube.step") << cylinder(seam);
    const auto read = read_document(folder_ / "tube.step");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->surfaces.size(), 1U);
    const auto& surface = read->surfaces[0].surface;
    double turned = 0;
    for (int i = 0; i < 64; ++i) {
      const auto a = evaluate(surface, i / 64.0, 0.25);
      const auto b = evaluate(surface, (i + 1) / 64.0, 0.25);
      EXPECT_NEAR(std::hypot(a.x, a.y), 3, 1e-9);
      turned += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
    EXPECT_NEAR(std::abs(turned), 2 * std::numbers::pi, 1e-6);
    EXPECT_NEAR(std::abs(evaluate(surface, 0.3, 1).z - evaluate(surface, 0.3, 0).z), 5, 1e-9);
  }
}

}  // namespace
}  // namespace keyline::exchange
