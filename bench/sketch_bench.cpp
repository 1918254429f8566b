// Tracing a drawing, whole and by stage; argument: megapixels. The peer (sketch.py) is potrace, as
// a process of its own, on the same ink; a second row names the most memory this process ever held.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "keyline/sketch/binarize.h"
#include "keyline/sketch/join_strokes.h"
#include "keyline/sketch/stroke_graph.h"
#include "keyline/sketch/thinning.h"
#include "keyline/sketch/tone.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {
namespace {

/// Rings and waves, 4 pixels wide, the same density of ink at every size; sketch.py draws the same.
const Image& drawing(std::int64_t megapixels) {
  static std::map<std::int64_t, Image> made;
  Image& image = made[megapixels];
  if (image.width() > 0) return image;
  const int height = static_cast<int>(std::lround(std::sqrt(megapixels * 1e6 / 1.5)));
  const int width = height * 3 / 2;
  image.luminance = Raster<std::uint16_t>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = std::fmod(x + 0.5, 400) - 200;
      const double v = std::fmod(y + 0.5, 400) - 200;
      const double ring = std::abs(std::hypot(u, v) - 150);
      const double wave = std::abs(v - 60 * std::sin(0.02 * u));
      const bool waves = std::abs(u) < 120;
      const double cover = std::clamp(2.5 - std::min(ring, waves ? wave : 99.0), 0.0, 1.0);
      image.luminance.at(x, y) = static_cast<std::uint16_t>(62000 * (1 - 0.85 * cover));
    }
  return image;
}

void report_memory(benchmark::State& state, const Image& image) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
  state.counters["Mpx/s"] =
      benchmark::Counter(static_cast<double>(image.luminance.data.size()) / 1e6,
                         benchmark::Counter::kIsIterationInvariantRate);
}

void sketch_whole(benchmark::State& state) {
  const Image& image = drawing(state.range(0));
  for (auto _ : state) {
    const auto result = trace(image);
    if (!result) state.SkipWithError(result.error().message.c_str());
    benchmark::DoNotOptimize(result);
  }
  report_memory(state, image);
}

void sketch_intensity(benchmark::State& state) {
  const Image& image = drawing(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(transform_intensity(image));
  report_memory(state, image);
}

void sketch_binarize(benchmark::State& state) {
  const Image& image = drawing(state.range(0));
  const Tone tone = transform_intensity(image);
  for (auto _ : state) benchmark::DoNotOptimize(binarize(tone));
  report_memory(state, image);
}

void sketch_thinning(benchmark::State& state) {
  const Image& image = drawing(state.range(0));
  const Binary ink = binarize(transform_intensity(image)).ink;
  for (auto _ : state) benchmark::DoNotOptimize(thin(ink));
  report_memory(state, image);
}

void sketch_lines(benchmark::State& state) {
  const Image& image = drawing(state.range(0));
  const Binary ink = binarize(transform_intensity(image)).ink;
  const Binary lines = thin(ink);
  for (auto _ : state) benchmark::DoNotOptimize(join_strokes(build_graph(lines, ink), {}));
  report_memory(state, image);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Arg(2)->Arg(8)->Arg(32)->Unit(benchmark::kMillisecond);
}

BENCHMARK(sketch_whole)->Apply(sizes);
BENCHMARK(sketch_intensity)->Apply(sizes);
BENCHMARK(sketch_binarize)->Apply(sizes);
BENCHMARK(sketch_thinning)->Apply(sizes);
BENCHMARK(sketch_lines)->Apply(sizes);

}  // namespace
}  // namespace keyline::sketch
