#include "keyline/numeric/parallel.h"

#include <algorithm>
#include <thread>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace keyline::numeric {

int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace detail {

void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t, int)>& body) {
  // More than the machine has would only make TBB complain.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        const int worker = tbb::this_task_arena::current_thread_index();
                        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, worker);
                      });
  });
}

}  // namespace detail
}  // namespace keyline::numeric
