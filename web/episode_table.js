// SPDX-License-Identifier: Apache-2.0
// Failing episodes in a table: sort, filter, see, copy the command that films one.

// Four digits, without noughts that say nothing.
const plainNumber = value => String(Number(Number(value).toPrecision(4)));

// `columns`: [{key, name, number, path: the scenario's key}], `rows`: objects by key, `command` among them. `onShow(row)` of a
// row that has something to show. Returns {reveal(index)}: selects a row and brings it into sight.
function addEpisodeTable(element, columns, rows, onShow) {
  const cells = columns.map(({key, name, number, path}) => ({
    field: key, headerName: name, headerTooltip: path, minWidth: number ? 100 : 130, flex: number ? 1 : 2,
    filter: number ? 'agNumberColumnFilter' : 'agTextColumnFilter',
    type: number ? 'rightAligned' : undefined,
    valueFormatter: ({value}) => (value === null || value === undefined ? ''
        : number && !Number.isInteger(value) ? plainNumber(value) : String(value)),
  }));
  cells.push({
    headerName: 'See it', sortable: false, filter: false, minWidth: 200, flex: 1,
    pinned: element.clientWidth > 700 ? 'right' : null,
    cellRenderer: ({data}) => make('span', {class: 'actions'},
        data.drive !== undefined && data.drive !== null
            ? make('button', {type: 'button', class: 'small', onclick: () => onShow(data)}, 'show') : null,
        copyButton(data.command, 'copy command')),
  });
  const grid = agGrid.createGrid(element, {
    columnDefs: cells, rowData: rows.map((row, index) => ({...row, index})), rowSelection: 'single',
    getRowId: ({data}) => String(data.index), domLayout: rows.length <= 12 ? 'autoHeight' : 'normal',
    defaultColDef: {sortable: true, resizable: true, filter: true, floatingFilter: rows.length > 6,
                    suppressHeaderMenuButton: true, wrapHeaderText: true, autoHeaderHeight: true},
    ensureDomOrder: true, enableCellTextSelection: true, suppressColumnVirtualisation: true,
    animateRows: false,
  });
  return {
    reveal: index => {
      const row = grid.getRowNode(String(index));
      if (!row) return;
      row.setSelected(true);
      grid.ensureNodeVisible(row, 'middle');
    },
  };
}
