// SPDX-License-Identifier: Apache-2.0
// What may lie over the floor, one at a time: visits, coverage, failure rates. Each has one scale of
// colours and its legend.

const kMissed = '#e69f00';  // apart from the blues for every eye
const kPasses = ['#b9d9ee', '#6baed6', '#2f7fbc', '#08408a'];  // once, twice, ..., more
const kSwept = '#6baed6';
const kRates = ['#fde9c9', '#f7a35c', '#d9542b', '#8c1d18'];  // from never to the highest

// Cells as an image: runs of [value, count] from the top row on. `paintOf(value)`: '#rrggbb', or null.
function cellsImage({width, height, runs}, paintOf) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext('2d');
  const pixels = pen.createImageData(width, height);
  let at = 0;
  for (let i = 0; i < runs.length; i += 2) {
    const paint = paintOf(runs[i]);
    const rgba = paint === null ? [0, 0, 0, 0]
        : [1, 3, 5].map(k => parseInt(paint.slice(k, k + 2), 16)).concat(255);
    for (let n = 0; n < runs[i + 1]; ++n, at += 4) pixels.data.set(rgba, at);
  }
  pen.putImageData(pixels, 0, 0);
  // So large that cells keep their edges when the image is stretched.
  const times = Math.max(1, Math.ceil(1400 / width));
  const large = document.createElement('canvas');
  large.width = width * times;
  large.height = height * times;
  const wide = large.getContext('2d');
  wide.imageSmoothingEnabled = false;
  wide.drawImage(canvas, 0, 0, large.width, large.height);
  return large;
}

// What `of` returns, made once for each argument: an image of many cells takes a while.
function lasting(of) {
  const made = new Map();
  return argument => {
    if (!made.has(argument)) made.set(argument, of(argument));
    return made.get(argument);
  };
}

// The image where its frame lies, as a series of a plot in metres.
function imageSeries(name, {frame}, image, options = {}) {
  return {
    type: 'custom', name, silent: true, data: [[frame.x, frame.y]], z: 0, ...options,
    renderItem: (params, api) => {
      const [left, bottom] = api.coord([frame.x, frame.y]);
      const scale = api.size([1, 1])[0];
      return {
        type: 'image', x: left, y: bottom, rotation: frame.yaw,
        style: {image, x: 0, y: -frame.height_m * scale, width: frame.width_m * scale,
                height: frame.height_m * scale},
      };
    },
  };
}

// A colour of a scale, `share` of the way along it.
function scaleColour(scale, share) {
  const along = Math.max(0, Math.min(1, share)) * (scale.length - 1);
  const from = Math.min(scale.length - 2, Math.floor(along)), rest = along - from;
  const channel = (paint, k) => parseInt(paint.slice(k, k + 2), 16);
  return '#' + [1, 3, 5].map(k => Math.round(channel(scale[from], k) * (1 - rest) + channel(scale[from + 1], k) * rest)
      .toString(16).padStart(2, '0')).join('');
}
const percent = share => `${Number((100 * share).toPrecision(3))} %`;

const swatches = entries => make('ul', {class: 'key'}, ...entries.map(([paint, text]) => {
  const mark = make('i');
  mark.style.background = paint;
  return make('li', {}, mark, text);
}));

function ratesLayer({cell_m, places}) {
  const most = Math.max(...places.map(([, , k, n]) => k / n));
  const bar = make('span', {class: 'scale-bar'});
  bar.style.background = `linear-gradient(to right, ${kRates.join(', ')})`;
  return {
    name: 'failure rate',
    legend: () => make('p', {class: 'scale'}, '0 % ', bar, ` ${percent(most)} of episodes failed in a square of `
        + `${Number(cell_m.toPrecision(3))} m`),
    series: () => ({
      type: 'custom', name: 'failure rate', z: 1, data: places.map(place => place.slice(0, 2)),
      tooltip: {formatter: ({dataIndex}) => {
        const [, , k, n, lower, upper] = places[dataIndex];
        return `${k} of ${n} episodes failed here<br>${percent(k / n)}, ${percent(lower)} to ${percent(upper)} at 95 %`;
      }},
      renderItem: ({dataIndex}, api) => {
        const [x, y, k, n] = places[dataIndex];
        const [left, top] = api.coord([x - cell_m / 2, y + cell_m / 2]);
        const [width, height] = api.size([cell_m, cell_m]);
        return {type: 'rect', shape: {x: left, y: top, width, height},
                style: {fill: scaleColour(kRates, k / n / most), opacity: 0.85}};
      },
    }),
  };
}

// The layers that this map's data has: [{name, legend(), series()}].
function layersOf({visits, rates}) {
  const layers = [];
  if (visits) {
    const paintsOf = {
      visits: passes => (passes < 0 ? null : passes === 0 ? kMissed : kPasses[Math.min(passes, kPasses.length) - 1]),
      coverage: passes => (passes < 0 ? null : passes > 0 ? kSwept : kMissed),
    };
    const imageOf = lasting(name => cellsImage(visits.cells, paintsOf[name]));
    const series = name => () => imageSeries(name, visits, imageOf(name), {z: 1});
    layers.push({
      name: 'visits',
      legend: () => swatches([[kMissed, 'missed'], [kPasses[0], 'passed once'], [kPasses[1], 'twice'],
                              [kPasses[2], '3 times'], [kPasses[3], '4 times or more']]),
      series: series('visits'),
    }, {
      name: 'coverage',
      legend: () => swatches([[kSwept, 'swept'], [kMissed, 'could have been swept, was not']]),
      series: series('coverage'),
    });
  }
  if (rates && rates.places.length > 0) layers.push(ratesLayer(rates));
  return layers;
}
