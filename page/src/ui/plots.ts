// The panel's plot: the selected block or monitor over time, the energies, or another column.
import { blockValue, withoutSign } from '../data/fields';
import type { Frames } from '../data/frames';
import type { Results } from '../data/results';
import type { Field } from '../data/run';
import { numbers } from '../data/table';
import { scaledUnit } from '../data/units';
import { byId, options } from './dom';
import { Plot, type Series } from './plot';

const ENERGIES = ['kinetic', 'strain', 'contact', 'gravity', 'friction', 'damping', 'fracture', 'external', 'step_change'];
/** Columns of a monitor, and the unit of each. */
const MONITOR: [string, string[], string][] = [
  ['displacement', ['ux', 'uy'], 'm'],
  ['velocity', ['vx', 'vy'], 'm/s'],
  ['acceleration', ['ax', 'ay'], 'm/s2'],
  ['stress', ['sxx', 'syy', 'sxy'], 'Pa'],
];

export class Plots {
  private readonly plot: Plot;
  private readonly select_ = byId<HTMLSelectElement>('plot-of');
  /** What draws each entry of the list, by its value. */
  private readonly drawn = new Map<string, () => void>();
  private block = -1;
  private field?: Field;
  /** Of the block's history that is being read; an older one gives up. */
  private reading = 0;

  constructor(private readonly results: Results, private readonly frames: Frames, seek: (time: number) => void) {
    this.plot = new Plot(byId('plot'), seek);
    this.select_.addEventListener('change', () => this.show());
    this.offer();
  }

  select(block: number, monitor: string): void {
    this.block = block;
    this.offer();
    if (monitor !== '') this.select_.value = `monitor:${monitor}:displacement`;
    else if (block >= 0) this.select_.value = 'block';
    this.show();
  }
  setField(field: Field | undefined): void {
    if (field?.name === this.field?.name) return;
    this.field = field;
    this.offer();
    if (this.select_.value === 'block') this.show();
  }
  refresh(): void {
    this.offer();
    this.show();
  }
  restyle(): void {
    this.show();
  }
  setTime(time: number): void {
    this.plot.setTime(time);
  }

  private offer(): void {
    const { run, history } = this.results;
    const pairs: [string, string][] = [];
    this.drawn.clear();
    const add = (value: string, text: string, show: () => void) => {
      pairs.push([value, text]);
      this.drawn.set(value, show);
    };
    if (this.block >= 0) add('block', `${this.block < this.results.mesh.blocks ? '' : 'zone of '}block ${this.results.mesh.id[this.block]}: ${this.blockField().label}`, () => void this.showBlock(this.reading));
    if (history !== undefined) {
      add('energy', 'energies', () => this.showColumns(ENERGIES.map((e) => [e, e]), 'J'));
      add('drift', 'energy balance error', () => this.showColumns([['drift', 'drift']], ''));
      add('unbalanced', 'unbalanced force', () => this.showColumns([['unbalanced', 'unbalanced']], ''));
      for (const { name } of run.monitors) {
        for (const [what, columns, unit] of MONITOR) {
          add(`monitor:${name}:${what}`, `${name}: ${what}`, () => this.showColumns(columns.map((c) => [`${name}.${c}`, c]), unit));
        }
      }
      for (const { name } of run.convergences) add(`convergence:${name}`, `${name}: convergence`, () => this.showColumns([[`${name}.convergence`, name]], 'm'));
    }
    const first = this.select_.options.length === 0;
    options(this.select_, pairs);
    if (first && pairs.length > 0) this.show();
  }

  /** What a block's history shows: the colour's field, or displacement where that is none of numbers. */
  private blockField(): Field {
    const { fields } = this.results.run;
    const fit = this.field !== undefined && this.field.of === 'blocks' && this.field.kind === 'numbers';
    return fit ? this.field! : fields.find((f) => f.name === 'displacement')!;
  }

  private show(): void {
    ++this.reading;
    const show = this.drawn.get(this.select_.value);
    if (show !== undefined) show();
    else this.plot.hide();
  }

  private showColumns(columns: [string, string][], unit: string): void {
    const { history } = this.results;
    const found = columns.map(([column, label]) => ({ label, values: numbers(history, column) }));
    const series = found.filter((s): s is { label: string; values: number[] } => s.values !== undefined);
    this.draw(unit, numbers(history, 'time') ?? [], series.filter((s) => unit !== 'J' || s.values.some((v) => v !== 0)));
  }

  /** From the frames, one after another; the line grows as they come. */
  private async showBlock(reading: number): Promise<void> {
    const { run, mesh } = this.results;
    const field = this.blockField();
    const values: (number | null)[] = run.frames.map(() => null);
    const draw = () => this.draw(field.unit, run.frames, [{ label: withoutSign(field.label), values }]);
    for (let k = 0; k < run.frames.length; ++k) {
      const frame = this.frames.ready(k) ?? (await this.frames.want(k).catch(() => undefined));
      if (reading !== this.reading) return;
      if (frame?.alive[this.block]) values[k] = blockValue(field.name, frame, this.block, mesh);
      if (k % 50 === 49) draw();
    }
    draw();
  }

  private draw(unit: string, times: number[], series: Series[]): void {
    const largest = series.reduce((most, s) => s.values.reduce((m: number, v) => Math.max(m, Math.abs(v ?? 0)), most), 0);
    const scaled = scaledUnit(unit, largest);
    const style = getComputedStyle(document.documentElement);
    this.plot.show(scaled.unit, times, series.map((s) => ({ label: s.label, values: s.values.map((v) => (v === null ? null : v * scaled.factor)) })), {
      ink: style.getPropertyValue('--ink').trim(),
      line: style.getPropertyValue('--line').trim(),
    }, isLogarithmic(unit, series));
  }
}

/** Ratios over many powers of ten are, as in pictures (src/report/history_plot.cpp). */
function isLogarithmic(unit: string, series: Series[]): boolean {
  let [least, most, leastPositive] = [Infinity, -Infinity, Infinity];
  for (const { values } of series) {
    for (const v of values) {
      if (v === null || !Number.isFinite(v)) continue;
      least = Math.min(least, v);
      most = Math.max(most, v);
      if (v > 0) leastPositive = Math.min(leastPositive, v);
    }
  }
  return unit === '' && least >= 0 && most > 1e3 * leastPositive;
}
