#include "folder.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "recovery.h"

namespace keyline::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void touch(const fs::path& file) { std::ofstream(file) << "x"; }

TEST(Folder, KeepsToItselfAndWhatWasNamed) {
  const Scratch scratch;
  fs::create_directories(scratch.file("in/deep"));
  touch(scratch.file("in/deep/a.csv"));
  touch(scratch.file("out.csv"));
  touch(scratch.file("named.csv"));
  fs::create_symlink(scratch.file("out.csv"), scratch.file("in/link.csv"));
  fs::create_directory_symlink(scratch.file("."), scratch.file("in/up"));
  const Folder folder(scratch.file("in"), {scratch.file("named.csv")});
  EXPECT_TRUE(folder.place_of("deep/a.csv"));
  EXPECT_TRUE(folder.place_of("deep/new.csv"));
  EXPECT_TRUE(folder.place_of("deep/../deep/a.csv"));
  EXPECT_TRUE(folder.place_of(scratch.file("named.csv")));
  for (const std::string name : {"../out.csv", "deep/../../out.csv", "link.csv", "up/out.csv",
                                 "/etc/passwd", "", ".", "..", "../in2/a.csv"})
    EXPECT_FALSE(folder.place_of(name)) << name;
  EXPECT_FALSE(folder.place_of(scratch.file("in-beside").string()));
  EXPECT_FALSE(folder.place_of(std::string("deep/a.csv\0.png", 15)));
}

TEST(Folder, ConfinesEveryFileOfARequest) {
  const Scratch scratch;
  touch(scratch.file("a.csv"));
  const Folder folder(scratch.file("."), {});
  for (const operations::Operation& operation : operations::operations()) {
    if (!operation.reads_files && !operation.writes_files) continue;
    json outside{{"file", "/etc/passwd"}, {"library", "x.db"}};
    EXPECT_FALSE(folder.confine(operation, outside)) << operation.name;
    json list{{"file", {"a.csv", "../../etc/passwd"}}, {"library", "x.db"}};
    EXPECT_FALSE(folder.confine(operation, list)) << operation.name;
    json library{{"library", "/tmp/../etc/x.db"}};
    EXPECT_FALSE(folder.confine(operation, library)) << operation.name;
    json inside{{"file", "a.csv"}, {"library", "x.db"}};
    EXPECT_TRUE(folder.confine(operation, inside)) << operation.name;
    EXPECT_EQ(inside["file"], fs::canonical(scratch.file("a.csv")).string());
  }
}

TEST(Folder, RefusesALibraryOfTheOperationsOwnChoice) {
  const Scratch scratch;
  const Folder folder(scratch.file("."), {});
  json unnamed{{"rhythm", "accelerating"}};
  EXPECT_FALSE(folder.confine(*operations::find_operation("library.find"), unnamed));
  json measured{{"file", "a.csv"}};
  EXPECT_TRUE(folder.confine(*operations::find_operation("library.measure"), measured));
}

/// What confine() looks at are the only texts of such operations that say they name a file.
TEST(Folder, KnowsEveryFieldThatNamesAFile) {
  for (const operations::Operation& operation : operations::operations()) {
    if (!operation.reads_files && !operation.writes_files) continue;
    core::visit_fields(*operation.request, operation.request->make().get(),
                       [&](const core::Field& field, void*) {
                         const bool known = field.name == "file" || field.name == "library";
                         for (const std::string_view word : {"file", "path", "folder", "library"})
                           EXPECT_TRUE(known || field.name.find(word) == std::string_view::npos)
                               << operation.name << " " << field.name;
                       });
  }
}

TEST(Folder, MakesPlainNames) {
  EXPECT_EQ(plain_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(plain_name("..hidden"), "hidden");
  EXPECT_EQ(plain_name("a\nb.csv"), "ab.csv");
  EXPECT_EQ(plain_name(""), "file");
  EXPECT_EQ(plain_name(std::string(300, 'x') + ".csv").size(), 120u);
}

TEST(Recovery, HoldsTheLastWhole) {
  const Scratch scratch;
  Recovery recovery(scratch.file("deep/work.json"));
  EXPECT_EQ(recovery.kept(), "");
  ASSERT_TRUE(recovery.keep("one"));
  ASSERT_TRUE(recovery.keep("two"));
  EXPECT_EQ(recovery.kept(), "two");
  EXPECT_EQ(Recovery(scratch.file("deep/work.json")).kept(), "two");
  touch(scratch.file("plain"));
  EXPECT_FALSE(Recovery(scratch.file("plain/work.json")).keep("three"));
}

TEST(Recovery, FolderHasAFileOfItsOwn) {
  EXPECT_EQ(recovery_file("/a"), recovery_file("/a"));
  EXPECT_NE(recovery_file("/a"), recovery_file("/b"));
}

}  // namespace
}  // namespace keyline::studio
