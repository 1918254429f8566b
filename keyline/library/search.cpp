#include "keyline/library/search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "keyline/library/database.h"

namespace keyline::library {

using core::ErrorCode;
using core::Result;
using detail::Database;
using detail::Statement;

namespace {

/// Conditions joined by AND with the values of their parameters.
struct Where {
  std::string text;
  std::vector<std::variant<double, std::string>> values;

  void add(const std::string& condition) { text += (text.empty() ? "" : " AND ") + condition; }
  void add_range(const std::string& column, const std::optional<Range>& range) {
    if (!range) return;
    add(column + " BETWEEN ? AND ?");
    add_ends(*range);
  }
  void add_ends(const Range& range) {
    values.emplace_back(range.low.value_or(-HUGE_VAL));
    values.emplace_back(range.high.value_or(HUGE_VAL));
  }
  void add_pattern(const std::string& column, const std::string& pattern) {
    if (pattern.empty()) return;
    add(column + " GLOB ?");
    values.emplace_back(pattern);
  }
  std::string clause() const { return text.empty() ? "" : " WHERE " + text; }
};

/// "minus" for "minus" and for each of "sharp", "forceful", "accelerating".
Result<std::string> rhythm_meant(const std::string& text) {
  using analysis::Rhythm;
  if (analysis::parse_rhythm(text)) return text;
  for (const Rhythm rhythm : {Rhythm::minus, Rhythm::zero, Rhythm::plus, Rhythm::plus_minus,
                              Rhythm::minus_plus, Rhythm::arc, Rhythm::straight, Rhythm::arcs}) {
    const std::string words = std::string(", ") + analysis::impression(rhythm) + ", ";
    if (!text.empty() && words.find(", " + text + ", ") != std::string::npos)
      return analysis::rhythm_name(rhythm);
  }
  return core::fail(ErrorCode::bad_input, "there is no rhythm \"" + text + "\"",
                    "use minus (accelerating), zero (stable), plus (decelerating), plus+minus, "
                    "minus+plus, arc, arcs or straight",
                    "rhythm");
}

Result<Where> where_of(const Criteria& wanted) {
  Where piece;
  if (!wanted.rhythm.empty()) {
    const auto rhythm = rhythm_meant(wanted.rhythm);
    if (!rhythm) return std::unexpected(rhythm.error());
    piece.add("rhythm = ?");
    piece.values.emplace_back(*rhythm);
  }
  if (wanted.slope) {
    piece.add("(slope BETWEEN ? AND ? OR second_slope BETWEEN ? AND ?)");
    for (int i = 0; i < 2; ++i) piece.add_ends(*wanted.slope);
  }
  piece.add_range("self_affinity", wanted.self_affinity);
  Where where;
  if (!piece.text.empty()) {
    where.add("id IN (SELECT curve FROM piece" + piece.clause() + ")");
    where.values = piece.values;
  }
  where.add_pattern("name", wanted.name);
  where.add_pattern("source", wanted.source);
  where.add_range("cav", wanted.cav);
  where.add_range("nearest_cav", wanted.nearest_cav);
  where.add_range("sav", wanted.sav);
  where.add_range("size", wanted.size);
  return where;
}

Result<Statement> prepare(Database& database, const std::string& sql, const Where& where) {
  auto statement = database.prepare(sql);
  if (!statement) return statement;
  int at = 0;
  for (const auto& value : where.values)
    std::visit(
        [&]<class Value>(const Value& v) {
          if constexpr (std::is_same_v<Value, double>)
            statement->bind(++at, v);
          else
            statement->bind(++at, std::string_view(v));
        },
        value);
  return statement;
}

Found found_of(const Statement& row) {
  return {row.integer(0),
          row.text(1),
          row.text(2),
          row.text(3),
          row.text(4),
          row.number(5),
          row.number_if_any(6),
          row.number_if_any(7),
          row.number_if_any(8),
          row.number_if_any(9),
          {}};
}

/// Those of the given numbers that there are, in their order.
Result<std::vector<Found>> rows_of(Database& database, const std::vector<std::int64_t>& ids) {
  auto row = database.prepare(
      "SELECT id, kind, name, source, rhythm, size, length, cav, nearest_cav, sav FROM curve "
      "WHERE id = ?");
  if (!row) return std::unexpected(row.error());
  std::vector<Found> all;
  for (const std::int64_t id : ids) {
    const auto there = row->bind(1, id).step();
    if (!there) return std::unexpected(there.error());
    if (*there) all.push_back(found_of(*row));
    if (auto done = row->run(); !done) return std::unexpected(done.error());
  }
  return all;
}

Result<Findings> find_in_order(Database& database, const Where& where, int limit) {
  auto rows = prepare(database, "SELECT id FROM curve" + where.clause(), where);
  if (!rows) return std::unexpected(rows.error());
  std::vector<std::int64_t> ids;
  for (;;) {
    const auto row = rows->step();
    if (!row) return std::unexpected(row.error());
    if (!*row) break;
    ids.push_back(rows->integer(0));
  }
  std::ranges::sort(ids);
  Findings findings{std::ssize(ids), {}};
  ids.resize(std::min(ids.size(), static_cast<std::size_t>(limit)));
  auto found = rows_of(database, ids);
  if (!found) return std::unexpected(found.error());
  findings.found = std::move(*found);
  return findings;
}

struct Candidate {
  TurningMatch match;
  std::int64_t id = 0;
  bool operator<(const Candidate& other) const {
    return std::pair(match.distance, id) < std::pair(other.match.distance, other.id);
  }
};

/// The nearest of all profiles, by one pass over them.
Result<std::int64_t> nearest(Database& database, const Where& where, const Criteria& wanted,
                             std::vector<Candidate>& best) {
  // The plus keeps SQLite from looking up one profile after another: to read all is faster.
  const std::string among =
      where.text.empty() ? "" : " WHERE +curve IN (SELECT id FROM curve" + where.clause() + ")";
  auto rows = prepare(database, "SELECT curve, turning FROM profile" + among, where);
  if (!rows) return std::unexpected(rows.error());
  std::int64_t count = 0;
  TurningProfile profile{};
  const auto most = static_cast<std::size_t>(wanted.limit);
  for (;;) {
    const auto row = rows->step();
    if (!row) return std::unexpected(row.error());
    if (!*row) break;
    if (!rows->floats(1, profile)) continue;
    ++count;
    const Candidate candidate{compare(*wanted.like, profile, wanted.mirror), rows->integer(0)};
    if (best.size() == most && !(candidate < best.front())) continue;
    best.push_back(candidate);
    std::push_heap(best.begin(), best.end());
    if (best.size() <= most) continue;
    std::pop_heap(best.begin(), best.end());
    best.pop_back();
  }
  std::sort_heap(best.begin(), best.end());
  return count;
}

Result<Findings> find_alike(Database& database, const Where& where, const Criteria& wanted) {
  std::vector<Candidate> best;
  const auto count = nearest(database, where, wanted, best);
  if (!count) return std::unexpected(count.error());
  std::vector<std::int64_t> ids;
  for (const Candidate& candidate : best) ids.push_back(candidate.id);
  auto found = rows_of(database, ids);
  if (!found) return std::unexpected(found.error());
  // Nothing is ever taken out of a library, so that none can be missing.
  for (std::size_t i = 0; i < found->size(); ++i) (*found)[i].match = best[i].match;
  return Findings{*count, std::move(*found)};
}

}  // namespace

Result<Findings> find(Library& library, const Criteria& criteria) {
  if (criteria.limit < 1)
    return core::fail(ErrorCode::bad_input, "the limit is below 1", "give 1 or more", "limit");
  const auto where = where_of(criteria);
  if (!where) return std::unexpected(where.error());
  if (criteria.like) return find_alike(library.database(), *where, criteria);
  return find_in_order(library.database(), *where, criteria.limit);
}

}  // namespace keyline::library
