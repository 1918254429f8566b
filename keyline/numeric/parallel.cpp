#include "keyline/numeric/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "keyline/core/sanitized.h"

namespace keyline::numeric {

int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace detail {

#ifdef KEYLINE_THREAD_SANITIZED

// TBB is built without the sanitizer, which takes what it hands from thread to thread for races.
// The starts and ends of plain threads it sees, and so the races of what runs on them.
void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t, int)>& body) {
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  std::exception_ptr thrown;
  const auto work = [&](int worker) {
    try {
      for (std::size_t i = next++; i < count; i = next++) body(i, worker);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!thrown) thrown = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int worker = 0; worker < threads; ++worker) workers.emplace_back(work, worker);
  }
  if (thrown) std::rethrow_exception(thrown);
}

#else

namespace {

/// Threads of the loop whose body this thread is in; 0: in none.
thread_local int loop_threads = 0;

class InLoop {
 public:
  explicit InLoop(int threads) : before_(std::exchange(loop_threads, threads)) {}
  InLoop(const InLoop&) = delete;
  InLoop& operator=(const InLoop&) = delete;
  ~InLoop() { loop_threads = before_; }

 private:
  int before_;
};

void loop(std::size_t count, int threads, const std::function<void(std::size_t, int)>& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const InLoop in(threads);
                      const int worker = tbb::this_task_arena::current_thread_index();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, worker);
                    });
}

}  // namespace

/// A loop within a loop goes on in the arena of the outer one: who has nothing left to do there
/// helps. Who waits for the inner one's end takes up nothing of the outer one meanwhile, so that a
/// worker is in one call of a body at a time. A thread keeps its arena for its next loop: a new one
/// costs a hundred times what a short loop takes, and 7 kB that TBB does not give back.
void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t, int)>& body) {
  // More than the machine has would only make TBB complain.
  const int used = std::min(threads, tbb::info::default_concurrency());
  const auto run = [&] { loop(count, used, body); };
  if (loop_threads == used) {
    tbb::this_task_arena::isolate(run);
    return;
  }
  if (loop_threads != 0) {
    tbb::task_arena(used).execute(run);
    return;
  }
  thread_local std::map<int, tbb::task_arena> arenas;
  arenas.try_emplace(used, used).first->second.execute(run);
}

#endif

}  // namespace detail
}  // namespace keyline::numeric
