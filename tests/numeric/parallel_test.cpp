#include "keyline/numeric/parallel.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

#include <sys/resource.h>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(ParallelFor, CallsEachIndexOnceWithAWorkerInRange) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> calls(1000, 0);
    std::vector<int> workers(1000, -1);
    parallel_for(calls.size(), threads, [&](std::size_t i, int worker) {
      ++calls[i];
      workers[i] = worker;
    });
    for (std::size_t i = 0; i < calls.size(); ++i) {
      ASSERT_EQ(calls[i], 1);
      ASSERT_GE(workers[i], 0);
      ASSERT_LT(workers[i], threads);
    }
  }
}

TEST(ParallelFor, LoopsWithinLoopsKeepTheirWorkersApart) {
  constexpr int kThreads = 2;
  std::vector<std::vector<int>> calls(40, std::vector<int>(8, 0));
  std::atomic<int> overlaps = 0;
  std::array<std::atomic<bool>, kThreads> outer_busy{};
  parallel_for(calls.size(), kThreads, [&](std::size_t i, int outer) {
    if (outer_busy[outer].exchange(true)) ++overlaps;
    std::array<std::atomic<bool>, kThreads> busy{};
    parallel_for(calls[i].size(), kThreads, [&](std::size_t k, int inner) {
      if (busy[inner].exchange(true)) ++overlaps;
      std::this_thread::sleep_for(std::chrono::microseconds(50 * ((i + k) % 4)));
      ++calls[i][k];
      busy[inner] = false;
    });
    outer_busy[outer] = false;
  });
  EXPECT_EQ(overlaps, 0);
  for (const auto& row : calls)
    for (const int count : row) ASSERT_EQ(count, 1);
}

/// A search asks for thousands of short loops, a server for more. With an arena made for each,
/// 5,000 loops took 36 MB.
TEST(ParallelFor, ManyLoopsTakeNoMemory) {
  const auto most_memory = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // kB
  };
  std::vector<double> values(12);
  const auto loops = [&](int count) {
    for (int k = 0; k < count; ++k)
      parallel_for(values.size(), 2, [&](std::size_t i) { values[i] += 1; });
  };
  loops(10);
  const long before = most_memory();
  loops(5000);
  EXPECT_LT(most_memory() - before, 12000);
  for (const double value : values) EXPECT_EQ(value, 5010);
}

TEST(ParallelFor, NothingToDo) {
  parallel_for(0, 2, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, PassesExceptionsOn) {
  const auto thrower = [](std::size_t i) {
    if (i == 17) throw std::runtime_error("seventeen");
  };
  EXPECT_THROW(parallel_for(100, 2, thrower), std::runtime_error);
  EXPECT_THROW(parallel_for(100, 1, thrower), std::runtime_error);
}

TEST(ParallelFor, ThreadCountIsAtLeastOne) {
  EXPECT_GE(thread_count(0), 1);
  EXPECT_GE(thread_count(-3), 1);
  EXPECT_EQ(thread_count(3), 3);
}

}  // namespace
}  // namespace keyline::numeric
