#include "keyline/exchange/input_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

/// A named pipe that brings a text in two parts, and is gone with it.
class Pipe {
 public:
  Pipe(std::string first, std::string second)
      : path_(fs::temp_directory_path() / ("keyline_pipe_" + std::to_string(::getpid()))) {
    fs::remove(path_);
    EXPECT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    writer_ = std::thread([path = path_, first, second] {
      std::ofstream out(path, std::ios::binary);
      out << first << std::flush << second;
    });
  }
  ~Pipe() {
    const int reader = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK);  // lets a writer go that waits
    writer_.join();
    ::close(reader);
    fs::remove(path_);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  std::thread writer_;
};

std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// All that comes, be it less than a format is told by, as much, or more than is read at once.
TEST(InputFile, HoldsAllThatComesThroughAPipe) {
  for (const std::size_t size : {2U, 1000U, 1024U, 1025U, 300'000U}) {
    SCOPED_TRACE(size);
    std::string text;
    while (text.size() < size) text += std::to_string(text.size()) + ",1\n";
    text.resize(size);
    fs::path copy;
    {
      const Pipe pipe(text.substr(0, size / 2), text.substr(size / 2));
      const auto input = InputFile::open(pipe.path());
      ASSERT_TRUE(input) << input.error().message;
      copy = input->path();
      EXPECT_NE(copy, pipe.path());
      EXPECT_EQ(read_all(copy), text);
      EXPECT_EQ(read_all(copy), text);
    }
    EXPECT_FALSE(fs::exists(copy));
  }
}

TEST(InputFile, OfNothingAtAllIsNone) {
  const Pipe pipe("", "");
  const auto input = InputFile::open(pipe.path());
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().code, core::ErrorCode::bad_input);
}

}  // namespace
}  // namespace keyline::exchange
