// Bolts as bolts.csv has them: a chain of nodes per bolt and frame.
import type { Table } from './table';

export interface BoltNode {
  /** Name of the bolt. */
  chain: string;
  x: number;
  y: number;
  /** Axial force at the node, N per bolt, tension positive. */
  force: number;
  utilisation: number;
  yielded: boolean;
  ruptured: boolean;
}

export class BoltRows {
  /** Times in s, rising, and the nodes of each. */
  private readonly times: number[] = [];
  private readonly nodes: BoltNode[][] = [];
  /** Largest force ever, N. */
  readonly largest: number = 0;

  constructor(table: Table | undefined) {
    if (table === undefined) return;
    const column = (name: string) => table.columns[table.names.indexOf(name)] ?? [];
    const [time, bolt, x, y] = [column('time'), column('bolt'), column('x'), column('y')];
    const [force, used] = [column('axial_force'), column('utilisation')];
    const [yielded, ruptured] = [column('yielded'), column('ruptured')];
    let largest = 0;
    for (let k = 0; k < time.length; ++k) {
      const t = Number(time[k]);
      if (this.times.length === 0 || this.times[this.times.length - 1] !== t) {
        this.times.push(t);
        this.nodes.push([]);
      }
      this.nodes[this.nodes.length - 1].push({
        chain: String(bolt[k]), x: Number(x[k]), y: Number(y[k]), force: Number(force[k]),
        utilisation: Number(used[k]), yielded: yielded[k] === 1, ruptured: ruptured[k] === 1,
      });
      largest = Math.max(largest, Math.abs(Number(force[k])));
    }
    this.largest = largest;
  }

  get any(): boolean {
    return this.times.length > 0;
  }
  /** At a frame; none where the bolts are not there yet. */
  at(time: number): BoltNode[] {
    const k = this.times.findIndex((t) => Math.abs(t - time) <= 1e-9 * Math.max(1, Math.abs(time)));
    return k < 0 ? [] : this.nodes[k];
  }
}
