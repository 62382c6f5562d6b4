// Values to colours.
import type { Ends } from './ends';
import { coloursOf, type Field, type Run } from './run';

export type Palette = 'sequential' | 'diverging' | 'kinds' | 'plain';

export class Scale {
  readonly palette: Palette;
  readonly low: number;
  readonly high: number;
  /** Red, green, blue of each step. */
  readonly colours: Uint8Array;
  /** The same of each state of contacts. */
  readonly states: Uint8Array;

  /** Smallest and largest value, which may lie beyond. */
  readonly all: Ends;

  /** `range`: other ends than the field's own, and all values of which they leave some out. */
  constructor(run: Run, readonly field: Field | undefined, range?: { ends: Ends; all: Ends }) {
    let [low, high] = range?.ends ?? field?.drawn ?? field?.range ?? [0, 0];
    if (field === undefined) {
      this.palette = 'plain';
    } else if (field.kind === 'kinds') {
      this.palette = 'kinds';
    } else {
      // Rounding is no range to paint: a bar from nothing to the one value there is (src/report/drawn_range.hpp).
      const size = Math.max(Math.abs(low), Math.abs(high));
      if (high - low <= 1e-7 * size) {
        low = Math.min(low, 0);
        high = Math.max(high, 0);
      }
      const twoSided = low < -1e-3 * size && high > 1e-3 * size;
      this.palette = twoSided ? 'diverging' : 'sequential';
    }
    this.all = range?.all ?? field?.range ?? [low, high];
    this.low = low;
    this.high = high;
    this.states = coloursOf(run.colours.states);
    this.colours = this.palette === 'plain' ? new Uint8Array([200, 200, 200]) : coloursOf(run.colours[this.palette]);
  }

  // Steps of a value: evenly from end to end; or, where it has two sides, from the middle at nothing to
  // the end of the larger one, as dark on either side at the same distance (src/report/colour_scale.cpp).
  private get perUnit(): number {
    const last = this.steps - 1;
    return this.palette === 'diverging' ? (0.5 * last) / Math.max(-this.low, this.high) : last / (this.high - this.low);
  }
  private get from(): number {
    return this.palette === 'diverging' ? 0.5 * (this.steps - 1) : -this.perUnit * this.low;
  }
  get steps(): number {
    return this.colours.length / 3;
  }
  /** Number of the colour of a value. */
  step(value: number): number {
    if (this.palette === 'kinds') return ((Math.round(value) % this.steps) + this.steps) % this.steps;
    if (!(this.high > this.low)) return 0;
    const at = this.from + this.perUnit * Math.max(this.low, Math.min(this.high, value));
    return Math.floor(at + 0.5);
  }
  /** Colours of all blocks, 65536 red + 256 green + blue; held ones and those without a value have their own. */
  paint(values: Float32Array, fixed: Uint8Array, held: number[], none: number[], colours: Float32Array): void {
    const packed = (c: ArrayLike<number>, k = 0) => 65536 * c[k] + 256 * c[k + 1] + c[k + 2];
    const steps = Array.from({ length: this.steps }, (_, step) => packed(this.colours, 3 * step));
    const [heldColour, noColour] = [packed(held), packed(none)];
    // As step() does, without a call per block.
    const { low, high, perUnit } = this;
    const from = this.from + 0.5;
    const flat = !(high > low);
    const kinds = this.palette === 'kinds';
    for (let b = 0; b < values.length; ++b) {
      const value = values[b];
      if (fixed[b]) colours[b] = heldColour;
      else if (value !== value) colours[b] = noColour;
      else if (kinds) colours[b] = steps[this.step(value)];
      else if (flat) colours[b] = steps[0];
      else colours[b] = steps[(from + perUnit * (value < low ? low : value > high ? high : value)) | 0];
    }
  }
  css(step: number): string {
    const [r, g, b] = this.colours.subarray(3 * step, 3 * step + 3);
    return `rgb(${r},${g},${b})`;
  }
}
