// What the page is told of a run before anything else (ViewRun::header()).

export interface Field {
  name: string;
  label: string;
  unit: string;
  kind: 'numbers' | 'kinds';
  of: 'blocks' | 'contacts';
  /** Smallest and largest value in all frames; held blocks do not count. */
  range?: [number, number];
  /** What colours and arrows are drawn by: the same, or without a few blocks that lie far beyond. */
  drawn?: [number, number];
  /** The same of the last frame alone. */
  last?: [number, number];
}

/** What the page looks at of summary.json. */
export interface Summary {
  status: string;
  message?: string;
  checks?: { name: string; value: number; limit: number | null; pass: boolean }[];
  largest_overlap?: { depth: number; at: [number, number]; blocks: [number, number]; time: number } | null;
}

export function summaryOf(run: Run): Summary | undefined {
  return run.summary === undefined ? undefined : (JSON.parse(run.summary) as Summary);
}

/** A sentence for each check that does not hold. */
export function failedChecks({ checks, largest_overlap: overlap }: Summary): string[] {
  const brief = (x: number) => String(Number(x.toPrecision(3))).replace('-', '\u2212');
  return (checks ?? []).filter((c) => !c.pass).map(({ name, value, limit }) => {
    const said = `${name} is ${brief(value)}, more than ${brief(limit ?? 0)}`;
    if (!name.startsWith('largest overlap') || !overlap) return said;
    const [i, j] = overlap.blocks;
    return `${said}: ${brief(overlap.depth)} m between blocks ${i} and ${j} at (${overlap.at.map(brief).join(', ')}), t = ${brief(overlap.time)} s`;
  });
}

export interface Mark {
  name: string;
  points: [number, number][];
}

export interface Run {
  format: number;
  edda: string;
  served: boolean;
  /** Of a served run: another text than before tells that the folder holds another run. */
  run?: string;
  title: string;
  materials: string[];
  monitors: Mark[];
  convergences: Mark[];
  /** Times in s. */
  frames: number[];
  datums: number;
  /** Joints have broken. */
  cracked: boolean;
  fields: Field[];
  /** Numbers of blocks that the frames have not, or that mean nothing in this run. */
  absent: string[];
  /** What strokes of the usual length stand for, in all frames: N, Pa, Pa; pressures are those at the ends of faces. */
  usual: { force: number; stress: number; pressure: number };
  /** The largest in all frames; `tension` is that of the pressures that are none. */
  largest: { force: number; stress: number; pressure: number; tension: number };
  colours: { sequential: string; diverging: string; kinds: string; states: string };
  /** Of contacts, by number. */
  states: string[];
  /** summary.json as text; absent until the run has ended. */
  summary?: string;
}

/** Six hexadecimal digits a colour -> red, green, blue of each, 0 to 255. */
export function coloursOf(hex: string): Uint8Array {
  const bytes = new Uint8Array(hex.length / 2);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = parseInt(hex.slice(2 * k, 2 * k + 2), 16);
  return bytes;
}
