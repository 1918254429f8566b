#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

/// Threads that work off one queue. What a hand waits for and what takes minutes go in different
/// lanes, so that neither waits for the other.
namespace keyline::studio {

class Lane {
 public:
  /// `gentle`: the system lets others go first.
  Lane(int threads, std::size_t most_waiting, bool gentle);
  /// Waits for what is being done; what still waits is dropped.
  ~Lane();
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;

  /// False where too much waits already. Work that throws
  /// ends there; whoever waits for it sees the connection close.
  bool take(std::function<void()> work);

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable there_is_;
  std::deque<std::function<void()>> waiting_;
  std::size_t most_waiting_;
  bool gentle_;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace keyline::studio
