// SPDX-License-Identifier: Apache-2.0
// Failing episodes in a table: sort, filter, see, copy the command that films one.

// `columns`: [{key, name, number}], `rows`: objects by key, `command` among them. `onShow(row)` of a
// row that has something to show.
function addEpisodeTable(element, columns, rows, onShow) {
  const cells = columns.map(({key, name, number}) => ({
    field: key, headerName: name, headerTooltip: name, minWidth: number ? 100 : 130, flex: number ? 1 : 2,
    filter: number ? 'agNumberColumnFilter' : 'agTextColumnFilter',
    type: number ? 'rightAligned' : undefined,
    valueFormatter: ({value}) => (value === null || value === undefined ? ''
        : number && !Number.isInteger(value) ? Number(value).toPrecision(4).replace(/\.?0+$/, '') : String(value)),
  }));
  cells.push({
    headerName: 'See it', sortable: false, filter: false, minWidth: 190, flex: 1,
    cellRenderer: ({data}) => make('span', {class: 'actions'},
        data.drive !== undefined && data.drive !== null
            ? make('button', {type: 'button', class: 'small', onclick: () => onShow(data)}, 'show') : null,
        copyButton(data.command, 'copy command')),
  });
  return agGrid.createGrid(element, {
    columnDefs: cells, rowData: rows, domLayout: rows.length <= 12 ? 'autoHeight' : 'normal',
    defaultColDef: {sortable: true, resizable: true, filter: true, floatingFilter: rows.length > 6,
                    suppressHeaderMenuButton: true, wrapHeaderText: true, autoHeaderHeight: true},
    ensureDomOrder: true, enableCellTextSelection: true, suppressColumnVirtualisation: true,
    animateRows: false,
  });
}
