// Draws the charts, and lets tables be sorted and filtered.
'use strict';

async function drawCharts() {
  const { config, specs } = JSON.parse(document.getElementById('charts').textContent);
  for (const element of document.querySelectorAll('.chart')) {
    // No menu: the figures are files beside the page.
    await vegaEmbed(element, specs[element.dataset.spec], { mode: 'vega-lite', renderer: 'svg', actions: false, config });
  }
  document.body.dataset.charts = 'drawn';
}

// Numbers by value, words by their letters; cells without a value last, in either direction.
function sortBy(table, column, direction) {
  const key = row => {
    const cell = row.cells[column];
    return 'value' in cell.dataset ? Number(cell.dataset.value) : cell.textContent.trim();
  };
  const isEmpty = value => value === '' || value === '\u2013';
  const order = new Intl.Collator('en', { numeric: true });
  const body = table.tBodies[0];
  const rows = [...body.rows].sort((a, b) => {
    const x = key(a), y = key(b);
    if (isEmpty(x) || isEmpty(y)) return isEmpty(x) - isEmpty(y);
    return direction * (typeof x === 'number' && typeof y === 'number' ? x - y : order.compare(x, y));
  });
  body.append(...rows);
}

for (const table of document.querySelectorAll('table.sortable')) {
  for (const head of table.tHead.rows[0].cells) {
    head.querySelector('button').addEventListener('click', () => {
      const direction = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', direction === 1 ? 'ascending' : 'descending');
      sortBy(table, head.cellIndex, direction);
    });
  }
}

// Every word has to be somewhere in the row.
for (const input of document.querySelectorAll('input[data-filters]')) {
  const table = document.getElementById(input.dataset.filters);
  const shown = document.getElementById(input.getAttribute('aria-describedby'));
  const texts = new Map([...table.tBodies[0].rows].map(row => [row, row.textContent.toLowerCase()]));
  const filter = () => {
    const words = input.value.toLowerCase().split(/\s+/);
    let left = 0;
    for (const [row, text] of texts) {
      row.hidden = !words.every(word => text.includes(word));
      left += !row.hidden;
    }
    shown.textContent = `${left} of ${texts.size} rows`;
  };
  input.addEventListener('input', filter);
  filter();
}

drawCharts();
