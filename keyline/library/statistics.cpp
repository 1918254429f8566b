#include "keyline/library/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/library/database.h"

namespace keyline::library {

using analysis::Rhythm;
using core::Result;
using detail::Database;

namespace {

constexpr std::array kFive = {Rhythm::minus, Rhythm::zero, Rhythm::plus, Rhythm::plus_minus,
                              Rhythm::minus_plus};
constexpr std::array kAll = {Rhythm::minus,      Rhythm::zero,     Rhythm::plus, Rhythm::plus_minus,
                             Rhythm::minus_plus, Rhythm::straight, Rhythm::arc,  Rhythm::arcs};

/// Of the values of a query's first column; nulls are left out.
Result<Spread> spread(Database& database, const std::string& sql) {
  auto row = database.prepare(sql);
  if (!row) return std::unexpected(row.error());
  std::vector<double> values;
  for (;;) {
    const auto more = row->step();
    if (!more) return std::unexpected(more.error());
    if (!*more) break;
    if (const auto value = row->number_if_any(0)) values.push_back(*value);
  }
  Spread result{static_cast<std::int64_t>(values.size()), 0, 0, 0};
  if (values.empty()) return result;
  std::ranges::sort(values);
  const auto quantile = [&](double q) {
    const double at = q * static_cast<double>(values.size() - 1);
    const auto i = static_cast<std::size_t>(at);
    const double next = values[std::min(i + 1, values.size() - 1)];
    return values[i] + (at - static_cast<double>(i)) * (next - values[i]);
  };
  result.low = quantile(0.1);
  result.median = quantile(0.5);
  result.high = quantile(0.9);
  return result;
}

/// Fills in numbers; the first failure stays.
class Questions {
 public:
  explicit Questions(Database& database) : database_(database) {}
  std::int64_t count(const std::string& sql) {
    return answer(done_ ? database_.integer(sql) : std::unexpected(done_.error()));
  }
  Spread spread_of(const std::string& sql) {
    return answer(done_ ? spread(database_, sql) : std::unexpected(done_.error()));
  }
  double number(const std::string& sql) {
    auto row = database_.prepare(sql);
    if (!row) return answer<double>(std::unexpected(row.error()));
    const auto there = row->step();
    return there && *there ? row->number(0) : 0;
  }
  const Result<void>& done() const { return done_; }

 private:
  template <class T>
  T answer(Result<T> result) {
    if (result) return *result;
    done_ = std::unexpected(result.error());
    return {};
  }
  Database& database_;
  Result<void> done_;
};

RhythmCount count_rhythm(Questions& ask, Rhythm rhythm) {
  const std::string name = analysis::rhythm_name(rhythm);
  const std::string pieces = " FROM piece WHERE rhythm = '" + name + "'";
  RhythmCount count{
      name, analysis::impression(rhythm), std::ranges::count(kFive, rhythm) > 0, 0, 0, 0, {}, {}};
  count.curves = ask.count("SELECT count(*) FROM curve WHERE rhythm = '" + name + "'");
  count.pieces = ask.count("SELECT count(*)" + pieces);
  count.length = ask.number("SELECT total(share)" + pieces);
  count.slope = ask.spread_of("SELECT slope" + pieces);
  count.self_affinity = ask.spread_of("SELECT self_affinity" + pieces);
  return count;
}

}  // namespace

Result<Statistics> statistics(Library& library) {
  Questions ask(library.database());
  const auto of_kind = [&](Kind kind) {
    return ask.count("SELECT count(*) FROM curve WHERE kind = '" +
                     std::string(core::word_of(kind)) + "'");
  };
  Statistics all;
  all.things = ask.count("SELECT count(*) FROM curve");
  all.curves = of_kind(Kind::curve);
  all.space_curves = of_kind(Kind::space_curve);
  all.surfaces = of_kind(Kind::surface);
  all.without_rhythm =
      ask.count("SELECT count(*) FROM curve WHERE rhythm = '' AND kind <> 'surface'");
  std::int64_t pieces = 0;
  std::int64_t five = 0;
  double length = 0;
  for (const Rhythm rhythm : kAll) {
    const RhythmCount& count = all.rhythms.emplace_back(count_rhythm(ask, rhythm));
    pieces += count.pieces;
    five += count.is_of_the_five ? count.pieces : 0;
    length += count.length;
  }
  if (length > 0)
    for (RhythmCount& count : all.rhythms) count.length /= length;
  if (pieces > 0) all.in_the_five = static_cast<double>(five) / static_cast<double>(pieces);
  all.self_affinity = ask.spread_of("SELECT self_affinity FROM piece");
  all.cav = ask.spread_of("SELECT cav FROM curve");
  all.sav = ask.spread_of("SELECT sav FROM curve");
  if (!ask.done()) return std::unexpected(ask.done().error());
  return all;
}

}  // namespace keyline::library
