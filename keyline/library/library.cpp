#include "keyline/library/library.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"
#include "keyline/library/database.h"
#include "keyline/library/schema.h"

namespace keyline::library {

using core::ErrorCode;
using core::Result;
using detail::Database;
using detail::Statement;

namespace {

constexpr std::string_view kInsertCurve =
    "INSERT INTO curve(digest, kind, name, layer, unit, source, size, length, volume, "
    "curvature_min, curvature_max, rhythm, cav_type, cav, nearest_cav, nearest_distance, sav, "
    "notes) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";
constexpr std::string_view kSelectCurve =
    "SELECT kind, source, size, length, volume, curvature_min, curvature_max, cav_type, cav, "
    "nearest_cav, nearest_distance, sav, notes, geometry, thumbnail FROM curve "
    "JOIN shape ON shape.curve = curve.id WHERE id = ?";

/// FNV-1a: finds what may be the same; whether it is, the text itself decides.
std::int64_t digest_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return static_cast<std::int64_t>(hash);
}

/// The thing as JSON; bytes of a name that are no UTF-8 are replaced.
std::string geometry_of(const document::Document& thing) {
  return exchange::to_json(thing).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string joined(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += (text.empty() ? "" : "\n") + note;
  return text;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

/// A curve is called by the rhythm of its longest piece.
std::string rhythm_of(const Entry& entry) {
  const PieceEntry* longest = nullptr;
  for (const PieceEntry& piece : entry.pieces)
    if (!longest || piece.share > longest->share) longest = &piece;
  return longest ? analysis::rhythm_name(longest->rhythm) : "";
}

/// The statements that store an entry, prepared once for many.
struct Writer {
  Statement same;
  Statement curve;
  Statement shape;
  Statement piece;
  Statement profile;

  static Result<Writer> prepare(Database& database) {
    auto same = database.prepare(
        "SELECT id FROM curve JOIN shape ON shape.curve = curve.id "
        "WHERE digest = ? AND source = ? AND geometry = ?");
    auto curve = database.prepare(kInsertCurve);
    auto shape = database.prepare("INSERT INTO shape VALUES(?,?,?)");
    auto piece = database.prepare("INSERT INTO piece VALUES(?,?,?,?,?,?,?,?,?,?)");
    auto profile = database.prepare("INSERT INTO profile VALUES(?,?)");
    for (const auto* statement : {&same, &curve, &shape, &piece, &profile})
      if (!*statement) return std::unexpected(statement->error());
    return Writer{std::move(*same), std::move(*curve), std::move(*shape), std::move(*piece),
                  std::move(*profile)};
  }
};

Result<void> insert_curve(Writer& writer, const Entry& e, std::int64_t digest) {
  const document::Label& named = label(e);
  const std::string rhythm = rhythm_of(e);
  const std::string notes = joined(e.notes);
  const auto type = e.cav_type ? std::optional<double>(*e.cav_type) : std::nullopt;
  return writer.curve.bind(1, digest)
      .bind(2, core::word_of(e.kind))
      .bind(3, named.name)
      .bind(4, named.layer)
      .bind(5, e.thing.unit)
      .bind(6, e.source)
      .bind(7, e.size)
      .bind(8, e.length)
      .bind(9, e.volume)
      .bind(10, e.curvature ? (*e.curvature)[0] : std::nullopt)
      .bind(11, e.curvature ? (*e.curvature)[1] : std::nullopt)
      .bind(12, rhythm)
      .bind(13, type)
      .bind(14, e.cav)
      .bind(15, e.nearest_cav)
      .bind(16, e.nearest_distance)
      .bind(17, e.sav)
      .bind(18, notes)
      .run();
}

Result<void> insert_pieces(Writer& writer, const Entry& e, std::int64_t id) {
  for (std::size_t i = 0; i < e.pieces.size(); ++i) {
    const PieceEntry& p = e.pieces[i];
    const auto slope = [&](std::size_t at) {
      return at < p.slopes.size() ? std::optional<double>(p.slopes[at]) : std::nullopt;
    };
    if (auto done = writer.piece.bind(1, id)
                        .bind(2, static_cast<std::int64_t>(i))
                        .bind(3, p.share)
                        .bind(4, std::string_view(analysis::rhythm_name(p.rhythm)))
                        .bind(5, slope(0))
                        .bind(6, slope(1))
                        .bind(7, p.lcg_slope)
                        .bind(8, p.lcg_variance)
                        .bind(9, p.volume)
                        .bind(10, p.self_affinity)
                        .run();
        !done)
      return done;
  }
  return {};
}

Result<std::optional<std::int64_t>> find_same(Writer& writer, const std::string& geometry,
                                              std::int64_t digest, const std::string& source) {
  writer.same.bind(1, digest).bind(2, source).bind(3, geometry);
  const auto row = writer.same.step();
  if (!row) return std::unexpected(row.error());
  std::optional<std::int64_t> id;
  if (*row) id = writer.same.integer(0);
  if (auto done = writer.same.run(); !done) return std::unexpected(done.error());
  return id;
}

Result<Added> add_one(Database& database, Writer& writer, const Entry& entry) {
  const std::string geometry = geometry_of(entry.thing);
  const std::int64_t digest = digest_of(geometry);
  const auto same = find_same(writer, geometry, digest, entry.source);
  if (!same) return std::unexpected(same.error());
  if (*same) return Added{**same, false};
  if (auto done = insert_curve(writer, entry, digest); !done) return std::unexpected(done.error());
  const std::int64_t id = database.last_row();
  if (auto done = writer.shape.bind(1, id).bind(2, geometry).bind(3, entry.thumbnail).run(); !done)
    return std::unexpected(done.error());
  if (auto done = insert_pieces(writer, entry, id); !done) return std::unexpected(done.error());
  if (entry.turning)
    if (auto done =
            writer.profile.bind(1, id).bind(2, std::span<const float>(*entry.turning)).run();
        !done)
      return std::unexpected(done.error());
  return Added{id, true};
}

Kind kind_of(const std::string& name) {
  for (const Kind kind : {Kind::curve, Kind::space_curve})
    if (name == core::word_of(kind)) return kind;
  return Kind::surface;
}

Result<Entry> read_curve(Database& database, std::int64_t id) {
  auto row = database.prepare(kSelectCurve);
  if (!row) return std::unexpected(row.error());
  const auto found = row->bind(1, id).step();
  if (!found) return std::unexpected(found.error());
  if (!*found)
    return core::fail(ErrorCode::bad_input, "the library holds nothing of that number", {},
                      std::to_string(id));
  Entry e;
  e.kind = kind_of(row->text(0));
  e.source = row->text(1);
  e.size = row->number(2);
  e.length = row->number_if_any(3);
  e.volume = row->number_if_any(4);
  const auto least = row->number_if_any(5);
  const auto most = row->number_if_any(6);
  if (least || most) e.curvature = {{least, most}};
  if (const auto type = row->number_if_any(7)) e.cav_type = static_cast<int>(*type);
  e.cav = row->number_if_any(8);
  e.nearest_cav = row->number_if_any(9);
  e.nearest_distance = row->number_if_any(10);
  e.sav = row->number_if_any(11);
  e.notes = split_lines(row->text(12));
  auto thing = exchange::read_json(row->text(13));
  if (!thing) return std::unexpected(thing.error());
  e.thing = std::move(*thing);
  e.thumbnail = row->text(14);
  return e;
}

Result<void> read_pieces(Database& database, std::int64_t id, Entry& entry) {
  auto row = database.prepare(
      "SELECT share, rhythm, slope, second_slope, lcg_slope, lcg_variance, volume, self_affinity "
      "FROM piece WHERE curve = ? ORDER BY ordinal");
  if (!row) return std::unexpected(row.error());
  row->bind(1, id);
  for (;;) {
    const auto more = row->step();
    if (!more) return std::unexpected(more.error());
    if (!*more) return {};
    PieceEntry& p = entry.pieces.emplace_back();
    p.share = row->number(0);
    p.rhythm = analysis::parse_rhythm(row->text(1)).value_or(analysis::Rhythm::straight);
    for (const int column : {2, 3})
      if (const auto slope = row->number_if_any(column)) p.slopes.push_back(*slope);
    p.lcg_slope = row->number_if_any(4);
    p.lcg_variance = row->number_if_any(5);
    p.volume = row->number(6);
    p.self_affinity = row->number_if_any(7);
  }
}

Result<void> read_profile(Database& database, std::int64_t id, Entry& entry) {
  auto row = database.prepare("SELECT turning FROM profile WHERE curve = ?");
  if (!row) return std::unexpected(row.error());
  const auto found = row->bind(1, id).step();
  if (!found) return std::unexpected(found.error());
  TurningProfile profile{};
  if (*found && row->floats(0, profile)) entry.turning = profile;
  return {};
}

}  // namespace

bool is_available() { return true; }

Library::Library(std::unique_ptr<Database> database) : database_(std::move(database)) {}
Library::Library(Library&&) noexcept = default;
Library& Library::operator=(Library&&) noexcept = default;
Library::~Library() = default;

Result<Library> Library::open(const std::filesystem::path& file, Mode mode) {
  auto database =
      Database::open(file, mode == Mode::read ? detail::Access::read : detail::Access::create);
  if (!database) return std::unexpected(database.error());
  const auto steps = detail::schema_steps();
  if (auto ready = mode == Mode::read ? detail::check_version(*database, steps.size())
                                      : detail::migrate(*database, steps);
      !ready)
    return std::unexpected(ready.error());
  // A finished answer means that it is on the disk.
  if (auto set = database->execute("PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL"); !set)
    return std::unexpected(set.error());
  return Library(std::make_unique<Database>(std::move(*database)));
}

Result<std::vector<Added>> add(Library& library, const std::vector<Entry>& entries) {
  Database& database = library.database();
  auto transaction = detail::Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  std::vector<Added> all;
  {
    auto writer = Writer::prepare(database);
    if (!writer) return std::unexpected(writer.error());
    for (const Entry& entry : entries) {
      const auto added = add_one(database, *writer, entry);
      if (!added) return std::unexpected(added.error());
      all.push_back(*added);
    }
  }
  if (auto done = transaction->commit(); !done) return std::unexpected(done.error());
  return all;
}

Result<Entry> get(Library& library, std::int64_t id) {
  auto entry = read_curve(library.database(), id);
  if (!entry) return entry;
  if (auto done = read_pieces(library.database(), id, *entry); !done)
    return std::unexpected(done.error());
  if (auto done = read_profile(library.database(), id, *entry); !done)
    return std::unexpected(done.error());
  return entry;
}

Result<document::Document> export_document(Library& library, const std::vector<std::int64_t>& ids) {
  document::Document all;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto entry = get(library, ids[i]);
    if (!entry) return std::unexpected(entry.error());
    document::Document& thing = entry->thing;
    if (i > 0 && thing.unit != all.unit)
      return core::fail(ErrorCode::bad_input,
                        "number " + std::to_string(ids[i]) + " is in \"" + thing.unit +
                            "\", the first in \"" + all.unit + "\"",
                        "export what shares a unit", "numbers");
    all.unit = thing.unit;
    std::ranges::move(thing.paths, std::back_inserter(all.paths));
    std::ranges::move(thing.space_curves, std::back_inserter(all.space_curves));
    std::ranges::move(thing.surfaces, std::back_inserter(all.surfaces));
  }
  return all;
}

Result<std::int64_t> size(Library& library) {
  return library.database().integer("SELECT count(*) FROM curve");
}

}  // namespace keyline::library
