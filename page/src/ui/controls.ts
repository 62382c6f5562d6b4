// What is to be shown and how: the panel's upper part, and the line below the drawing.
import { drawnEnds, type Ends, endsOf } from '../data/ends';
import { contactValues, isAlongFaces, isKnown, length, withoutSign } from '../data/fields';
import type { Frame } from '../data/frame';
import type { Results } from '../data/results';
import type { Field } from '../data/run';
import { QUANTITIES, type Quantity } from '../data/linings';
import { brief, scaledUnit } from '../data/units';
import type { Vectors } from '../scene/view';
import { byId, make } from './dom';
import type { Player } from './player';

const checkbox = (id: string) => byId<HTMLInputElement>(id).checked;

export class Controls {
  constructor(private readonly results: Results, private readonly changed: () => void) {
    const absent: string[] = results.run.absent;
    const known = results.run.fields.filter((f) => isKnown(f.name) && f.name !== 'id' && !absent.includes(f.name));
    const select = byId<HTMLSelectElement>('field');
    const group = (label: string, of: Field['of']) => {
      const element = make('optgroup', '', { label });
      // principal_stress and its minor part are one and the same.
      const shown = known.filter((f) => f.of === of && f.name !== 'principal_stress');
      element.append(...shown.map((f) => make('option', withoutSign(f.label), { value: f.name })));
      return element;
    };
    select.replaceChildren(make('option', 'nothing', { value: 'none' }), group('blocks', 'blocks'), group('contacts', 'contacts'));
    select.value = 'displacement';
    this.chooseRange();
    byId('cracks').parentElement!.hidden = !results.run.cracked && !results.run.served;
    byId('bolts').parentElement!.hidden = !results.bolts.any && !results.run.served;
    byId('lining').parentElement!.hidden = !results.linings.any && !results.run.served;
    byId('lining').append(...QUANTITIES.map((q) => make('option', q, { value: q })));
    byId('marks').parentElement!.hidden = results.run.monitors.length + results.run.convergences.length === 0;
    this.listen();
    this.showMagnification();
  }

  get field(): Field | undefined {
    // Of the run as it is now: the ranges of one that goes on grow.
    const { value } = byId<HTMLSelectElement>('field');
    return this.results.run.fields.find((f) => f.name === value);
  }
  get edges(): boolean {
    return checkbox('edges');
  }
  get contacts(): boolean {
    return checkbox('contacts');
  }
  get forces(): boolean {
    return checkbox('forces');
  }
  get cracks(): boolean {
    return checkbox('cracks') && this.results.run.cracked;
  }
  get crosses(): boolean {
    return checkbox('crosses');
  }
  get bolts(): boolean {
    return checkbox('bolts');
  }
  get lining(): Quantity | undefined {
    return QUANTITIES.find((q) => q === byId<HTMLSelectElement>('lining').value);
  }
  get marks(): boolean {
    return checkbox('marks');
  }
  get axes(): boolean {
    return checkbox('axes');
  }
  get vectors(): Vectors {
    return byId<HTMLSelectElement>('vectors').value as Vectors;
  }

  /** 1 in the first tenth of the slider, then to 10,000. */
  get magnification(): number {
    const s = Number(byId<HTMLInputElement>('magnify').value);
    return s <= 0.1 ? 1 : 10 ** ((4 * (s - 0.1)) / 0.9);
  }
  setMagnification(m: number): void {
    byId<HTMLInputElement>('magnify').value = String(m <= 1 ? 0 : 0.1 + (0.9 * Math.log10(Math.min(m, 1e4))) / 4);
    this.showMagnification();
    this.changed();
  }
  /** True, or a round factor that makes the largest displacement, but for a few blocks far beyond, about a fortieth of
   * the model. */
  flipMagnification(results: Results, frame: Frame | undefined): void {
    if (this.magnification > 1 || frame === undefined) {
      this.setMagnification(1);
      return;
    }
    const { mesh } = results;
    const sizes = frame.motion[0].map((ux, b) => Math.hypot(ux, frame.motion[1][b]));
    const largest = drawnEnds(sizes, this.weights(frame))[1];
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let b = 0; b < mesh.parts; ++b) {
      x0 = Math.min(x0, mesh.centre[2 * b]);
      x1 = Math.max(x1, mesh.centre[2 * b]);
      y0 = Math.min(y0, mesh.centre[2 * b + 1]);
      y1 = Math.max(y1, mesh.centre[2 * b + 1]);
    }
    const wanted = largest > 0 ? (0.025 * Math.hypot(x1 - x0, y1 - y0)) / largest : 1;
    this.setMagnification(Math.max(1, Number(wanted.toPrecision(1))));
  }

  /** Whether colours and arrows reach as far as the values. */
  get wholeRange(): boolean {
    return byId<HTMLSelectElement>('range').value.startsWith('whole');
  }
  /** How much each block or zone counts where a few may be left out. */
  private weights(frame: Frame): Float64Array {
    const { area: areas, zoned } = this.results.mesh;
    return areas.map((area, b) => (frame.alive[b] && !this.held[b] && !zoned[b] ? area : 0));
  }

  /** Of the faces, m. */
  private lengths({ contacts: { count, edge, alongA, alongB } }: Frame): Float64Array {
    const { edges, vertex } = this.results.mesh;
    return Float64Array.from({ length: count }, (_, k) => {
      const [p, q] = [2 * edges[2 * edge[k]], 2 * edges[2 * edge[k] + 1]];
      return Math.abs(alongB[k] - alongA[k]) * length(vertex[q] - vertex[p], vertex[q + 1] - vertex[p + 1]);
    });
  }

  /** Where what stays is little beside what has passed (a run that was shaken), the colours are those that show what
   * stays: all frames' would make the last one flat. As long as nobody has chosen otherwise. */
  private chooseRange(): void {
    const range = byId<HTMLSelectElement>('range');
    if (this.rangeIsChosen) return;
    const stays = ['displacement', 'rotation', 'opening', 'slip'].some((name) => this.field?.name.startsWith(name));
    const span = ([low, high]: Ends) => high - low;
    const { last, drawn, frames } = { ...this.field, frames: this.results.run.frames.length };
    const little = last !== undefined && drawn !== undefined && frames > 1 && span(last) > 1e-6 * span(drawn) && span(last) < 0.25 * span(drawn);
    range.value = stays && little ? 'last' : 'run';
  }
  private rangeIsChosen = false;

  /** Ends of the colours, and of all values; undefined: the field's own over all frames. */
  rangeOf(frame: Frame, values: Float32Array): { ends: Ends; all: Ends } | undefined {
    const how = byId<HTMLSelectElement>('range').value;
    if (this.field === undefined || this.field.kind === 'kinds') return undefined;
    if (how === 'own') {
      const ends = this.ownEnds();
      return ends && { ends, all: this.field.range ?? ends };
    }
    if (how === 'run') return undefined;
    if (how === 'last') return this.field.last && { ends: this.field.last, all: this.field.range ?? this.field.last };
    const { range } = this.field;
    if (how === 'whole') return range === undefined ? undefined : { ends: range, all: range };
    const ofContacts = this.field.of === 'contacts' ? (contactValues(this.field.name, frame.contacts) ?? []) : undefined;
    const shown = ofContacts ?? values;
    const faces = isAlongFaces(this.field.name);
    const weights = faces ? this.lengths(frame) : ofContacts === undefined ? this.weights(frame) : new Uint8Array(shown.length).fill(1);
    const all = endsOf(shown, weights);
    const ends = (ofContacts !== undefined && !faces) || this.wholeRange ? all : drawnEnds(shown, weights);
    return all[1] > all[0] ? { ends, all } : undefined;
  }
  held: Uint8Array = new Uint8Array(0);

  setTime(player: Player, results: Results): void {
    const scrub = byId<HTMLInputElement>('scrub');
    scrub.max = String(player.end);
    scrub.value = String(player.index);
    const t = player.time;
    const stage = results.stages.find((s) => t <= s.end * (1 + 1e-12) && (t > s.start || s === results.stages[0]));
    const text = `t = ${brief(t, 5)} s`;
    byId('time').textContent = results.stages.length > 1 && stage !== undefined ? `${stage.name} \u00b7 ${text}` : text;
    scrub.setAttribute('aria-valuetext', text);
    const play = byId('play');
    play.classList.toggle('playing', player.playing);
    play.setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
    this.markStages(player, results);
  }

  connect(player: Player): void {
    const press = (id: string, act: () => void) => byId(id).addEventListener('click', act);
    press('play', () => player.toggle());
    press('first', () => player.go(0));
    press('back', () => player.go(player.index - 1));
    press('on', () => player.go(player.index + 1));
    press('last', () => player.go(player.end));
    byId('scrub').addEventListener('input', () => player.go(Number(byId<HTMLInputElement>('scrub').value)));
    byId('speed').addEventListener('change', () => (player.speed = Number(byId<HTMLSelectElement>('speed').value)));
  }

  private listen(): void {
    for (const id of ['field', 'range', 'vectors', 'lining', 'edges', 'contacts', 'forces', 'cracks', 'crosses', 'bolts', 'marks', 'axes', 'low', 'high']) {
      byId(id).addEventListener('change', () => {
        if (id === 'range') this.rangeIsChosen = true;
        if (id === 'field') this.chooseRange();
        if (id === 'range' || id === 'field') this.offerOwnRange();
        this.changed();
      });
    }
    byId('magnify').addEventListener('input', () => {
      this.showMagnification();
      this.changed();
    });
  }

  private ownUnit() {
    const range = this.field?.range ?? [0, 0];
    return scaledUnit(this.field?.unit ?? '', Math.max(Math.abs(range[0]), Math.abs(range[1])));
  }
  /** The ends that were given; undefined, and said so, where they are none. */
  private ownEnds(): Ends | undefined {
    const inputs = ['low', 'high'].map((id) => byId<HTMLInputElement>(id));
    const [low, high] = inputs.map((i) => (i.value === '' ? NaN : Number(i.value)) / this.ownUnit().factor);
    const fault = Number.isNaN(low + high) ? 'give two numbers' : low >= high ? 'the lower end must be below the upper one' : '';
    inputs.forEach((i) => i.setAttribute('aria-invalid', String(fault !== '')));
    byId('own-fault').hidden = fault === '';
    byId('own-fault').textContent = fault && `${fault}; till then as for all frames`;
    return fault === '' ? [low, high] : undefined;
  }
  private offerOwnRange(): void {
    const own = byId<HTMLSelectElement>('range').value === 'own';
    byId('own').hidden = !own;
    byId('own-fault').hidden = true;
    if (!own || this.field === undefined) return;
    const scaled = this.ownUnit();
    const [low, high] = this.field.range ?? [0, 1];
    byId<HTMLInputElement>('low').value = String(Number((low * scaled.factor).toPrecision(4)));
    byId<HTMLInputElement>('high').value = String(Number((high * scaled.factor).toPrecision(4)));
    byId('own-unit').textContent = scaled.unit;
  }
  private showMagnification(): void {
    byId('magnify-value').textContent = `\u00d7 ${brief(this.magnification, 3)}`;
  }

  private marked = '';
  private markStages(player: Player, results: Results): void {
    const key = JSON.stringify([results.stages, player.end]);
    if (key === this.marked) return;
    this.marked = key;
    const marks = results.stages.slice(0, -1).map((s) => {
      let k = 0;
      results.run.frames.forEach((t, i) => {
        if (t <= s.end * (1 + 1e-12)) k = i;
      });
      return make('i', '', { style: `left: ${(100 * k) / Math.max(player.end, 1)}%`, title: `end of ${s.name}` });
    });
    byId('marks-of-stages').replaceChildren(...marks);
  }
}
