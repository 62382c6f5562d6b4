// The page: what is chosen, and how it reaches the drawing.
import uPlotStyle from 'uplot/dist/uPlot.min.css';
import { LONGEST_BEYOND } from './data/ends';
import { blockValue, blockValues } from './data/fields';
import type { Frame } from './data/frame';
import { Frames } from './data/frames';
import { unitOf } from './data/linings';
import { refresh, type Results } from './data/results';
import { failedChecks, type Field, summaryOf } from './data/run';
import { Scale } from './data/scale';
import { Absent, type Source } from './data/source';
import { brief, quantity } from './data/units';
import { LONGEST } from './scene/layers';
import { Overlay } from './scene/overlay';
import { View } from './scene/view';
import { Controls } from './ui/controls';
import { byId, make } from './ui/dom';
import { listenToKeys } from './ui/keys';
import { legendBox, type LegendEntries, paintLegend, WIDTH as LEGEND_WIDTH } from './ui/legend';
import { Player } from './ui/player';
import { Plots } from './ui/plots';
import { listenToPointer } from './ui/pointer';
import { savePicture } from './ui/save';
import { digitsOf, showValues, valuesOf, yieldsIn } from './ui/selection';
import { css, overlayStyle, themeAtStart, type ThemeName, themes } from './ui/theme';
import { showWaiting } from './ui/waiting';

/** How often a served run is asked for more, ms. */
export const ASK_EVERY = 1000;
/** Height of the largest force of a lining, over the size of the linings. */
const DIAGRAM = 0.2;

export class App {
  readonly frames: Frames;
  readonly player: Player;
  readonly view: View;
  private readonly overlay: Overlay;
  private readonly controls: Controls;
  private readonly plots: Plots;
  private readonly values: Float32Array;
  private theme: ThemeName = themeAtStart();
  private scale: Scale;
  private frame?: Frame;
  /** Number of `frame`; the player may be ahead of it. */
  private shown = 0;
  private fitted = false;
  /** The block or zone that was clicked. */
  selected = -1;
  private monitor = '';
  private stale = true;
  private overlayStale = true;
  /** Of the last frames drawn: ms of script each. */
  readonly scriptTimes: number[] = [];
  drawn = 0;

  constructor(private readonly source: Source, readonly results: Results) {
    document.head.append(Object.assign(document.createElement('style'), { textContent: uPlotStyle }));
    document.documentElement.dataset.theme = this.theme;
    const { run, mesh } = results;
    this.values = new Float32Array(mesh.parts);
    this.frames = new Frames(source, mesh, run.absent);
    this.player = new Player(run.frames, this.frames, () => this.wake());
    this.view = new View(byId<HTMLCanvasElement>('blocks'), mesh, themes[this.theme]);
    this.overlay = new Overlay(byId<HTMLCanvasElement>('overlay'), mesh, run.monitors, run.convergences);
    this.controls = new Controls(results, () => this.restyle());
    this.controls.held = mesh.fixed;
    this.plots = new Plots(results, this.frames, (t) => this.player.seek(t));
    this.scale = new Scale(run, this.controls.field);
    this.listen();
    this.describe();
    new ResizeObserver(() => this.resize()).observe(byId('stage'));
    this.resize();
    this.restyle();
    const loop = (now: number) => {
      this.tick(now);
      requestAnimationFrame(loop);
    };
    requestAnimationFrame(loop);
    if (run.served) setTimeout(() => this.ask(), ASK_EVERY);
  }

  /** Something of the frame has changed. */
  private wake(): void {
    this.stale = true;
  }

  private tick(now: number): void {
    const start = performance.now();
    this.player.tick(now);
    if (this.stale) this.takeFrame();
    if (!this.overlayStale) return;
    this.overlayStale = false;
    this.view.draw();
    this.overlay.draw(this.view.camera, this.view.pose, overlayStyle(), this.overlayOptions());
    this.paintLegend(byId<HTMLCanvasElement>('overlay').getContext('2d')!);
    if (this.frame !== undefined) ++this.drawn;
    this.scriptTimes.push(performance.now() - start);
    if (this.scriptTimes.length > 600) this.scriptTimes.shift();
  }

  /** The player's frame where it is there; else once it has come. */
  private takeFrame(): void {
    this.stale = false;
    this.controls.setTime(this.player, this.results);
    const { index } = this.player;
    const frame = this.frames.ready(index);
    byId('busy').hidden = frame !== undefined;
    if (frame === undefined) {
      this.frames.want(index).then(() => this.wake(), (error: Error) => {
        if (error instanceof Absent) setTimeout(() => this.wake(), ASK_EVERY);
        else this.fail(error);
      });
      return;
    }
    this.frame = frame;
    this.shown = index;
    this.show(frame);
    this.plots.setTime(this.player.time);
  }

  private show(frame: Frame): void {
    const { controls, view, results } = this;
    const field = controls.field;
    blockValues(field?.of === 'blocks' ? field.name : 'none', frame, results.mesh, this.values);
    this.scale = new Scale(results.run, field, controls.rangeOf(frame, this.values));
    view.show({
      frame,
      datum: results.datums[frame.datum],
      values: this.values,
      magnification: controls.magnification,
      scale: this.scale,
      edges: controls.edges,
      contacts: controls.contacts || field?.of === 'contacts',
      forces: controls.forces,
      usualForce: results.run.usual.force,
      usualPressure: results.run.usual.pressure,
      cracks: controls.cracks,
      crosses: controls.crosses,
      usualStress: results.run.usual.stress,
      vectors: controls.vectors,
      largestVector: this.largestVector(),
      bolts: controls.bolts ? results.bolts.at(results.run.frames[this.shown]) : [],
      linings: controls.lining === undefined ? [] : results.linings.at(results.run.frames[this.shown], controls.lining),
      largestOfLinings: controls.lining === undefined ? 0 : results.linings.largest[controls.lining],
      heightOfLinings: DIAGRAM * results.linings.extent,
    });
    if (!this.fitted) this.fit();
    this.showSelection();
    this.overlayStale = true;
  }

  private largestVector(): number {
    const field = this.results.run.fields.find((f) => f.name === this.controls.vectors);
    return (this.controls.wholeRange ? field?.range : field?.drawn)?.[1] ?? 0;
  }

  private showSelection(): void {
    const { frame, results, selected } = this;
    if (frame === undefined || selected < 0) {
      showValues('Selection', [], 0);
      return;
    }
    const rows = valuesOf(results.run, results.mesh, frame, results.datums[frame.datum], selected);
    const block = `block ${results.mesh.id[selected]}`;
    const inside = selected < results.mesh.blocks ? block : `a zone of ${block}`;
    const title = this.monitor === '' ? inside[0].toUpperCase() + inside.slice(1) : `Monitor ${this.monitor}, in ${inside}`;
    showValues(frame.alive[selected] ? title : `${title}: excavated`, frame.alive[selected] ? rows : [], digitsOf(frame));
  }

  /** Selects the monitor or the block at a pixel of the drawing. */
  pick(px: number, py: number): void {
    const { camera, pose } = this.view;
    const monitor = this.overlay.monitorAt(camera, pose, px, py);
    this.monitor = monitor?.name ?? '';
    this.selected = monitor !== undefined ? monitor.at[0].row : pose.blockAt(...camera.at(px, py));
    this.plots.select(this.selected, this.monitor);
    this.showSelection();
    this.overlayStale = true;
  }

  fit(): void {
    this.view.camera.fit(this.view.pose.box(), LEGEND_WIDTH);
    this.fitted = true;
    this.overlayStale = true;
  }

  private restyle(): void {
    this.plots.setField(this.controls.field);
    this.wake();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = byId('stage');
    const ratio = this.view.software ? 1 : Math.min(devicePixelRatio, 2);
    this.view.resize(clientWidth, clientHeight, ratio);
    this.overlay.resize(clientWidth, clientHeight, devicePixelRatio);
    this.overlayStale = true;
  }

  private overlayOptions() {
    const { axes, marks } = this.controls;
    const { width, height } = this.view.camera;
    const g = byId<HTMLCanvasElement>('overlay').getContext('2d')!;
    const legend = legendBox(g, width - 10, 10, height - 10, overlayStyle(), this.legend());
    return { axes, marks, selected: this.selected, monitor: this.monitor, legend };
  }

  private paintLegend(g: CanvasRenderingContext2D): void {
    const { width, height } = this.view.camera;
    paintLegend(g, width - 10, 10, height - 10, overlayStyle(), this.legend());
  }

  private legend(): LegendEntries {
    const { controls, results } = this;
    const theme = themes[this.theme];
    const strokes: LegendEntries['strokes'] = [];
    const per = (of: 'forces' | 'pressures' | 'crosses' | 'arrows' | 'linings') => this.view.valuePerPixel(of);
    const { usual, largest } = results.run;
    const cut = (of: 'force' | 'stress') => (largest[of] > LONGEST * usual[of] ? LONGEST * usual[of] : undefined);
    if (controls.forces) strokes.push({ colour: css(theme.ink), text: `force, up to ${quantity(largest.force, 'N', 3)}`, perPixel: per('forces'), unit: 'N', cutAt: cut('force') });
    if (controls.forces) {
      const most = Math.max(largest.pressure, largest.tension);
      const cutAt = most > LONGEST_BEYOND * usual.pressure ? LONGEST_BEYOND * usual.pressure : undefined;
      const up = (text: string, value: number, colour: number[]) => ({ colour: css(colour), text: `${text}, up to ${quantity(value, 'Pa', 2)}`, unit: 'Pa', most: value });
      const drawn: LegendEntries['strokes'] = [];
      if (largest.pressure > 0) drawn.push(up('pressure', largest.pressure, theme.compression));
      if (largest.tension > 0) drawn.push(up('in tension', largest.tension, theme.tension));
      // One sample is enough, and so is one word of what is cut.
      if (drawn.length > 0) drawn[0].perPixel = per('pressures');
      if (drawn.length > 0) drawn[drawn.length - 1].cutAt = cutAt;
      strokes.push(...drawn);
    }
    if (controls.cracks) {
      strokes.push({ colour: css(theme.tension), text: 'broken in tension' }, { colour: css(theme.compression), text: 'broken in shear' });
    }
    if (controls.crosses) {
      strokes.push({ colour: css(theme.compression), text: 'compression', perPixel: per('crosses'), unit: 'Pa' });
      strokes.push({ colour: css(theme.tension), text: 'tension', unit: 'Pa', cutAt: cut('stress') });
    }
    if (controls.vectors !== 'none') {
      const unit = controls.vectors === 'velocity' ? 'm/s' : 'm';
      strokes.push({ colour: css(theme.ink), text: controls.vectors, perPixel: per('arrows'), unit });
    }
    if (controls.bolts && results.bolts.any) {
      strokes.push({ colour: css(theme.ink), text: `bolt, up to ${quantity(results.bolts.largest, 'N', 3)}` });
      strokes.push({ colour: css(theme.tension), text: 'bolt at its strength' });
    }
    const { lining } = controls;
    if (lining !== undefined && results.linings.any) {
      const unit = unitOf[lining];
      strokes.push({ colour: css(theme.compression), text: `${lining}, up to ${quantity(results.linings.largest[lining], unit, 3)}`, perPixel: per('linings'), unit, most: results.linings.largest[lining] });
    }
    const states = controls.field?.of === 'contacts' ? controls.field.name === 'state' : controls.contacts;
    return { scale: this.scale, kinds: this.kinds(controls.field), states: states ? results.run.states : [], strokes };
  }

  private kinds(field: Field | undefined): [number, string][] {
    if (field?.name === 'yields') return yieldsIn.map((name, k) => [k, `yields ${name}`.replace('yields no', 'does not yield')]);
    if (field?.name !== 'material') return [];
    const there = [...new Set(this.results.mesh.material)].sort((a, b) => a - b);
    return there.map((m) => [m, this.results.run.materials[m] ?? String(m)]);
  }

  private setTheme(theme: ThemeName): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.view.setTheme(themes[theme]);
    this.plots.restyle();
    this.overlayStale = true;
  }

  private save(): void {
    const style = overlayStyle();
    const ratio = Math.max(2, devicePixelRatio);
    savePicture(`${this.results.run.title || 'edda'}-${this.shown}.png`.replaceAll(/[^\w.-]+/g, '_'), this.view, ratio, this.results.run.title, this.pictureTime(), style.halo, style.ink, (g) => {
      this.overlay.paint(g, this.view.camera, this.view.pose, style, this.overlayOptions());
      this.paintLegend(g);
    });
  }

  /** Of the frame that is drawn. */
  private pictureTime(): string {
    const { frames } = this.results.run;
    const { magnification } = this.controls;
    const drawn = magnification > 1 ? `displacements \u00d7 ${brief(magnification, 3)}` : '';
    return [`t = ${brief(frames[this.shown], 6)} s`, drawn].filter((t) => t !== '').join('    ');
  }

  private listen(): void {
    const { player, view } = this;
    listenToPointer(byId('overlay'), view.camera, {
      moved: () => (this.overlayStale = true),
      clicked: (x, y) => this.pick(x, y),
      fit: () => this.fit(),
    });
    const zoom = (factor: number) => {
      view.camera.zoom(factor, 0.5 * view.camera.width, 0.5 * view.camera.height);
      this.overlayStale = true;
    };
    const flip = () => this.setTheme(this.theme === 'light' ? 'dark' : 'light');
    const help = () => byId<HTMLDialogElement>('keys').showModal();
    listenToKeys([
      { keys: [' '], shown: 'space', does: 'play or pause', act: () => player.toggle() },
      { keys: ['ArrowLeft'], shown: '\u2190', does: 'one frame back', act: () => player.go(player.index - 1) },
      { keys: ['ArrowRight'], shown: '\u2192', does: 'one frame on', act: () => player.go(player.index + 1) },
      { keys: ['Home'], shown: 'Home', does: 'first frame', act: () => player.go(0) },
      { keys: ['End'], shown: 'End', does: 'last frame', act: () => player.go(player.end) },
      { keys: ['+', '='], shown: '+', does: 'closer', act: () => zoom(1.25) },
      { keys: ['-'], shown: '\u2212', does: 'further away', act: () => zoom(0.8) },
      { keys: ['0', 'f'], shown: 'F', does: 'all of it', act: () => this.fit() },
      { keys: ['m'], shown: 'M', does: 'displacements larger, or true', act: () => this.controls.flipMagnification(this.results, this.frame) },
      { keys: ['p'], shown: 'P', does: 'save a picture', act: () => this.save() },
      { keys: ['t'], shown: 'T', does: 'light or dark', act: flip },
      { keys: ['Escape'], shown: 'Esc', does: 'select nothing', act: () => this.pick(-1e6, -1e6) },
      { keys: ['?'], shown: '?', does: 'these keys', act: help },
    ]);
    this.controls.connect(player);
    byId('save').addEventListener('click', () => this.save());
    byId('theme').addEventListener('click', flip);
    byId('help').addEventListener('click', help);
  }

  private describe(): void {
    const { run, mesh } = this.results;
    byId('title').textContent = run.title || 'edda';
    document.title = run.title ? `${run.title} \u2013 edda` : 'edda';
    const summary = summaryOf(run);
    const failed = summary === undefined ? [] : failedChecks(summary);
    const status = summary?.status ?? (run.served ? 'going on' : 'not ended');
    const chip = byId('status');
    const doubts = failed.length === 0 ? '' : failed.length === 1 ? ' \u00b7 a check does not hold' : ` \u00b7 ${failed.length} checks do not hold`;
    chip.textContent = `${status} \u00b7 ${mesh.blocks.toLocaleString('en')} ${mesh.blocks === 1 ? 'block' : 'blocks'}${doubts}`;
    chip.title = summary?.message ?? '';
    chip.classList.toggle('bad', status === 'failed' || status === 'collapsed' || failed.length > 0);
    byId('failed').hidden = failed.length === 0;
    byId('failed-checks').replaceChildren(...failed.map((said) => make('li', said)));
  }

  /** A served run: what has come since. */
  private async ask(): Promise<void> {
    try {
      const run = await this.source.run();
      const before = this.results.run;
      if (run.run !== before.run) {
        location.reload();
        return;
      }
      if (run.frames.length !== before.frames.length || run.summary !== before.summary) {
        const atEnd = this.player.index === this.player.end && !this.player.playing;
        // All at once: where a part does not come, it is asked for again.
        const results = { ...this.results, run };
        await refresh(this.source, results);
        Object.assign(this.results, results);
        this.player.setTimes(run.frames);
        this.plots.refresh();
        if (atEnd) this.player.go(this.player.end);
        this.wake();
      }
      this.describe();
      byId('fault').hidden = true;
    } catch (error) {
      // What fetch() makes of no answer at all is a TypeError.
      const silent = error instanceof TypeError;
      if (error instanceof Absent) showWaiting(error);
      else this.fail(silent ? new Error('the program that serves this page does not answer: start edda view --serve again') : (error as Error));
    }
    setTimeout(() => this.ask(), ASK_EVERY);
  }

  private fail(error: Error): void {
    byId('fault').hidden = false;
    byId('fault').textContent = error.message;
  }

  /** For tests: the value of a field at the selected block, unrounded. */
  valueOf(field: string): number {
    return this.frame === undefined ? NaN : blockValue(field, this.frame, this.selected, this.results.mesh);
  }
  /** For tests: where a point of the model is on the page's drawing, px. */
  pixelOf(x: number, y: number): [number, number] {
    const { origin } = this.view.pose;
    return this.view.camera.px(x - origin[0], y - origin[1]);
  }
}

