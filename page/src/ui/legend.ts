// What the colours and strokes mean.
import type { Scale } from '../data/scale';
import { quantity, scaledUnit, ticks } from '../data/units';
import type { Rectangle } from '../scene/labels';
import type { OverlayStyle } from '../scene/overlay';
import { wrap } from './text';

export interface StrokeEntry {
  colour: string;
  text: string;
  perPixel?: number;
  unit?: string;
  /** The value of the longest stroke, where some of the run are cut. */
  cutAt?: number;
  /** The largest value: what is drawn beside it is not above. */
  most?: number;
}

export interface LegendEntries {
  scale: Scale;
  /** Names of kinds, by number; those that occur. */
  kinds: [number, string][];
  /** Names of the states of contacts; empty where they are not shown. */
  states: string[];
  /** Strokes; where their length means something, what a pixel of it stands for. */
  strokes: StrokeEntry[];
}

export const WIDTH = 180;
/** Length of the colours, where there is room and where there is none. */
const BAR = 190;
const LEAST_BAR = 70;

/** What it takes below `top`: with a shorter bar, then smaller, so that it ends above `bottom`. */
function layOut(g: CanvasRenderingContext2D, top: number, bottom: number, style: OverlayStyle, e: LegendEntries) {
  const bar = e.scale.palette === 'sequential' || e.scale.palette === 'diverging';
  g.font = `600 12px ${style.font}`;
  const lines = e.scale.field === undefined ? [] : wrap((t) => g.measureText(t).width, e.scale.field.label + (bar ? beyond(e.scale) : ''), WIDTH - 24);
  const kinds = e.scale.palette === 'kinds' && e.kinds.length <= 12 ? e.kinds : [];
  const measured = e.strokes.filter((stroke) => stroke.perPixel !== undefined);
  const cut = e.strokes.filter((stroke) => stroke.cutAt !== undefined);
  const rows = kinds.length + e.states.length + e.strokes.length + measured.length + cut.length;
  const others = 14 + 16 * lines.length + (bar ? 36 : 0) + 18 * rows;
  const length = bar ? Math.max(LEAST_BAR, Math.min(BAR, bottom - top - others)) : 0;
  const height = others + length;
  return { bar, lines, kinds, length, height, shrunk: Math.min(1, Math.max(bottom - top, 1) / height) };
}

/** Where paintLegend() will paint it. */
export function legendBox(g: CanvasRenderingContext2D, right: number, top: number, bottom: number, style: OverlayStyle, e: LegendEntries): Rectangle {
  const { height, shrunk } = layOut(g, top, bottom, style, e);
  return height <= 14 ? { x0: right, y0: top, x1: right, y1: top } : { x0: right - shrunk * WIDTH, y0: top, x1: right, y1: top + shrunk * height };
}

/** Paints it with its upper right corner at (right, top), not below `bottom`. */
export function paintLegend(g: CanvasRenderingContext2D, right: number, top: number, bottom: number, style: OverlayStyle, e: LegendEntries): void {
  const { bar, lines, kinds, length, height, shrunk } = layOut(g, top, bottom, style, e);
  if (height <= 14) return;
  const left = right - WIDTH;
  g.save();
  g.translate(right, top);
  g.scale(shrunk, shrunk);
  g.translate(-right, -top);
  g.globalAlpha = 0.88;
  g.fillStyle = style.halo;
  g.beginPath();
  g.roundRect(left, top, WIDTH, height, 6);
  g.fill();
  g.globalAlpha = 1;
  g.textAlign = 'left';
  let y = top + 20;
  g.fillStyle = style.ink;
  g.font = `600 12px ${style.font}`;
  for (const line of lines) {
    g.fillText(line, left + 12, y);
    y += 16;
  }
  g.font = `12px ${style.font}`;
  if (bar) {
    paintBar(g, left + 12, y, length, style, e.scale);
    y += length + 36;
  }
  const entry = (text: string, swatch: () => void) => {
    swatch();
    g.fillStyle = style.ink;
    g.fillText(text, left + 36, y + 1, WIDTH - 42);
    y += 18;
  };
  for (const [k, name] of kinds) entry(name, () => square(g, left + 12, y - 9, e.scale.css(e.scale.step(k)), style));
  e.states.forEach((name, k) => entry(name, () => {
    if (k === 0) dot(g, left + 19, y - 3, style.ink);
    const [r, gr, b] = e.scale.states.subarray(3 * k, 3 * k + 3);
    dot(g, left + 19, y - 3, `rgb(${r},${gr},${b})`, k === 0 ? 3.5 : 4.5);
  }));
  for (const stroke of e.strokes) {
    entry(stroke.text, () => line(g, left + 12, y - 3, 16, stroke.colour));
    if (stroke.perPixel !== undefined) {
      // As long as in the drawing, however small the legend.
      const perPixel = shrunk * stroke.perPixel;
      const value = roundBelow(Math.min(72 * perPixel, stroke.most ?? Infinity));
      line(g, left + 12, y - 3, value / perPixel || 0, stroke.colour);
      g.fillStyle = style.ink;
      g.fillText(quantity(value, stroke.unit ?? '', 1), left + 92, y + 1, WIDTH - 98);
      y += 18;
    }
    if (stroke.cutAt === undefined) continue;
    g.fillText(`longer: cut at ${quantity(stroke.cutAt, stroke.unit ?? '', 3)}`, left + 12, y + 1, WIDTH - 18);
    y += 18;
  }
  g.restore();
}

/** What the values reach that lie beyond the colours' ends. */
function beyond({ field, low, high, all }: Scale): string {
  const far = (v: number) => quantity(v, field!.unit, 3);
  return (all[0] < low ? `, from ${far(all[0])}` : '') + (all[1] > high ? `, up to ${far(all[1])}` : '');
}

function paintBar(g: CanvasRenderingContext2D, left: number, top: number, length: number, style: OverlayStyle, scale: Scale): void {
  const { low, high } = scale;
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const unit = scaledUnit(scale.field!.unit, largest);
  if (unit.unit !== '') {
    g.fillStyle = style.faint;
    g.fillText(unit.unit === 'degrees' ? '\u00b0 (degrees)' : unit.unit, left, top + 2);
  }
  const y0 = top + 12;
  if (!(high > low)) {
    g.fillStyle = scale.css(scale.step(low));
    g.fillRect(left, y0, 18, length);
    g.fillStyle = style.ink;
    g.fillText(quantity(low, '', 3), left + 26, y0 + length);
    return;
  }
  for (let k = 0; k < length; ++k) {
    g.fillStyle = scale.css(scale.step(low + ((high - low) * (k + 0.5)) / length));
    g.fillRect(left, y0 + length - 1 - k, 18, Math.min(3, k + 1));
  }
  // Points where values lie beyond, as in pictures.
  const tip = (base: number, peak: number, value: number) => {
    g.fillStyle = scale.css(scale.step(value));
    g.beginPath();
    g.moveTo(left, base);
    g.lineTo(left + 9, peak);
    g.lineTo(left + 18, base);
    g.fill();
  };
  if (scale.all[1] > high) tip(y0 + 0.5, y0 - 9, high);
  if (scale.all[0] < low) tip(y0 + length - 0.5, y0 + length + 9, low);
  const t = ticks(low * unit.factor, high * unit.factor, Math.max(2, length / 32));
  g.strokeStyle = style.ink;
  g.fillStyle = style.ink;
  g.lineWidth = 1;
  for (const at of t.at) {
    const y = y0 + length * (1 - (at / unit.factor - low) / (high - low));
    g.beginPath();
    g.moveTo(left + 18, y);
    g.lineTo(left + 22, y);
    g.stroke();
    g.fillText(at.toFixed(t.digits).replace('-', '\u2212'), left + 26, y + 4);
  }
}

/** The largest of 1, 2, 5 times a power of ten that is not above. */
function roundBelow(value: number): number {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([5, 2, 1].find((m) => m * power <= value * (1 + 1e-9)) ?? 1) * power;
}

function square(g: CanvasRenderingContext2D, x: number, y: number, colour: string, style: OverlayStyle): void {
  g.fillStyle = colour;
  g.fillRect(x, y, 14, 12);
  g.strokeStyle = style.faint;
  g.strokeRect(x, y, 14, 12);
}

function dot(g: CanvasRenderingContext2D, x: number, y: number, colour: string, radius = 4.5): void {
  g.fillStyle = colour;
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  g.fill();
}

function line(g: CanvasRenderingContext2D, x: number, y: number, length: number, colour: string): void {
  g.strokeStyle = colour;
  g.lineWidth = 3;
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(x + length, y);
  g.stroke();
}
