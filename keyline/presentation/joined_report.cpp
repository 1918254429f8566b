#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "keyline/presentation/fair_report.h"

namespace keyline::presentation {

report::Report joined_report(const std::vector<report::Report>& reports, const std::string& title) {
  if (reports.empty()) return {};
  if (reports.size() == 1) return reports.front();
  report::Report all;
  all.title = title;
  all.subtitle = reports.front().subtitle;
  all.command = reports.front().command;
  all.options = reports.front().options;
  all.generator = reports.front().generator;
  std::size_t passed = 0;
  for (const report::Report& one : reports) {
    all.verdict = std::max(all.verdict, one.verdict);
    passed += one.verdict == report::Verdict::good ? 1 : 0;
    report::Section head{one.title, {one.verdict_line}, {}, {}};
    report::ReportTable numbers{
        "In numbers",
        {{"", report::Alignment::text}, {"Value"}, {"", report::Alignment::text}},
        {}};
    for (const report::KeyNumber& number : one.numbers)
      numbers.rows.push_back({number.label, number.value, number.note});
    if (!numbers.rows.empty()) head.tables.push_back(std::move(numbers));
    all.sections.push_back(std::move(head));
    for (report::Section section : one.sections) {
      section.title = one.title + ": " + section.title;
      all.sections.push_back(std::move(section));
    }
    for (report::ReportNote note : one.notes) {
      note.text = one.title + ": " + note.text;
      all.notes.push_back(std::move(note));
    }
  }
  all.verdict_line = fmt::format("{} of {} curves pass without remark.", passed, reports.size());
  return all;
}

}  // namespace keyline::presentation
