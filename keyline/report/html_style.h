#pragma once

#include <string_view>

namespace keyline::report::detail {

/// The page's style sheet.
inline constexpr std::string_view kStyle = R"css(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 2rem 1.5rem 3rem; background: #fff; color: #212529;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial,
  "Liberation Sans", "DejaVu Sans", sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0; letter-spacing: -0.01em; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 2.5rem 0 0.75rem; padding-bottom: 0.3rem;
  border-bottom: 1px solid #dee2e6; }
p { margin: 0.5rem 0; max-width: 46rem; }
.subtitle { color: #5a6268; margin-top: 0.3rem; }
.verdict { display: flex; gap: 0.8rem; align-items: baseline; margin: 1.4rem 0; padding: 0.8rem 1rem;
  border-left: 5px solid; border-radius: 3px; font-size: 1.06rem;
  max-width: none; }
.verdict strong { white-space: nowrap; }
.good { border-color: #00794f; background: #eef8f3; }
.good strong { color: #00603f; }
.caution { border-color: #b57600; background: #fdf6e7; }
.caution strong { color: #7c5000; }
.bad { border-color: #b3300c; background: #fdf0ec; }
.bad strong { color: #98270a; }
.numbers { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: 0.75rem;
  margin: 0; }
.numbers div { border: 1px solid #dee2e6; border-radius: 4px; padding: 0.65rem 0.85rem; }
.numbers dt { color: #5a6268; font-size: 0.83rem; }
.numbers dd { margin: 0; }
.numbers .value { font-size: 1.1rem; font-weight: 600; line-height: 1.3;
  font-variant-numeric: tabular-nums; }
.numbers .aside { color: #5a6268; font-size: 0.83rem; }
figure { margin: 1rem 0 1.5rem; }
figcaption { color: #5a6268; font-size: 0.9rem; margin-top: 0.35rem; max-width: 46rem; }
.scroll { overflow-x: auto; }
.scroll:focus-visible { outline: 2px solid #0069aa; outline-offset: 2px; }
svg { display: block; max-width: 100%; height: auto; }
.wide svg { min-width: 35rem; width: 100%; max-width: 58rem; }
.explorer { display: none; margin: 1rem 0 1.5rem; }
.live .explorer { display: block; }
.live .still { display: none; }
.explorer canvas { display: block; width: 100%; touch-action: pan-y; cursor: crosshair; }
.explorer canvas:focus-visible { outline: 2px solid #0069aa; outline-offset: 2px; }
.explorer .comb { height: clamp(16rem, 52vh, 30rem); }
.explorer .plot { height: 15rem; }
.controls { display: flex; gap: 0.4rem; align-items: center; }
.controls button { font: inherit; min-width: 2.2rem; min-height: 2rem; color: inherit;
  background: #f5f7f9; border: 1px solid #adb5bd; border-radius: 4px; cursor: pointer; }
.controls label { margin-left: auto; display: flex; gap: 0.5rem; align-items: center;
  color: #5a6268; font-size: 0.9rem; }
.explorer .told { max-width: none; min-height: 1.5em; color: #212529; font-size: 0.92rem;
  font-variant-numeric: tabular-nums; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr));
  gap: 0.5rem 1rem; }
.pair figure { margin: 0.5rem 0; }
table { border-collapse: collapse; font-size: 0.92rem; min-width: 60%; margin: 0.75rem 0 1.5rem;
  overflow-wrap: normal; }
caption { text-align: left; color: #5a6268; padding-bottom: 0.35rem; }
th, td { text-align: left; vertical-align: top; padding: 0.35rem 0.8rem 0.35rem 0;
  border-bottom: 1px solid #e9ecef; }
thead th { border-bottom: 2px solid #adb5bd; vertical-align: bottom; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.notes { padding-left: 1.2rem; max-width: 52rem; }
.notes li { margin: 0.3rem 0; }
.notes .warning::marker { content: "! "; color: #98270a; font-weight: 700; }
pre { background: #f5f7f9; border: 1px solid #dee2e6; border-radius: 4px; padding: 0.7rem 0.9rem;
  white-space: pre-wrap; font: 0.88rem/1.45 ui-monospace, "Cascadia Mono", Menlo, Consolas,
  "Liberation Mono", "DejaVu Sans Mono", monospace; }
footer { margin-top: 2.5rem; color: #5a6268; font-size: 0.83rem; }
@media (max-width: 40rem) {
  body { padding: 1.25rem 1rem 2rem; font-size: 15px; }
  h1 { font-size: 1.5rem; }
  .verdict { display: block; }
}
@page { margin: 16mm 14mm; }
@media print {
  body { max-width: none; padding: 0 1px; font-size: 10pt; }
  h1 { font-size: 18pt; }
  h2 { font-size: 13pt; margin-top: 14pt; break-after: avoid; }
  figure, .numbers div, .verdict, tr, pre { break-inside: avoid; }
  .live .explorer { display: none; }
  .live .still { display: block; }
  .scroll { overflow: visible; }
  .wide svg { min-width: 0; max-height: 200mm; }
  .pair { grid-template-columns: 1fr 1fr; }
  table { font-size: 9pt; min-width: 0; }
  thead { display: table-header-group; }
  caption, thead { break-after: avoid; }
  tbody tr:first-child { break-before: avoid; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

}  // namespace keyline::report::detail
