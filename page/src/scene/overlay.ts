// Text and thin lines over the drawing: axes, the selected block, monitors, convergence lines.
import type { Mark } from '../data/run';
import type { Mesh } from '../data/mesh';
import { ticks } from '../data/units';
import type { Camera } from './camera';
import { along, beside, Labels, type Rectangle } from './labels';
import type { Pose } from './pose';

export interface OverlayStyle {
  ink: string;
  faint: string;
  halo: string;
  accent: string;
  font: string;
}

export interface OverlayOptions {
  axes: boolean;
  marks: boolean;
  selected: number;
  monitor: string;
  /** Where the legend will stand. */
  legend: Rectangle;
}

/** A mark's points as they move with their blocks. */
export interface Follower {
  name: string;
  /** Per point: the part, and the place from its centre in the first frame; -1: outside all. */
  at: { row: number; rx: number; ry: number }[];
}

export class Overlay {
  readonly monitors: Follower[];
  readonly lines: Follower[];

  constructor(private readonly canvas: HTMLCanvasElement, private readonly mesh: Mesh, monitors: Mark[], lines: Mark[]) {
    this.monitors = monitors.map((m) => follow(mesh, m));
    this.lines = lines.map((m) => follow(mesh, m));
  }

  resize(width: number, height: number, ratio: number): void {
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  draw(camera: Camera, pose: Pose, style: OverlayStyle, options: OverlayOptions): void {
    const g = this.canvas.getContext('2d')!;
    const ratio = this.canvas.width / camera.width;
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    g.clearRect(0, 0, camera.width, camera.height);
    this.paint(g, camera, pose, style, options);
  }

  /** On any canvas whose units are pixels of the screen. */
  paint(g: CanvasRenderingContext2D, camera: Camera, pose: Pose, style: OverlayStyle, options: OverlayOptions): void {
    if (options.axes) drawAxes(g, camera, pose.origin, style);
    if (options.selected >= 0 && pose.isAlive(options.selected)) this.outline(g, camera, pose, this.mesh.block[options.selected], style);
    if (!options.marks) return;
    g.font = `600 12px ${style.font}`;
    this.paintMarks(g, camera, pose, style, options);
  }

  private paintMarks(g: CanvasRenderingContext2D, camera: Camera, pose: Pose, style: OverlayStyle, { monitor, legend }: OverlayOptions): void {
    const there = this.monitors.filter((m) => m.at[0].row < 0 || pose.isAlive(m.at[0].row));
    const dots = there.map((m) => ({ name: m.name, at: this.place(camera, pose, m, 0), radius: this.ringRadius(camera, pose, m), selected: m.name === monitor }));
    const lines = this.lines.map((l) => ({ name: l.name, from: this.place(camera, pose, l, 0), to: this.place(camera, pose, l, 1) }));
    for (const { from, to } of lines) drawLine(g, from, to, style);
    for (const { at, radius, selected } of dots) drawRing(g, at, radius, style, selected);
    const labels = new Labels(g, camera.width, camera.height, [legend, ...dots.map(({ at: [x, y], radius: r }) => ({ x0: x - r - 1, y0: y - r - 1, x1: x + r + 1, y1: y + r + 1 }))]);
    const write = (text: string, at: [number, number] | undefined) => at && label(g, text, ...at, style);
    // What was clicked comes first.
    dots.sort((a, b) => Number(b.selected) - Number(a.selected));
    for (const { name, at, selected } of dots) write(name, labels.place(name, beside(...at), selected));
    for (const { name, from, to } of lines) write(name, labels.place(name, along(from, to)));
  }

  /** The monitor within reach of the pixel, or undefined. */
  monitorAt(camera: Camera, pose: Pose, px: number, py: number): Follower | undefined {
    return this.monitors.find((m) => {
      const [x, y] = this.place(camera, pose, m, 0);
      return Math.hypot(x - px, y - py) < 9;
    });
  }

  /** As wide as shows the block inside it, where that is small. */
  private ringRadius(camera: Camera, pose: Pose, follower: Follower): number {
    const part = follower.at[0].row;
    const [least, most, rim] = [5, 16, 4];
    const row = part < 0 ? part : this.mesh.block[part];
    if (row < 0 || this.mesh.reach[row] * camera.scale > most) return least;
    const [x, y] = this.place(camera, pose, follower, 0);
    const [cx, cy] = camera.px(...pose.point(row, 0, 0));
    return Math.max(least, Math.hypot(x - cx, y - cy) + Math.SQRT2 * this.mesh.reach[row] * camera.scale + rim);
  }

  private place(camera: Camera, pose: Pose, f: Follower, k: number): [number, number] {
    const { row, rx, ry } = f.at[k];
    if (row < 0) return camera.px(rx - pose.origin[0], ry - pose.origin[1]);
    return camera.px(...pose.point(row, rx, ry));
  }

  private outline(g: CanvasRenderingContext2D, camera: Camera, pose: Pose, row: number, style: OverlayStyle): void {
    const { edges, edgeBegin } = this.mesh;
    g.beginPath();
    for (let e = edgeBegin[row]; e < edgeBegin[row + 1]; ++e) {
      g.moveTo(...camera.px(...pose.vertex(edges[2 * e])));
      g.lineTo(...camera.px(...pose.vertex(edges[2 * e + 1])));
    }
    g.lineCap = 'round';
    for (const [width, colour] of [[6, style.halo], [3, style.accent]] as const) {
      g.lineWidth = width;
      g.strokeStyle = colour;
      g.stroke();
    }
  }
}

/** Open, so that it hides no block. */
function drawRing(g: CanvasRenderingContext2D, [x, y]: [number, number], radius: number, style: OverlayStyle, selected: boolean): void {
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  for (const [width, colour] of [[4.5, style.halo], [2.5, selected ? style.accent : style.ink]] as const) {
    g.lineWidth = width;
    g.strokeStyle = colour;
    g.stroke();
  }
}

function drawLine(g: CanvasRenderingContext2D, from: [number, number], to: [number, number], style: OverlayStyle): void {
  g.setLineDash([6, 4]);
  g.beginPath();
  g.moveTo(...from);
  g.lineTo(...to);
  g.lineWidth = 1.5;
  g.strokeStyle = style.ink;
  g.stroke();
  g.setLineDash([]);
}

function label(g: CanvasRenderingContext2D, text: string, x: number, y: number, style: OverlayStyle): void {
  g.lineWidth = 4;
  g.lineJoin = 'round';
  g.strokeStyle = style.halo;
  g.strokeText(text, x, y);
  g.fillStyle = style.ink;
  g.fillText(text, x, y);
}

/** The part round each point, in the first frame; a point a rounding outside still counts. On a border it is one that
 * is free before one that is held, then that of lowest id: as in the program. */
function follow(mesh: Mesh, mark: Mark): Follower {
  const at = mark.points.map(([x, y]) => {
    const row = blockRound(mesh, x, y);
    if (row < 0) return { row, rx: x, ry: y };
    return { row, rx: x - mesh.centre[2 * row], ry: y - mesh.centre[2 * row + 1] };
  });
  return { name: mark.name, at };
}

function blockRound(mesh: Mesh, x: number, y: number): number {
  const { triangles, vertex, row, centre, fixed } = mesh;
  let held = -1;
  for (let t = 0; t < triangles.length; t += 3) {
    const b = row[triangles[t]];
    const [px, py] = [x - centre[2 * b], y - centre[2 * b + 1]];
    const corner = (k: number) => [vertex[2 * triangles[t + k]], vertex[2 * triangles[t + k] + 1]];
    const [p, q, r] = [corner(0), corner(1), corner(2)];
    const side = (u: number[], v: number[]) => (v[0] - u[0]) * (py - u[1]) - (v[1] - u[1]) * (px - u[0]);
    const area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    const least = -1e-5 * Math.abs(area);
    if (side(p, q) >= least && side(q, r) >= least && side(r, p) >= least) {
      if (!fixed[b]) return b;
      if (held < 0) held = b;
    }
  }
  return held;
}

function drawAxes(g: CanvasRenderingContext2D, camera: Camera, origin: [number, number], style: OverlayStyle): void {
  const [x0, y0] = camera.at(0, camera.height);
  const [x1, y1] = camera.at(camera.width, 0);
  g.font = `11px ${style.font}`;
  g.fillStyle = style.faint;
  g.strokeStyle = style.faint;
  g.lineWidth = 1;
  const across = ticks(x0 + origin[0], x1 + origin[0], camera.width / 110);
  g.textAlign = 'center';
  for (const t of across.at) {
    const [px] = camera.px(t - origin[0], 0);
    if (px < 46 || px > camera.width - 22) continue;
    g.beginPath();
    g.moveTo(px, camera.height);
    g.lineTo(px, camera.height - 5);
    g.stroke();
    haloed(g, t.toFixed(across.digits).replace('-', '\u2212'), px, camera.height - 8, style);
  }
  const up = ticks(y0 + origin[1], y1 + origin[1], camera.height / 90);
  g.textAlign = 'left';
  for (const t of up.at) {
    const [, py] = camera.px(0, t - origin[1]);
    if (py < 14 || py > camera.height - 24) continue;
    g.beginPath();
    g.moveTo(0, py);
    g.lineTo(5, py);
    g.stroke();
    haloed(g, t.toFixed(up.digits).replace('-', '\u2212'), 8, py + 4, style);
  }
  haloed(g, 'm', 8, camera.height - 8, style);
}

function haloed(g: CanvasRenderingContext2D, text: string, x: number, y: number, style: OverlayStyle): void {
  g.save();
  g.lineWidth = 3;
  g.lineJoin = 'round';
  g.strokeStyle = style.halo;
  g.strokeText(text, x, y);
  g.restore();
  g.fillText(text, x, y);
}
