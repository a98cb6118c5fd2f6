// SPDX-License-Identifier: Apache-2.0
// Curves over the time of a drive, one above the other, with the cursor at the clock's time.

// `columns`: {t_s: [], and one list each}, `curves`: [{key, name, unit}], `events`: [{t_s, label}].
// A curve with `points` ([[t_s, value], ..]) has times of its own, and holds each value to the next;
// `says(value)`: what the tooltip adds.
function addTimePlots(element, columns, curves, events, clock) {
  const rows = curves.filter(({key, points}) => columns[key] || points);
  const kRow_px = 96, kTop_px = 26;
  element.style.height = `${rows.length * kRow_px + kTop_px + 24}px`;
  // The failures, and the cursor.
  const linesAt = now_s => [
    ...events.map(({t_s}) => ({xAxis: t_s, lineStyle: {color: colour('bad'), type: 'dashed'}})),
    {xAxis: now_s, lineStyle: {color: '#c2410c', type: 'solid', width: 1.5}},
  ];
  const optionOf = () => {
    const style = axisStyle();
    return {
      animation: false, textStyle: textStyle(),
      axisPointer: {link: [{xAxisIndex: 'all'}]},
      tooltip: {...tooltipStyle(), trigger: 'axis',
                formatter: items => `<b>${items[0].axisValue.toFixed(1)} s</b><br>` + items.map(
                    ({seriesName, seriesId, value}) => {
                      const {says} = rows.find(({key}) => key === seriesId);
                      const said = value[1] === null ? 'not known' : plainNumber(value[1]);
                      return `${escaped(seriesName)}: ${said}${says ? escaped(says(value)) : ''}`;
                    }).join('<br>')},
      title: rows.map(({name, unit}, i) => ({
        text: unit ? `${name} (${unit})` : name, left: 46, top: kTop_px + i * kRow_px - 20,
        textStyle: {color: colour('soft'), fontSize: 12, fontWeight: 400},
      })),
      grid: rows.map((row, i) => ({left: 50, right: 14, top: kTop_px + i * kRow_px, height: kRow_px - 34})),
      xAxis: rows.map((row, i) => ({
        type: 'value', gridIndex: i, min: 0, max: clock.end_s, ...style,
        axisLabel: {...style.axisLabel, show: i + 1 === rows.length, showMaxLabel: false, formatter: v => `${v} s`},
        splitLine: {show: false},
      })),
      yAxis: rows.map((row, i) => ({type: 'value', gridIndex: i, splitNumber: 2, scale: false, ...style})),
      series: rows.map(({key, name, unit, points}, i) => ({
        type: 'line', id: key, name: unit ? `${name} (${unit})` : name, step: points ? 'end' : false, xAxisIndex: i, yAxisIndex: i, showSymbol: false,
        data: points || columns.t_s.map((t, k) => [t, columns[key][k]]), lineStyle: {width: 1.3, color: colour('mark')},
        itemStyle: {color: colour('mark')},
        markLine: {
          symbol: 'none', silent: true, animation: false, label: {show: false},
          data: linesAt(clock.time_s),
        },
      })),
    };
  };
  const plot = addPlot(element, optionOf);
  plot.getZr().on('click', ({offsetX, offsetY}) => {
    const row = Math.max(0, Math.min(rows.length - 1, Math.floor((offsetY - kTop_px + 20) / kRow_px)));
    const [t_s] = plot.convertFromPixel({gridIndex: row}, [offsetX, offsetY]);
    clock.set(t_s);
  });
  let shown_s = -1;
  clock.onTime(t_s => {
    // A few times a second are enough while it plays.
    if (clock.playing && Math.abs(t_s - shown_s) < 0.12 * clock.speed) return;
    shown_s = t_s;
    const lines = linesAt(t_s);
    plot.setOption({series: rows.map(({key}) => ({id: key, markLine: {data: lines}}))}, {lazyUpdate: true});
  });
  return plot;
}

// What a replay alone says: where the robot's base was.
function columnsOfReplay(replay) {
  const {t_s, states, width} = replay;
  const joint = baseJointOf(replay);
  const columns = {t_s: [], speed_mps: [], tilt_deg: []};
  if (!joint) return columns;
  const every = Math.max(1, Math.ceil(t_s.length / 1500));
  for (let i = 0; i < t_s.length; i += every) {
    const at = i * width + joint.first, before = Math.max(0, i - 12), from = before * width + joint.first;
    const dt = t_s[i] - t_s[before];
    columns.t_s.push(t_s[i]);
    columns.speed_mps.push(dt > 0 ? Math.hypot(states[at] - states[from], states[at + 1] - states[from + 1]) / dt : 0);
    const [qx, qy] = [states[at + 4], states[at + 5]];
    columns.tilt_deg.push(Math.acos(Math.max(-1, Math.min(1, 1 - 2 * (qx * qx + qy * qy)))) * 180 / Math.PI);
  }
  return columns;
}
