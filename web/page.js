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

// A choice above a view; nothing where there is none.
function choice(id, label, names, onChange) {
  if (names.length < 2) return [];
  const select = make('select', {id}, ...names.map((name, i) => make('option', {value: i}, name)));
  select.addEventListener('change', () => onChange(Number(select.value)));
  return [make('p', {class: 'which'}, make('label', {for: id}, label), ' ', select)];
}

// Map, drive and table, which lead to one another.
class Page {
  constructor(data) {
    this.data = data;
    this.theater = document.getElementById('theater');
    this.mapRoom = document.getElementById('map-view');
    this.map = this.view = this.table = null;
    this.mapShown = -1;
    if (this.theater && data.drives.length > 0) this.openDrives();
    if (this.mapRoom && data.maps.length > 0 && typeof echarts !== 'undefined') this.openMaps();
    if (this.theater) this.theater.classList.toggle('alone', !this.map);
    if (this.view) this.showDrive(0);
    this.openTable();
  }

  openDrives() {
    this.theater.hidden = false;
    const room = document.getElementById('drive-view');
    const stage = make('div');
    room.append(...choice('which-drive', 'Drive', this.data.drives.map(({name}) => name), i => this.showDrive(i)),
                stage);
    this.view = new DriveView(stage, document.getElementById('drive-curves'), (place, drive) => {
      if (this.map) this.map.showAt(drive.map === this.mapShown ? place : null);
    });
  }
  showDrive(index) {
    const drive = this.data.drives[index];
    if (this.map && drive.map !== undefined && drive.map !== this.mapShown) this.showMap(drive.map);
    this.view.show(drive);
    const select = document.getElementById('which-drive');
    if (select) select.value = String(index);
    this.showWays();
  }
  // A campaign's map shows the way of the drive that is looked at.
  showWays() {
    const {ways} = this.data.maps[this.mapShown] || {};
    if (!this.map || ways.length > 0 || !this.view) return;
    this.map.showWays(this.view.drive && this.view.drive.map === this.mapShown ? this.view.ways() : []);
  }

  openMaps() {
    this.theater.hidden = this.mapRoom.hidden = false;
    for (const still of document.querySelectorAll('.replaced-by-map')) still.hidden = true;
    this.mapStage = make('div');
    // Elsewhere each drive has a map of its own, which comes with it.
    const variants = this.data.table ? this.data.maps.map(({name}) => name) : [];
    this.mapRoom.append(...choice('which-map', 'Variant', variants, i => {
      this.showMap(i);
      this.showWays();
    }), this.mapStage);
    this.showMap(0);
  }
  showMap(index) {
    const shown = this.data.maps[index];
    const {map: floor, ways, failures, note} = shown;
    this.mapShown = index;
    const room = make('div', {role: 'img', 'aria-label': `Map of ${floor.name}, in metres, with `
        + `${failures.length} places of failures; ctrl and wheel to zoom`});
    this.pile = make('div', {class: 'pile', 'aria-live': 'polite'});
    this.mapStage.replaceChildren(room);
    this.map = addMapView(room, floor, ways, failures, those => this.chooseFailures(those));
    // The marks again, for who has no pointer.
    const list = failures.length > 1
        ? [make('p', {class: 'only-screen'}, make('button', {
            type: 'button', class: 'small', onclick: () => this.listFailures(failures, ''),
          }, `list the ${failures.length} failures`))] : [];
    this.mapStage.append(...layerChoice(layersOf(shown), this.map.showLayer), ...list, this.pile);
    if (note) this.mapStage.append(make('p', {class: 'note'}, note));
    const select = document.getElementById('which-map');
    if (select) select.value = String(index);
  }
  // Of several on one spot there is a list to choose from.
  chooseFailures(failures) {
    this.pile.replaceChildren();
    if (failures.length === 1) {
      this.showFailure(failures[0]);
      return;
    }
    this.listFailures(failures, `${failures.length} failures here:`);
    this.pile.scrollIntoView({block: 'nearest'});
  }
  listFailures(failures, heading) {
    this.pile.replaceChildren(...(heading ? [make('p', {class: 'note'}, heading)] : []),
        make('ul', {tabindex: 0, 'aria-label': 'Failures'}, ...failures.map(failure => make('li', {}, make('button', {
          type: 'button', class: 'link', onclick: () => this.showFailure(failure),
        }, failure.text)))));
  }
  // Its moment, if it was recorded; and its row.
  showFailure(failure) {
    if (this.table && failure.row !== undefined) this.table.reveal(failure.row);
    if (this.view && Number.isInteger(failure.drive)) {
      if (this.view.drive !== this.data.drives[failure.drive]) this.showDrive(failure.drive);
      this.view.toEvent(failure);
      return;
    }
    const {command} = (this.data.table && this.data.table.rows[failure.row]) || {};
    this.pile.append(make('p', {class: 'note'}, `${failure.text}: its replay is not in the page. `),
                     ...(command ? [make('p', {class: 'command'}, make('code', {}, command), ' ',
                                         copyButton(command, 'copy'))] : []));
  }

  openTable() {
    const room = document.getElementById('episode-table'), {table} = this.data;
    if (!room || !table || typeof agGrid === 'undefined') return;
    for (const still of document.querySelectorAll('.replaced-by-table')) still.hidden = true;
    const grid = make('div', {class: 'sheet'});
    const dress = () => {
      grid.classList.toggle('ag-theme-quartz', !isDark());
      grid.classList.toggle('ag-theme-quartz-dark', isDark());
    };
    dress();
    keepDrawn({element: grid, draw: dress});
    const shown = table.rows.filter(({drive}) => Number.isInteger(drive)).length;
    const listed = table.rows.length;
    const notes = [
      ...(listed < table.of ? [`Listed: ${listed} of ${table.of} episodes; episodes.csv has all.`] : []),
      ...(shown < listed ? [`${shown} of ${listed} have a replay or film in this page.`] : [])];
    room.append(make('div', {class: 'row'},
        make('p', {class: 'note'}, notes.join(' ')),
        csvButton('failing_episodes.csv', () => {
          const {columns, rows} = table;
          return [[...columns.map(({path}) => path), 'command'],
                  ...rows.map(row => [...columns.map(({key}) => row[key]), row.command])];
        })), grid);
    if (table.rows.length > 12) grid.classList.add('tall');
    this.table = addEpisodeTable(grid, table.columns, table.rows, row => {
      this.showDrive(row.drive);
      this.theater.scrollIntoView({block: 'start', behavior: 'smooth'});
    });
  }
}

// Pictures that stand side by side are small; each can be seen as wide as the page.
for (const figure of document.querySelectorAll('.frames figure')) {
  const button = make('button', {type: 'button', class: 'small only-screen', 'aria-pressed': 'false'}, 'enlarge');
  button.addEventListener('click', () => {
    const large = figure.classList.toggle('large');
    button.textContent = large ? 'smaller' : 'enlarge';
    button.setAttribute('aria-pressed', String(large));
  });
  figure.append(button);
}

// What a table says, row by row; drawn bars say nothing more.
function textOf(table) {
  return [...table.rows].map(row => [...row.cells].filter(cell => !cell.classList.contains('plotted'))
      .map(cell => cell.innerText.trim().replace(/\s*\n\s*/g, '; ')));
}
for (const section of document.querySelectorAll('section')) {
  const tables = [...section.querySelectorAll('table:not(.list)')];
  tables.forEach((table, i) => {
    const name = tables.length > 1 ? `${section.id}_${i + 1}.csv` : `${section.id}.csv`;
    const button = csvButton(name, () => textOf(table), 'CSV');
    button.setAttribute('aria-label', `CSV of this table: ${name}`);
    table.after(make('p', {class: 'only-screen saves'}, button));
  });
}

const text = document.getElementById('page-data');
if (text) {
  new Page(JSON.parse(text.textContent));
  document.documentElement.classList.add('alive');
}
