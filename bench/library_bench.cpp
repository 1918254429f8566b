// The design library: how fast curves are measured and stored, how much room they take, and how
// long a question takes among 100,000 of them.

#include <cmath>
#include <filesystem>
#include <random>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "keyline/library/search.h"
#include "keyline/library/statistics.h"
#include "keyline/numeric/parallel.h"

namespace {

using namespace keyline;

constexpr int kCurves = 100'000;

/// A cubic whose edges turn and grow at random, as those of a designer's curve do.
curve::Bezier2 random_cubic(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  curve::Bezier2 cubic{{{between(-9, 9), between(-9, 9)}}, {}};
  double direction = between(-3, 3);
  double edge = between(0.5, 2);
  for (int i = 0; i < 3; ++i) {
    cubic.control.push_back(cubic.control.back() + edge * core::unit_vector(direction));
    direction += between(-0.8, 0.8);
    edge *= between(0.5, 2);
  }
  return cubic;
}

document::Document document_of(const curve::Bezier2& cubic, unsigned seed) {
  document::Document thing;
  thing.unit = "mm";
  thing.paths.push_back(
      {{"curve " + std::to_string(seed), "", ""}, document::Path{{{cubic}}, false}, 0});
  return thing;
}

/// What describe() gives, but for the readings, which are drawn at random: a hundred thousand
/// analyses are not what is measured here.
library::Entry entry_of(unsigned seed) {
  const curve::Bezier2 cubic = random_cubic(seed);
  library::Entry entry;
  entry.thing = document_of(cubic, seed);
  entry.source = "bench";
  entry.size = 5;
  entry.length = 5;
  entry.thumbnail = std::string(360, 'M');
  std::mt19937 random(seed + 1);
  const double slope = std::uniform_real_distribution<double>(-3, 3)(random);
  const auto rhythm = slope < -0.1  ? analysis::Rhythm::minus
                      : slope < 0.1 ? analysis::Rhythm::zero
                                    : analysis::Rhythm::plus;
  entry.pieces.push_back({1, rhythm, {slope}, slope, 0.01, 0.2, 0.03});
  entry.cav_type = 3;
  entry.cav = std::exponential_distribution<double>(0.2)(random);
  entry.turning = library::turning_profile(curve::PlanarView(cubic));
  return entry;
}

class Shelf {
 public:
  Shelf() : file_("/tmp/keyline-bench-" + std::to_string(getpid()) + ".kl") {}
  ~Shelf() {
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(file_ + suffix);
  }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

const std::string& full_library() {
  static Shelf shelf;
  static const bool filled = [] {
    std::vector<library::Entry> entries(kCurves);
    numeric::parallel_for(entries.size(), 0,
                          [&](std::size_t i) { entries[i] = entry_of(static_cast<unsigned>(i)); });
    auto library = library::Library::open(shelf.file(), library::Mode::write);
    return library && library::add(*library, entries).has_value();
  }();
  if (!filled) std::abort();
  return shelf.file();
}

void library_describe(benchmark::State& state) {
  unsigned seed = 0;
  for (auto _ : state) {
    const auto entries =
        library::describe(document_of(random_cubic(seed), seed), "bench", {.threads = 1});
    benchmark::DoNotOptimize(entries);
    ++seed;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(library_describe)->Name("library/describe")->Unit(benchmark::kMillisecond);

void library_profile(benchmark::State& state) {
  const curve::Bezier2 cubic = random_cubic(1);
  for (auto _ : state) benchmark::DoNotOptimize(library::turning_profile(curve::PlanarView(cubic)));
}
BENCHMARK(library_profile)->Name("library/profile")->Unit(benchmark::kMicrosecond);

/// One transaction for so many entries, on the disk when it returns.
void library_add(benchmark::State& state) {
  const auto count = static_cast<unsigned>(state.range(0));
  const Shelf shelf;
  auto library = library::Library::open(shelf.file(), library::Mode::write);
  unsigned seed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<library::Entry> entries;
    for (unsigned i = 0; i < count; ++i) entries.push_back(entry_of(seed++));
    state.ResumeTiming();
    if (!library::add(*library, entries)) state.SkipWithError("not stored");
  }
  state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(library_add)->Name("library/add")->Arg(1)->Arg(1000)->Unit(benchmark::kMillisecond);

void ask(benchmark::State& state, const library::Criteria& wanted) {
  auto library = library::Library::open(full_library(), library::Mode::read);
  for (auto _ : state) benchmark::DoNotOptimize(library::find(*library, wanted));
  state.counters["bytes_per_curve"] =
      static_cast<double>(std::filesystem::file_size(full_library())) / kCurves;
}

void library_like(benchmark::State& state) {
  library::Criteria wanted;
  wanted.like = library::turning_profile(curve::PlanarView(random_cubic(77)));
  ask(state, wanted);
}
BENCHMARK(library_like)->Name("library/like/100000")->Unit(benchmark::kMillisecond);

void library_like_rhythm(benchmark::State& state) {
  library::Criteria wanted;
  wanted.like = library::turning_profile(curve::PlanarView(random_cubic(77)));
  wanted.rhythm = "accelerating";
  ask(state, wanted);
}
BENCHMARK(library_like_rhythm)->Name("library/like+rhythm/100000")->Unit(benchmark::kMillisecond);

void library_rhythm(benchmark::State& state) {
  library::Criteria wanted;
  wanted.rhythm = "accelerating";
  wanted.slope = library::Range::from_text("-1±0.2").value();
  wanted.cav = library::Range::from_text("<1").value();
  ask(state, wanted);
}
BENCHMARK(library_rhythm)->Name("library/rhythm+slope+cav/100000")->Unit(benchmark::kMillisecond);

void library_name(benchmark::State& state) {
  library::Criteria wanted;
  wanted.name = "*4242";
  ask(state, wanted);
}
BENCHMARK(library_name)->Name("library/name/100000")->Unit(benchmark::kMillisecond);

/// Opened anew for every question, as the command line does.
void library_open_like(benchmark::State& state) {
  library::Criteria wanted;
  wanted.like = library::turning_profile(curve::PlanarView(random_cubic(77)));
  for (auto _ : state) {
    auto library = library::Library::open(full_library(), library::Mode::read);
    benchmark::DoNotOptimize(library::find(*library, wanted));
  }
}
BENCHMARK(library_open_like)->Name("library/open+like/100000")->Unit(benchmark::kMillisecond);

void library_stats(benchmark::State& state) {
  auto library = library::Library::open(full_library(), library::Mode::read);
  for (auto _ : state) benchmark::DoNotOptimize(library::statistics(*library));
}
BENCHMARK(library_stats)->Name("library/stats/100000")->Unit(benchmark::kMillisecond);

/// Of a thousand stored curves the twin, turned round, grown, mirrored and moved: how many are
/// found first. The time is that of one question.
void library_twins(benchmark::State& state) {
  auto library = library::Library::open(full_library(), library::Mode::read);
  unsigned sample = 0;
  int first = 0;
  int asked = 0;
  for (auto _ : state) {
    const unsigned seed = (97 * sample++) % kCurves;
    curve::Bezier2 twin = curve::transform(random_cubic(seed), {13.7, 2.2, {400, -1e3}});
    if (sample % 2 == 0) twin = curve::reverse(twin);
    if (sample % 3 == 0)
      for (core::Point2& p : twin.control) p.y = -p.y;
    library::Criteria wanted;
    wanted.like = library::turning_profile(curve::PlanarView(twin));
    wanted.limit = 2;
    const auto found = library::find(*library, wanted);
    ++asked;
    if (found && found->found.front().id == static_cast<std::int64_t>(seed) + 1) ++first;
  }
  state.counters["asked"] = asked;
  state.counters["first"] = first;
}
BENCHMARK(library_twins)
    ->Name("library/twins/100000")
    ->Iterations(1000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
