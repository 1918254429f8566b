#include <filesystem>

#include <gtest/gtest.h>

#include "keyline/library/library.h"

namespace keyline::library {
namespace {

TEST(Absent, ABuildWithoutSqliteSaysSoAndWritesNothing) {
  if (is_available()) GTEST_SKIP() << "this build has SQLite";
  const auto file = std::filesystem::temp_directory_path() / "keyline-absent.kl";
  const auto library = Library::open(file, Mode::write);
  ASSERT_FALSE(library);
  EXPECT_EQ(library.error().code, core::ErrorCode::unsupported);
  EXPECT_NE(library.error().hint.find("KEYLINE_LIBRARY"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace keyline::library
