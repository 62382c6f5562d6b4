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
  fields: Field[];
  /** Numbers of blocks that the frames have not, or that mean nothing in this run. */
  absent: ('omega' | 'rotation' | 'overstress')[];
  /** What strokes of the usual length stand for, in all frames: N, Pa. */
  usual: { force: number; stress: number };
  /** The largest in all frames. */
  largest: { force: number; stress: number };
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
