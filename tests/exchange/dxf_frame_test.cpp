#include "keyline/exchange/dxf/dxf_frame.h"

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/dxf/dxf_writer.h"

namespace keyline::exchange {
namespace {

using detail::dxf_name;
using detail::dxf_text;
using testing::ElementsAre;
using testing::IsSupersetOf;

struct Group {
  int code = 0;
  std::string value;
};

std::vector<Group> groups_of(const std::string& dxf) {
  std::istringstream lines(dxf);
  std::vector<Group> groups;
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);)
    groups.push_back({std::stoi(code), value});
  return groups;
}

std::string written(const char* unit = "mm") {
  document::Document d;
  d.unit = unit;
  for (const char* layer : {"body", "glass", "body"})
    d.paths.push_back(
        {{"a", layer, "#fe0101"}, {{{curve::Bezier2{{{0, 0}, {1, 2}, {3, 0}}, {}}}}, false}, 0});
  return write_dxf(d, {.tolerance = 1e-3}).value().content;
}

// DXF reference, "HEADER section group codes".
TEST(DxfFrame, HeaderVariablesHaveTheirGroupsAndValues) {
  struct Case {
    const char *unit, *number, *metric;
  };
  for (const Case& c : {Case{"mm", "4", "1"},
                        {"cm", "5", "1"},
                        {"m", "6", "1"},
                        {"in", "1", "0"},
                        {"ft", "2", "0"}}) {
    const std::vector<Group> groups = groups_of(written(c.unit));
    int seen = 0;
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
      if (groups[i].code != 9) continue;
      const auto& [code, value] = groups[i + 1];
      const std::string& name = groups[i].value;
      ++seen;
      const int wanted = name == "$ACADVER"       ? 1
                         : name == "$DWGCODEPAGE" ? 3
                         : name == "$HANDSEED"    ? 5
                                                  : 70;
      EXPECT_EQ(code, wanted) << name;
      if (name == "$INSUNITS") {
        EXPECT_EQ(std::stoi(value), std::stoi(c.number)) << c.unit;
      }
      if (name == "$MEASUREMENT") {
        EXPECT_EQ(std::stoi(value), std::stoi(c.metric)) << c.unit;
      }
    }
    EXPECT_EQ(seen, 5);
  }
}

// DXF reference, "General DXF file structure": what begins with group 0 ends with group 0.
TEST(DxfFrame, SectionsTablesAndBlocksEndWhereTheyShould) {
  std::vector<std::string> sections, tables, open;
  const std::vector<Group> groups = groups_of(written());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string& value = groups[i].value;
    if (groups[i].code != 0) {
      EXPECT_FALSE(value == "ENDSEC" || value == "ENDTAB" || value == "EOF") << i;
      continue;
    }
    if (value == "SECTION" || value == "TABLE") {
      EXPECT_EQ(groups.at(i + 1).code, 2);
      (value == "TABLE" ? tables : sections).push_back(groups.at(i + 1).value);
    }
    if (value == "SECTION" || value == "TABLE" || value == "BLOCK") {
      open.push_back(value);
    } else if (value == "ENDSEC" || value == "ENDTAB" || value == "ENDBLK") {
      ASSERT_FALSE(open.empty()) << i;
      const std::string begun = value == "ENDBLK"   ? "BLOCK"
                                : value == "ENDTAB" ? "TABLE"
                                                    : "SECTION";
      EXPECT_EQ(open.back(), begun) << i;
      open.pop_back();
    } else {
      EXPECT_EQ(value == "EOF", i + 1 == groups.size()) << i;
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_THAT(sections, ElementsAre("HEADER", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS"));
  EXPECT_THAT(tables, IsSupersetOf({"VPORT", "LTYPE", "LAYER", "STYLE", "VIEW", "UCS", "APPID",
                                    "DIMSTYLE", "BLOCK_RECORD"}));
}

// Handles are hexadecimal numbers, each of one object; owners (330) are among them, or 0.
TEST(DxfFrame, HandlesAreOfOneObjectEach) {
  std::set<std::string> handles, owners;
  std::string next;
  const std::vector<Group> groups = groups_of(written());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].code == 9) next = groups[i].value == "$HANDSEED" ? groups.at(i + 1).value : next;
    if (groups[i].code == 330) owners.insert(groups[i].value);
    const bool header = i > 0 && groups[i - 1].code == 9;
    if (header || (groups[i].code != 5 && groups[i].code != 105)) continue;
    EXPECT_TRUE(handles.insert(groups[i].value).second) << groups[i].value;
  }
  owners.erase("0");
  for (const std::string& owner : owners) EXPECT_TRUE(handles.contains(owner)) << owner;
  for (const std::string& handle : handles)
    EXPECT_LT(std::stoul(handle, nullptr, 16), std::stoul(next, nullptr, 16));
}

// Printable ASCII as it is, the rest by the escape of AutoCAD's text: \\U+ and four digits of
// UTF-16, of which what lies beyond the first 65,536 characters takes two (U+1F600 is D83D DE00
// there).
TEST(DxfText, HoldsNothingButPrintableAscii) {
  EXPECT_EQ(dxf_text(" ~A"), " ~A");
  EXPECT_EQ(dxf_text("a\tb\x1f\x7f"), "a b  ");
  EXPECT_EQ(dxf_text("\xc2\x80"), "\\U+0080");
  EXPECT_EQ(dxf_text("\xc3\xa9t"), "\\U+00E9t");
  EXPECT_EQ(dxf_text("\xef\xbf\xbd"), "\\U+FFFD");
  EXPECT_EQ(dxf_text("\xf0\x90\x80\x80"), "\\U+D800\\U+DC00");
  EXPECT_EQ(dxf_text("\xf0\x9f\x98\x80"), "\\U+D83D\\U+DE00");
}

// What a table's name may not hold (DXF reference, symbol table entries) is a dash; nothing is "0".
TEST(DxfText, NamesHaveNoSignsOfTheirOwnMeaning) {
  EXPECT_EQ(dxf_name("a<b>c/d\\e\"f:g;h?i*j|k=l`m"), "a_b_c_d_e_f_g_h_i_j_k_l_m");
  EXPECT_EQ(dxf_name("\xc3\xa9*"), "\\U+00E9_");
  EXPECT_EQ(dxf_name("\\U"), "_U");
  EXPECT_EQ(dxf_name(""), "0");
}

/// The layers of a DXF as they are read from it, of curves on these; and what writing it tells.
struct OnLayers {
  std::vector<std::string> read;
  std::vector<std::string> notes;
};
OnLayers on_layers(const std::vector<std::string>& layers) {
  document::Document d;
  for (const std::string& layer : layers)
    d.paths.push_back({{"", layer, ""}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0});
  const auto dxf = write_dxf(d, {}).value();
  OnLayers result{{}, dxf.notes};
  const document::Document read = read_dxf(dxf.content).value();
  for (const document::NamedPath& named : read.paths) result.read.push_back(named.label.layer);
  return result;
}

// No two layers become one, and those that cannot keep their name are told.
TEST(DxfNames, LayersStayApart) {
  const OnLayers signs = on_layers({"A/B", "A:B", "A_B", "fine", "A/B"});
  EXPECT_THAT(signs.read, ElementsAre("A_B_2", "A_B_3", "A_B", "fine", "A_B_2"));
  EXPECT_THAT(signs.notes,
              ElementsAre("called otherwise in the file: 2 layers, \"A/B\" as \"A_B_2\", "
                          "\"A:B\" as \"A_B_3\""));
  const OnLayers letters = on_layers({"hull", "Hull", "HULL"});
  EXPECT_THAT(letters.read, ElementsAre("hull", "Hull_2", "HULL_3"));
  EXPECT_EQ(letters.notes.size(), 1U);
  const std::string base(300, 'x');
  const OnLayers cut = on_layers({base + "1", base + "2"});
  EXPECT_NE(cut.read.at(0), cut.read.at(1));
  EXPECT_EQ(cut.notes.size(), 1U);
  const OnLayers kept = on_layers({"0", "", "\xc3\xa9t\xc3\xa9", "a b-c#2"});
  EXPECT_THAT(kept.read, ElementsAre("0", "0", "\xc3\xa9t\xc3\xa9", "a b-c#2"));
  EXPECT_TRUE(kept.notes.empty());
}

// A name that looks like an escape is none: its sign is escaped itself.
TEST(DxfNames, ComeBackAsTheyWereOrAreTold) {
  document::Document d;
  const auto named = [&d](const std::string& name) {
    d.paths = {{{name, "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0}};
    const auto dxf = write_dxf(d, {}).value();
    const std::string read = read_dxf(dxf.content).value().paths.at(0).label.name;
    return std::pair{read == name, dxf.notes.empty()};
  };
  for (const char* name :
       {"plain", "\\U+0041", "a\\b", "\\\\U+0041", "\xf0\x9f\x98\x80", "C:\\Users", "\\U+005C"})
    EXPECT_EQ(named(name), (std::pair{true, true})) << name;
  for (const std::string& name : {std::string("a\nb"), std::string(300, 'n')})
    EXPECT_EQ(named(name), (std::pair{false, false})) << name;
}

// DXF reference, "LTYPE": 72 is 65 always, 73 the number of a pattern's elements, 40 its length.
TEST(DxfFrame, TypesOfLinesHaveNoPattern) {
  const std::vector<Group> groups = groups_of(written());
  int seen = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].code != 0 || groups[i].value != "LTYPE") continue;
    ++seen;
    for (std::size_t k = i + 1; groups[k].code != 0; ++k) {
      const bool pattern = groups[k].code == 73 || groups[k].code == 40;
      if (pattern || groups[k].code == 72) {
        EXPECT_EQ(std::stod(groups[k].value), pattern ? 0 : 65);
      }
    }
  }
  EXPECT_EQ(seen, 3);
}

// DXF reference, "TABLES section group codes": 5 is a record's handle (105 of a dimension style),
// 330 its table, 100 its classes, the second its table's own, 2 its name.
TEST(DxfFrame, RecordsOfTablesAreOfTheirClasses) {
  const std::vector<Group> groups = groups_of(written());
  const std::vector<std::pair<std::string, std::string>> classes{
      {"LTYPE", "AcDbLinetypeTableRecord"},    {"LAYER", "AcDbLayerTableRecord"},
      {"STYLE", "AcDbTextStyleTableRecord"},   {"APPID", "AcDbRegAppTableRecord"},
      {"DIMSTYLE", "AcDbDimStyleTableRecord"}, {"BLOCK_RECORD", "AcDbBlockTableRecord"}};
  std::string table;
  std::string table_handle;
  std::set<std::string> seen;
  for (std::size_t i = 0; i + 5 < groups.size(); ++i) {
    if (groups[i].code != 0) continue;
    if (groups[i].value == "TABLE") {
      table = groups[i + 1].value;
      table_handle = groups[i + 2].value;
      EXPECT_EQ(groups[i + 2].code, 5);
      EXPECT_EQ(groups[i + 4].value, "AcDbSymbolTable");
      continue;
    }
    for (const auto& [name, own] : classes) {
      if (groups[i].value != name || name != table) continue;
      seen.insert(name);
      EXPECT_EQ(groups[i + 1].code, name == "DIMSTYLE" ? 105 : 5) << name;
      EXPECT_EQ(groups[i + 2].code, 330) << name;
      EXPECT_EQ(groups[i + 2].value, table_handle) << name;
      EXPECT_EQ(groups[i + 3].code, 100) << name;
      EXPECT_EQ(groups[i + 3].value, "AcDbSymbolTableRecord") << name;
      EXPECT_EQ(groups[i + 4].code, 100) << name;
      EXPECT_EQ(groups[i + 4].value, own) << name;
      EXPECT_EQ(groups[i + 5].code, 2) << name;
    }
    if (groups[i].value == "ENDTAB") table.clear();
  }
  EXPECT_EQ(seen.size(), classes.size());
  int named = 0;
  for (const Group& group : groups) {
    if (!group.value.starts_with("AcDb")) continue;
    EXPECT_EQ(group.code, 100) << group.value;
    named += group.value == "AcDbDimStyleTable";  // the one table with a class of its own
  }
  EXPECT_EQ(named, 1);
}

}  // namespace
}  // namespace keyline::exchange
