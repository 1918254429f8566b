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

#include "keyline/operations/perform.h"
#include "keyline/operations/references.h"
#include "keyline/operations/schema.h"

#include "batch.h"
#include "commands.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;

constexpr std::size_t kAtOnce = 1u << 16;

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

int workers_of(const BatchCommand& command) {
  if (command.common.threads > 0) return command.common.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

nlohmann::json defaults_of(const BatchCommand& command) {
  nlohmann::json defaults = nlohmann::json::object();
  if (command.seed) defaults["seed"] = *command.seed;
  if (command.common.tolerance) defaults["tolerance"] = *command.common.tolerance;
  return defaults;
}

void tell(const BatchCommand& command, const BatchReport& report, const Sink& sink) {
  std::string text;
  if (sink.answers > 0) text = fmt::format("{} lines were answered before; ", sink.answers);
  text +=
      fmt::format("{} lines in {:.3g} s, {:.0f} per second, {} {}", report.lines, report.seconds,
                  static_cast<double>(report.lines) / std::max(report.seconds, 1e-9),
                  workers_of(command), workers_of(command) == 1 ? "worker" : "workers");
  if (report.crashed > 0) text += fmt::format(", {} brought a worker down", report.crashed);
  if (report.expired > 0) text += fmt::format(", {} over the time limit", report.expired);
  say(command.common.quiet, text);
}

}  // namespace

int run_batch(const BatchCommand& command) {
  std::signal(SIGPIPE, SIG_IGN);
  auto sink = command.resume.empty() ? Result<Sink>(Sink{}) : resumed(command.resume);
  if (!sink) return report_failure(sink.error());
  BatchOptions options;
  options.workers = workers_of(command);
  options.time_limit = command.time_limit.value_or(0);
  options.skip = sink->answers;
  options.progress = interactive_progress(true);
  const nlohmann::json defaults = defaults_of(command);
  const WorkerMain main = [&](int in, int out) { serve(in, out, defaults); };
  const auto report = run_lines(STDIN_FILENO, sink->file, main, kAnswers, options);
  if (!report) return report_failure(report.error());
  tell(command, *report, *sink);
  return report->cancelled ? kCancelled : kDone;
}

namespace {

/// Everything about every operation in one go.
int print_all(const std::string& format) {
  if (format == "typescript") {
    fmt::print("{}", operations::typescript_types());
  } else if (format == "python") {
    fmt::print("{}", operations::python_stubs());
  } else if (format == "openapi") {
    fmt::print("{}\n", operations::openapi_document().dump(1));
  } else if (format == "markdown") {
    for (const auto& operation : operations::operations())
      fmt::print("{}\n", operations::reference_page(operation));
  } else {
    nlohmann::json all = nlohmann::json::object();
    for (const auto& operation : operations::operations())
      all[operation.name] = {{"request", operations::request_schema(operation)},
                             {"result", operations::result_schema(operation)}};
    fmt::print("{}\n", all.dump(1));
  }
  return kDone;
}

}  // namespace

int run_operations(const OperationsCommand& command) {
  if (command.name.empty() && !command.format.empty()) return print_all(command.format);
  if (command.name.empty()) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& operation : operations::operations()) {
      if (command.common.json)
        list.push_back({{"name", operation.name}, {"summary", operation.summary}});
      else
        fmt::print("{:<18} {}\n", operation.name, operation.summary);
    }
    if (command.common.json) fmt::print("{}\n", list.dump());
    return kDone;
  }
  const operations::Operation* operation = operations::find_operation(command.name);
  if (!operation)
    return report_failure({core::ErrorCode::bad_input,
                           "there is no operation \"" + command.name + "\"",
                           "keyline operations lists them", ""});
  if (command.format == "markdown")
    fmt::print("{}", operations::reference_page(*operation));
  else if (command.format == "result")
    fmt::print("{}\n", operations::result_schema(*operation).dump(2));
  else
    fmt::print("{}\n", operations::request_schema(*operation).dump(2));
  return kDone;
}

}  // namespace keyline::app
