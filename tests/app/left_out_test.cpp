#include <gmock/gmock.h>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kFlat =
    R"({"name":"flat","curve":{"type":"bezier","points":[[0,2,0],[10,2,5],[20,2,5],[30,2,0]]}})";
const std::string kBent =
    R"({"name":"bent","curve":{"type":"bezier","points":[[0,0,0],[10,4,5],[20,9,5],[30,0,0]]}})";
const std::string kSurface = R"("surfaces":[{"name":"p","surface":{"type":"bezier-surface",)"
                             R"("points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0.2]]]}}])";

// Curves in no plane, and surfaces: what a command has no use for is told.
TEST(LeftOut, IsToldBesideWhatIsFaired) {
  const Scratch s;
  const std::string file =
      s.write("all.json", R"({"curves":[)" + kFlat + "," + kBent + "]," + kSurface + "}");
  const Outcome faired = run_keyline("fair " + file);
  EXPECT_EQ(faired.status, 0);
  EXPECT_THAT(faired.out, HasSubstr("flat\n"));
  EXPECT_THAT(faired.out, Not(HasSubstr("bent")));
  EXPECT_THAT(faired.err, HasSubstr("keyline: flat: in the plane y = 2; x and z\n"));
  EXPECT_THAT(faired.err, HasSubstr("keyline: skipped: bent: lies in no plane\n"));
  EXPECT_THAT(faired.err, HasSubstr("keyline: 1 surface of the file left out beside its curves\n"));

  const std::string curves = s.write("curves.json", R"({"curves":[)" + kFlat + "," + kBent + "]}");
  EXPECT_THAT(run_keyline("analyze " + curves).err, HasSubstr("skipped: bent: lies in no plane"));
}

TEST(LeftOut, SurfacesAloneAreNoCurves) {
  const Scratch s;
  const std::string file = s.write("surface.json", "{" + kSurface + "}");
  const Outcome refused = run_keyline("fair " + file);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr(file + ": there is no planar curve in it, but 1 surface; "));
  EXPECT_EQ(run_keyline("analyze " + file).status, 0);
}

TEST(LeftOut, IsToldByEveryCommandThatReadsCurves) {
  const Scratch s;
  const std::string file = s.write(
      "text.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><text x="3" y="3">hi</text>
<path fill="none" stroke="black" d="M0 0 C5 10 15 10 20 0"/></svg>)");
  for (const char* command : {"fair ", "analyze ", "edit ", "reverse ", "offset --distance 1 "})
    EXPECT_THAT(run_keyline(command + file).err, HasSubstr("skipped: line 1: text: 1 element"))
        << command;
}

TEST(LeftOut, IsToldOfWhatIsCut) {
  const Scratch s;
  const std::string mesh =
      s.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 9\nf 1 2 3\n") + " --section z=0.25";
  EXPECT_THAT(run_keyline("convert " + mesh + " -o - --quiet").out, HasSubstr("line 4"));
  EXPECT_THAT(run_keyline("convert " + mesh + " -o " + s.path("a.csv")).err,
              HasSubstr("keyline: skipped: line 4"));
}

// An option that nothing of the input or output asks for is told wherever it is given.
TEST(LeftOut, OptionsWithoutAUseAreTold) {
  const Scratch s;
  const std::string curve =
      s.write("c.json", R"({"type":"bezier","points":[[0,0],[1,2],[3,2],[4,0]]})");
  const std::string table = s.write("t.csv", "x,y\n0,0\n1,1\n2,1.5\n3,1\n4,0\n");
  const auto told = [](const std::string& command) {
    const Outcome done = run_keyline(command);
    EXPECT_EQ(done.status, 0) << command << "\n" << done.err;
    return done.err;
  };
  const std::string listed =
      told("list " + curve + " --section y=0 --glyphs S --columns 1,2 --band 1 --row 2 --closed");
  for (const char* option : {"section", "glyphs", "columns", "band", "row", "closed"})
    EXPECT_THAT(listed, HasSubstr("keyline: --" + std::string(option) + " has no use here ("));
  EXPECT_THAT(told("fair " + curve + " --noise 0.1"), HasSubstr("--noise has no use here ("));
  EXPECT_THAT(told("analyze " + curve + " --noise 0.1"), Not(HasSubstr("no use")));
  EXPECT_THAT(told("analyze " + table + " --noise 0.1"), Not(HasSubstr("no use")));
  EXPECT_THAT(told("list " + table + " --columns 1,2 --trims"), HasSubstr("keyline: --trims has"));
  EXPECT_THAT(told("list " + table + " --columns 1,2"), Not(HasSubstr("no use")));

  const std::string svg = " -o " + s.path("a.svg");
  const std::string written = told("convert " + curve + svg + " --polylines --grid");
  EXPECT_THAT(written, HasSubstr("--polylines has no use here ("));
  EXPECT_THAT(written, HasSubstr("--grid has no use here ("));
  EXPECT_THAT(told("convert " + curve + svg + " -o " + s.path("a.dxf") + " --polylines"),
              Not(HasSubstr("no use")));
  // of two files one has a use for it
  EXPECT_THAT(told("compare " + curve + " " + table + " --columns 1,2"), Not(HasSubstr("no use")));
  EXPECT_THAT(told("compare " + curve + " " + curve + " --columns 1,2"), HasSubstr("no use"));
  EXPECT_THAT(run_keyline("list " + curve + " --columns 1,2 --json").out,
              HasSubstr(R"("unused":["columns"])"));
}

}  // namespace
}  // namespace keyline::app_test
