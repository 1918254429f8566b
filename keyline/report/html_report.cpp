#include "keyline/report/html_report.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "keyline/core/markup.h"
#include "keyline/figure/text.h"
#include "keyline/report/html_script.h"
#include "keyline/report/html_style.h"
#include "keyline/report/linked_curve.h"

namespace keyline::report {

namespace {

constexpr double kNarrowFigure = 480;  // px

std::string safe(std::string_view text) { return core::escape_markup(figure::clean_text(text)); }

void append(std::string& html, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts) html += part;
}

bool has_linked(const Report& report) {
  return std::ranges::any_of(report.sections,
                             [](const Section& s) { return s.linked.has_value(); });
}

void append_head(std::string& html, const Report& report) {
  append(html, {"<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n"
                "<head>\n<meta charset=\"utf-8\"/>\n"
                "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                "style-src 'unsafe-inline'; img-src data:"});
  if (has_linked(report)) append(html, {"; script-src 'sha256-", detail::kScriptHash, "'"});
  html += "\"/>\n";
  if (!report.generator.empty())
    append(html, {"<meta name=\"generator\" content=\"", safe(report.generator), "\"/>\n"});
  append(html, {"<title>", safe(report.title), "</title>\n<style>", detail::kStyle,
                "</style>\n</head>\n"});
}

void append_verdict(std::string& html, const Report& report) {
  struct Look {
    std::string_view style;
    std::string_view words;
  };
  static constexpr Look kLooks[] = {
      {"good", "\u2713 Passed"}, {"caution", "\u25B3 Look closer"}, {"bad", "\u2715 Not met"}};
  const Look& look = kLooks[static_cast<std::size_t>(report.verdict)];
  append(html, {"<p class=\"verdict ", look.style, "\"><strong>", look.words, "</strong> <span>",
                safe(report.verdict_line), "</span></p>\n"});
}

void append_numbers(std::string& html, const std::vector<KeyNumber>& numbers) {
  if (numbers.empty()) return;
  html += "<dl class=\"numbers\">\n";
  for (const KeyNumber& number : numbers) {
    append(html, {"<div><dt>", safe(number.label), "</dt><dd class=\"value\">", safe(number.value),
                  "</dd>"});
    if (!number.note.empty()) append(html, {"<dd class=\"aside\">", safe(number.note), "</dd>"});
    html += "</div>\n";
  }
  html += "</dl>\n";
}

/// Figures get numbers through the whole report; every id in them starts with theirs.
void append_figure(std::string& html, const ReportFigure& item, int number) {
  const std::string count = std::to_string(number);
  const bool wide = item.drawing.width >= kNarrowFigure;
  const std::string_view look = wide && item.on_paper ? " class=\"wide still\""
                                : wide                ? " class=\"wide\""
                                : item.on_paper       ? " class=\"still\""
                                                      : "";
  append(html, {"<figure id=\"figure-", count, "\"", look, ">\n"});
  if (wide)
    append(html, {"<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Figure ",
                  count, "\">\n"});
  html += figure::write_svg(item.drawing, {.id_prefix = "f" + count, .standalone = false});
  if (wide) html += "</div>\n";
  append(html,
         {"<figcaption>Figure ", count, ". ", safe(item.caption), "</figcaption>\n</figure>\n"});
}

void append_table(std::string& html, const ReportTable& table) {
  append(html,
         {"<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"", safe(table.caption),
          "\">\n<table>\n<caption>", safe(table.caption), "</caption>\n<thead><tr>"});
  const auto kind = [](const Column& column) {
    return column.alignment == Alignment::number ? " class=\"number\"" : "";
  };
  for (const Column& column : table.columns)
    append(html, {"<th scope=\"col\"", kind(column), ">", safe(column.title), "</th>"});
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      append(html,
             {"<td", kind(table.columns[i]), ">", i < row.size() ? safe(row[i]) : "", "</td>"});
    html += "</tr>\n";
  }
  html += "</tbody>\n</table>\n</div>\n";
}

/// Numbers of the figures that the linked curve stands for, counted from `first`: "2 and 3".
std::string numbers_on_paper(const Section& section, int first) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < section.figures.size(); ++i)
    if (section.figures[i].on_paper) numbers.push_back(std::to_string(first + static_cast<int>(i)));
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += (i == 0 ? "" : i + 1 < numbers.size() ? ", " : " and ") + numbers[i];
  return text;
}

void append_section(std::string& html, const Section& section, int number, int& figures) {
  const std::string id = "section-" + std::to_string(number);
  append(html, {"<section aria-labelledby=\"", id, "\">\n<h2 id=\"", id, "\">", safe(section.title),
                "</h2>\n"});
  for (const std::string& paragraph : section.paragraphs)
    append(html, {"<p>", safe(paragraph), "</p>\n"});
  if (section.linked)
    html += detail::linked_curve(*section.linked, numbers_on_paper(section, figures + 1));
  bool paired = false;
  for (const ReportFigure& item : section.figures) {
    const bool narrow = item.drawing.width < kNarrowFigure;
    if (narrow != paired) html += narrow ? "<div class=\"pair\">\n" : "</div>\n";
    paired = narrow;
    append_figure(html, item, ++figures);
  }
  if (paired) html += "</div>\n";
  for (const ReportTable& table : section.tables) append_table(html, table);
  html += "</section>\n";
}

void append_notes(std::string& html, const std::vector<ReportNote>& notes) {
  if (notes.empty()) return;
  html +=
      "<section aria-labelledby=\"notes\">\n<h2 id=\"notes\">Notes</h2>\n<ul class=\"notes\">\n";
  for (const ReportNote& note : notes) {
    const bool warning = note.kind == NoteKind::warning;
    append(html, {warning ? "<li class=\"warning\"><strong>Warning:</strong> " : "<li>",
                  safe(note.text), "</li>\n"});
  }
  html += "</ul>\n</section>\n";
}

void append_repeat(std::string& html, const Report& report) {
  if (report.command.empty() && report.options.empty()) return;
  html += "<section aria-labelledby=\"repeat\">\n<h2 id=\"repeat\">To repeat this run</h2>\n";
  if (!report.command.empty()) append(html, {"<pre>", safe(report.command), "</pre>\n"});
  if (!report.options.empty()) {
    ReportTable table{
        "Options in force", {{"Option", Alignment::text}, {"Value", Alignment::text}}, {}};
    for (const auto& [name, value] : report.options) table.rows.push_back({name, value});
    append_table(html, table);
  }
  html += "</section>\n";
}

}  // namespace

std::string html_report(const Report& report) {
  std::string html;
  append_head(html, report);
  append(html, {"<body>\n<header>\n<h1>", safe(report.title), "</h1>\n"});
  if (!report.subtitle.empty())
    append(html, {"<p class=\"subtitle\">", safe(report.subtitle), "</p>\n"});
  html += "</header>\n<main>\n";
  append_verdict(html, report);
  append_numbers(html, report.numbers);
  int number = 0;
  int figures = 0;
  for (const Section& section : report.sections) append_section(html, section, ++number, figures);
  append_notes(html, report.notes);
  append_repeat(html, report);
  html += "</main>\n";
  if (!report.generator.empty())
    append(html, {"<footer>Made by ", safe(report.generator), ".</footer>\n"});
  if (has_linked(report)) append(html, {"<script>", detail::kScript, "</script>\n"});
  return html + "</body>\n</html>\n";
}

}  // namespace keyline::report
