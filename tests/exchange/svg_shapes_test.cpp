#include "keyline/exchange/svg/svg_shapes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/exchange/points/points_columns.h"

/// Basic shapes of SVG 1.1, section 9, and columns of tables.
namespace keyline::exchange::detail {
namespace {

using core::Point2;

struct Shape {
  pugi::xml_document document;
  explicit Shape(const char* text) { document.load_string(text); }
  pugi::xml_node node() const { return document.first_child(); }
};

SvgPathData shape(const char* text, const SvgViewport& viewport = {}) {
  const Shape s(text);
  return svg_shape(s.node(), viewport);
}

std::vector<Point2> starts(const SvgPathData& data) {
  std::vector<Point2> all;
  for (const auto& piece : data.subpaths.at(0).pieces) all.push_back(piece.control.front());
  return all;
}

// Clockwise on the screen from its upper left corner.
TEST(SvgShapes, RectanglesAreFourSides) {
  const auto rect = shape("<rect x='1' y='2' width='4' height='3'/>");
  EXPECT_EQ(starts(rect), (std::vector<Point2>{{1, 2}, {5, 2}, {5, 5}, {1, 5}}));
  EXPECT_TRUE(rect.subpaths[0].closed);
  for (const char* none :
       {"<rect width='4'/>", "<rect width='0' height='3'/>", "<rect width='-4' height='3'/>",
        "<rect width='4' height='x'/>", "<rect x='z' width='4' height='3'/>"})
    EXPECT_FALSE(shape(none).error.empty()) << none;
}

// One radius counts for both, none is more than half a side, and 0 or less rounds nothing.
TEST(SvgShapes, RectanglesMayHaveRoundCorners) {
  const auto places = [](const char* text) { return starts(shape(text)); };
  EXPECT_EQ(places("<rect width='10' height='6' rx='2' ry='1'/>")[1], (Point2{8, 0}));
  EXPECT_EQ(places("<rect width='10' height='6' rx='2' ry='1'/>")[2], (Point2{10, 1}));
  EXPECT_EQ(places("<rect width='10' height='6' rx='2'/>")[2], (Point2{10, 2}));
  EXPECT_EQ(places("<rect width='10' height='6' ry='2'/>")[1], (Point2{8, 0}));
  const auto round = places("<rect width='10' height='6' rx='9' ry='9'/>");
  EXPECT_EQ(round.size(), 4U);  // half an ellipse after the other, no sides left
  EXPECT_EQ(places("<rect width='10' height='6' rx='0' ry='2'/>").size(), 4U);
  EXPECT_EQ(places("<rect width='10' height='6' rx='-1' ry='2'/>")[1], (Point2{8, 0}));
}

TEST(SvgShapes, CirclesAndEllipsesBeginOnTheRight) {
  const auto circle = shape("<circle cx='1' cy='2' r='3'/>");
  EXPECT_EQ(starts(circle), (std::vector<Point2>{{4, 2}, {1, 5}, {-2, 2}, {1, -1}}));
  const auto middle = evaluate(circle.subpaths[0].pieces[0], 0.5);
  EXPECT_NEAR(std::hypot(middle.x - 1, middle.y - 2), 3, 1e-3);
  EXPECT_GT(middle.y, 2);
  EXPECT_EQ(starts(shape("<ellipse rx='3' ry='2'/>")),
            (std::vector<Point2>{{3, 0}, {0, 2}, {-3, 0}, {0, -2}}));
  for (const char* none :
       {"<circle r='0'/>", "<circle r='-1'/>", "<ellipse rx='1'/>", "<circle cx='x' r='1'/>"})
    EXPECT_FALSE(shape(none).error.empty()) << none;
}

TEST(SvgShapes, LinesAndPolygonsAreTheirCorners) {
  EXPECT_EQ(shape("<line x1='1' y2='2'/>").subpaths[0].pieces[0].control,
            (std::vector<Point2>{{1, 0}, {0, 2}}));
  EXPECT_TRUE(shape("<line x1='1' x2='1'/>").subpaths.empty());
  EXPECT_TRUE(shape("<line x1='1' x2='1'/>").error.empty());
  EXPECT_FALSE(shape("<line x1='a'/>").error.empty());
  const auto open = shape("<polyline points='0,0 1 0, 1,1 1,1'/>");
  EXPECT_EQ(open.subpaths[0].pieces.size(), 2U);
  EXPECT_FALSE(open.subpaths[0].closed);
  const auto closed = shape("<polygon points='0,0 1,0 1,1'/>");
  EXPECT_EQ(closed.subpaths[0].pieces.size(), 3U);
  EXPECT_TRUE(closed.subpaths[0].closed);
  // What cannot be read ends it; what stood before counts.
  const auto bad = shape("<polyline points='0,0 1,0 1'/>");
  EXPECT_EQ(bad.subpaths[0].pieces.size(), 1U);
  EXPECT_FALSE(bad.error.empty());
}

// Percentages are of the width, the height, or the diagonal over the root of 2.
TEST(SvgShapes, LengthsMayBeShares) {
  const SvgViewport viewport{200, 100};
  const Shape s(
      "<circle cx='10%' cy='10%' r='10%' width='50%' height='50%' x='1in' y='z' ry='5%'/>");
  const auto length = [&](const char* name) { return svg_length(s.node(), name, 7, viewport); };
  EXPECT_EQ(length("cx"), 20);
  EXPECT_EQ(length("cy"), 10);
  EXPECT_NEAR(length("r"), 0.1 * std::hypot(200, 100) / std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(length("width"), 100);
  EXPECT_EQ(length("height"), 50);
  EXPECT_EQ(length("ry"), 5);
  EXPECT_EQ(length("x"), 96);
  EXPECT_TRUE(std::isnan(length("y")));
  EXPECT_EQ(length("fx"), 7);
}

TEST(SvgShapes, NamesHaveNoPrefix) {
  EXPECT_EQ(local_name(Shape("<svg:rect/>").node()), "rect");
  EXPECT_EQ(local_name(Shape("<rect/>").node()), "rect");
  for (const char* name : {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"})
    EXPECT_TRUE(is_svg_shape(name)) << name;
  EXPECT_FALSE(is_svg_shape("text"));
}

// ---- Columns -----------------------------------------------------------------------------

PointsColumns columns(const std::vector<std::string>& names, const PointsOptions& options = {},
                      std::size_t fields = 2, bool text_id = false) {
  return choose_columns(names, options, fields, text_id, "place").value();
}

TEST(PointsColumns, AreNamedOrTheFirst) {
  const PointsColumns named = columns({"t", "y", "x", "w", "name"});
  EXPECT_EQ(named.x, 2);
  EXPECT_EQ(named.y, 1);
  EXPECT_EQ(named.z, PointsColumns::kNone);
  EXPECT_EQ(named.weight, 3);
  EXPECT_EQ(named.id, 4);
  EXPECT_EQ(named.last(), 4);
  EXPECT_EQ(columns({"x", "y", "z"}).z, 2);
  // Of two axes alone these are the plane's.
  const PointsColumns plane = columns({"z", "y"});
  EXPECT_EQ(plane.x, 1);
  EXPECT_EQ(plane.y, 0);
  const PointsColumns bare = columns({});
  EXPECT_EQ(bare.x, 0);
  EXPECT_EQ(bare.y, 1);
  EXPECT_EQ(bare.z, PointsColumns::kNone);
  EXPECT_EQ(columns({}, {}, 3).z, 2);
  EXPECT_EQ(columns({}, {}, 3, true).z, PointsColumns::kNone);
  EXPECT_EQ(columns({}, {}, 4, true).z, 3);
  EXPECT_EQ(columns({}, {}, 4, true).id, 0);
}

TEST(PointsColumns, ThoseAskedForCount) {
  PointsOptions options;
  options.columns = {"b", "3", "a"};
  options.weight_column = "c";
  options.id_column = "1";
  const PointsColumns asked = columns({"a", "b", "c"}, options);
  EXPECT_EQ(asked.x, 1);
  EXPECT_EQ(asked.y, 2);
  EXPECT_EQ(asked.z, 0);
  EXPECT_EQ(asked.weight, 2);
  EXPECT_EQ(asked.id, 0);
  for (const auto& bad : {std::vector<std::string>{"a"},
                          {"a", "b", "c", "a"},
                          {"a", "q"},
                          {"a", "0"},
                          {"a", "12345"}}) {
    options.columns = bad;
    EXPECT_FALSE(choose_columns({"a", "b", "c"}, options, 3, false, "place"));
  }
}

TEST(PointsColumns, HeadersNameAxesOrWhatIsAskedFor) {
  EXPECT_TRUE(is_points_header({"x", "y"}, {}));
  EXPECT_TRUE(is_points_header({"z", "x"}, {}));
  EXPECT_TRUE(is_points_header({"z", "y"}, {}));
  EXPECT_FALSE(is_points_header({"x"}, {}));
  EXPECT_FALSE(is_points_header({"x", "q"}, {}));
  PointsOptions options;
  options.columns = {"east", "north"};
  EXPECT_TRUE(is_points_header({"north", "q"}, options));
  options.columns.clear();
  options.id_column = "q";
  EXPECT_TRUE(is_points_header({"p", "q"}, options));
  options.id_column = "";
  options.weight_column = "p";
  EXPECT_TRUE(is_points_header({"p", "q"}, options));
}

TEST(PointsColumns, LongNamesAreShortened) {
  EXPECT_EQ(shortened("short"), "short");
  EXPECT_EQ(shortened(std::string(40, 'x')), std::string(40, 'x'));
  EXPECT_EQ(shortened(std::string(41, 'x')), std::string(40, 'x') + "...");
  EXPECT_EQ(shortened("a\tb\x7f"), "a b ");
}

// What a person takes for text among rows of two numbers.
TEST(PointsColumns, RemarksAreWordsNotOfARowsShape) {
  const auto remark = [](const char* line, char separator = ' ', std::size_t width = 2) {
    const TableStyle style{separator, false};
    return is_remark(split(line, style), style, 0, width);
  };
  EXPECT_FALSE(remark("1 2"));
  EXPECT_FALSE(remark("1 2 top"));
  EXPECT_FALSE(remark("1 2 3 top"));
  EXPECT_TRUE(remark("1 2 top of"));
  EXPECT_TRUE(remark("1 2 the top of it"));
  EXPECT_TRUE(remark("the end"));
  EXPECT_TRUE(remark("p= 8"));
  EXPECT_TRUE(remark("see below", ','));
  EXPECT_FALSE(remark("a,b,3", ','));
  EXPECT_TRUE(remark("part: one,two words,and three", ','));
  EXPECT_FALSE(remark("a,b,c", ','));
}

}  // namespace
}  // namespace keyline::exchange::detail
