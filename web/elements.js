// SPDX-License-Identifier: Apache-2.0
// HTML elements made by scripts. Texts are texts: nothing that a file says becomes markup.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter(child => child !== null && child !== undefined));
  return element;
}

// A button that copies a text, and says that it did.
function copyButton(text, label) {
  const button = make('button', {type: 'button', class: 'small', 'aria-label': `${label}: ${text}`}, label);
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(text);
    } catch {  // from a file some browsers have no clipboard
      const field = make('textarea', {class: 'off'});
      field.value = text;
      document.body.append(field);
      field.select();
      document.execCommand('copy');
      field.remove();
    }
    button.textContent = 'copied';
    setTimeout(() => { button.textContent = label; }, 1500);
  });
  return button;
}

// A field of a CSV file. What a spreadsheet would take for a formula is made a text.
function csvField(value) {
  let text = value === null || value === undefined ? '' : String(value);
  if (typeof value === 'string' && /^[=+\-@\t\r]/.test(text)) text = `'${text}`;
  return /[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

// A button that saves rows (lists of values, the heading first) as a CSV file.
function csvButton(name, rowsOf, label = 'Download CSV') {
  return make('button', {
    type: 'button', class: 'small',
    onclick: () => {
      const text = rowsOf().map(row => row.map(csvField).join(',')).join('\n') + '\n';
      const link = make('a', {download: name, href: URL.createObjectURL(new Blob([text], {type: 'text/csv'}))});
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    },
  }, label);
}
