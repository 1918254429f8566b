#include <csignal>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "keyline/library/database.h"
#include "keyline/library/schema.h"
#include "keyline/library/search.h"

#include "tests/library/library_files.h"

namespace keyline::library {
namespace {

using core::ErrorCode;
using detail::Access;
using detail::Database;
using testing::Folder;
using testing::in_child;
using testing::quick_entry;

/// SQLite's own check, and that every curve has its shape, its piece and its profile.
std::string fault_of(const std::filesystem::path& file) {
  auto database = Database::open(file, Access::write);
  if (!database) return database.error().message;
  auto check = database->prepare("PRAGMA integrity_check");
  if (!check || !check->step().value_or(false)) return "no check";
  if (check->text(0) != "ok") return check->text(0);
  const auto curves = database->integer("SELECT count(*) FROM curve");
  for (const char* part : {"shape", "piece", "profile"}) {
    const auto count = database->integer(std::string("SELECT count(*) FROM ") + part);
    if (!count || !curves || *count != *curves) return std::string("curves without their ") + part;
  }
  return {};
}

std::string add_some(const std::filesystem::path& file, unsigned from, unsigned count) {
  auto library = Library::open(file, Mode::write);
  if (!library) return library.error().message;
  for (unsigned i = from; i < from + count; ++i)
    if (const auto done = add(*library, {quick_entry(i)}); !done) return done.error().message;
  return {};
}

/// Two programs that begin a library at the same time, and add so many curves each.
void expect_room_for_two(const std::filesystem::path& file, unsigned each) {
  std::vector<pid_t> children;
  for (unsigned writer = 0; writer < 2; ++writer) {
    children.push_back(fork());
    if (children.back() == 0) _exit(add_some(file, writer * each, each).empty() ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  auto library = Library::open(file, Mode::read);
  ASSERT_TRUE(library);
  EXPECT_EQ(size(*library), 2 * each);
  EXPECT_EQ(fault_of(file), "");
}

// What goes wrong in that moment goes wrong once in three times.
TEST(LibrarySafety, TwoWritersAndTheFirstMomentOfAFile) {
  const Folder folder;
  expect_room_for_two(folder / "l.kl", 100);
  for (int round = 0; round < 20; ++round)
    expect_room_for_two(folder / (std::to_string(round) + ".kl"), 1);
}

/// Adds curves one by one and tells each number on the pipe once it is promised.
[[noreturn]] void add_for_ever(const std::filesystem::path& file, unsigned seed, int pipe_end) {
  auto library = Library::open(file, Mode::write);
  for (unsigned i = seed; library; ++i) {
    const auto added = add(*library, {quick_entry(i)});
    if (!added) break;
    const std::int64_t id = added->front().id;
    if (write(pipe_end, &id, sizeof id) != sizeof id) break;
  }
  _exit(1);
}

TEST(LibrarySafety, NothingPromisedIsLostWhenTheWriterIsKilled) {
  const Folder folder;
  const auto file = folder / "l.kl";
  std::mt19937 random(7);
  std::int64_t promised = 0;
  for (unsigned round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);  // a signal to -1 would end everything
    if (child == 0) add_for_ever(file, 10'000 * round, ends[1]);
    close(ends[1]);
    // Every other writer is killed only after its first promise, however slow it is.
    std::int64_t first = 0;
    if (round % 2 == 1 && read(ends[0], &first, sizeof first) == sizeof first) promised = first;
    usleep(std::uniform_int_distribution<unsigned>(3'000, 60'000)(random));
    kill(child, SIGKILL);
    for (std::int64_t id = 0; read(ends[0], &id, sizeof id) == sizeof id;) promised = id;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    ASSERT_TRUE(Library::open(file, Mode::write));
    ASSERT_EQ(fault_of(file), "");
    auto library = Library::open(file, Mode::read);
    ASSERT_TRUE(library);
    const auto held = size(*library);
    ASSERT_TRUE(held);
    EXPECT_GE(*held, promised);  // numbers are given in order, none is taken back
    EXPECT_LE(*held, promised + 1 + round);
    EXPECT_TRUE(promised == 0 || get(*library, promised));
  }
  EXPECT_GE(promised, 10);
}

TEST(LibrarySafety, ANewerSchemaIsRefusedClearly) {
  const Folder folder;
  const auto file = folder / "l.kl";
  ASSERT_EQ(add_some(file, 0, 1), "");
  ASSERT_TRUE(Database::open(file, Access::write)->execute("PRAGMA user_version = 99"));
  for (const Mode mode : {Mode::read, Mode::write}) {
    const auto library = Library::open(file, mode);
    ASSERT_FALSE(library);
    EXPECT_EQ(library.error().code, ErrorCode::unsupported);
    EXPECT_NE(library.error().message.find("version 99"), std::string::npos);
  }
  EXPECT_EQ(Database::open(file, Access::read)->integer("PRAGMA user_version"), 99);
}

TEST(LibrarySafety, AnOlderSchemaIsBroughtUpToDateWhole) {
  const Folder folder;
  const auto file = folder / "l.kl";
  ASSERT_EQ(add_some(file, 0, 3), "");
  const auto published = detail::schema_steps();
  std::vector<const char*> steps(published.begin(), published.end());
  steps.push_back("ALTER TABLE curve ADD COLUMN designer TEXT NOT NULL DEFAULT ''");
  steps.push_back("this is no SQL");
  auto database = Database::open(file, Access::write);
  ASSERT_TRUE(database);
  EXPECT_FALSE(detail::migrate(*database, steps));  // and nothing of it stays
  EXPECT_EQ(database->integer("PRAGMA user_version"), std::ssize(published));
  EXPECT_FALSE(database->integer("SELECT count(designer) FROM curve"));
  steps.pop_back();
  ASSERT_TRUE(detail::migrate(*database, steps));
  EXPECT_EQ(database->integer("SELECT count(designer) FROM curve"), 3);
  EXPECT_EQ(fault_of(file), "");
  EXPECT_EQ(Library::open(file, Mode::read).error().code, ErrorCode::unsupported);
}

TEST(LibrarySafety, OtherFilesAreLeftAlone) {
  const Folder folder;
  const auto text = folder / "notes.txt";
  std::ofstream(text) << std::string(5000, 'x');
  EXPECT_EQ(Library::open(text, Mode::write).error().code, ErrorCode::bad_input);
  EXPECT_EQ(std::filesystem::file_size(text), 5000u);
  const auto other = folder / "other.db";
  ASSERT_TRUE(Database::open(other, Access::create)->execute("CREATE TABLE t(x)"));
  EXPECT_EQ(Library::open(other, Mode::write).error().code, ErrorCode::bad_input);
  EXPECT_EQ(Library::open(folder / "absent.kl", Mode::read).error().code, ErrorCode::io);
  EXPECT_FALSE(std::filesystem::exists(folder / "absent.kl"));
  EXPECT_EQ(Library::open(folder / "no" / "such.kl", Mode::write).error().code, ErrorCode::io);
}

/// As somebody who may only look: the library in a folder nobody else may write.
TEST(LibrarySafety, MayBeReadWhereItCannotBeWritten) {
  const Folder folder;
  const auto file = folder / "l.kl";
  ASSERT_EQ(add_some(file, 0, 5), "");
  chmod(file.c_str(), 0444);
  chmod(folder.path().c_str(), 0555);
  const std::string wrong = in_child([&]() -> std::string {
    constexpr uid_t kNobody = 65534;
    if (getuid() == 0 && setuid(kNobody) != 0) return "no other user";
    auto library = Library::open(file, Mode::read);
    if (!library) return "not opened: " + library.error().message;
    if (size(*library).value_or(-1) != 5) return "not read";
    const auto found = find(*library, {.like = quick_entry(3).turning});
    if (!found || found->found.front().id != 4) return "not found";
    auto writer = Library::open(file, Mode::write);
    if (writer) return add(*writer, {quick_entry(9)}) ? "written" : "";
    return writer.error().code == ErrorCode::io ? "" : "another failure";
  });
  EXPECT_EQ(wrong, "");
  chmod(folder.path().c_str(), 0755);
}

/// A disk of its own that fills up; without the right to mount one, a limit on the file's size.
bool small_disk(const std::filesystem::path& folder) {
  if (unshare(CLONE_NEWNS) == 0 && mount("", "/", "", MS_REC | MS_PRIVATE, nullptr) == 0 &&
      mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=600k") == 0)
    return true;
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{400'000, RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &limit);
  return false;
}

void give_room(const std::filesystem::path& folder, bool mounted) {
  if (mounted) {
    mount("tmpfs", folder.c_str(), "tmpfs", MS_REMOUNT, "size=20m");
  } else {
    const rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
}

TEST(LibrarySafety, AFullDiskLosesNothing) {
  const Folder folder;
  const std::string wrong = in_child([&]() -> std::string {
    const bool mounted = small_disk(folder.path());
    const auto file = folder / "l.kl";
    auto library = Library::open(file, Mode::write);
    if (!library) return "not made: " + library.error().message;
    unsigned stored = 0;
    core::Result<std::vector<Added>> added;
    while ((added = add(*library, {quick_entry(stored)})) && stored < 10'000) ++stored;
    if (added) return "the disk never filled";
    if (added.error().code != ErrorCode::io) return "another failure: " + added.error().message;
    if (mounted && added.error().message.find("room") == std::string::npos)
      return "not told: " + added.error().message;
    if (size(*library).value_or(-1) != stored) return "something was lost";
    give_room(folder.path(), mounted);
    if (!add(*library, {quick_entry(stored)})) return "no second chance";
    if (size(*library).value_or(-1) != stored + 1) return "something was lost later";
    library = core::fail(ErrorCode::io, "closed");
    return fault_of(file);
  });
  EXPECT_EQ(wrong, "");
}

}  // namespace
}  // namespace keyline::library
