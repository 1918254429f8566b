#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"
#include "keyline/exchange/document_file.h"

#include "cad_fixture.h"

namespace keyline::exchange {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Files of one coloured curve whose values are exchanged for others.
class CadValues : public CadTest {
 protected:
  static std::string sound(const std::string& extension, const curve::Bezier2& curve) {
    document::Document d;
    d.unit = "mm";
    d.paths.push_back({{"a", "", "#336699"}, {{{curve}}, false}, 0});
    return format_document(d, extension).value().content;
  }

  /// The file with what stands from the end of `before` up to `end` replaced.
  core::Result<document::Document> with(std::string text, const std::string& extension,
                                        std::string_view before, char end,
                                        std::string_view value) const {
    const std::size_t at = text.find(before);
    if (at == std::string::npos) return core::fail(core::ErrorCode::internal, "not there", "", "");
    const std::size_t from = at + before.size();
    text.replace(from, text.find(end, from) - from, value);
    const auto file = folder_ / ("d" + extension);
    std::ofstream(file, std::ios::binary) << text;
    return read_document(file);
  }
};

const curve::Bezier2 kLine{{{0, 0}, {12.5, 3.75}}, {}};
const curve::Bezier2 kArch{{{0, 0}, {10, 12.5}, {30, 0.25}, {40, 20}}, {}};

// ISO 10303-46: a colour has a name and three intensities from 0 to 1. OCCT takes 0 for what is not
// there, and 1 for 255.
TEST_F(CadValues, ColoursThatAreNoneAreToldAndNotGuessed) {
  const std::string file = sound(".step", kArch);
  const auto with_color = [&](std::string_view rgb) {
    return with(file, ".step", "COLOUR_RGB('',", ')', rgb);
  };
  const auto green = with_color("0.2,0.6,0.");
  ASSERT_TRUE(green) << green.error().message;
  EXPECT_EQ(green->paths.at(0).label.color, "#339900");
  EXPECT_THAT(green->skipped, IsEmpty());
  const auto bounds = with_color("1.,1,0");
  ASSERT_TRUE(bounds) << bounds.error().message;
  EXPECT_EQ(bounds->paths.at(0).label.color, "#ffff00");
  EXPECT_THAT(bounds->skipped, IsEmpty());
  for (const char* none : {"0.2,0.4", "$,0.4,0.6", "-0.2,0.4,0.6", "0.2,0.4,1.001"}) {
    const auto read = with_color(none);
    ASSERT_TRUE(read) << none << ": " << read.error().message;
    EXPECT_EQ(read->paths.at(0).label.color, "") << none;
    const auto why = AnyOf(HasSubstr("Count of Parameters is not 4"), HasSubstr("not a Real"),
                           HasSubstr("three numbers from 0 to 1"));
    EXPECT_THAT(read->skipped, ElementsAre(why)) << none;
  }
}

// Printed by programs that do not know ISO 10303-21, 6.4.2, which wants a point and a large E.
TEST_F(CadValues, NumbersWithPowersOfTenAreReadHoweverTheyAreWritten) {
  const std::string file = sound(".step", kArch);
  for (const char* x : {"e1", "00E-1", ".0e+01", "0.0e0", ".E1", "E+1"}) {
    const auto read = with(file, ".step", "CARTESIAN_POINT('',(1", ',', x);
    ASSERT_TRUE(read) << "1" << x << ": " << read.error().message;
    const auto& arch = std::get<curve::BSpline2>(read->paths.at(0).path.curves.at(0).value);
    EXPECT_EQ(arch.control.at(1), kArch.control.at(1)) << "1" << x;
  }
}

// ISO 10303-42: a spline has nine parameters, a degree and multiplicities that are whole numbers;
// OCCT takes 0 for others, or breaks down.
TEST_F(CadValues, GeometryOfOtherParametersIsRefused) {
  const std::string file = sound(".step", kArch);
  for (const char* degree : {"$", "3,3"}) {
    const auto read = with(file, ".step", "B_SPLINE_CURVE_WITH_KNOTS('',", ',', degree);
    ASSERT_FALSE(read) << degree;
    EXPECT_THAT(read.error().message, HasSubstr("#")) << degree;
  }
  const auto read = with(file, ".step", "CARTESIAN_POINT('',(", ',', "$");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("not a Real"));
}

/// The place of the first parameter line that begins with that type.
std::size_t parameters_of(const std::string& file, const std::string& type) {
  const std::size_t at = file.find("\n" + type + ",");
  return at == std::string::npos ? at : at + 1;
}

// IGES 5.3, 4.23 and 4.4: a spline's numbers are counted by its index and degree, a composite's
// curves by their own count; with a count less there is more than it counts, as with a comma more.
TEST_F(CadValues, EntitiesOfMoreNumbersThanTheyCountAreRefused) {
  document::Document d;
  d.unit = "mm";
  const curve::Bezier2 on{{{40, 20}, {60, 20}}, {}};
  d.paths.push_back({{"a", "", ""}, {{{kArch}, {on}}, false}, 0});
  const std::string file = format_document(d, ".iges").value().content;
  const auto name = folder_ / "d.iges";
  for (const char* type : {"126", "102"}) {
    const std::size_t at = parameters_of(file, type);
    ASSERT_NE(at, std::string::npos) << type;
    std::string fewer = file;
    --fewer[fewer.find(',', at + 4) - 1];
    std::ofstream(name, std::ios::binary) << fewer;
    const auto read = read_document(name);
    ASSERT_FALSE(read) << type;
    EXPECT_THAT(read.error().message,
                HasSubstr("more numbers than an entity of type " + std::string(type) + " has"));
  }
  std::ofstream(name, std::ios::binary) << file;
  EXPECT_TRUE(read_document(name));
}

// "12,5" in place of "12.5" leaves a coordinate over: where that is 0, it is no list of no
// pointers.
TEST_F(CadValues, ANumberLeftOverIsNoCount) {
  document::Document d;
  d.unit = "mm";
  d.paths.push_back({{}, {{{kLine}}, false}, 0});
  std::string file = format_document(d, ".iges").value().content;
  const std::size_t first = parameters_of(file, "110");
  std::string record = "110,0,0,0,12.5,3,0;";
  const auto text = [&] {
    return file.substr(0, first) + record + std::string(64 - record.size(), ' ') +
           " 0000001P0000001\nS      1G      3D      2P      1" + std::string(40, ' ') +
           "T0000001\n";
  };
  const auto name = folder_ / "d.iges";
  std::ofstream(name, std::ios::binary) << text();
  const auto read = read_document(name);
  ASSERT_TRUE(read) << read.error().message << text();
  EXPECT_EQ(evaluate(read->paths.at(0).path, 1), (core::Point2{12.5, 3}));
  record[12] = ',';
  std::ofstream(name, std::ios::binary) << text();
  const auto comma = read_document(name);
  ASSERT_FALSE(comma);
  EXPECT_THAT(comma.error().message, HasSubstr("more numbers than an entity of type 110 has"));
}

// A line of the file that stands twice or at another's place moves numbers to others', though every
// entity has as many as before.
TEST_F(CadValues, LinesOfIgesHaveToStandInTheirOrder) {
  const std::string file = sound(".iges", kArch);
  const std::size_t first = file.find('\n', parameters_of(file, "126")) + 1;
  const std::size_t second = file.find('\n', first) + 1, third = file.find('\n', second) + 1;
  const std::string one = file.substr(first, second - first);
  const std::string two = file.substr(second, third - second);
  const std::size_t name = parameters_of(file, "406");
  const std::string line = file.substr(name, file.find('\n', name) + 1 - name);
  const auto path = folder_ / "d.iges";
  for (const std::string& text : {file.substr(0, first) + two + one + file.substr(third),
                                  file.substr(0, name) + line + file.substr(name)}) {
    std::ofstream(path, std::ios::binary) << text;
    const auto read = read_document(path);
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().message, HasSubstr("of section P should stand here"));
  }
  std::string bare = file;  // a line that leaves its number out
  bare.replace(first + 73, 7, 7, ' ');
  std::ofstream(path, std::ios::binary) << bare;
  EXPECT_TRUE(read_document(path));
}

// IGES 5.3, 4.13: a line has six numbers; a decimal comma makes a seventh, and another end.
TEST_F(CadValues, ALineOfMoreNumbersThanSixIsRefused) {
  const std::string file = sound(".iges", kLine);
  const std::size_t at = file.find("1.25", file.find("110,"));
  ASSERT_NE(at, std::string::npos);
  std::string commas = file;
  commas[at + 1] = ',';
  const auto name = folder_ / "d.iges";
  std::ofstream(name, std::ios::binary) << commas;
  const auto read = read_document(name);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("more numbers than an entity of type 110 has"));
  std::ofstream(name, std::ios::binary) << file;
  EXPECT_TRUE(read_document(name));
}

}  // namespace
}  // namespace keyline::exchange
