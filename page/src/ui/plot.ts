// A plot over time, with the shown frame's time as a line; a click goes to that time.
import uPlot from 'uplot';
import { brief, short, tickText } from '../data/units';

export interface Series {
  label: string;
  values: (number | null)[];
}

// Told apart by the colour-blind, on light and on dark (Okabe and Ito's palette, darkened a little).
const COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b8860b', '#56b4e9', '#7f7f7f', '#8b5cf6', '#94a3b8', '#a16207'];

export class Plot {
  private plot?: uPlot;
  private time = 0;
  private times: number[] = [];
  private key = '';

  constructor(private readonly holder: HTMLElement, private readonly seek: (time: number) => void) {
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(holder);
  }

  /** `times` rising, s. Logarithmic: of values above nothing; others are left out. */
  show(unit: string, times: number[], series: Series[], colours: { ink: string; line: string }, logarithmic = false): void {
    const key = JSON.stringify([unit, series.map((s) => s.label), colours, logarithmic]);
    const drawn = (v: number | null) => (logarithmic && !(v! > 0) ? null : v);
    const data = [times, ...series.map((s) => s.values.map(drawn))] as uPlot.AlignedData;
    if (this.plot !== undefined && this.key === key) {
      this.times = times;
      this.plot.setData(data);
      this.showValues();
      return;
    }
    this.key = key;
    this.plot?.destroy();
    this.times = times;
    const texts: uPlot.Axis.DynamicValues = (_u, at, _axis, _space, step) => at.map((v) => tickText(v, step));
    const axis = { stroke: colours.ink, grid: { stroke: colours.line, width: 1 }, ticks: { stroke: colours.line, width: 1 }, font: '11px system-ui', labelFont: '11px system-ui', labelSize: 16, values: texts };
    this.plot = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false }, y: logarithmic ? { distr: 3, log: 10 } : {} },
        legend: { live: true },
        cursor: { drag: { x: true, y: false } },
        axes: [
          { ...axis, label: 'time in s', size: 34, space: roomOfTime },
          { ...axis, label: unit, size: 62, ...(logarithmic ? powers : {}) },
        ],
        series: [
          { label: 't', value: (_u, v) => (v == null ? '\u2013' : `${brief(v, 7)} s`) },
          ...series.map((s, k) => ({
            label: s.label, stroke: COLOURS[k % COLOURS.length], width: 1.5, spanGaps: true,
            value: (_u: uPlot, v: number | null) => (v == null ? '\u2013' : short(v, 5)),
          })),
        ],
        hooks: {
          draw: [(u) => this.drawTime(u, colours.ink)],
          ready: [(u) => this.listen(u)],
          setLegend: [() => this.showValues()],
        },
      },
      data,
      this.holder,
    );
    this.showValues();
  }

  hide(): void {
    this.plot?.destroy();
    this.plot = undefined;
    this.key = '';
  }

  setTime(time: number): void {
    this.time = time;
    this.plot?.redraw(false, false);
    this.showValues();
  }

  /** In the legend: those at the shown time, while no mouse is over the plot. */
  private showValues(): void {
    if (this.plot === undefined || (this.plot.cursor.left ?? -1) >= 0) return;
    this.plot.setLegend({ idx: nearest(this.times, this.time) }, false);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(160, this.holder.clientWidth), height: 220 };
  }

  private listen(u: uPlot): void {
    let down = 0;
    u.over.addEventListener('mousedown', (e) => (down = e.clientX));
    u.over.addEventListener('click', (e) => {
      if (Math.abs(e.clientX - down) < 3) this.seek(u.posToVal(e.clientX - u.over.getBoundingClientRect().left, 'x'));
    });
  }

  private drawTime(u: uPlot, colour: string): void {
    const x = u.valToPos(this.time, 'x', true);
    if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
    const { ctx } = u;
    ctx.save();
    ctx.strokeStyle = colour;
    ctx.globalAlpha = 0.6;
    ctx.lineWidth = devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, u.bbox.top);
    ctx.lineTo(x, u.bbox.top + u.bbox.height);
    ctx.stroke();
    ctx.restore();
  }
}

/** Marks of a logarithmic axis: powers of ten, ten at most. */
const powers: Partial<uPlot.Axis> = {
  splits: (_u, _axis, low, high) => {
    const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
    const every = Math.max(1, Math.ceil((last - first) / 10));
    return Array.from({ length: Math.floor((last - first) / every) + 1 }, (_, k) => 10 ** (first + every * k));
  },
  filter: (_u, at) => at,
  values: (_u, at) => at.map((v) => brief(v, 1)),
};

/** The index of the one next to `time`; `times` rising. */
function nearest(times: number[], time: number): number {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return high > low && times[high] - time < time - times[low] ? high : low;
}

/** Room for the times' digits, px. */
function roomOfTime(_u: uPlot, _axis: number, low: number, high: number): number {
  const longest = Math.max(...[low, high].map((t) => tickText(t, (high - low) / 4).length));
  return Math.max(50, 16 + 6.5 * longest);
}
