#include <string>

#include <gtest/gtest.h>

#include "keyline/fairing/fair.h"

/// Options as text, read and refused.
namespace keyline::fairing {
namespace {

TEST(EndClamps, AreReadFromText) {
  const auto read = [](const char* text) {
    const auto clamps = EndClamps::from_text(text);
    EXPECT_TRUE(clamps) << text;
    return clamps.value_or(EndClamps{});
  };
  EXPECT_EQ(read("start:G1").start, Clamp::g1);
  EXPECT_EQ(read("start:G1").end, Clamp::none);
  EXPECT_EQ(read("end:G2").end, Clamp::g2);
  EXPECT_EQ(read("end:G2").start, Clamp::none);
  EXPECT_EQ(read("start:G0,end:G2").start, Clamp::g0);
  EXPECT_EQ(read("start:G0,end:G2").end, Clamp::g2);
  EXPECT_EQ(read("end:G0,start:none").end, Clamp::g0);
  EXPECT_EQ(read("start:G1,start:G2").start, Clamp::g2);  // the last one counts
  for (const char* text : {"", "start", "start:", "start:G3", "G1", ":G1", "middle:G1", "start:G1,",
                           ",end:G1", "start:G1;end:G1", "start:G1,end"})
    EXPECT_FALSE(EndClamps::from_text(text)) << text;
}

TEST(InterpretationOverride, IsReadFromText) {
  const auto rhythm = InterpretationOverride::from_text("3:plus").value();
  EXPECT_EQ(rhythm.piece, 3);
  EXPECT_EQ(rhythm.rhythm, analysis::Rhythm::plus);
  EXPECT_FALSE(rhythm.slope);
  const auto slope = InterpretationOverride::from_text("0:slope=-0.5").value();
  EXPECT_EQ(slope.piece, 0);
  EXPECT_EQ(slope.slope, -0.5);
  EXPECT_FALSE(slope.rhythm);
  EXPECT_EQ(InterpretationOverride::from_text("1000000:arc").value().piece, 1'000'000);
  EXPECT_EQ(InterpretationOverride::from_text("1:plus+minus").value().rhythm,
            analysis::Rhythm::plus_minus);
  for (const char* text : {"", "3", "plus", ":plus", "3:", "-1:plus", "1.5:plus", "1000001:arc",
                           "x:plus", "3:curly", "3:slope=", "3:slope=x", "3:slope"})
    EXPECT_FALSE(InterpretationOverride::from_text(text)) << text;
}

TEST(InterpretationOverride, IsOneOfTheTwo) {
  InterpretationOverride asked;
  EXPECT_EQ(InterpretationOverride::check(asked).error().path, "rhythm");
  asked.slope = 1;
  EXPECT_TRUE(InterpretationOverride::check(asked));
  asked.rhythm = analysis::Rhythm::arc;
  EXPECT_EQ(InterpretationOverride::check(asked).error().path, "slope");
  asked.slope.reset();
  EXPECT_TRUE(InterpretationOverride::check(asked));
}

// Words of an impression are for pieces that the points tell and the eye sees.
TEST(Impression, IsOfWhatIsToldAndSeen) {
  FairPiece piece;
  piece.rhythm = analysis::Rhythm::plus;
  const std::string words = impression(piece);
  EXPECT_EQ(words, analysis::impression(analysis::Rhythm::plus));
  EXPECT_NE(words, "");
  piece.told = false;
  EXPECT_STREQ(impression(piece), "");
  piece.told = true;
  piece.seen = false;
  EXPECT_STREQ(impression(piece), "");
}

}  // namespace
}  // namespace keyline::fairing
