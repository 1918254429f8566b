#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

/// `keyline batch` on a million segments: all cores against one worker (the ratio is the gain of
/// the further ones), with the largest memory of any of its processes.
namespace {

constexpr int kLines = 1'000'000;

/// The requests, written once.
const std::string& requests() {
  static const std::string file = [] {
    const auto name = std::filesystem::temp_directory_path() / "keyline-batch-bench.ndjson";
    std::ofstream out(name);
    for (int i = 0; i < kLines; ++i) {
      char line[128];
      std::snprintf(line, sizeof line,
                    R"({"op":"lac.segment","id":%d,"points":[[0,0],[2,0],[3,1.5]],"alpha":%.6f})",
                    i, -2 + 4e-6 * i);
      out << line << '\n';
    }
    return name.string();
  }();
  return file;
}

void run(benchmark::State& state, const std::string& options) {
  const std::string command = std::string(KEYLINE_PROGRAM) + " batch --quiet " + options + " <" +
                              requests() + " >/dev/null";
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("keyline batch failed");
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  state.counters["largest_MB"] = static_cast<double>(used.ru_maxrss) / 1024;
  state.counters["per_second"] =
      benchmark::Counter(static_cast<double>(kLines) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

void all_cores(benchmark::State& state) { run(state, ""); }
void one_worker(benchmark::State& state) { run(state, "--threads 1"); }

BENCHMARK(all_cores)
    ->Name("batch_lac_segment/1000000")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(one_worker)
    ->Name("batch_lac_segment/peer:one_worker/1000000")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
