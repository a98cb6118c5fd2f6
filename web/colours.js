// SPDX-License-Identifier: Apache-2.0
// The page's colours (page.css), for what is drawn by scripts. Modes are told apart by shape and
// number too, never by colour alone.

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}
// While the page is printed colours are the light ones.
const isDark = () => matchMedia('(prefers-color-scheme: dark)').matches
    && !document.documentElement.classList.contains('printing');

// What is drawn anew when the colours change: {element, draw, end}. What has left the page is ended.
let drawn = [];
// Without what is gone, with `more`.
function keepDrawn(...more) {
  for (const {element, end} of drawn) if (!element.isConnected && end) end();
  drawn = [...drawn.filter(({element}) => element.isConnected), ...more];
}
function redraw() {
  keepDrawn();
  for (const {draw} of drawn) draw();
}
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
for (const [event, prints] of [['beforeprint', true], ['afterprint', false]])
  addEventListener(event, () => {
    document.documentElement.classList.toggle('printing', prints);
    redraw();
  });

// A plot that is drawn anew when the colours or its room change.
function addPlot(element, optionOf, {onClick = null} = {}) {
  const plot = echarts.init(element, null, {renderer: 'svg'});
  const draw = () => plot.setOption(optionOf(plot), true);
  draw();
  if (onClick) plot.on('click', onClick);
  let width = element.clientWidth;
  const observer = new ResizeObserver(() => {
    if (element.clientWidth === 0 || element.clientWidth === width) return;
    width = element.clientWidth;
    plot.resize();
    draw();
  });
  observer.observe(element);
  keepDrawn({element, draw, end: () => {
    observer.disconnect();
    plot.dispose();
  }});
  return plot;
}

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
