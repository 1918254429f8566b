#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"

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
  /// What comes of a file of that name with that text.
  core::Result<document::Document> read_text(const std::string& name,
                                             const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return read_document(folder_ / name);
  }
  /// The same of a file that is sound.
  document::Document read_sound(const std::string& name, const std::string& text) const {
    const auto d = read_text(name, text);
    EXPECT_TRUE(d) << d.error().message;
    return d.value_or(document::Document{});
  }
  std::filesystem::path folder_;
};

}  // namespace keyline::exchange
