#include "keyline/library/library.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"
#include "keyline/library/search.h"
#include "keyline/library/statistics.h"

#include "tests/library/library_files.h"

namespace keyline::library {
namespace {

using testing::Folder;
using testing::one_curve;

lac::Chain spiral(double alpha, double k0, double k1) {
  return {{{1, 2}, 0.3}, {{alpha, 3, k0, k1}}, false};
}

std::vector<Entry> entries_of(const document::Document& thing, const std::string& source) {
  auto entries = describe(thing, source);
  EXPECT_TRUE(entries);
  return entries.value_or(std::vector<Entry>{});
}

/// Three curves of known rhythm, a cubic of Class A, a patch and a polyline.
document::Document collection() {
  document::Document all;
  all.unit = "mm";
  const auto add = [&](const std::string& name, document::PlanarCurve curve) {
    all.paths.push_back({{name, "", ""}, document::Path{{std::move(curve)}, false}, 0});
  };
  add("clothoid", {spiral(-1, 0.2, 2)});
  add("nielsen", {spiral(0, 0.2, 2)});
  add("involute", {spiral(2, 0.2, 2)});
  // [Oya]'s matrix with alpha = 0.3, s = 1.2: edges turned and stretched from one to the next.
  curve::Bezier2 cubic{{{0, 0}}, {}};
  for (int i = 0; i < 3; ++i)
    cubic.control.push_back(cubic.control.back() + std::pow(1.2, i) * core::unit_vector(0.3 * i));
  add("cubic", {cubic});
  add("scan", {curve::Polyline2{{{0, 0}, {1, 0.1}, {2, 0.3}, {3, 0.8}}}});
  surface::BezierSurface patch;
  patch.net = {4, 4, std::vector<core::Point3>(16)};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) patch.net.at(i, k) = {1.0 * i, 1.0 * k, 0};
  all.surfaces.push_back({{"roof", "", ""}, patch, 0, {}});
  return all;
}

TEST(Describe, PartsAreWhatTheWholeHolds) {
  const document::Document all = collection();
  const std::vector<Entry> whole = entries_of(all, "");
  for (std::size_t first = 0; first < whole.size() + 4; first += 4) {
    const auto part = describe(all, "", {.first = first, .most = 4});
    ASSERT_TRUE(part);
    EXPECT_EQ(part->size(), first == 0 ? 4 : first == 4 ? 2 : 0);
    for (std::size_t i = 0; i < part->size(); ++i) {
      EXPECT_EQ(label((*part)[i]).name, label(whole[first + i]).name);
      EXPECT_EQ((*part)[i].length, whole[first + i].length);
      EXPECT_EQ((*part)[i].sav, whole[first + i].sav);
    }
  }
}

Library filled(const std::filesystem::path& file) {
  auto library = Library::open(file, Mode::write);
  EXPECT_TRUE(library) << (library ? "" : library.error().message);
  const auto added = add(*library, entries_of(collection(), "collection.json"));
  EXPECT_TRUE(added);
  EXPECT_EQ(added->size(), 6u);
  return std::move(*library);
}

std::vector<std::string> names(const core::Result<Findings>& findings) {
  std::vector<std::string> all;
  EXPECT_TRUE(findings) << (findings ? "" : findings.error().message);
  if (findings)
    for (const Found& found : findings->found) all.push_back(found.name);
  return all;
}

TEST(Library, GivesBackExactlyWhatItWasGiven) {
  const Folder folder;
  Library library = filled(folder / "l.kl");
  const auto entries = entries_of(collection(), "collection.json");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    SCOPED_TRACE(label(entries[i]).name);
    const auto back = get(library, static_cast<std::int64_t>(i) + 1);
    ASSERT_TRUE(back);
    EXPECT_EQ(exchange::to_json(back->thing), exchange::to_json(entries[i].thing));
    EXPECT_EQ(back->thumbnail, entries[i].thumbnail);
    EXPECT_EQ(back->cav, entries[i].cav);
    EXPECT_EQ(back->sav, entries[i].sav);
    EXPECT_EQ(back->turning, entries[i].turning);
    EXPECT_EQ(back->notes, entries[i].notes);
    ASSERT_EQ(back->pieces.size(), entries[i].pieces.size());
    for (std::size_t k = 0; k < back->pieces.size(); ++k) {
      EXPECT_EQ(back->pieces[k].slopes, entries[i].pieces[k].slopes);
      EXPECT_EQ(back->pieces[k].self_affinity, entries[i].pieces[k].self_affinity);
    }
  }
}

TEST(Library, MeasuresWhatThePapersSay) {
  const auto entries = entries_of(collection(), "");
  ASSERT_EQ(entries.size(), 6u);
  const double alphas[] = {-1, 0, 2};
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(label(entries[i]).name);
    ASSERT_EQ(entries[i].pieces.size(), 1u);
    EXPECT_NEAR(entries[i].pieces[0].lcg_slope.value(), alphas[i], 1e-6);
    EXPECT_NEAR(entries[i].pieces[0].slopes.at(0), alphas[i], 0.05);
    EXPECT_LT(entries[i].pieces[0].self_affinity.value(), 1e-4);  // cubics between 257 samples
    EXPECT_NEAR(entries[i].length.value(), 3, 1e-12);
  }
  EXPECT_LE(entries[3].cav_type.value(), 3);  // one matrix
  EXPECT_TRUE(entries[4].pieces.empty());     // a polyline has no rhythm, and that is said
  EXPECT_THAT(entries[4].notes, ::testing::ElementsAre(::testing::HasSubstr("polyline")));
  EXPECT_EQ(entries[5].sav.value(), 0);  // a flat patch of straight, even rows
}

TEST(Library, AddingTheSameTwiceChangesNothing) {
  const Folder folder;
  Library library = filled(folder / "l.kl");
  const auto again = add(library, entries_of(collection(), "collection.json"));
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < again->size(); ++i) {
    EXPECT_FALSE((*again)[i].is_new);
    EXPECT_EQ((*again)[i].id, static_cast<std::int64_t>(i) + 1);
  }
  EXPECT_EQ(size(library), 6);
  const auto elsewhere = add(library, entries_of(collection(), "copy.json"));
  ASSERT_TRUE(elsewhere);
  EXPECT_TRUE(elsewhere->front().is_new);
  EXPECT_EQ(size(library), 12);
}

TEST(Library, FindsByRhythmSlopeCavAndName) {
  const Folder folder;
  Library library = filled(folder / "l.kl");
  using ::testing::ElementsAre;
  const auto found = [&](Criteria wanted) { return names(find(library, wanted)); };
  Criteria wanted;
  wanted.rhythm = "accelerating";
  wanted.name = "*o*d";
  EXPECT_THAT(found(wanted), ElementsAre("clothoid"));
  wanted = {};
  wanted.slope = Range::from_text("-1±0.2").value();
  wanted.name = "[cni]*";
  EXPECT_THAT(found(wanted), ::testing::Contains("clothoid"));
  EXPECT_THAT(found(wanted), ::testing::Not(::testing::Contains("involute")));
  wanted = {};
  wanted.rhythm = "plus";
  wanted.slope = Range::from_text("1.5..2.5").value();
  EXPECT_THAT(found(wanted), ElementsAre("involute"));
  wanted.slope = Range::from_text("<0").value();
  EXPECT_THAT(found(wanted), ElementsAre());
  wanted = {};
  wanted.cav = Range::from_text("<5").value();
  EXPECT_THAT(found(wanted), ElementsAre("cubic"));
  wanted = {};
  wanted.sav = Range::from_text("<=0").value();
  EXPECT_THAT(found(wanted), ElementsAre("roof"));
  wanted = {};
  wanted.limit = 2;
  EXPECT_THAT(found(wanted), ElementsAre("clothoid", "nielsen"));
  EXPECT_EQ(find(library, wanted)->count, 6);
  wanted.rhythm = "nervous";
  EXPECT_EQ(find(library, wanted).error().path, "rhythm");
}

TEST(Library, RangesAreWhatTheySay) {
  struct Case {
    const char* text;
    double low, high;
  };
  const double inf = std::numeric_limits<double>::infinity();
  const double below = std::nextafter(1.0, 0.0);
  for (const Case& c : {Case{"-1±0.2", -1.2, -0.8},
                        {"-1+-0.2", -1.2, -0.8},
                        {"0..1", 0, 1},
                        {"<1", -inf, below},
                        {"<=1", -inf, 1},
                        {">=-2e-3", -2e-3, inf},
                        {"0.5", 0.5, 0.5},
                        {"-3..-2", -3, -2},
                        {"+1", 1, 1}}) {
    SCOPED_TRACE(c.text);
    const auto range = Range::from_text(c.text);
    ASSERT_TRUE(range);
    EXPECT_DOUBLE_EQ(range->low.value_or(-inf), c.low);
    EXPECT_DOUBLE_EQ(range->high.value_or(inf), c.high);
  }
  for (const char* text : {"", "<", "a", "1..", "2..1", "1±-1", "1 2", "nan", "inf", "<<1"})
    EXPECT_FALSE(Range::from_text(text)) << text;
}

TEST(Library, ExportsWhatWasStored) {
  const Folder folder;
  Library library = filled(folder / "l.kl");
  const auto document = export_document(library, {1, 6});
  ASSERT_TRUE(document);
  ASSERT_EQ(document->paths.size(), 1u);
  EXPECT_EQ(document->unit, "mm");
  EXPECT_EQ(std::get<lac::Chain>(document->paths[0].path.curves[0].value), spiral(-1, 0.2, 2));
  EXPECT_EQ(document->surfaces.size(), 1u);
  EXPECT_EQ(export_document(library, {1, 77}).error().code, core::ErrorCode::bad_input);
  auto inches = one_curve({spiral(-1, 0.2, 2)}, "inch");
  inches.unit = "in";
  ASSERT_TRUE(add(library, entries_of(inches, "")));
  EXPECT_FALSE(export_document(library, {1, 7}));
}

TEST(Library, CountsTheFiveTypes) {
  const Folder folder;
  Library library = filled(folder / "l.kl");
  const auto all = statistics(library);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->things, 6);
  EXPECT_EQ(all->curves, 5);
  EXPECT_EQ(all->surfaces, 1);
  EXPECT_EQ(all->without_rhythm, 1);
  ASSERT_EQ(all->rhythms.size(), 8u);
  EXPECT_EQ(all->rhythms[0].rhythm, "minus");
  EXPECT_EQ(all->rhythms[0].curves, 1);  // the clothoid
  EXPECT_EQ(all->rhythms[2].rhythm, "plus");
  EXPECT_EQ(all->rhythms[2].curves, 1);  // the involute
  EXPECT_EQ(all->in_the_five, 1);
  double share = 0;
  std::int64_t pieces = 0;
  for (const RhythmCount& count : all->rhythms) {
    share += count.length;
    pieces += count.pieces;
  }
  EXPECT_NEAR(share, 1, 1e-12);
  EXPECT_EQ(pieces, 4);
  EXPECT_EQ(all->self_affinity.count, 4);
}

TEST(Library, AnEmptyOneAnswersToo) {
  const Folder folder;
  auto library = Library::open(folder / "l.kl", Mode::write);
  ASSERT_TRUE(library);
  EXPECT_EQ(statistics(*library)->things, 0);
  EXPECT_TRUE(find(*library, {})->found.empty());
  EXPECT_EQ(get(*library, 1).error().code, core::ErrorCode::bad_input);
}

}  // namespace
}  // namespace keyline::library
