// A table of the results (CSV with one header line).

export interface Table {
  names: string[];
  /** By column; text where it is no number, and in columns of names, which may look like some. */
  columns: (number | string)[][];
}

/** Cells of a line; a cell in quotes may hold commas, and doubled quotes. */
function cells(line: string): string[] {
  if (!line.includes('"')) return line.split(',');
  const found: string[] = [];
  const pattern = /("(?:[^"]|"")*"|[^,]*)(,|$)/g;
  for (let match = pattern.exec(line); match !== null; match = pattern.exec(line)) {
    const cell = match[1];
    found.push(cell.startsWith('"') ? cell.slice(1, -1).replaceAll('""', '"') : cell);
    if (match[2] === '') break;
  }
  return found;
}

/** Lines of a table; one within quotes goes on in the next. */
function linesOf(text: string): string[] {
  const lines: string[] = [];
  let open = false;
  for (const part of text.split('\n')) {
    if (open) lines[lines.length - 1] += `\n${part}`;
    else lines.push(part);
    if (part.split('"').length % 2 === 0) open = !open;
  }
  return lines.filter((line) => line !== '');
}

export function readTable(text: string): Table {
  const lines = linesOf(text);
  const names = cells(lines[0] ?? '');
  const columns: (number | string)[][] = names.map(() => []);
  const isText = names.map((name) => name === 'bolt' || name === 'lining' || name === 'name');
  for (const line of lines.slice(1)) {
    const row = cells(line);
    if (row.length !== names.length) continue; // a row that is being written
    row.forEach((cell, k) => columns[k].push(isText[k] || cell === '' || Number.isNaN(Number(cell)) ? cell : Number(cell)));
  }
  return { names, columns };
}

/** A column of numbers by name; undefined where there is none. */
export function numbers(table: Table | undefined, name: string): number[] | undefined {
  const k = table?.names.indexOf(name) ?? -1;
  if (table === undefined || k < 0) return undefined;
  return table.columns[k].map((v) => (typeof v === 'number' ? v : NaN));
}
