#include "keyline/exchange/points/points_reader.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <streambuf>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

using acquire::RawCurve;

core::Result<std::vector<RawCurve>> parse(const std::string& text,
                                          const PointsOptions& options = {}) {
  std::istringstream in(text);
  return read_points(in, "data.csv", options);
}

struct FormatCase {
  const char* name;
  const char* text;
  bool has_z;
};

// Every text holds the points (1.5, -2), (0.25, 1000), (3, 4) and maybe z = 7, 8, 9.
constexpr FormatCase kFormats[] = {
    {"comma", "1.5,-2\n0.25,1e3\n3,4\n", false},
    {"semicolon", "1.5;-2\n0.25;1e3\n3;4\n", false},
    {"decimal comma", "1,5;-2\n0,25;1e3\n3;4\n", false},
    {"decimal comma, tabs", "1,5\t-2\n0,25\t1e3\n3\t4\n", false},
    {"decimal comma, spaces", "1,5 -2,0\n0,25 1000,0\n3,0 4,0\n", false},
    {"tab", "1.5\t-2\n0.25\t1000\n3\t4", false},
    {"spaces", "   1.5   -2\n .25 +1000. \n 3 4\n", false},
    {"comma and space", "1.5, -2\n0.25, 1e3\n3, 4\n", false},
    {"crlf and mark",
     "\xef\xbb\xbf"
     "1.5,-2\r\n0.25,1e3\r\n3,4\r\n",
     false},
    {"old mac", "1.5,-2\r0.25,1e3\r3,4\r", false},
    {"header", "x,y\n1.5,-2\n0.25,1e3\n3,4\n", false},
    {"quoted header", "\"Y [mm]\";\"X [mm]\"\n-2;1.5\n1e3;0.25\n4;3\n", false},
    {"comment header", "# x_m,y_m,w_tr_right_m\n1.5,-2,9\n0.25,1e3,9\n3,4,9\n", false},
    {"comments", "// made by hand\n1.5,-2\n% here\n0.25,1e3\n\n3,4\n! end\n", false},
    {"trailing separators", "1.5,-2,,\n0.25,1e3,,\n3,4,,\n", false},
    {"three columns", "1.5 -2 7\n0.25 1e3 8\n3 4 9\n", true},
    {"six columns", "1.5 -2 7 0 0 1\n0.25 1e3 8 0 0 1\n3 4 9 0 0 1\n", true},
    {"bars", "x|y\n1.5|-2\n0.25|1e3\n3|4\n", false},
    {"a list of C", "double p[][2] = {\n  {1.5, -2},\n  {0.25, 1e3},\n  {3, 4}\n};\n", false},
    {"points in brackets", "(1.5, -2)\n(0.25, 1e3)\n(3, 4)\n", false},
    {"Fortran", "1.5D0 -2.0D0\n2.5d-1 1.0D+03\n3 4\n", false},
};

TEST(ReadPoints, UnderstandsCommonFormats) {
  for (const FormatCase& c : kFormats) {
    SCOPED_TRACE(c.name);
    const auto curves = parse(c.text);
    ASSERT_TRUE(curves) << curves.error().message;
    ASSERT_EQ(curves->size(), 1u);
    const RawCurve& curve = curves->front();
    ASSERT_EQ(curve.points.size(), 3u);
    EXPECT_EQ(curve.has_z, c.has_z);
    const double z = c.has_z ? 7 : 0;
    EXPECT_EQ(curve.points[0], (core::Point3{1.5, -2, z}));
    EXPECT_EQ(curve.points[1], (core::Point3{0.25, 1000, c.has_z ? 8.0 : 0.0}));
    EXPECT_EQ(curve.points[2], (core::Point3{3, 4, c.has_z ? 9.0 : 0.0}));
  }
}

// Whole numbers in the first row leave open what parts a fraction.
TEST(ReadPoints, TheFirstFractionTellsTheDecimalComma) {
  for (const char* text : {"x;y\n0;0\n1;5\n2,5;-2,25\n3;1\n", "0;0\n1;5\n2.5;-2.25\n3;1\n"}) {
    SCOPED_TRACE(text);
    const auto curves = parse(text);
    ASSERT_TRUE(curves) << curves.error().message;
    ASSERT_EQ(curves->size(), 1u);
    ASSERT_EQ(curves->front().points.size(), 4u);
    EXPECT_EQ(curves->front().points[2], (core::Point3{2.5, -2.25, 0}));
  }
}

TEST(ReadPoints, SeligTitleAndJunkLinesAreIgnored) {
  const auto curves =
      parse("SU-26M scanned 26\n\n1 0\n0.5 0.1\n0 0\n\nhttp://x.example/\n+ Profscan.exe\n");
  ASSERT_TRUE(curves) << curves.error().message;
  EXPECT_EQ(curves->front().points.size(), 3u);
  EXPECT_EQ(curves->front().id, "SU-26M scanned 26");
  EXPECT_EQ(curves->front().notes.size(), 1u);
  EXPECT_EQ(curves->front().left_out,
            (std::vector<std::string>{"line 7: http://x.example/", "line 8: + Profscan.exe"}));
}

TEST(ReadPoints, WordsBetweenTabsHeadColumnsAndNameNoCurve) {
  const auto headed = parse("station\thalf breadth\n0.0\t0.5\n1.0\t1.5\n2.0\t2.5\n");
  ASSERT_TRUE(headed) << headed.error().message;
  EXPECT_EQ((*headed)[0].id, "");
  EXPECT_EQ((*headed)[0].left_out,
            std::vector<std::string>{
                "line 1: station half breadth: names no x and y: the first columns taken"});
  const auto titled = parse("hull nine\n0.0\t0.5\n1.0\t1.5\n2.0\t2.5\n");
  ASSERT_TRUE(titled) << titled.error().message;
  EXPECT_EQ((*titled)[0].id, "hull nine");
}

TEST(ReadPoints, LednicerBecomesOneCurve) {
  const auto curves = parse("NAME\n 3. 4.\n\n0 0\n0.5 0.1\n1 0\n\n0 0\n0.2 -0.1\n0.6 -0.1\n1 0\n");
  ASSERT_TRUE(curves) << curves.error().message;
  const auto& p = curves->front().points;
  ASSERT_EQ(p.size(), 7u);
  EXPECT_EQ(p.front(), (core::Point3{1, 0, 0}));
  EXPECT_EQ(p[1], (core::Point3{0.5, 0.1, 0}));
  EXPECT_EQ(p[4], (core::Point3{0.2, -0.1, 0}));
  EXPECT_EQ(p.back(), (core::Point3{1, 0, 0}));
}

TEST(ReadPoints, IdColumnMakesCurves) {
  const auto curves = parse("id,x,y\na,1,2\nb,3,4\na,5,6\n");
  ASSERT_TRUE(curves) << curves.error().message;
  ASSERT_EQ(curves->size(), 2u);
  EXPECT_EQ((*curves)[0].id, "a");
  EXPECT_EQ((*curves)[0].points.size(), 2u);
  EXPECT_EQ((*curves)[0].source_lines, (std::vector<int>{2, 4}));
  EXPECT_EQ((*curves)[1].points[0], (core::Point3{3, 4, 0}));
  const auto plain = parse("a,1,2\na,3,4\nb,1,1\n");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->size(), 2u);
}

TEST(ReadPoints, ColumnsByNameAndNumber) {
  const char* text = "t,station,height,trust\n0,1,2,0.5\n1,3,4,0.25\n";
  PointsOptions options;
  options.columns = {"station", "3"};
  options.weight_column = "trust";
  const auto curves = parse(text, options);
  ASSERT_TRUE(curves) << curves.error().message;
  EXPECT_EQ(curves->front().points[1], (core::Point3{3, 4, 0}));
  EXPECT_EQ(curves->front().weights, (std::vector<double>{0.5, 0.25}));
  options.columns = {"station", "depth"};
  const auto unknown = parse(text, options);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("depth"), std::string::npos);
}

TEST(ReadPoints, MissingEntriesBecomeNonFinite) {
  const auto curves = parse("0,0\nnan,1\n2,\n3,inf\nNA,1\n,7\n4,4\n");
  ASSERT_TRUE(curves) << curves.error().message;
  ASSERT_EQ(curves->front().points.size(), 7u);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_FALSE(core::is_finite(curves->front().points[i])) << i;
}

struct RealCase {
  const char* name;
  std::string text;
  std::size_t curves;
  std::size_t points;
  std::vector<std::string> left_out;
};

// An airfoil may be called by its number; a count of rows is no name.
TEST(ReadPoints, ANumberBeforeTheRowsIsATitleUnlessItCountsThem) {
  const std::string rows = "1.0 0.0\n0.5 0.06\n0.0 0.0\n0.5 -0.06\n1.0 0.0\n";
  const auto named = parse("2412\n" + rows);
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_EQ(named->front().id, "2412");
  EXPECT_THAT(named->front().left_out,
              testing::ElementsAre(
                  "the number before the rows, 2412, counts none of them: taken for a title"));
  const auto counted = parse("5\n" + rows);
  ASSERT_TRUE(counted);
  EXPECT_EQ(counted->front().id, "");
  EXPECT_EQ(counted->front().points.size(), 5U);
  for (const char* count : {"5", "7", "8"}) {  // of the first, of both, of the row between them too
    const auto both = parse(std::string(count) + "\n" + rows + "999 999\n0.2 0.4\n0.8 0.4\n");
    ASSERT_TRUE(both);
    ASSERT_EQ(both->size(), 2U);
    EXPECT_EQ(both->front().id, "") << count;
  }
}

// Lines as people leave them in files of points; what is data there was counted by hand.
TEST(ReadPoints, RealFilesAreReadAsAPersonReadsThem) {
  const std::string rows = "1.0 0.0\n0.5 0.06\n0.0 0.0\n0.5 -0.06\n1.0 0.0\n";
  const std::string element = "0.9 0.1\n0.95 0.12\n1.0 0.1\n";
  const RealCase cases[] = {
      {"type behind",
       "drop\n" + rows + "Profiltyp: Tropfen\n",
       1,
       5,
       {"line 7: Profiltyp: Tropfen"}},
      {"values behind",
       "E 1\n" + rows + "\n p= 8 alfa0= -4.8\n cm0 = 0.1\n",
       1,
       5,
       {"line 8: p= 8 alfa0= -4.8", "line 9: cm0 = 0.1"}},
      {"a date behind", rows + "Stand: 12.05.1998\n", 1, 5, {"line 6: Stand: 12.05.1998"}},
      {"a sentence that starts with a number",
       rows + "8 percent thick, drawn by hand\n",
       1,
       5,
       {"line 6: 8 percent thick, drawn by hand"}},
      {"end mark", "a\n" + rows + "\x1a\n", 1, 5, {}},
      {"end mark and padding",
       rows + "\x1a" + std::string(3, '\0') + "abc",
       1,
       5,
       {"line 6: what follows the end mark (^Z)"}},
      {"window",
       "two\n -1.0 2.0 -1.0 1.5\n" + rows,
       1,
       5,
       {"line 2: 4 numbers before the rows of points"}},
      {"a count before points in space",
       "5 3\n1 0 0\n0.5 0.06 1\n0 0 2\n0.5 -0.06 3\n1 0 4\n",
       1,
       5,
       {"line 1: 2 numbers before the rows of points"}},
      {"a number too many", rows + "0.9 -0.05 7\n", 1, 6, {"line 6: what stands behind column 2"}},
      {"window and elements",
       "two\n -1.0 2.0 -1.0 1.5\n" + rows + "999.0 999.0\n" + element,
       2,
       8,
       {"line 2: 4 numbers before the rows of points"}},
      {"parts with headings", "Upper\n" + rows + "Lower\n" + element, 2, 8, {}},
      {"commas", "x,y\n1,0\n0.5,1\n0,0\nProfil: Tropfen\n", 1, 3, {"line 5: Profil: Tropfen"}},
  };
  for (const RealCase& c : cases) {
    SCOPED_TRACE(c.name);
    const auto curves = parse(c.text);
    ASSERT_TRUE(curves) << curves.error().message << ' ' << curves.error().path;
    EXPECT_EQ(curves->size(), c.curves);
    std::size_t points = 0;
    for (const RawCurve& curve : *curves) points += curve.points.size();
    EXPECT_EQ(points, c.points);
    EXPECT_EQ(curves->front().left_out, c.left_out);
  }
}

// Names are UTF-8 whatever the file's encoding was, and are not cut within a character.
TEST(ReadPoints, NamesAreUtf8) {
  const std::string rows = "1 0\n0.5 0.06\n0 0\n";
  EXPECT_EQ(parse("Profil G\xf6ttingen 387\n" + rows)->front().id, "Profil G\u00f6ttingen 387");
  EXPECT_EQ(parse("Profil G\u00f6ttingen 387\n" + rows)->front().id, "Profil G\u00f6ttingen 387");
  EXPECT_EQ(parse("\x80 100\n" + rows)->front().id, "\u20ac 100");  // Windows-1252
  const std::string most(39, 'a');
  EXPECT_EQ(parse(most + "\u00f6\n" + rows)->front().id, most + "...");
}

TEST(ReadPoints, PointsAt999BelongToLargeDrawings) {
  const auto curves = parse("0 0\n500 500\n999 999\n1500 1400\n");
  ASSERT_TRUE(curves);
  EXPECT_EQ(curves->size(), 1u);
  EXPECT_EQ(curves->front().points.size(), 4u);
}

TEST(ReadPoints, PartsKeepTheirNames) {
  const auto curves = parse("wing\n0 0\n1 0\n2 1\nflap\n3 0\n4 0\n5 1\n");
  ASSERT_TRUE(curves) << curves.error().message;
  ASSERT_EQ(curves->size(), 2u);
  EXPECT_EQ((*curves)[0].id, "wing");
  EXPECT_EQ((*curves)[1].id, "flap");
  EXPECT_EQ((*curves)[1].source_lines, (std::vector<int>{6, 7, 8}));
}

struct BadCase {
  const char* name;
  std::string text;
  const char* path;
};

TEST(ReadPoints, FailuresTellThePlace) {
  const BadCase cases[] = {
      {"empty", "", "data.csv"},
      {"blank", "\n \n\n", "data.csv"},
      {"no points", "hello\nworld\n", "data.csv"},
      {"one column", "1\n2\n3\n", "data.csv"},
      {"text", "0,0\n1,abc\n2,0\n", "data.csv:2"},
      {"text, spaces", "0 0\n1 abc\n2 0\n", "data.csv:2"},
      {"text in the first row", "0,zero\n1,1\n", "data.csv:1"},
      {"text row", "0,0\n1,1\nx,y\n", "data.csv:3"},
      {"text between", "0 0\nfoo bar\n1 1\n", "data.csv:2"},
      {"columns missing", "0 0 0\n1 1 1\n2 2\n", "data.csv:3"},
      {"a cut last row", "0 0\n1 1\n2\n", "data.csv:3"},
      {"a broken last row", "0 0\n1 1\n2 2\n3 o.5\n", "data.csv:4"},
      {"text within a curve", "0 0\n1 1\n2 2\nfoo bar\n3 3\n4 4\n", "data.csv:4"},
      {"a decimal comma among commas", "0,0\n1,3,5\n2,1\n3,2\n", "data.csv:2"},
      {"a comma where points part fractions", "0;0\n1.5;2\n1,234;2\n", "data.csv:3"},
      {"one row behind another", "0 0 0\n1 1\n", "data.csv:2"},
      {"large", "0,0\n1,1e300\n", "data.csv:2"},
      {"overflow", "0,0\n1,1e999\n", "data.csv:2"},
      {"binary", std::string("0,0\n\0\1\2", 7), "data.csv:2"},
  };
  for (const BadCase& c : cases) {
    SCOPED_TRACE(c.name);
    const auto curves = parse(c.text);
    ASSERT_FALSE(curves);
    EXPECT_EQ(curves.error().code, core::ErrorCode::bad_input);
    EXPECT_EQ(curves.error().path, c.path);
    EXPECT_FALSE(curves.error().message.empty());
    EXPECT_FALSE(curves.error().hint.empty());
  }
}

/// Endless stream of one digit: a line of any length without a newline.
class Endless : public std::streambuf {
 public:
  std::size_t served = 0;

 protected:
  int_type underflow() override {
    served += sizeof(chunk_);
    std::fill(std::begin(chunk_), std::end(chunk_), '1');
    setg(chunk_, chunk_, chunk_ + sizeof(chunk_));
    return traits_type::to_int_type(*gptr());
  }

 private:
  char chunk_[4096];
};

TEST(ReadPoints, HugeLineIsGivenUpEarly) {
  Endless endless;
  std::istream in(&endless);
  const auto curves = read_points(in, "huge.csv", {});
  ASSERT_FALSE(curves);
  EXPECT_EQ(curves.error().path, "huge.csv:1");
  EXPECT_LT(endless.served, 3u << 20);
}

TEST(ReadPoints, MissingFileIsIo) {
  const auto curves = read_points(std::filesystem::path("/nowhere/at/all.csv"));
  ASSERT_FALSE(curves);
  EXPECT_EQ(curves.error().code, core::ErrorCode::io);
  const auto folder = read_points(std::filesystem::temp_directory_path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, core::ErrorCode::io);
}

struct SharedCase {
  const char* file;
  std::size_t curves;
  std::size_t points;  // of all curves
};

constexpr SharedCase kShared[] = {
    {"airfoil/e387.dat", 1, 61},
    {"airfoil/eiffel371.dat", 1, 401},
    {"airfoil/fx63145.dat", 1, 97},
    {"airfoil/goe387.dat", 1, 33},
    {"airfoil/hq17.dat", 1, 95},
    {"airfoil/joukowsk.dat", 1, 91},
    {"airfoil/naca2412.dat", 1, 69},
    {"airfoil/su-26m.dat", 1, 255},
    {"track/Monza.csv", 1, 1159},
    {"track/Norisring.csv", 1, 460},
    {"track/Spa.csv", 1, 1401},
    {"contour/bot_open.csv", 24, 3971},
    {"contour/hearts_open.csv", 12, 960},
    {"contour/mosquito_open.csv", 5, 500},
    {"contour/nsfishes_open.csv", 6, 720},
    {"contour/trilo_open.csv", 5, 320},
    {"contour/olea_open.csv", 5, 486},
};

TEST(ReadPoints, ReadsTheSharedProfiles) {
  const std::filesystem::path folder = std::filesystem::path(KEYLINE_SHARED_DATA) / "1_profiles";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(folder), folder);
  for (const SharedCase& c : kShared) {
    SCOPED_TRACE(c.file);
    const auto curves = read_points(folder / c.file);
    ASSERT_TRUE(curves) << curves.error().message << " " << curves.error().path;
    EXPECT_EQ(curves->size(), c.curves);
    std::size_t points = 0;
    for (const RawCurve& curve : *curves) {
      points += curve.points.size();
      EXPECT_FALSE(curve.has_z);
      EXPECT_TRUE(curve.weights.empty());
    }
    EXPECT_EQ(points, c.points);
  }
}

}  // namespace
}  // namespace keyline::exchange
