#include "keyline/document/document.h"

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/document/arc.h"

namespace keyline::document {
namespace {

NamedPath line(const std::string& name, const std::string& layer) {
  return {{name, layer, {}}, {{{curve::Bezier2{{{0, 0}, {1, 0}}, {}}}}, false}, 0};
}

Document three() {
  Document d;
  d.paths = {line("roof", "body"), line("sill", "body"), line("3", "")};
  d.space_curves.push_back({{"rail", "wire", {}}, {curve::Bezier3{{{0, 0, 0}, {1, 0, 2}}, {}}}});
  return d;
}

std::size_t left(const std::string& wanted) {
  Document d = three();
  const auto done = select(d, wanted);
  return done ? size(d) : 0;
}

TEST(Document, SelectsByNameThenLayerThenNumber) {
  EXPECT_EQ(left(""), 4U);
  EXPECT_EQ(left("roof"), 1U);
  EXPECT_EQ(left("body"), 2U);
  Document d = three();
  ASSERT_TRUE(select(d, "3"));  // the name goes before the number
  EXPECT_EQ(d.paths.at(0).label.name, "3");
  d = three();
  ASSERT_TRUE(select(d, "4"));
  EXPECT_TRUE(d.paths.empty());
  EXPECT_EQ(d.space_curves.at(0).label.name, "rail");
}

TEST(Document, SaysWhatCouldBeSelected) {
  for (const char* wanted : {"boot", "5", "0", "-1", "2x"}) {
    Document d = three();
    const auto done = select(d, wanted);
    ASSERT_FALSE(done) << wanted;
    EXPECT_EQ(done.error().path, "--select");
    EXPECT_NE(done.error().hint.find("roof, sill, 3, rail"), std::string::npos);
    EXPECT_EQ(size(d), 4U);
  }
}

TEST(Arc, IsFoundInPiecesAndRationalQuadratics) {
  for (const double turn : {0.3, -1.2, 1.5707963267948966}) {
    const Arc arc{{3, -2}, 5, 0.7, turn};
    const auto chain = as_arc(lac::segment_at(chain_of(arc), 0));
    ASSERT_TRUE(chain);
    const core::Point2 a = point_on(arc, arc.start);
    const core::Point2 b = point_on(arc, arc.start + turn);
    const double w = std::cos(turn / 2);
    const core::Point2 m = arc.center + (5 / w) * core::unit_vector(arc.start + turn / 2);
    const auto bezier = as_arc(curve::Bezier2{{a, m, b}, {1, w, 1}});
    ASSERT_TRUE(bezier);
    for (const Arc& found : {*chain, *bezier}) {
      EXPECT_NEAR(distance(found.center, arc.center), 0, 1e-13);
      EXPECT_NEAR(found.radius, 5, 1e-13);
      EXPECT_NEAR(found.start, 0.7, 1e-14);
      EXPECT_NEAR(found.turn, turn, 1e-14);
    }
    EXPECT_FALSE(as_arc(curve::Bezier2{{a, m, b}, {1, w * 1.001, 1}}));
    EXPECT_FALSE(as_arc(curve::Bezier2{{a, m, b}, {}}));
  }
  EXPECT_FALSE(as_arc(lac::Segment{{}, -1, 2, 0, 0}));
  EXPECT_FALSE(as_arc(lac::Segment{{}, -1, 2, 0.1, 0.2}));
}

TEST(Arc, JoinsWhatGoesOnAndNothingElse) {
  const Arc first{{1, 1}, 2, 0.5, 1};
  const auto whole = joined(first, {{1, 1}, 2, 1.5, 2});
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->turn, 3, 1e-15);
  EXPECT_FALSE(joined(first, {{1, 1}, 2, 1.6, 2}));
  EXPECT_FALSE(joined(first, {{1, 1}, 2, 1.5, -1}));
  EXPECT_FALSE(joined(first, {{1, 1.1}, 2, 1.5, 1}));
  EXPECT_FALSE(joined(first, {{1, 1}, 2, 1.5, 6}));
}

}  // namespace
}  // namespace keyline::document
