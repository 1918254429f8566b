#include "keyline/operations/sound_result.h"

#include <vector>

#include <gtest/gtest.h>

#include "keyline/operations/made_curve.h"

namespace keyline::operations {
namespace {

struct Inner {
  MadeCurve curve;
  static constexpr auto describe() { return core::fields(core::flattened<&Inner::curve>()); }
};

struct Whole {
  std::vector<Inner> parts;
  std::optional<surface::Surface> surface;
  static constexpr auto describe() {
    return core::fields(core::field<&Whole::parts>("curves"),
                        core::field<&Whole::surface>("a surface"));
  }
};

lac::Chain chain_of_slope(double alpha) { return {{}, {{alpha, 1, -0.5, 0.5}}, false}; }

TEST(SoundResult, NamesTheCurveThatBreaksItsRoomsRules) {
  Whole whole;
  whole.parts.resize(2);
  whole.parts[0].curve = made({chain_of_slope(-1)});
  whole.parts[1].curve = made({chain_of_slope(-2)});
  EXPECT_TRUE(check_values(core::type_of<Whole>(), &whole));
  // From slope 0 on curvature keeps its sign.
  whole.parts[1].curve = made({chain_of_slope(0)});
  const auto failed = check_values(core::type_of<Whole>(), &whole);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, core::ErrorCode::internal);
  EXPECT_EQ(failed.error().path, "parts[1].curve");
}

TEST(SoundResult, LooksAtSurfacesAndFurtherForms) {
  Whole whole;
  whole.parts.resize(1);
  whole.parts[0].curve = made({chain_of_slope(-1)});
  whole.parts[0].curve.bezier = BoundedCurve{document::PlanarCurve{curve::Bezier2{}}, 0};
  auto failed = check_values(core::type_of<Whole>(), &whole);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().path, "parts[0].bezier");
  whole.parts.clear();
  whole.surface = surface::BezierSurface{};
  failed = check_values(core::type_of<Whole>(), &whole);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().path, "surface");
}

}  // namespace
}  // namespace keyline::operations
