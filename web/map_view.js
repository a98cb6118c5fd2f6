// SPDX-License-Identifier: Apache-2.0
// The floor as a plot in metres: walls, hazards, plan, way driven, and numbered failures to click.

const kHazardColours = {C1: '#7a3f8f', C2: '#2a8f9e', C3: '#b47a12', C4: '#5f7d2e'};

// What a map's cells are painted in: free, wall, unknown.
const floorPaints = () => (isDark() ? ['#20252a', '#788492', '#343a40'] : ['#ffffff', '#5c6672', '#e2e5e8']);

// `map`: {frame: {x, y, yaw, width_m, height_m}, cells, hazards}, `ways`: [{name, points, colour}],
// `failures`: [{x, y, label, text, ...}]. `onFailure(failure)` at a click. Returns {plot, showAt,
// showLayer}.
function addMapView(element, map, ways, failures, onFailure) {
  const {frame} = map;
  const cos = Math.cos(frame.yaw), sin = Math.sin(frame.yaw);
  const toWorld = (x, y) => [frame.x + cos * x - sin * y, frame.y + sin * x + cos * y];
  const corners = [[0, 0], [frame.width_m, 0], [frame.width_m, frame.height_m], [0, frame.height_m]]
      .map(([x, y]) => toWorld(x, y));
  const low = [0, 1].map(k => Math.min(...corners.map(c => c[k])));
  const high = [0, 1].map(k => Math.max(...corners.map(c => c[k])));
  const margin = {left: 46, right: 14, top: 34, bottom: 40};
  let at = null, layer = null;

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
    return {x: range(0, width), y: range(1, height)};
  };

  const optionOf = plot => {
    const {x, y} = fit();
    plot.resize();
    const paints = floorPaints();
    const walls = cellsImage(map.cells, kind => paints[kind]);
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
        style: {fill: kHazardColours[hazard.class], opacity: 0.45, stroke: kHazardColours[hazard.class],
                lineWidth: 1.5, lineDash: hazard.known ? null : [4, 3]},
      })),
    });
    const series = [imageSeries('walls', map, walls)];
    if (layer) series.push(layer.series());
    for (const hazard of map.hazards)
      series.push({type: 'custom', name: 'hazards', data: [hazard.polygons[0][0]], z: 2,
                   renderItem: polygonItem(hazard), tooltip: {formatter: () => escaped(hazard.text)},
                   itemStyle: {color: '#b47a12'}});
    for (const way of ways)
      series.push({type: 'line', name: way.name, data: way.points, symbol: 'none', silent: true,
                   z: 2, lineStyle: {color: colour(way.colour), width: way.width, type: way.dash || 'solid'},
                   itemStyle: {color: colour(way.colour)}, animation: false});
    series.push({
      type: 'scatter', name: 'failures', z: 6, symbol: 'pin', symbolSize: failures.length > 40 ? 22 : 34,
      data: failures.map(failure => ({value: [failure.x, failure.y], failure})),
      itemStyle: {color: colour('bad')}, cursor: 'pointer',
      label: {show: failures.length <= 150, formatter: ({data}) => data.failure.label, color: '#fff',
              fontSize: 11, fontWeight: 600},
      tooltip: {formatter: ({data}) => escaped(data.failure.text)},
    });
    series.push({type: 'scatter', name: 'robot', id: 'robot', z: 7, silent: true, symbolSize: 13,
                 data: at ? [at] : [], itemStyle: {color: '#c2410c', borderColor: '#fff', borderWidth: 2},
                 tooltip: {show: false}});
    return {
      animation: false, textStyle: textStyle(),
      grid: {...margin, show: true, borderColor: colour('line'), backgroundColor: colour('card')},
      legend: {top: 0, left: 0, itemWidth: 16, itemHeight: 9, textStyle: {color: colour('soft')},
               data: ['hazards', ...ways.map(way => way.name), 'failures'].filter(
                   name => name !== 'hazards' || map.hazards.length > 0)
                   .filter(name => name !== 'failures' || failures.length > 0)},
      tooltip: {...tooltipStyle(), trigger: 'item'},
      xAxis: axis(x, 'x (m)'), yAxis: axis(y, 'y (m)'),
      dataZoom: [{type: 'inside', xAxisIndex: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl'},
                 {type: 'inside', yAxisIndex: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl'}],
      series,
    };
  };
  const plot = addPlot(element, optionOf, {
    onClick: ({data}) => { if (data && data.failure) onFailure(data.failure); },
  });
  return {
    plot,
    // One of layersOf; null: none.
    showLayer: one => {
      layer = one;
      plot.setOption(optionOf(plot), true);
    },
    showAt: p => {
      at = p;
      plot.setOption({series: [{id: 'robot', data: [p]}]}, {lazyUpdate: true});
    },
  };
}
