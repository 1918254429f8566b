#include "keyline/operations/document_points.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"
#include "keyline/operations/document_write.h"

namespace keyline::operations {
namespace {

namespace fs = std::filesystem;
using core::Point3;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder that goes with the test.
class PointFiles : public testing::Test {
 protected:
  PointFiles()
      : folder_(fs::temp_directory_path() / ("keyline-points-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~PointFiles() override { fs::remove_all(folder_); }

  std::string table(const std::string& header, const std::vector<Point3>& points) {
    const fs::path file = folder_ / ("a" + std::to_string(++count_) + ".csv");
    std::ofstream out(file);
    out.precision(17);
    out << header << '\n';
    for (const Point3 p : points) out << p.x << ',' << p.y << ',' << p.z << '\n';
    return file.string();
  }
  std::string text(const std::string& content) {
    const fs::path file = folder_ / "a.txt";
    std::ofstream(file) << content;
    return file.string();
  }
  static core::Result<ReadAnswer> read(std::vector<std::string> files, bool planar) {
    InputRequest request;
    request.file = std::move(files);
    request.planar = planar;
    return read_input(request, {});
  }

 private:
  fs::path folder_;
  int count_ = 0;
};

std::vector<Point3> helix() {
  std::vector<Point3> points;
  for (int i = 0; i < 60; ++i) points.push_back({std::cos(i / 9.0), std::sin(i / 9.0), i / 40.0});
  return points;
}

/// Half an ellipse in the plane x + z = 5, out of it by so much now and then.
std::vector<Point3> tilted(double off = 0) {
  std::vector<Point3> points;
  for (int i = 0; i <= 40; ++i) {
    const double t = i * 0.075;
    const double away = i % 4 == 1 ? off * std::sqrt(0.5) : 0;
    points.push_back({2 * std::cos(t) + away, std::sin(t), 5 - 2 * std::cos(t) + away});
  }
  return points;
}

const curve::Polyline3& line_of(const document::Document& d) {
  return std::get<curve::Polyline3>(d.space_curves.at(0).curve.value);
}

TEST_F(PointFiles, StayWhereTheyLieInSpace) {
  for (const auto& points : {helix(), tilted(), tilted(0.01)}) {
    const auto answer = read({table("x,y,z", points)}, false);
    ASSERT_TRUE(answer) << answer.error().message;
    const document::Document d = document_of(*answer);
    EXPECT_TRUE(d.paths.empty());
    EXPECT_EQ(line_of(d).points, points);
  }
  const auto flat = read({table("x,y,z", {{0, 0, 0}, {1, 2, 0}, {3, 3, 0}})}, false);
  EXPECT_EQ(document_of(*flat).paths.size(), 1U);
}

// The name of a table's curve stands for its parts, as in other files.
TEST_F(PointFiles, PartsAreChosenByTheNameOfTheWhole) {
  const std::string file = text("wing\nx yu yl\n0 0 0\n1 2 -1\n2 2.5 -1.5\n3 2 -1\n");
  const auto found = [&](const std::string& wanted) {
    InputRequest input;
    input.file = {file};
    input.select = wanted;
    const auto answer = read_input(input, {});
    return answer ? answer->curves.size() : 0;
  };
  EXPECT_EQ(found(""), 2U);
  EXPECT_EQ(found("wing"), 2U);
  EXPECT_EQ(found("wing/yl"), 1U);
  EXPECT_EQ(found("2"), 1U);
  EXPECT_EQ(found("yl"), 0U);
}

TEST_F(PointFiles, AreToldInTheirPlaneWhereAsked) {
  const auto answer = read({table("x,y,z", tilted())}, true);
  ASSERT_TRUE(answer) << answer.error().message;
  const NamedCurve& curve = answer->curves.at(0);
  ASSERT_TRUE(curve.line && curve.plane);
  EXPECT_EQ(answer->notes.size(), 1U);
  const acquire::Plane plane{curve.plane->origin, curve.plane->axis_x - Point3{},
                             curve.plane->axis_y - Point3{}};
  for (std::size_t i = 0; i < tilted().size(); ++i)
    EXPECT_LT(distance(acquire::from_plane(plane, curve.line->points[i]), tilted()[i]), 1e-12);
}

TEST_F(PointFiles, ThatLieInNoPlaneAreNotLaidIntoOne) {
  const auto answer = read({table("x,y,z", helix())}, true);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, core::ErrorCode::bad_input);
  EXPECT_THAT(answer.error().message, HasSubstr("no plane"));
}

TEST_F(PointFiles, PicturesTellHowFarTheyLeaveTheirPlane) {
  const auto svg = [this](const std::vector<Point3>& points) {
    const auto answer = read({table("x,y,z", points)}, false);
    return formatted(document_of(*answer), ".svg", {}, false, {});
  };
  const auto exact = svg(tilted());
  ASSERT_TRUE(exact) << exact.error().message;
  EXPECT_LT(exact->deviation, 1e-12);
  const auto off = svg(tilted(0.01));
  ASSERT_TRUE(off) << off.error().message;
  EXPECT_GT(off->deviation, 0.005);
  EXPECT_LT(off->deviation, 0.01);
  EXPECT_FALSE(svg(helix()));
}

TEST_F(PointFiles, HaveTheUnitOfTheirHeader) {
  const std::string inches = table("x [in],y [in],z [in]", tilted());
  EXPECT_EQ(read({inches}, false)->unit, "in");
  EXPECT_EQ(read({inches}, true)->unit, "in");
  const auto both = read({inches, table("x [mm],y [mm],z [mm]", tilted())}, false);
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message, HasSubstr("is in mm, " + inches + " in in"));
  const auto document = exchange::read_document(inches);
  ASSERT_TRUE(document);
  EXPECT_EQ(document->unit, "in");
}

TEST_F(PointFiles, RepeatedPointsAreTold) {
  const auto answer = read({table("x,y", {{0, 0, 0}, {1, 1, 0}, {1, 1, 0}, {2, 0, 0}})}, false);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_THAT(answer->skipped, testing::Contains(HasSubstr("1 point where a neighbour is")));
}

/// Along a helix there is nothing to tell; in leaps of 23 of its 60 points they follow no curve: a
/// leap is 17 times as long as a step.
TEST_F(PointFiles, OfNoOrderInSpaceAreTold) {
  const std::vector<Point3> along = helix();
  std::vector<Point3> strewn;
  for (std::size_t i = 0; i < along.size(); ++i) strewn.push_back(along[i * 23 % 60]);
  EXPECT_TRUE(read({table("x,y,z", along)}, false)->notes.empty());
  EXPECT_THAT(read({table("x,y,z", strewn)}, false)->notes,
              ElementsAre(HasSubstr("the order of the file, which follows no curve")));
}

}  // namespace
}  // namespace keyline::operations
