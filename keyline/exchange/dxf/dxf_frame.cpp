#include "keyline/exchange/dxf/dxf_frame.h"

#include <array>
#include <charconv>
#include <utility>

#include "keyline/core/utf8.h"
#include "keyline/exchange/points/points_writer.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange::detail {
namespace {

// Fixed handles of what every drawing holds.
constexpr const char* kModelRecord = "1F";
constexpr const char* kPaperRecord = "1B";
constexpr const char* kRoot = "C";
constexpr const char* kGroups = "D";

std::string handle_text(unsigned long handle) {
  std::array<char, 20> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), handle, 16);
  std::string text(digits.data(), end.ptr);
  for (char& c : text)
    if (c >= 'a') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

void add_header(DxfText& file, int unit, const std::string& seed) {
  file.text(0, "SECTION");
  file.text(2, "HEADER");
  file.text(9, "$ACADVER");
  file.text(1, "AC1015");
  file.text(9, "$DWGCODEPAGE");
  file.text(3, "ANSI_1252");
  file.text(9, "$INSUNITS");
  file.whole(70, unit);
  file.text(9, "$MEASUREMENT");  // all that Inkscape looks at: 0 inches, 1 millimetres
  file.whole(70, unit == 1 || unit == 2 ? 0 : 1);
  file.text(9, "$HANDSEED");
  file.text(5, seed);
  file.text(0, "ENDSEC");
}

void start_table(DxfText& file, const char* name, const char* handle, int count) {
  file.text(0, "TABLE");
  file.text(2, name);
  file.text(5, handle);
  file.text(330, "0");
  file.text(100, "AcDbSymbolTable");
  file.whole(70, count);
}

void start_record(DxfText& file, const char* type, const std::string& handle, const char* table,
                  const char* subclass, std::string_view name) {
  file.text(0, type);
  file.text(std::string_view(type) == "DIMSTYLE" ? 105 : 5, handle);
  file.text(330, table);
  file.text(100, "AcDbSymbolTableRecord");
  file.text(100, subclass);
  file.text(2, name);
}

void add_views(DxfText& file) {
  start_table(file, "VPORT", "8", 0);
  file.text(0, "ENDTAB");
  start_table(file, "LTYPE", "5", 3);
  for (const auto& [name, handle] :
       {std::pair{"ByBlock", "14"}, {"ByLayer", "15"}, {"Continuous", "16"}}) {
    start_record(file, "LTYPE", handle, "5", "AcDbLinetypeTableRecord", name);
    file.whole(70, 0);
    file.text(3, "");
    file.whole(72, 65);
    file.whole(73, 0);
    file.real(40, 0);
  }
  file.text(0, "ENDTAB");
}

void add_layers(DxfText& file, const std::set<std::string>& layers) {
  start_table(file, "LAYER", "2", static_cast<int>(layers.size()));
  for (const std::string& layer : layers) {
    file.text(0, "LAYER");
    file.handle(5);
    file.text(330, "2");
    file.text(100, "AcDbSymbolTableRecord");
    file.text(100, "AcDbLayerTableRecord");
    file.text(2, layer);
    file.whole(70, 0);
    file.whole(62, 7);
    file.text(6, "Continuous");
    file.text(390, "F");
  }
  file.text(0, "ENDTAB");
}

void add_styles(DxfText& file) {
  start_table(file, "STYLE", "3", 1);
  start_record(file, "STYLE", "11", "3", "AcDbTextStyleTableRecord", "Standard");
  file.whole(70, 0);
  file.real(40, 0);
  file.real(41, 1);
  file.real(50, 0);
  file.whole(71, 0);
  file.real(42, 2.5);
  file.text(3, "txt");
  file.text(4, "");
  file.text(0, "ENDTAB");
  start_table(file, "VIEW", "6", 0);
  file.text(0, "ENDTAB");
  start_table(file, "UCS", "7", 0);
  file.text(0, "ENDTAB");
  start_table(file, "APPID", "9", 2);
  for (const auto& [name, handle] : {std::pair{"ACAD", "12"}, {"KEYLINE", "13"}}) {
    start_record(file, "APPID", handle, "9", "AcDbRegAppTableRecord", name);
    file.whole(70, 0);
  }
  file.text(0, "ENDTAB");
  start_table(file, "DIMSTYLE", "A", 1);
  file.text(100, "AcDbDimStyleTable");
  start_record(file, "DIMSTYLE", "27", "A", "AcDbDimStyleTableRecord", "Standard");
  file.whole(70, 0);
  file.text(0, "ENDTAB");
}

void add_tables(DxfText& file, const std::set<std::string>& layers) {
  file.text(0, "SECTION");
  file.text(2, "TABLES");
  add_views(file);
  add_layers(file, layers);
  add_styles(file);
  start_table(file, "BLOCK_RECORD", "1", 2);
  start_record(file, "BLOCK_RECORD", kModelRecord, "1", "AcDbBlockTableRecord", "*Model_Space");
  start_record(file, "BLOCK_RECORD", kPaperRecord, "1", "AcDbBlockTableRecord", "*Paper_Space");
  file.text(0, "ENDTAB");
  file.text(0, "ENDSEC");
}

void add_block(DxfText& file, const char* name, const char* record, const char* begin,
               const char* end) {
  file.text(0, "BLOCK");
  file.text(5, begin);
  file.text(330, record);
  file.text(100, "AcDbEntity");
  file.text(8, "0");
  file.text(100, "AcDbBlockBegin");
  file.text(2, name);
  file.whole(70, 0);
  file.point(10, {});
  file.text(3, name);
  file.text(1, "");
  file.text(0, "ENDBLK");
  file.text(5, end);
  file.text(330, record);
  file.text(100, "AcDbEntity");
  file.text(8, "0");
  file.text(100, "AcDbBlockEnd");
}

void add_objects(DxfText& file) {
  file.text(0, "SECTION");
  file.text(2, "OBJECTS");
  file.text(0, "DICTIONARY");
  file.text(5, kRoot);
  file.text(330, "0");
  file.text(100, "AcDbDictionary");
  file.whole(281, 1);
  file.text(3, "ACAD_GROUP");
  file.text(350, kGroups);
  file.text(0, "DICTIONARY");
  file.text(5, kGroups);
  file.text(330, kRoot);
  file.text(100, "AcDbDictionary");
  file.whole(281, 1);
  file.text(0, "ENDSEC");
}

}  // namespace

void DxfText::text(int code, std::string_view value) {
  content_ += std::to_string(code);
  content_ += '\n';
  content_ += value;
  content_ += '\n';
}

void DxfText::whole(int code, long value) { text(code, std::to_string(value)); }
void DxfText::real(int code, double value) { text(code, shortest(value)); }

void DxfText::point(int code, core::Point3 p) {
  real(code, p.x);
  real(code + 10, p.y);
  real(code + 20, p.z);
}

void DxfText::handle(int code) { text(code, handle_text(next_++)); }

std::string dxf_text(std::string_view name) {
  constexpr std::size_t kLongest = 240;
  std::string result;
  for (std::size_t at = 0; at < name.size() && result.size() < kLongest;) {
    const unsigned code = core::code_point(name, at);
    if (code < 0x20 || code == 0x7f) {
      result += ' ';
    } else if (code == '\\' && name.substr(at).starts_with("U+")) {
      result += "\\U+005C";  // itself, not the sign of an escape
    } else if (code < 0x80) {
      result += static_cast<char>(code);
    } else {
      result += utf16_digits(code, "\\U+");
    }
  }
  return result;
}

std::string dxf_name(std::string_view name) {
  std::string allowed(name);
  for (char& c : allowed)
    if (std::string_view("<>/\\\":;?*|=`").find(c) != std::string_view::npos) c = '_';
  return allowed.empty() ? "0" : dxf_text(allowed);
}

std::string dxf_file(const DxfText& entities, const std::set<std::string>& layers, int unit) {
  DxfText file(entities.next());
  add_header(file, unit, handle_text(entities.next() + layers.size()));
  add_tables(file, layers);
  file.text(0, "SECTION");
  file.text(2, "BLOCKS");
  add_block(file, "*Model_Space", kModelRecord, "20", "21");
  add_block(file, "*Paper_Space", kPaperRecord, "1C", "1D");
  file.text(0, "ENDSEC");
  file.text(0, "SECTION");
  file.text(2, "ENTITIES");
  std::string content = file.content() + entities.content();
  DxfText tail;
  tail.text(0, "ENDSEC");
  add_objects(tail);
  tail.text(0, "EOF");
  return content + tail.content();
}

}  // namespace keyline::exchange::detail
