#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "keyline/acquire/plane.h"
#include "keyline/core/sanitized.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/mesh/mesh.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

#ifdef KEYLINE_SHADOWED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// The head, the part again and again until there are some megabytes, and the tail.
std::string filled(const std::string& head, const std::string& part, const std::string& tail) {
  std::string text = head;
  while (text.size() < 6 * kMegabyte) text += part;
  return text + tail;
}

std::string times(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

/// An STL's header with the number of its triangles.
std::string with_count(std::string stl) {
  const auto count = static_cast<std::uint32_t>((stl.size() - 84) / 50);
  for (std::size_t i = 0; i < 4; ++i) stl[80 + i] = static_cast<char>(count >> (8 * i));
  return stl;
}

struct Input {
  const char* name;
  std::string (*content)();  ///< made when it is its turn: one at a time is in memory
};

const std::string kSvg = "<svg xmlns='http://www.w3.org/2000/svg'>";
const std::string kDxf = "0\nSECTION\n2\nENTITIES\n";
const std::string kDxfEnd = "0\nENDSEC\n0\nEOF\n";

constexpr Input kInputs[] = {
    {"cubics.svg",
     [] { return filled(kSvg, "<path d='M1 2c" + times("1 2 3-4 5 6 ", 200) + "'/>", "</svg>"); }},
    {"lines.svg",
     [] { return filled(kSvg, "<path d='M1 2l" + times("1 2 3 4 ", 300) + "'/>", "</svg>"); }},
    {"runs.svg", [] { return filled(kSvg, "<path d='" + times("M0 0h1", 300) + "'/>", "</svg>"); }},
    {"shapes.svg", [] { return filled(kSvg, "<path d='M0 0h1'/>", "</svg>"); }},
    {"uses.svg",
     [] {
       return kSvg + "<path id='a' d='M0 0" + times("l1 1", 50'000) + "'/>" +
              times("<use href='#a'/>", 5'000) + "</svg>";
     }},
    {"lines.dxf",
     [] { return filled(kDxf, "0\nLINE\n8\n0\n10\n2\n20\n0\n11\n1\n21\n5\n", kDxfEnd); }},
    {"polylines.dxf",
     [] {
       const std::string points = times("10\n1\n20\n2\n10\n3\n20\n4\n", 200);
       return filled(kDxf, "0\nLWPOLYLINE\n8\n0\n" + points, kDxfEnd);
     }},
    {"array.dxf",
     [] {
       return "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n0\n" +
              ("0\nENDBLK\n0\nENDSEC\n" + kDxf) +
              "0\nINSERT\n2\nA\n10\n0\n20\n0\n70\n30000\n71\n30000\n44\n1\n45\n1\n" + kDxfEnd;
     }},
    {"points.csv", [] { return filled("x,y\n", "1,2\n3,4\n", ""); }},
    {"polyline.json",
     [] { return filled(R"({"type":"polyline","points":[[0,0])", ",[1,2]", "]}"); }},
    {"curves.json",
     [] {
       const std::string curve = R"({"type":"bezier","points":[[0,0],[1,2]]})";
       return filled(R"({"curves":[)" + curve, "," + curve, "]}");
     }},
    {"a.glif",
     [] {
       const std::string points =
           times("<point x='1' y='2' type='line'/><point x='3' y='4' type='line'/>", 50);
       return filled("<glyph><outline>", "<contour>" + points + "</contour>", "</outline></glyph>");
     }},
    {"a.obj", [] { return filled("v 0 0 1\nv 1 0 -1\nv 0 1 1\n", "f 1 2 3\n", ""); }},
    {"a.stl",
     [] { return with_count(filled(std::string(84, '\0'), times("\1\2\3\4\5", 1000), "")); }},
    {"a.ply",
     [] {
       return filled(
           "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
           "property uchar x\nproperty uchar y\nproperty uchar z\n"
           "element face 400000\nproperty list uchar int vertex_indices\n"
           "end_header\n\0\0\1\1\0\0\0\1\2"s,
           times("\3\1\0\0\0\0\0\0\0\2\0\0\0"s, 100), "");
     }},
};

class Memory : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
    folder_ = fs::temp_directory_path() / ("keyline-memory-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  /// What a process that does this and nothing else needs at most, in bytes.
  static std::size_t peak(const std::function<bool()>& work, bool& done) {
    const pid_t child = ::fork();
    if (child == 0) std::_Exit(work() ? 0 : 1);
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    EXPECT_TRUE(WIFEXITED(status));
    done = WEXITSTATUS(status) == 0;
    return static_cast<std::size_t>(usage.ru_maxrss) << 10;
  }

  fs::path folder_;
};

TEST_F(Memory, OfEveryReaderIsBoundedByTheFile) {
  for (const Input& input : kInputs) {
    const fs::path file = folder_ / input.name;
    std::ofstream(file, std::ios::binary) << input.content();
    const std::size_t most = 20 * fs::file_size(file) + 100 * kMegabyte;
    bool read = false;
    const std::size_t used = peak(
        [&] {
          if (!is_mesh_file(file)) return read_document(file).has_value();
          const auto mesh = read_mesh(file);
          if (mesh) (void)section(*mesh, acquire::Plane{});
          return mesh && !mesh->triangles.empty();
        },
        read);
    EXPECT_TRUE(read) << input.name;  // who gives up at once needs no memory
    EXPECT_LE(used, most) << input.name;
    std::printf("%-14s %5.1f MB of %5.1f\n", input.name, 1e-6 * double(used), 1e-6 * double(most));
    fs::remove(file);
  }
}

}  // namespace
}  // namespace keyline::exchange
