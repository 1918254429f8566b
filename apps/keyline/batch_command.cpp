#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/operations/perform.h"

#include "batch.h"
#include "session.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;

constexpr std::size_t kAtOnce = 1u << 18;

/// What batch takes beside the options every command has.
struct BatchWords {
  std::string resume;
  std::optional<double> time_limit;
  static constexpr auto describe() {
    return core::fields(
        core::field<&BatchWords::resume>(
            "file for the answers; requests whose answers it holds are skipped"),
        core::field<&BatchWords::time_limit>("longest time for a line; any unless given")
            .in("second")
            .within(core::kPositive));
  }
};

/// Seed, tolerance and threads mean here what they mean in every request, output has no place.
Session new_session() {
  OptionGroup door = door_group();
  door.without = {"output", "json"};
  return Session(
      {"batch", "", "Reads requests as lines of JSON and writes the answers in the same order.",
       "--seed and --tolerance are for requests that leave them out; --threads counts processes.\n"
       "Example: echo '{\"op\":\"lac.region\",\"theta\":1,\"alpha\":-1}' | keyline batch"},
      {{"Answers", &core::type_of<BatchWords>(), {}}, door}, false);
}

bool write_all(int out, std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(out, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    done += static_cast<std::size_t>(n);
  }
  text.clear();
  return true;
}

/// A worker's life: answers are written when there is no other line waiting.
void serve(int in, int out, const nlohmann::json& defaults) {
  operations::Context context;
  context.threads = 1;
  std::string lines;
  std::string answers;
  char bytes[kAtOnce];
  for (;;) {
    std::size_t from = 0;
    for (std::size_t end = lines.find('\n'); end != std::string::npos;
         end = lines.find('\n', from)) {
      answers += operations::answer_line(lines.substr(from, end - from), context, defaults);
      answers += '\n';
      from = end + 1;
      if (answers.size() > kAtOnce && !write_all(out, answers)) return;
    }
    lines.erase(0, from);
    if (!write_all(out, answers)) return;
    const ssize_t n = ::read(in, bytes, sizeof bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    lines.append(bytes, static_cast<std::size_t>(n));
  }
}

const BatchAnswers kAnswers{
    [] {
      return operations::failed_line(
          "", {ErrorCode::bad_input, "the line is longer than 256 MB", "give a shorter one", ""});
    },
    [](const std::string& line) {
      return operations::failed_line(line,
                                     {ErrorCode::internal, "the request brought its process down",
                                      "please report this request", ""});
    },
    [](const std::string& line, double seconds) {
      return operations::failed_line(
          line, {ErrorCode::cancelled, fmt::format("no answer within {:g} seconds", seconds),
                 "allow more time with --time-limit", ""});
    }};

/// Where answers go, and how many are there already.
struct Sink {
  int file = STDOUT_FILENO;
  std::uint64_t answers = 0;
};

std::unexpected<core::Failure> io_failure(const std::string& file, const std::string& what) {
  return core::fail(ErrorCode::io, what + ": " + std::generic_category().message(errno),
                    "check the file", file);
}

/// Complete answers in the file are kept, part of one at its end is cut off.
Result<Sink> resumed(const std::string& name) {
  Sink sink;
  sink.file = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (sink.file < 0) return io_failure(name, "cannot be opened");
  if (::flock(sink.file, LOCK_EX | LOCK_NB) != 0)
    return core::fail(ErrorCode::io, "another batch writes to it", "wait for it to end", name);
  char bytes[kAtOnce];
  off_t read = 0;
  off_t complete = 0;
  for (;;) {
    const ssize_t n = ::read(sink.file, bytes, sizeof bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return io_failure(name, "cannot be read");
    if (n == 0) break;
    for (ssize_t i = 0; i < n; ++i)
      if (bytes[i] == '\n') {
        ++sink.answers;
        complete = read + i + 1;
      }
    read += n;
  }
  if (::ftruncate(sink.file, complete) != 0 || ::lseek(sink.file, complete, SEEK_SET) < 0)
    return io_failure(name, "cannot be written");
  return sink;
}

int workers_of(const DoorOptions& door) {
  if (door.threads > 0) return door.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

nlohmann::json defaults_of(const DoorOptions& door) {
  nlohmann::json defaults = nlohmann::json::object();
  if (door.seed) defaults["seed"] = *door.seed;
  if (door.tolerance) defaults["tolerance"] = *door.tolerance;
  return defaults;
}

void tell(const DoorOptions& door, const BatchReport& report, const Sink& sink) {
  std::string text;
  if (sink.answers > 0)
    text = core::counted(static_cast<std::size_t>(sink.answers), "line") + " answered before; ";
  const int workers = workers_of(door);
  text += fmt::format("{} in {:.3g} s, {:.3g} per second, {}",
                      core::counted(static_cast<std::size_t>(report.lines), "line"), report.seconds,
                      static_cast<double>(report.lines) / std::max(report.seconds, 1e-9),
                      core::counted(static_cast<std::size_t>(workers), "worker"));
  if (report.crashed > 0) text += fmt::format(", {} brought a worker down", report.crashed);
  if (report.expired > 0) text += fmt::format(", {} over the time limit", report.expired);
  say(door.quiet, text);
}

int answer_lines(const DoorOptions& door, const BatchWords& batch) {
  std::signal(SIGPIPE, SIG_IGN);
  auto sink = batch.resume.empty() ? Result<Sink>(Sink{}) : resumed(batch.resume);
  if (!sink) return report_failure(sink.error());
  BatchOptions options;
  options.workers = workers_of(door);
  options.time_limit = batch.time_limit.value_or(0);
  options.skip = sink->answers;
  options.progress = interactive_progress(true);
  const nlohmann::json defaults = defaults_of(door);
  const WorkerMain main = [&](int in, int out) { serve(in, out, defaults); };
  const auto report = run_lines(STDIN_FILENO, sink->file, main, kAnswers, options);
  if (!report) return report_failure(report.error());
  tell(door, *report, *sink);
  return report->cancelled ? kCancelled : kDone;
}

}  // namespace

int run_batch(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  const auto batch = session.record<BatchWords>(0);
  if (!batch) return report_failure(batch.error());
  return answer_lines(session.door(), *batch);
}

Manual batch_manual() { return new_session().manual(); }

}  // namespace keyline::app
