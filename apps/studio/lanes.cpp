#include "lanes.h"

#include <sys/resource.h>
#include <unistd.h>

namespace keyline::studio {

Lane::Lane(int threads, std::size_t most_waiting, bool gentle)
    : most_waiting_(most_waiting), gentle_(gentle) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

Lane::~Lane() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    waiting_.clear();
  }
  there_is_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool Lane::take(std::function<void()> work) {
  {
    const std::scoped_lock lock(mutex_);
    if (ending_ || waiting_.size() >= most_waiting_) return false;
    waiting_.push_back(std::move(work));
  }
  there_is_.notify_one();
  return true;
}

void Lane::serve() {
  constexpr int kGentle = 10;  // of Linux's 19 steps, for this thread alone
  if (gentle_) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kGentle);
  for (;;) {
    std::unique_lock lock(mutex_);
    there_is_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    const std::function<void()> work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    try {
      work();
    } catch (...) {
      // Its responder goes with it, which closes the connection; others are served on.
    }
  }
}

}  // namespace keyline::studio
