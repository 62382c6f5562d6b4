// Text broken into lines.

/** Words one after another in lines no wider than `width`, but for words that are wider. */
export function wrap(measure: (text: string) => number, text: string, width: number): string[] {
  const lines = [''];
  for (const word of text.split(' ')) {
    const last = lines[lines.length - 1];
    const longer = last === '' ? word : `${last} ${word}`;
    if (last === '' || measure(longer) <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** `title` and what follows it in at most `most` lines: where it is too long, without its end. */
export function headLines(measure: (text: string) => number, title: string, rest: string, width: number, most: number): string[] {
  const unbroken = rest.replaceAll(/(?<=\S) (?=\S)/g, '\u00a0');
  for (let n = title.length; ; --n) {
    const kept = n < title.length ? `${title.slice(0, n).trimEnd()}\u2026` : title;
    const lines = wrap(measure, [kept, unbroken].filter((t) => t !== '').join('    '), width);
    if (n <= 0 || (lines.length <= most && lines.every((line) => measure(line) <= width))) return lines.slice(0, most);
  }
}
