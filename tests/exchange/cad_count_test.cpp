#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "iges_text.h"
#include "step_text.h"

/// How many parameters entities have, counted by hand from IGES 5.3, and what else of a file's
/// values is checked before it is read.
namespace keyline::exchange {
namespace {

using testing::HasSubstr;
using testing::Not;

class CadCount : public CadTest {
 protected:
  /// What a file of one entity with those parameters, its type first, is refused for.
  std::string why(const std::string& parameters) const {
    const auto d = read_text("d.iges", iges_file({{.parameters = parameters}}));
    if (d) return {};
    const std::string& place = d.error().path;
    return place.substr(place.rfind(':') + 1) + ": " + d.error().message;
  }
};

struct Counted {
  const char* start;  ///< type, and the counts it tells
  int more;           ///< parameters behind these
};

// Sections 4.3 to 4.36: of a circle ZT, X1, Y1 … Y3; of a copious form 1 a z and two numbers a
// point, of 2 three, of 3 six; of a parametric spline n + 1 breaks, 12 coefficients of each of n
// pieces and 12 values at its end; of a spline of index 2 and degree 1 its 4 properties, 5 knots, 3
// weights, 9 coordinates, 2 ends and a normal; of a surface of indices 1 and 2 and degrees 1 and 2
// 5 properties, 4 and 6 knots, 6 weights, 18 coordinates and 4 ends.
constexpr Counted kCounted[] = {
    {"100", 7},      {"102,2", 2},      {"104", 11},       {"106,1,2", 5},      {"106,2,2", 6},
    {"106,3,2", 12}, {"108", 9},        {"110", 6},        {"112,3,1,3,2", 39}, {"116", 4},
    {"118", 4},      {"120", 4},        {"122", 4},        {"123", 3},          {"124", 12},
    {"125", 6},      {"126,2,1", 26},   {"130", 14},       {"128,1,2,1,2", 43}, {"140", 5},
    {"142", 5},      {"143,1,99,2", 2}, {"144,99,1,2", 3}, {"144,99,0,1", 2},
};

TEST_F(CadCount, OfEveryTypeIsThatOfIges) {
  for (const Counted& c : kCounted) {
    SCOPED_TRACE(c.start);
    std::string all = c.start;
    for (int i = 0; i < c.more; ++i) all += ",1";
    EXPECT_THAT(why(all), Not(HasSubstr("more numbers")));
    const std::string type = std::string(c.start).substr(0, 3);
    EXPECT_EQ(why(all + ",1"), "6: more numbers than an entity of type " + type + " has");
  }
}

// 2.2.4.5.2: behind the parameters two counts, of so many pointers each, to lines with odd numbers.
TEST_F(CadCount, ListsOfPointersMayStandBehind) {
  const std::string line = "110,0,0,0,4,3,0";
  for (const char* lists : {"", ",", ",0,0", ",1,5", ",0,1,5", ",2,1,3", ",1,5,1,7", ",1,5,0"})
    EXPECT_THAT(why(line + lists), Not(HasSubstr("more numbers"))) << lists;
  for (const char* none : {",0", ",1", ",1,4", ",0,1,4", ",1,5,1", ",1,5,1,7,1,9", ",2,1", ",-1"})
    EXPECT_THAT(why(line + none), HasSubstr("more numbers")) << none;
}

// 2.2.2.1 and 2.2.4.4: powers of ten as Fortran writes them; the form of an entity is a whole
// number.
TEST_F(CadCount, NumbersOfIgesAreThoseOfFortran) {
  for (const char* end :
       {"12.5,3.75,0", "1.25D1,.375D+1,0.D0", "1.25d1,37.5d-1,0", "125E-1,3.75e0,0"}) {
    const auto d =
        read_text("d.iges", iges_file({{.parameters = "110,0,0,0," + std::string(end)}}));
    ASSERT_TRUE(d) << d.error().message;
    EXPECT_LT(distance(evaluate(d->paths.at(0).path, 1), {12.5, 3.75}), 1e-14) << end;
  }
  std::string text = iges_file({{.parameters = "110,0,0,0,4,3,0"}});
  const std::size_t form = text.find("D0000002") - 72 + 32;
  ASSERT_EQ(text.substr(form, 8), "       0");
  text[form + 7] = 'x';
  const auto bad = read_text("d.iges", text);
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message, HasSubstr("\"x\" is no value"));
}

/// A line from the origin, and what else stands in a STEP file's data.
std::string step_line(const std::string& end, const std::string& beside = {}) {
  return step_curves("#21",
                     "#21=TRIMMED_CURVE('',#22,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(5.)),"
                     ".T.,.PARAMETER.);\n#22=LINE('',#15,#23);\n#23=VECTOR('',#24,1.);\n"
                     "#24=DIRECTION('',(" +
                         end + "));\n" + beside);
}

// ISO 10303-21, 6.4 to 6.6 and 9.2: comments hold anything, keywords of the user's own begin with
// "!".
TEST_F(CadCount, CommentsAndOwnKeywordsOfStepAreNoValues) {
  for (const char* beside : {"", "/* (1.,,x) it's */\n", "/**/", "#30=(A()!OWN_THING((1.)));\n",
                             "#30=!OWN_THING((.T.,.OTHER.),'a''b (1.,,2',$,*);\n"}) {
    const auto d = read_text("d.step", step_line("0.6,0.8,0.", beside));
    ASSERT_TRUE(d) << beside << d.error().message;
    EXPECT_LT(distance(evaluate(d->paths.at(0).path, 1), {3, 4}), 1e-14) << beside;
  }
  for (const char* none : {"#30=A((.));\n", "#30=A((..));\n", "#30=A(OTHER);\n"}) {
    const auto d = read_text("d.step", step_line("1.,0.,0.", none));
    ASSERT_FALSE(d) << none;
    EXPECT_THAT(d.error().message, HasSubstr("is no value")) << none;
  }
}

// A decimal comma makes a fourth number of a direction, too.
TEST_F(CadCount, DirectionsOfStepHaveThreeNumbers) {
  EXPECT_TRUE(read_text("d.step", step_line("0.6,0.8,0.")));
  const auto comma = read_text("d.step", step_line("0,6,0.8,0."));
  ASSERT_FALSE(comma);
  EXPECT_THAT(comma.error().message, HasSubstr("more than three coordinates"));
}

}  // namespace
}  // namespace keyline::exchange
