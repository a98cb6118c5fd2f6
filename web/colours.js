// SPDX-License-Identifier: Apache-2.0
// The page's colours (page.css), for what is drawn by scripts. Modes are told apart by shape and
// number too, never by colour alone.

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}
const isDark = () => matchMedia('(prefers-color-scheme: dark)').matches && !matchMedia('print').matches;

// Plots that are drawn anew when the colours change or their room does.
const plots = [];
function addPlot(element, optionOf, {onClick = null} = {}) {
  const plot = echarts.init(element, null, {renderer: 'svg'});
  const draw = () => plot.setOption(optionOf(plot), true);
  draw();
  if (onClick) plot.on('click', onClick);
  let width = element.clientWidth;
  new ResizeObserver(() => {
    if (element.clientWidth === 0 || element.clientWidth === width) return;
    width = element.clientWidth;
    plot.resize();
    draw();
  }).observe(element);
  plots.push(draw);
  return plot;
}
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => plots.forEach(draw => draw()));

const axisStyle = () => ({
  axisLine: {lineStyle: {color: colour('line')}},
  axisLabel: {color: colour('soft'), hideOverlap: true},
  splitLine: {lineStyle: {color: colour('line')}},
  nameTextStyle: {color: colour('soft')},
});
const textStyle = () => ({color: colour('ink'), fontFamily: 'system-ui, sans-serif'});
const tooltipStyle = () => ({
  backgroundColor: colour('card'), borderColor: colour('line'), textStyle: {color: colour('ink')},
  confine: true,
});
// For texts in tooltips, which are HTML.
const escaped = text => String(text).replace(/[&<>"']/g, c => `&#${c.charCodeAt(0)};`);
