// SPDX-License-Identifier: Apache-2.0
// Brings the page to life: what stands in it as data becomes plots, map, replay and table. Without
// scripts the page is whole, too: pictures, tables, films.

// Buttons for what lies over the floor, and the legend of what does; nothing where there is no layer.
function layerChoice(layers, show) {
  if (layers.length === 0) return [];
  const legend = make('div', {class: 'layer-legend', 'aria-live': 'polite'});
  const buttons = [null, ...layers].map(layer => make('button', {
    type: 'button', class: 'small', 'aria-pressed': String(layer === null),
    onclick: event => {
      for (const button of buttons) button.setAttribute('aria-pressed', String(button === event.currentTarget));
      legend.replaceChildren(...(layer ? [layer.legend()] : []));
      show(layer);
    },
  }, layer ? layer.name : 'floor'));
  return [make('div', {class: 'layers', role: 'group', 'aria-label': 'What the map shows'}, ...buttons), legend];
}

function main() {
  const text = document.getElementById('page-data');
  if (!text) return;
  const data = JSON.parse(text.textContent);
  const theater = document.getElementById('theater');
  let map = null, view = null;

  const show = index => {
    const drive = data.drives[index];
    view.show(drive);
    const select = document.getElementById('which-drive');
    if (select) select.value = String(index);
  };
  if (theater && data.drives.length > 0) {
    theater.hidden = false;
    const room = document.getElementById('drive-view');
    view = new DriveView(room, document.getElementById('drive-curves'), place => { if (map) map.showAt(place); });
    if (data.drives.length > 1) {
      const select = make('select', {id: 'which-drive'},
                          ...data.drives.map(({name}, i) => make('option', {value: i}, name)));
      select.addEventListener('change', () => show(Number(select.value)));
      room.before(make('p', {class: 'which'}, make('label', {for: 'which-drive'}, 'Drive '), select));
    }
  }
  const mapRoom = document.getElementById('map-view');
  if (mapRoom && data.maps.length > 0 && typeof echarts !== 'undefined') {
    theater.hidden = false;
    mapRoom.hidden = false;
    for (const still of document.querySelectorAll('.replaced-by-map')) still.hidden = true;
    const showMap = shown => {
      const {map: floor, ways, failures} = shown;
      mapRoom.replaceChildren();
      const room = make('div', {role: 'img', 'aria-label': `Map of ${floor.name}, in metres, with `
          + `${failures.length} places of failures; ctrl and wheel to zoom`});
      mapRoom.append(room);
      map = addMapView(room, floor, ways, failures, failure => {
        if (failure.drive === null || failure.drive === undefined) return;
        if (!view || view.drive !== data.drives[failure.drive]) show(failure.drive);
        view.toEvent(failure);
      });
      mapRoom.append(...layerChoice(layersOf(shown), map.showLayer));
    };
    showMap(data.maps[0]);
    if (data.maps.length > 1) {
      const select = make('select', {id: 'which-map'},
                          ...data.maps.map(({name}, i) => make('option', {value: i}, name)));
      select.addEventListener('change', () => showMap(data.maps[Number(select.value)]));
      mapRoom.before(make('p', {class: 'which'}, make('label', {for: 'which-map'}, 'Variant '), select));
    }
  }
  if (theater) theater.classList.toggle('alone', !map);
  if (view) show(0);

  const tableRoom = document.getElementById('episode-table');
  if (tableRoom && data.table && typeof agGrid !== 'undefined') {
    for (const still of document.querySelectorAll('.replaced-by-table')) still.hidden = true;
    const grid = make('div', {class: `ag-theme-quartz${isDark() ? '-dark' : ''} sheet`});
    tableRoom.append(make('div', {class: 'row'}, csvButton('failing_episodes.csv', () => {
      const {columns, rows} = data.table;
      return [[...columns.map(({name}) => name), 'command'],
              ...rows.map(row => [...columns.map(({key}) => row[key]), row.command])];
    })), grid);
    if (data.table.rows.length > 12) grid.classList.add('tall');
    addEpisodeTable(grid, data.table.columns, data.table.rows, row => {
      show(row.drive);
      theater.scrollIntoView({block: 'start', behavior: 'smooth'});
    });
  }
  document.documentElement.classList.add('alive');
}

main();
