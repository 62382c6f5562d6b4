// Linings as linings.csv has them: two rows for each piece and frame, its ends.
import type { Table } from './table';

export const QUANTITIES = ['thrust', 'moment', 'shear', 'utilisation'] as const;
export type Quantity = (typeof QUANTITIES)[number];
export const unitOf: Record<Quantity, string> = { thrust: 'N', moment: 'N m', shear: 'N', utilisation: '' };

/** One end of a piece; the ends of a piece follow each other, with the wall on the right of the way between them. */
export interface LiningEnd {
  /** Name of the lining. */
  chain: string;
  x: number;
  y: number;
  value: number;
}

export class LiningRows {
  private readonly times: number[] = [];
  /** First row of each time, and their number. */
  private readonly begin: number[] = [];
  private readonly lining: string[] = [];
  private readonly x: number[] = [];
  private readonly y: number[] = [];
  private readonly values: Record<Quantity, number[]> = { thrust: [], moment: [], shear: [], utilisation: [] };
  /** Largest sizes ever. */
  readonly largest: Record<Quantity, number> = { thrust: 0, moment: 0, shear: 0, utilisation: 0 };

  /** The larger side of all that they ever cover, m. */
  readonly extent: number = 0;

  constructor(table: Table | undefined) {
    if (table === undefined) return;
    const column = (name: string) => table.columns[table.names.indexOf(name)] ?? [];
    const time = column('time');
    for (let k = 0; k < time.length; ++k) {
      if (k > 0 && time[k] === time[k - 1]) continue;
      this.times.push(Number(time[k]));
      this.begin.push(k);
    }
    this.begin.push(time.length);
    this.lining = column('lining').map(String);
    [this.x, this.y] = [column('x').map(Number), column('y').map(Number)];
    const side = (places: number[]) => places.reduce((most, v) => Math.max(most, v), -Infinity) - places.reduce((least, v) => Math.min(least, v), Infinity);
    if (this.any) this.extent = Math.max(side(this.x), side(this.y));
    for (const name of QUANTITIES) {
      this.values[name] = column(name).map(Number);
      this.largest[name] = this.values[name].reduce((most, v) => Math.max(most, Math.abs(v)), 0);
    }
  }

  get any(): boolean {
    return this.times.length > 0;
  }
  /** At a frame; none before a lining is there. */
  at(time: number, quantity: Quantity): LiningEnd[] {
    const k = this.times.findIndex((t) => Math.abs(t - time) <= 1e-9 * Math.max(1, Math.abs(time)));
    if (k < 0) return [];
    const ends: LiningEnd[] = [];
    for (let r = this.begin[k]; r < this.begin[k + 1]; ++r) ends.push({ chain: this.lining[r], x: this.x[r], y: this.y[r], value: this.values[quantity][r] });
    return ends;
  }
}
