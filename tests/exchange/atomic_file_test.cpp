#include "keyline/exchange/file/atomic_file.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
 protected:
  Outputs() {
    std::string pattern = (fs::temp_directory_path() / "keyline-outputs-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Outputs() override { fs::remove_all(folder_); }

  std::string held(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::ptrdiff_t count() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_;
};

TEST_F(Outputs, AppearTogether) {
  put("a", "old");
  OutputFiles files;
  ASSERT_TRUE(files.add(folder_ / "a", "new a"));
  ASSERT_TRUE(files.add(folder_ / "b", "new b"));
  EXPECT_EQ(held("a"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "b"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(held("a"), "new a");
  EXPECT_EQ(held("b"), "new b");
  EXPECT_EQ(count(), 2);
}

// Locks end with the work: a server that writes all day must not run out of files.
TEST_F(Outputs, LeaveNothingOpen) {
  const auto open = [] { return std::distance(fs::directory_iterator("/proc/self/fd"), {}); };
  put("a", "old");
  const auto before = open();
  for (int i = 0; i < 3; ++i) {
    OutputFiles files;
    ASSERT_TRUE(files.add(folder_ / "a", "new a"));
    ASSERT_TRUE(files.add(folder_ / "b", "new b"));
    ASSERT_TRUE(i == 0 || files.commit());
  }
  EXPECT_EQ(open(), before);
}

TEST_F(Outputs, NoneAppearsWhereOneCannot) {
  put("a", "old");
  fs::create_directories(folder_ / "sub");
  for (const bool late : {false, true}) {
    OutputFiles files;
    ASSERT_TRUE(files.add(folder_ / "a", "new a"));
    ASSERT_TRUE(files.add(folder_ / "fresh", "new"));
    if (!late) {
      EXPECT_FALSE(files.add(folder_ / "nowhere" / "b", "new b"));
      continue;
    }
    ASSERT_TRUE(files.add(folder_ / "sub" / "b", "new b"));
    fs::remove_all(folder_ / "sub");  // between the two steps
    const auto done = files.commit();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, core::ErrorCode::io);
    EXPECT_NE(done.error().path.find("sub/b"), std::string::npos);
  }
  EXPECT_EQ(held("a"), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(Outputs, KeepRightsAndLinks) {
  put("a", "old");
  ::chmod((folder_ / "a").c_str(), 0640);
  fs::create_symlink("a", folder_ / "link");
  ASSERT_TRUE(write_atomically(folder_ / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(held("a"), "new");
  struct stat status{};
  ASSERT_EQ(::stat((folder_ / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST_F(Outputs, LinksToNothingAreFollowed) {
  fs::create_directory(folder_ / "sub");
  fs::create_symlink("sub/made", folder_ / "link");
  fs::create_symlink("link", folder_ / "link-to-link");
  ASSERT_TRUE(write_atomically(folder_ / "link-to-link", "new"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link-to-link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(held("sub/made"), "new");
  fs::create_symlink("nowhere/made", folder_ / "lost");
  fs::create_symlink("round", folder_ / "round");
  for (const char* name : {"lost", "round"}) {
    EXPECT_FALSE(check_writable(folder_ / name)) << name;
    EXPECT_FALSE(write_atomically(folder_ / name, "new")) << name;
    EXPECT_TRUE(fs::is_symlink(folder_ / name)) << name;
  }
}

TEST_F(Outputs, UnwritableIsIo) {
  for (const fs::path& path : {folder_ / "no" / "such" / "folder.csv", folder_}) {
    EXPECT_FALSE(check_writable(path));
    const auto written = write_atomically(path, "x");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, core::ErrorCode::io);
    EXPECT_FALSE(written.error().message.empty());
  }
  EXPECT_TRUE(write_atomically("/dev/null", "x"));
  EXPECT_EQ(write_atomically("/dev/full", "x").error().code, core::ErrorCode::io);
}

TEST_F(Outputs, WhatIsLeftOverIsSwept) {
  put(".keyline-0123456789abcdef.part", "of a run that was killed");
  put(".keyline1234-0.part", "of an older version");
  put(".keyline-notes", "a person's");
  OutputFiles alive;
  ASSERT_TRUE(alive.add(folder_ / "a", "x"));
  ASSERT_TRUE(write_atomically(folder_ / "b", "y"));  // leaves what a living run writes
  ASSERT_TRUE(alive.commit());
  EXPECT_EQ(held("a"), "x");
  EXPECT_EQ(count(), 3);
  EXPECT_EQ(held(".keyline-notes"), "a person's");
}

/// Writes the same two files over and over until it is killed.
[[noreturn]] void write_for_ever(const fs::path& folder) {
  for (int round = 0;; ++round) {
    const std::string text(20'000, static_cast<char>('a' + round % 26));
    OutputFiles files;
    if (!files.add(folder / "one", text) || !files.add(folder / "two", text) || !files.commit())
      std::_Exit(1);
  }
}

// A hundred times killed at some moment: both files are whole, old or new, and the next run leaves
// nothing else.
TEST_F(Outputs, KilledAnywhereTheyAreOldOrNew) {
  ASSERT_TRUE(write_atomically(folder_ / "one", "start"));
  ASSERT_TRUE(write_atomically(folder_ / "two", "start"));
  const auto whole = [](const std::string& text) {
    return text == "start" ||
           (text.size() == 20'000 && text.find_first_not_of(text[0]) == std::string::npos);
  };
  for (int time = 0; time < 100; ++time) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);  // a signal to -1 would end everything
    if (child == 0) write_for_ever(folder_);
    std::this_thread::sleep_for(std::chrono::microseconds(500 + 173 * time));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_TRUE(whole(held("one")));
    EXPECT_TRUE(whole(held("two")));
    ASSERT_TRUE(write_atomically(folder_ / "three", "x"));
    EXPECT_EQ(count(), 3);
  }
}

// A disk that is full after so many bytes, as the limit of a file's size stands in for one.
TEST_F(Outputs, OnAFullDiskTheOldFilesStay) {
  put("one", "old");
  put("two", "old");
  for (int room = 0; room < 20; ++room) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{static_cast<rlim_t>(500 * room), static_cast<rlim_t>(500 * room)};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      bool io = false;
      {
        OutputFiles files;
        const auto first = files.add(folder_ / "one", std::string(4000, 'x'));
        const auto second = files.add(folder_ / "two", std::string(10'000, 'x'));
        io = !second && second.error().code == core::ErrorCode::io && (first || room < 9);
      }
      std::_Exit(io ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << room;
    EXPECT_EQ(held("one"), "old");
    EXPECT_EQ(held("two"), "old");
    EXPECT_EQ(count(), 2);
  }
}

}  // namespace
}  // namespace keyline::exchange
