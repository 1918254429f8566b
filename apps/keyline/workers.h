#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

/// Processes that answer lines, so that a line that brings one down harms no other.
namespace keyline::app {

/// A line of the input and its place among those that get an answer.
struct NumberedLine {
  std::uint64_t number = 0;
  std::string text;
  bool alone = false;  ///< was in a block whose worker died: goes to a worker of its own
};

/// What a worker runs: reads lines from `in` and writes one line for each to `out` until `in` ends.
using WorkerMain = std::function<void(int in, int out)>;

/// One process with a pipe each way. Lines go in blocks: as many as it answers in about ten
/// milliseconds, so that the pipe costs little and an answer does not wait long.
class Worker {
 public:
  explicit Worker(const WorkerMain& main);
  ~Worker();
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&&) = delete;

  bool idle() const { return sent_.empty(); }
  bool wants_to_write() const { return !outgoing_.empty(); }
  int input() const { return to_; }
  int output() const { return from_; }

  /// Takes lines from the front of the queue. Precondition: idle.
  void take(std::deque<NumberedLine>& queue);
  /// Writes what the pipe takes; false where the process is gone.
  bool write_some();
  /// Reads what is there and hands over complete answers; false where the process is gone.
  bool read_some(const std::function<void(std::uint64_t number, std::string answer)>& answered);
  /// The lines it was given and has not answered; it holds none afterwards.
  std::vector<NumberedLine> unanswered();
  /// Seconds since it last answered a line (or got its block).
  double waiting() const;

 private:
  void adapt();

  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::deque<NumberedLine> sent_;
  std::string outgoing_;
  std::string incoming_;
  std::size_t block_ = 1;
  double began_ = 0;  ///< when the block was taken
  double heard_ = 0;  ///< when it last answered
};

/// The first '\n' in [from, to), else `to`.
const char* line_end(const char* from, const char* to);

/// Seconds on a clock that never goes back.
double now();

}  // namespace keyline::app
