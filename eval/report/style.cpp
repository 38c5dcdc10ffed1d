// SPDX-License-Identifier: Apache-2.0
// The colours of the methods are told apart by people with any common colour vision (after Okabe and Ito, 2008), darker
// on white and lighter on black than the originals; the first method is ink.
#include "eval/report/style.h"

#include <cstddef>
#include <fmt/format.h>

namespace limber::eval {
namespace {

constexpr std::string_view kColors = R"css(
:root { color-scheme: light dark; --page: #fff; --ink: #1c1c1a; --quiet: #64645e; --rule: #d9d9d2; --faint: #ecece7;
  --card: #f6f6f3; --mat: #f6f6f3; --m0: #1c1c1a; --m1: #0067a8; --m2: #c84a00; --m3: #00805c; --m4: #a8457f; --m5: #a87400; --m6: #2b93c9;
  --m7: #7a7a00; }
@media (prefers-color-scheme: dark) { :root { --page: #131315; --ink: #e9e9e4; --quiet: #a0a09a; --rule: #38383c;
  --faint: #232327; --card: #1c1c1f; --mat: #cfcfca; --m0: #f0f0ea; --m1: #4ea8e6; --m2: #ff7f3f; --m3: #2fc294; --m4: #e08fbf;
  --m5: #e8ad2e; --m6: #8fd0f5; --m7: #c9c94a; } }
@media print { :root { color-scheme: light; --page: #fff; --ink: #000; --quiet: #444; --rule: #bbb; --faint: #e4e4e0;
  --card: #fff; --mat: #fff; --m0: #1c1c1a; --m1: #0067a8; --m2: #c84a00; --m3: #00805c; --m4: #a8457f; --m5: #a87400; --m6: #2b93c9;
  --m7: #7a7a00; } }
)css";

constexpr std::string_view kCharts = R"css(
svg text { font: 13px system-ui, "Helvetica Neue", Arial, sans-serif; fill: var(--quiet); font-variant-numeric: tabular-nums; }
svg .title { fill: var(--ink); }
svg .middle { text-anchor: middle; }
svg .end { text-anchor: end; }
svg .name { fill: var(--c); font-weight: 600; }
svg path { fill: none; }
.grid { stroke: var(--faint); }
.tick { stroke: var(--quiet); }
.line { stroke: var(--c); stroke-width: 1.8; stroke-linejoin: round; }
.leader { stroke: var(--c); stroke-width: 0.8; opacity: 0.6; }
.dot { fill: var(--c); }
.ring { fill: var(--page); stroke: var(--c); stroke-width: 2.2; }
.bar { fill: var(--c); opacity: 0.75; }
.bar.beyond { opacity: 0.4; }
.outline { stroke: var(--ink); stroke-width: 1; }
.reference { stroke: var(--quiet); stroke-dasharray: 2 3; }
.marked { stroke: var(--ink); stroke-width: 1; stroke-dasharray: 3 2; }
.hover rect { fill: transparent; }
.hover rect:hover { fill: var(--ink); opacity: 0.08; }
.c0 { --c: var(--m0); } .c1 { --c: var(--m1); } .c2 { --c: var(--m2); } .c3 { --c: var(--m3); } .c4 { --c: var(--m4); }
.c5 { --c: var(--m5); } .c6 { --c: var(--m6); } .c7 { --c: var(--m7); }
)css";

constexpr std::string_view kPage = R"css(
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 56px 24px 96px; max-width: 1128px; background: var(--page); color: var(--ink);
  font: 15px/1.55 system-ui, "Helvetica Neue", Arial, sans-serif; print-color-adjust: exact;
  -webkit-print-color-adjust: exact; }
h1 { font-size: 28px; line-height: 1.2; font-weight: 600; margin: 0 0 8px; letter-spacing: -0.01em; overflow-wrap: anywhere; }
h2 { font-size: 20px; line-height: 1.3; font-weight: 600; margin: 64px 0 12px; }
h3 { font-size: 15px; font-weight: 600; margin: 28px 0 8px; }
h3 span { font-weight: 400; color: var(--quiet); }
p { margin: 0 0 12px; max-width: 46em; }
.facts { color: var(--quiet); margin-bottom: 24px; }
figure { margin: 20px 0 0; }
figcaption, .note { font-size: 13px; line-height: 1.5; color: var(--quiet); max-width: 58em; margin-top: 10px; }
figcaption b { color: var(--ink); font-weight: 600; }
figcaption code { white-space: nowrap; }
code, pre { font: 13px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
pre { margin: 8px 0 16px; padding: 12px 14px; background: var(--card); border: 1px solid var(--rule); white-space: pre-wrap;
  overflow-wrap: anywhere; }
.scroll { overflow-x: auto; margin: 20px 0 0; }
table { border-collapse: collapse; width: 100%; font-size: 13px; line-height: 1.35; font-variant-numeric: tabular-nums lining-nums; }
th, td { padding: 5px 0 5px 8px; text-align: right; white-space: nowrap; font-weight: 400; vertical-align: baseline; }
thead th { vertical-align: bottom; font-weight: 600; border-top: 1.5px solid var(--ink); border-bottom: 1px solid var(--ink); }
thead th span { display: block; font-weight: 400; color: var(--quiet); }
tbody tr + tr > * { border-top: 1px solid var(--faint); }
tbody tr:last-child > * { border-bottom: 1.5px solid var(--ink); }
th:first-child { text-align: left; padding-left: 0; position: sticky; left: 0; background: var(--page); }
td.best { font-weight: 700; }
.text { text-align: left; white-space: normal; min-width: 15em; }
.storage td:not(.text), .storage th:not(.text) { padding-left: 18px; }
.storage th:first-child { padding-left: 0; }
.facts-table th { color: var(--quiet); padding-right: 12px; white-space: normal; vertical-align: top; }
.facts-table td { text-align: left; white-space: normal; overflow-wrap: anywhere; }
.facts-table tr:first-child > * { border-top: 1.5px solid var(--ink); }
figure svg { width: 100%; }
svg { display: block; max-width: 100%; height: auto; overflow: visible; }
.swatch, figure .swatch { display: inline-block; width: 22px; flex: none; vertical-align: baseline; margin-right: 7px; }
.narrow { display: none; }
.key { list-style: none; padding: 0; margin: 8px 0 0; display: flex; flex-wrap: wrap; gap: 2px 16px; font-size: 13px; }
.three { display: grid; grid-template-columns: repeat(auto-fit, minmax(260px, 1fr)); gap: 16px 24px; }
.three svg { max-width: 420px; }
.small { display: grid; grid-template-columns: repeat(auto-fill, minmax(220px, 1fr)); gap: 20px 24px; margin-top: 16px; }
.small h3 { margin: 0 0 8px; } .small h3 span { display: block; font-size: 13px; padding-left: 29px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px 10px; }
.tiles figure { margin: 0; max-width: 300px; }
.tiles img { display: block; width: 100%; height: auto; background: var(--mat); }
.tiles figcaption { margin-top: 4px; line-height: 1.35; font-variant-numeric: tabular-nums; }
.tiles figcaption b { display: block; }
.tiles .blamed img { outline: 2px solid var(--c); }
.ramp { display: flex; align-items: center; gap: 10px; font-size: 13px; color: var(--quiet); margin: 16px 0 0;
  font-variant-numeric: tabular-nums; }
.ramp i { display: block; width: 220px; height: 10px; flex: 0 1 auto; }
@media (max-width: 860px) {
  body { padding: 28px 16px 56px; } h1 { font-size: 24px; } h2 { margin-top: 48px; }
  .tiles { grid-template-columns: repeat(auto-fill, minmax(130px, 1fr)); }
}
@media screen and (max-width: 860px) { .wide { display: none; } .narrow { display: block; } .narrow > svg { max-width: 520px;
  width: 100%; } }
@media print {
  @page { margin: 14mm; }
  body { padding: 0; max-width: none; font-size: 10pt; }
  h2 { margin-top: 28px; break-after: avoid; } h3, .ramp { break-after: avoid; }
  figure, .scroll, .tiles { break-inside: avoid; }
  figure.pictures { break-inside: auto; }
  .scroll { overflow: visible; } figcaption, .note, code, pre { font-size: 7.6pt; } table { font-size: 6.8pt; }
  th, td { padding-left: 4px; }
  .tiles { grid-template-columns: repeat(auto-fit, minmax(26mm, 1fr)); gap: 6px; } .tiles figcaption { font-size: 7pt; }
  .small { grid-template-columns: repeat(4, 1fr); gap: 12px; }
}
)css";

}  // namespace

std::string report_style() { return fmt::format("{}{}{}", kColors, kCharts, kPage); }

std::string standalone(std::string_view drawing) {
  constexpr int kMargin = 16;
  const auto pixels = [&](std::string_view attribute) {
    const std::size_t at = drawing.find(attribute) + attribute.size();
    return std::stoi(std::string(drawing.substr(at, drawing.find('"', at) - at)));
  };
  const int width = pixels(" width=\"") + 2 * kMargin, height = pixels(" height=\"") + 2 * kMargin;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<style>{3}{4}svg svg {{ overflow: visible; }}\n.ground {{ fill: var(--page); }}\n</style>\n"
      "<rect class=\"ground\" width=\"{0}\" height=\"{1}\"/>\n<g transform=\"translate({2} {2})\">{5}</g>\n</svg>\n",
      width, height, kMargin, kColors, kCharts, drawing);
}

}  // namespace limber::eval
