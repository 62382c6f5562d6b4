// Where the parts, blocks and zones, are drawn: x = p + M r, r from the part's centre in the first frame.
//
//   p = c + D + m d - o,   M = I + B + m A
//
// c centre, D and B the motion from the first frame to the datum, d and A the displacement since,
// m the magnification, o the scene's origin, taken off in double precision.
import type { Frame, Motion } from '../data/frame';
import type { Mesh } from '../data/mesh';
import type { Box } from './camera';

export class Pose {
  /** [4 np] p.x p.y M.xx M.xy and M.yx M.yy colour alive: two texels of each part. */
  readonly place: Float32Array;
  readonly rest: Float32Array;
  readonly origin: [number, number];

  constructor(private readonly mesh: Mesh, texels: number) {
    this.place = new Float32Array(4 * texels);
    this.rest = new Float32Array(4 * texels);
    let [x, y] = [0, 0];
    for (let b = 0; b < mesh.blocks; ++b) {
      x += mesh.centre[2 * b] / mesh.blocks;
      y += mesh.centre[2 * b + 1] / mesh.blocks;
    }
    this.origin = [x, y];
  }

  set(frame: Frame, datum: Motion, magnification: number, colours: Float32Array): void {
    const { place, rest, mesh } = this;
    const [ox, oy] = this.origin;
    const m = magnification;
    const [dx, dy, xx, xy, yx, yy] = frame.motion;
    const [Dx, Dy, Bxx, Bxy, Byx, Byy] = datum;
    const { centre } = mesh;
    for (let b = 0, k = 0; b < mesh.parts; ++b, k += 4) {
      place[k] = centre[2 * b] - ox + Dx[b] + m * dx[b];
      place[k + 1] = centre[2 * b + 1] - oy + Dy[b] + m * dy[b];
      place[k + 2] = 1 + Bxx[b] + m * xx[b];
      place[k + 3] = Bxy[b] + m * xy[b];
      rest[k] = Byx[b] + m * yx[b];
      rest[k + 1] = 1 + Byy[b] + m * yy[b];
      rest[k + 2] = colours[b];
      rest[k + 3] = frame.alive[b];
    }
  }

  /** Where a point r from the centre of block b is drawn. */
  point(b: number, rx: number, ry: number): [number, number] {
    const { place, rest } = this;
    const k = 4 * b;
    return [
      place[k] + place[k + 2] * rx + place[k + 3] * ry,
      place[k + 1] + rest[k] * rx + rest[k + 1] * ry,
    ];
  }
  /** The point from the centre of block b that is drawn at (x, y). */
  inverse(b: number, x: number, y: number): [number, number] {
    const { place, rest } = this;
    const k = 4 * b;
    const [dx, dy] = [x - place[k], y - place[k + 1]];
    const det = place[k + 2] * rest[k + 1] - place[k + 3] * rest[k];
    return [(rest[k + 1] * dx - place[k + 3] * dy) / det, (place[k + 2] * dy - rest[k] * dx) / det];
  }
  /** Not less than half of what M makes of a length in x or y. */
  private stretch(b: number): number {
    const { place, rest } = this;
    const k = 4 * b;
    return Math.max(Math.abs(place[k + 2]), Math.abs(place[k + 3]), Math.abs(rest[k]), Math.abs(rest[k + 1]));
  }
  vertex(v: number): [number, number] {
    const { vertex, row } = this.mesh;
    return this.point(row[v], vertex[2 * v], vertex[2 * v + 1]);
  }
  isAlive(b: number): boolean {
    return this.rest[4 * b + 3] !== 0;
  }

  /** Of all parts alive. */
  box(): Box {
    const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
    for (let v = 0; v < this.mesh.vertices; ++v) {
      if (!this.isAlive(this.mesh.row[v]) || this.mesh.zoned[this.mesh.row[v]]) continue;
      const [x, y] = this.vertex(v);
      box.x0 = Math.min(box.x0, x);
      box.x1 = Math.max(box.x1, x);
      box.y0 = Math.min(box.y0, y);
      box.y1 = Math.max(box.y1, y);
    }
    return box.x0 <= box.x1 ? box : { x0: -1, y0: -1, x1: 1, y1: 1 };
  }

  /** The part that is drawn at (x, y), or -1: the one whose outline goes round it. `first` is tried before the others. */
  blockAt(x: number, y: number, first = -1): number {
    const { mesh } = this;
    if (first >= 0 && this.isAlive(first)) {
      for (let t = this.trianglesFrom(first); t < mesh.triangles.length && mesh.row[mesh.triangles[t]] === first; t += 3) {
        if (this.covers(t, x, y)) return first;
      }
    }
    for (let t = 0; t < mesh.triangles.length; t += 3) {
      const b = mesh.row[mesh.triangles[t]];
      if (this.isAlive(b) && this.covers(t, x, y)) return b;
    }
    return -1;
  }
  /** Where the triangles of a part begin: they are in the order of the parts. */
  private trianglesFrom(b: number): number {
    const { row, triangles } = this.mesh;
    let [low, high] = [0, triangles.length / 3];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (row[triangles[3 * middle]] < b) low = middle + 1;
      else high = middle;
    }
    return 3 * low;
  }
  private covers(t: number, x: number, y: number): boolean {
    // Most are far away.
    const row = this.mesh.row[this.mesh.triangles[t]];
    const far = 2 * this.mesh.reach[row] * Math.max(1, this.stretch(row));
    if (Math.abs(x - this.place[4 * row]) > far || Math.abs(y - this.place[4 * row + 1]) > far) return false;
    const [a, b, c] = [0, 1, 2].map((k) => this.vertex(this.mesh.triangles[t + k]));
    const side = (p: number[], q: number[]) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    const [s0, s1, s2] = [side(a, b), side(b, c), side(c, a)];
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
  }
}
