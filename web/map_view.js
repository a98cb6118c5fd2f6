// SPDX-License-Identifier: Apache-2.0
// The floor as a plot in metres: walls, hazards, plan, way driven, and numbered failures to click.

// What a map's cells are painted in: free, wall, unknown.
const kFloorPaints = {dark: ['#20252a', '#788492', '#343a40'], light: ['#ffffff', '#5c6672', '#e2e5e8']};

// Kinds of hazard as the legend has them; a dashed edge: known to no planner.
function hazardLegend(hazards) {
  const entry = ({label, colour, known}) => ({
    name: label,
    itemStyle: {color: colour, opacity: 0.6, borderColor: colour, borderWidth: 1.5,
                borderType: known ? 'solid' : 'dashed'},
  });
  return [...new Map(hazards.map(hazard => [hazard.label, entry(hazard)])).values()];
}

const kWayLooks = {plan: {colour: 'mark', width: 1.4, dash: 'dashed'}, driven: {colour: 'driven', width: 1.8, dash: 'solid'}};

// Marks that would hide one another are one, with the first's label and a +: [{x, y, of: [failure, ..]}].
// `pixels(failure)`: where it is on the screen.
function pilesOf(failures, pixels, apart_px) {
  const piles = [];
  for (const failure of failures) {
    const [x, y] = pixels(failure);
    const pile = piles.find(({at}) => Math.hypot(at[0] - x, at[1] - y) < apart_px);
    if (pile) pile.of.push(failure); else piles.push({x: failure.x, y: failure.y, at: [x, y], of: [failure]});
  }
  return piles;
}

// `map`: {frame: {x, y, yaw, width_m, height_m}, seen: [x, y, x, y] (what is shown, in the grid's
// frame), cells, hazards: [{colour, label, ..}]}, `ways`: [{name: of kWayLooks, points}], `failures`:
// [{x, y, label, text, ...}]. `onFailures([failure, ..])` at a click. Returns {showAt, showLayer,
// showWays}.
function addMapView(element, map, ways, failures, onFailures) {
  const {frame} = map;
  const cos = Math.cos(frame.yaw), sin = Math.sin(frame.yaw);
  const toWorld = (x, y) => [frame.x + cos * x - sin * y, frame.y + sin * x + cos * y];
  const [left, bottom, right, top] = map.seen || [0, 0, frame.width_m, frame.height_m];
  const corners = [[left, bottom], [right, bottom], [right, top], [left, top]]
      .map(([x, y]) => toWorld(x, y));
  const low = [0, 1].map(k => Math.min(...corners.map(c => c[k])));
  const high = [0, 1].map(k => Math.max(...corners.map(c => c[k])));
  const margin = {left: 46, right: 14, top: 34, bottom: 40};
  const kPin_px = 34;
  let at = null, layer = null, metres_per_px = 0.01;

  const wallsFor = lasting(dark => cellsImage(map.cells, kind => kFloorPaints[dark ? 'dark' : 'light'][kind]));

  // As many pixels a metre along x as along y.
  const fit = () => {
    const width = Math.max(80, element.clientWidth - margin.left - margin.right);
    const aspect = (high[1] - low[1]) / (high[0] - low[0]);
    const height = Math.min(Math.max(width * aspect, 160), 620);
    element.style.height = `${height + margin.top + margin.bottom}px`;
    const metres = Math.max((high[0] - low[0]) / width, (high[1] - low[1]) / height);
    const range = (k, pixels) => {
      const middle = (low[k] + high[k]) / 2;
      return {min: middle - metres * pixels / 2, max: middle + metres * pixels / 2};
    };
    metres_per_px = metres;
    return {x: range(0, width), y: range(1, height)};
  };

  const optionOf = plot => {
    const {x, y} = fit();
    plot.resize();
    const style = axisStyle();
    const axis = (range, name) => ({
      type: 'value', ...range, name, nameLocation: 'middle', nameGap: 26, ...style,
      axisLabel: {...style.axisLabel, showMinLabel: false, showMaxLabel: false,
                  formatter: v => Number(v.toFixed(2))},
      splitLine: {show: false},
    });
    const polygonItem = hazard => (params, api) => ({
      type: 'group',
      children: hazard.polygons.map(polygon => ({
        type: 'polygon',
        shape: {points: polygon.map(p => api.coord(p))},
        style: {fill: hazard.colour, opacity: 0.45, stroke: hazard.colour,
                lineWidth: 1.5, lineDash: hazard.known ? null : [4, 3]},
      })),
    });
    const series = [imageSeries('walls', map, wallsFor(isDark()))];
    if (layer) series.push(layer.series());
    for (const hazard of map.hazards)
      series.push({type: 'custom', name: hazard.label, data: [hazard.polygons[0][0]], z: 2,
                   renderItem: polygonItem(hazard), tooltip: {formatter: () => escaped(hazard.text)},
                   itemStyle: {color: hazard.colour}});
    for (const {name, points} of ways) {
      const look = kWayLooks[name], paint = colour(look.colour);
      series.push({type: 'line', name, data: points, symbol: 'none', silent: true, z: 2,
                   lineStyle: {color: paint, width: look.width, type: look.dash}, itemStyle: {color: paint},
                   animation: false});
    }
    const piles = pilesOf(failures, ({x: fx, y: fy}) => [fx, fy].map(p => p / metres_per_px), kPin_px * 0.6);
    series.push({
      type: 'scatter', name: 'failures', z: 6, symbol: 'pin', symbolSize: kPin_px,
      data: piles.map(pile => ({value: [pile.x, pile.y], pile})),
      itemStyle: {color: colour('bad')}, cursor: 'pointer',
      label: {show: true, color: colour('card'), fontSize: 11, fontWeight: 600,
              formatter: ({data}) => data.pile.of[0].label + (data.pile.of.length > 1 ? '+' : '')},
      tooltip: {formatter: ({data: {pile: {of}}}) => escaped(of[0].text)
          + (of.length > 1 ? `<br>and ${of.length - 1} more here: click` : '')},
    });
    series.push({type: 'scatter', name: 'robot', id: 'robot', z: 7, silent: true, symbolSize: 13,
                 data: at ? [at] : [], itemStyle: {color: '#c2410c', borderColor: '#fff', borderWidth: 2},
                 tooltip: {show: false}});
    return {
      animation: false, textStyle: textStyle(),
      grid: {...margin, show: true, borderColor: colour('line'), backgroundColor: colour('card')},
      legend: {top: 0, left: 0, itemWidth: 16, itemHeight: 9, textStyle: {color: colour('soft')},
               type: 'scroll', right: 0,
               data: [...ways.map(({name}) => name), ...(failures.length > 0 ? ['failures'] : []),
                      ...hazardLegend(map.hazards)]},
      tooltip: {...tooltipStyle(), trigger: 'item'},
      xAxis: axis(x, 'x (m)'), yAxis: axis(y, 'y (m)'),
      dataZoom: [{type: 'inside', xAxisIndex: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl'},
                 {type: 'inside', yAxisIndex: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl'}],
      series,
    };
  };
  const plot = addPlot(element, optionOf, {
    onClick: ({data}) => { if (data && data.pile) onFailures(data.pile.of); },
  });
  return {
    // One of layersOf; null: none.
    showLayer: one => {
      layer = one;
      plot.setOption(optionOf(plot), true);
    },
    showWays: those => {
      ways = those;
      plot.setOption(optionOf(plot), true);
    },
    // Where the robot is; null: on another map.
    showAt: p => {
      at = p;
      plot.setOption({series: [{id: 'robot', data: p ? [p] : []}]}, {lazyUpdate: true});
    },
  };
}
