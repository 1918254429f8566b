#include "keyline/core/sanitized.h"

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

TEST(BadInput, EmptyFile) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.write("empty.csv", "")), 2, "empty.csv");
}

TEST(BadInput, OnePoint) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.write("one.csv", "1,2\n")), 2, "one.csv");
}

TEST(BadInput, TwoPointsAreAStraightLine) {
  const Scratch s;
  const Outcome o = run_keyline("fair --json --quiet " + s.write("two.csv", "1,2\n3,4\n"));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("\"straight\""), std::string::npos);
}

TEST(BadInput, ThreePointsGiveACurve) {
  const Scratch s;
  EXPECT_EQ(run_keyline("fair --quiet " + s.write("three.csv", "0,0\n1,0.1\n2,0\n")).status, 0);
}

TEST(BadInput, AllPointsEqual) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.write("same.csv", "1,1\n1,1\n1,1\n1,1\n")), 2,
                 "same.csv");
}

TEST(BadInput, CollinearPointsAreAStraightLine) {
  const Scratch s;
  std::string text;
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + "," + std::to_string(2 * i) + "\n";
  const Outcome o = run_keyline("fair --json --quiet " + s.write("line.csv", text));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("\"straight\""), std::string::npos);
}

TEST(BadInput, NanAndInfinityAreDroppedAndCounted) {
  const Scratch s;
  std::string text = "x,y\n";
  for (int i = 0; i < 20; ++i)
    text += std::to_string(i) + "," + std::to_string(0.01 * i * i) + "\n";
  text += "nan,3\ninf,4\n";
  const Outcome o = run_keyline("fair --json " + s.write("holes.csv", text));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("2 "), std::string::npos) << o.err;
  EXPECT_EQ(o.out.find("nan"), std::string::npos);
}

TEST(BadInput, HugeNumber) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.write("huge.csv", "0,0\n1,1\n1e300,2\n3,3\n")), 2,
                 "huge.csv:3");
}

TEST(BadInput, TextWhereANumberBelongs) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.write("text.csv", "0,0\n1,one\n2,2\n")), 2,
                 "text.csv:2");
}

TEST(BadInput, BinaryFile) {
  const Scratch s;
  std::string bytes("\x89PNG\r\n\x1a\n", 8);
  for (int i = 0; i < 300; ++i) bytes.push_back(static_cast<char>(i * 37));
  expect_failure(run_keyline("fair --quiet " + s.write("binary.csv", bytes)), 2, "binary.csv");
}

TEST(BadInput, EndlessLineInBoundedMemory) {
#ifdef KEYLINE_SHADOWED
  GTEST_SKIP() << "the sanitizer's shadow memory is larger than the limit";
#endif
  // 1 GB without a line end, under a limit of 800 MB of address space.
  const Scratch s;
  const std::string script = s.write(
      "run.sh", std::string("ulimit -v 800000; head -c 1073741824 /dev/zero | tr '\\0' '1' | ") +
                    KEYLINE_PROGRAM + " fair --quiet - >" + s.path("out") + " 2>" + s.path("err"));
  const int status = std::system(("bash " + script).c_str());
  expect_failure({WEXITSTATUS(status), slurp(s.path("out")), slurp(s.path("err"))}, 2, "line");
}

// 101 references to a path of 100 cubics, and a line: 10,100 spans, of which 10,000 are allowed.
// The blanks let the reader take all of it, which reads in proportion to the file's size.
TEST(BadInput, MoreSpansThanAnyoneWaitsForAreRefusedBeforehand) {
  const Scratch s;
  std::string path = "M0 0";
  for (int i = 0; i < 100; ++i) path += "c1 1 2 1 3 0";
  const auto drawing = [&](int references) {
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\">" + std::string(20000, ' ') +
                      "<line id=\"edge\" x2=\"9\" y2=\"9\"/><defs><path id=\"p\" d=\"" + path +
                      "\"/></defs>";
    for (int i = 0; i < references; ++i)
      svg += "<use href=\"#p\" x=\"" + std::to_string(i) + "\"/>";
    return svg + "</svg>";
  };
  const std::string file = s.write("uses.svg", drawing(101));
  for (const char* command : {"analyze --quiet ", "fair --quiet "})
    expect_failure(run_keyline(command + file), 2,
                   "102 curves of 10100 spans together; at most 10000 at a time; choose some with "
                   "--select");
  EXPECT_EQ(run_keyline("analyze --quiet --select edge " + file).status, 0);
  EXPECT_EQ(run_keyline("list --quiet " + file).status, 0);
  EXPECT_EQ(run_keyline("convert --quiet " + file + " -o " + s.path("uses.dxf")).status, 0);
}

TEST(BadInput, MissingFile) {
  expect_failure(run_keyline("fair --quiet /no/such/file.csv"), 3, "/no/such/file.csv");
}

TEST(BadInput, Directory) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + s.path("")), 3, "is a directory");
}

TEST(BadInput, UnwritableOutputLeavesNothingBehind) {
  const Scratch s;
  expect_failure(run_keyline("fair --quiet " + example("clothoid.csv") + " -o /no/such/place.svg"),
                 3, "/no/such/place.svg");
  const std::string kept = s.write("kept.svg", "old");
  EXPECT_EQ(run_keyline("fair --quiet /no/such/file.csv -o " + kept).status, 3);
  EXPECT_EQ(slurp(kept), "old");
  EXPECT_EQ(s.count(), 1U);
}

TEST(BadInput, OutputsThatWouldBeLost) {
  const Scratch s;
  const std::string text = slurp(example("cubic.json"));
  const std::string file = s.write("a.json", text);
  expect_failure(run_keyline("convert --quiet " + file + " -o " + s.path("./a.json")), 2,
                 "this is the input");
  expect_failure(run_keyline("edit --quiet " + file + " -o " + file), 2, "this is the input");
  EXPECT_EQ(slurp(file), text);
  std::filesystem::create_symlink(file, s.path("link.json"));
  expect_failure(run_keyline("analyze --quiet " + file + " -o " + s.path("link.json")), 2,
                 "this is the input");
  expect_failure(
      run_keyline("convert --quiet " + file + " -o " + s.path("b.svg") + " -o " +
                  s.path("../" +
                         std::filesystem::path(s.path("")).parent_path().filename().string() +
                         "/b.svg")),
      2, "named twice");
  EXPECT_FALSE(std::filesystem::exists(s.path("b.svg")));
}

TEST(BadInput, StandardOutputThatTakesNothing) {
  const Scratch s;
  for (const char* command : {"operations", "operations fair", "--version", "fair --help"})
    for (const char* full : {">/dev/full", ">&-"}) {
      const std::string line =
          std::string(KEYLINE_PROGRAM) + " " + command + " " + full + " 2>" + s.path("err");
      EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3) << line;
      EXPECT_TRUE(slurp(s.path("err")).starts_with("keyline: standard output cannot be written"))
          << slurp(s.path("err"));
    }
}

TEST(BadInput, LongNamesAreWritten) {
  const Scratch s;
  const std::string name = s.path(std::string(251, 'n') + ".svg");
  EXPECT_EQ(run_keyline("draw --quiet --points 0,0 2,0 3,1.5 -o " + name).status, 0);
  EXPECT_TRUE(std::filesystem::exists(name));
}

TEST(BadInput, UnknownOption) {
  expect_failure(run_keyline("fair --fairer " + example("clothoid.csv")), 2, "--fairer");
  expect_failure(run_keyline("fair --tolerence 1 " + example("clothoid.csv")), 2,
                 "did you mean --tolerance? see keyline fair --help");
  expect_failure(run_keyline(""), 2, "a command is missing; see keyline --help");
}

TEST(BadInput, UnknownCommandAndFormat) {
  expect_failure(run_keyline("fear x.csv"), 2, "fear");
  expect_failure(run_keyline("fair --quiet " + example("clothoid.csv") + " -o x.docx"), 2, ".docx");
}

TEST(BadInput, OptionsThatMakeNoSense) {
  const std::string file = example("clothoid.csv");
  expect_failure(run_keyline("fair --quiet --clamp begin:G1 " + file), 2, "clamp");
  expect_failure(run_keyline("fair --quiet --region 0.9:0.1 " + file), 2, "region");
  expect_failure(run_keyline("fair --quiet --interpretation 0:lovely " + file), 2, "lovely");
  expect_failure(run_keyline("fair --quiet --interpretation 99:arc " + file), 2, "99");
  for (const char* wrong : {"-1", "0", "abc", "inf", "nan", "0,1"})
    expect_failure(run_keyline("fair --quiet --tolerance=" + std::string(wrong) + " " + file), 2,
                   "greater than zero");
  expect_failure(run_keyline("fair --quiet --order 9 " + file), 2, "order");
}

TEST(BadInput, CurvesThatAreNone) {
  const Scratch s;
  expect_failure(run_keyline("analyze --quiet " + s.write("a.json", "{\n\"type\": }")), 2,
                 "a.json:2");
  expect_failure(run_keyline("analyze --quiet " +
                             s.write("b.json", R"({"type":"bezier","points":[[0,0],[1,"x"]]})")),
                 2, "points[1][1]");
  expect_failure(run_keyline("analyze --quiet " + s.write("c.json", R"({"type":"spiral"})")), 2,
                 "spiral");
}

// Files, options and requests have one reader of JSON.
TEST(BadInput, TwoMembersOfOneNameAreRefusedWhereverJsonIsRead) {
  const Scratch s;
  const std::string twice = "an object has two members of the name \"points\"";
  const std::string curve = R"({"type":"polyline","points":[[0,0],[1,1]],"points":[[0,0],[2,1]]})";
  expect_failure(run_keyline("list " + s.write("c.json", "\n" + curve)), 2, "c.json:2: " + twice);
  expect_failure(run_keyline("curve.reverse --curve '" + curve + "'"), 2, "--curve: " + twice);
  const Outcome batch =
      run_keyline("batch --quiet <" + s.write("requests", R"({"op":"curve.reverse","curve":)" +
                                                              curve + ",\"id\":1}\n"));
  EXPECT_EQ(batch.status, 0);
  EXPECT_NE(batch.out.find("\"ok\":false"), std::string::npos) << batch.out;
  EXPECT_NE(batch.out.find(R"(two members of the name \"points\")"), std::string::npos)
      << batch.out;
}

TEST(BadInput, ToleranceOutOfReachIsStatusOneWithTheBestWritten) {
  const Scratch s;
  std::string text;
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i) + "," + std::to_string((i * 7919) % 13 * 0.3) + "\n";
  const Outcome o = run_keyline("fair --quiet --tolerance 1e-9 --keep-order --keep-strays " +
                                s.write("wild.csv", text) + " -o " + s.path("best.json"));
  EXPECT_EQ(o.status, 1) << o.err;
  EXPECT_TRUE(std::filesystem::exists(s.path("best.json")));
}

}  // namespace
}  // namespace keyline::app_test
