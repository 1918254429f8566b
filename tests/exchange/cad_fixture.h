#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace keyline::exchange {

/// Tests that read or write STEP or IGES: the reader's process of this build, and a folder.
class CadTest : public testing::Test {
 protected:
  void SetUp() override {
#ifdef KEYLINE_CAD_PROGRAM
    ::setenv("KEYLINE_CAD", KEYLINE_CAD_PROGRAM, 1);
    folder_ =
        std::filesystem::temp_directory_path() / ("keyline-cad-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
#else
    GTEST_SKIP() << "built without OCCT";
#endif
  }
  void TearDown() override {
    ::unsetenv("KEYLINE_CAD");
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

}  // namespace keyline::exchange
