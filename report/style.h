// SPDX-License-Identifier: Apache-2.0
// How a report looks: one style sheet for screen and paper, light and dark, wide and narrow.
#pragma once

namespace floorproof {

inline constexpr const char* kReportStyle = R"css(
:root { color-scheme: light dark;
  --paper: #f7f7f5; --card: #ffffff; --ink: #1d2329; --soft: #5b6570; --line: #dfe2e5;
  --mark: #1f5fa8; --good: #2c7a54; --bad: #b83a2f; --warn: #b47a12; --broken: #7a3f8f;
  --idle: #9aa3ab; --code: #eef0f2; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #14171a; --card: #1c2024; --ink: #e6e9ec; --soft: #a0a9b2; --line: #343a41;
  --mark: #7fb2ea; --good: #5cb98a; --bad: #ea7a6d; --warn: #dda94a; --broken: #c08fd4;
  --idle: #6d767f; --code: #262b30; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; }
main, header, footer { max-width: 66rem; margin: 0 auto; padding: 0 1.25rem; }
header { padding-top: 2.5rem; }
.over { margin: 0; color: var(--soft); font-size: .8rem; letter-spacing: .08em;
  text-transform: uppercase; }
h1 { margin: .1rem 0 1.2rem; font-size: 2rem; line-height: 1.2; overflow-wrap: anywhere; }
h2 { margin: 3rem 0 .8rem; font-size: 1.35rem; }
h3 { margin: 0 0 .8rem; font-size: 1.1rem; overflow-wrap: anywhere; }
h4 { margin: 1.8rem 0 .3rem; font-size: .95rem; }
p { margin: .5rem 0; overflow-wrap: anywhere; max-width: 46rem; }
a { color: var(--mark); }
nav { margin: 1.2rem 0 0; font-size: .9rem; display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; }
.verdict { background: var(--card); border: 1px solid var(--line);
  border-left: .45rem solid var(--tone, var(--mark)); border-radius: .4rem; padding: 1rem 1.3rem; }
.verdict p { margin: 0; font-size: 1.2rem; line-height: 1.45; max-width: none; }
.verdict ul { margin: .7rem 0 0; padding-left: 1.1rem; color: var(--soft); font-size: .95rem; }
.verdict li { overflow-wrap: anywhere; }
.passed { --tone: var(--good); } .failed { --tone: var(--bad); }
.undecided { --tone: var(--warn); }
.note, figcaption { color: var(--soft); font-size: .87rem; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: .4rem;
  padding: 1.2rem 1.3rem; margin: 1rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .92rem; margin: .5rem 0; }
th, td { text-align: left; padding: .38rem .9rem .38rem 0; border-top: 1px solid var(--line);
  vertical-align: baseline; font-weight: 400; }
th:last-child, td:last-child { padding-right: 0; }
thead th { border-top: 0; color: var(--soft); font-size: .82rem; vertical-align: bottom; }
tbody th { overflow-wrap: anywhere; min-width: 7rem; }
.total th, .total td { font-weight: 650; }
.num { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.plotted { width: 38%; padding-left: 1.2rem; vertical-align: middle; }
.grid td, .grid th { text-align: center; padding: .3rem .4rem; }
.grid tbody th, .grid thead th:first-child { text-align: left; }
.grid td { background: color-mix(in srgb, var(--bad) calc(.6 * var(--share, 0%)), var(--card));
  font-variant-numeric: tabular-nums; }
.grid small { display: block; color: var(--soft); white-space: nowrap; }
svg { display: block; width: 100%; overflow: visible; }
.axis { height: 16px; } .axis text { fill: var(--soft); font-size: 11px; }
.plot { height: 20px; }
.plot .grid { stroke: var(--line); }
.plot .limit { stroke: var(--bad); stroke-width: 1.5; stroke-dasharray: 4 3; }
.plot .bar { stroke: var(--mark); stroke-width: 1.6; }
.plot .point { fill: var(--mark); }
.plot .none { fill: var(--card); stroke: var(--mark); stroke-width: 1.6; }
.outcomes { display: flex; height: .7rem; gap: 2px; border-radius: .35rem; overflow: hidden;
  background: var(--line); }
.outcomes span { flex-basis: 0; min-width: 2px; }
.good { background: var(--good); } .bad { background: var(--bad); }
.warn { background: var(--warn); } .broken { background: var(--broken); }
.idle { background: var(--idle); } .halted { background: var(--mark); }
.key { list-style: none; margin: .5rem 0 1rem; padding: 0; display: flex; flex-wrap: wrap;
  gap: .1rem 1.2rem; font-size: .9rem; }
.key i { display: inline-block; width: .65rem; height: .65rem; border-radius: 50%;
  margin-right: .4rem; }
.key .nil { color: var(--soft); } .key .nil i { opacity: .35; }
figure { margin: 1rem 0 0; }
img, video { display: block; max-width: 100%; height: auto; border-radius: .3rem;
  border: 1px solid var(--line); background: #fff; }
video { width: 100%; background: #000; }
.places img { margin: 0 auto; max-height: 40rem; width: auto; }
.frames { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr));
  gap: 0 1rem; }
code, pre { font: .84rem/1.5 ui-monospace, "SF Mono", Menlo, Consolas, monospace; }
code { background: var(--code); border-radius: .25rem; padding: .1rem .35rem; user-select: all;
  overflow-wrap: anywhere; }
pre { background: var(--code); border-radius: .3rem; padding: .9rem 1rem; overflow-x: auto;
  margin: .6rem 0; }
summary { cursor: pointer; margin-top: 1rem; font-size: .95rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1.2rem; margin: .5rem 0; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
footer { padding-top: 2rem; padding-bottom: 3rem; }
@media (max-width: 40rem) {
  header { padding-top: 1.4rem; } h1 { font-size: 1.6rem; } .card, .verdict { padding: 1rem; }
  main, header, footer { padding-left: .8rem; padding-right: .8rem; }
  .rates thead th:not(.plotted) { display: none; }
  .rates thead tr, .rates tbody tr { display: grid; grid-template-columns: 1fr auto auto; }
  .rates thead tr { grid-template-columns: 1fr; }
  .rates tbody tr { border-top: 1px solid var(--line); padding: .35rem 0; column-gap: 1rem; }
  .rates tbody th, .rates td { border: 0; padding: .1rem 0; min-width: 0; }
  .rates tbody th { grid-column: 1 / -1; }
  .rates td:nth-child(2) { text-align: left; }
  .rates .plotted { grid-column: 1 / -1; width: auto; padding: .1rem .3rem; }
  .list thead { display: none; }
  .list tr { display: block; padding: .5rem 0; border-top: 1px solid var(--line); }
  .list th, .list td { display: inline; border: 0; padding: 0 .6rem 0 0; }
  .list td:last-child { display: block; padding-top: .25rem; }
}
@media print {
  :root { color-scheme: light; --paper: #fff; --card: #fff; --ink: #000; --soft: #444;
    --line: #bbb; --mark: #1f5fa8; --good: #2c7a54; --bad: #b83a2f; --warn: #b47a12;
    --broken: #7a3f8f; --idle: #9aa3ab; --code: #f2f2f2; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  body { font-size: 10pt; } nav, video { display: none; }
  .card { border: 0; padding: 0; } h2 { margin-top: 1.5rem; }
  h2, h3, h4, thead { break-after: avoid; } tr, figure, .verdict { break-inside: avoid; }
  .scroll, pre { overflow: visible; } pre { white-space: pre-wrap; }
  details::details-content { content-visibility: visible; display: block; height: auto; }
}
)css";

}  // namespace floorproof
