// What is drawn over the blocks: strokes of contacts, stresses, motions and bolts.
import type { BoltNode } from '../data/bolts';
import { LONGEST_BEYOND } from '../data/ends';
import { contactValues, isAlongFaces, length as lengthOf, principal } from '../data/fields';
import type { LiningEnd } from '../data/linings';
import type { Contacts, Frame } from '../data/frame';
import type { Mesh } from '../data/mesh';
import type { Scale } from '../data/scale';
import type { Areas } from './areas';
import { endsOf, middleOf, pressureDiagram } from './faces';
import type { Pose } from './pose';
import type { Strokes } from './strokes';

export interface Palette {
  paper: number[];
  ink: number[];
  tension: number[];
  compression: number[];
}

/** Strokes of forces and crosses are never longer than so many usual ones: one blow would cover all others. */
export const LONGEST = 4;
/** Of what sets a stroke off from what lies below, px. */
const RIM = 0.9;
/** States of contacts, by number. */
const FROM_BELOW = [0, 1, 3, 2];

/** A stroke with a rim that sets it off from what lies below. */
function stroke(layer: Strokes, x0: number, y0: number, x1: number, y1: number, width: number, ink: number[], c: Palette): void {
  const [r, g, b] = c.paper;
  layer.add(x0, y0, x1, y1, width, r, g, b, 170, RIM);
  layer.add(x0, y0, x1, y1, width, ink[0], ink[1], ink[2]);
}

/** Force on block i, times `scale`: N into it across the face, and S from end a to end b. */
function forceOn(c: Contacts, k: number, pose: Pose, mesh: Mesh, scale: number): [number, number] {
  const [ax, ay] = pose.vertex(mesh.edges[2 * c.edge[k]]);
  const [bx, by] = pose.vertex(mesh.edges[2 * c.edge[k] + 1]);
  const size = lengthOf(bx - ax, by - ay) || 1;
  const [tx, ty] = [(bx - ax) / size, (by - ay) / size];
  return [scale * (c.normal[k] * ty + c.shear[k] * tx), scale * (-c.normal[k] * tx + c.shear[k] * ty)];
}

/** A stroke through each closed contact along its force; `length`: m of one of the usual force. */
export function drawForces(layer: Strokes, frame: Frame, pose: Pose, mesh: Mesh, usual: number, length: number, c: Palette): void {
  const { contacts } = frame;
  layer.clear(2 * contacts.normal.length);
  for (let k = 0; k < contacts.normal.length && usual > 0; ++k) {
    const size = Math.min(lengthOf(contacts.normal[k], contacts.shear[k]) / usual, LONGEST);
    if (contacts.state[k] === 0 || size <= 1e-3) continue;
    const [x, y] = middleOf(contacts, k, pose, mesh);
    const [dx, dy] = forceOn(contacts, k, pose, mesh, (0.5 * length * size) / lengthOf(contacts.normal[k], contacts.shear[k]));
    stroke(layer, x - dx, y - dy, x + dx, y + dy, 1 + size, contacts.normal[k] < 0 ? c.tension : c.ink, c);
  }
  layer.upload();
}

/** The pressure on each closed face, across it; `height`: m of the usual one; larger ones are cut. `least`: of the length
 * that bears, m. */
export function drawPressures(areas: Areas, rims: Strokes, frame: Frame, pose: Pose, mesh: Mesh, usual: number, height: number, least: number, c: Palette): void {
  const { contacts } = frame;
  areas.clear();
  // Two parts of five points at most.
  rims.clear(8 * contacts.stressA.length);
  for (let k = 0; k < contacts.stressA.length && usual > 0; ++k) {
    if (contacts.state[k] === 0) continue;
    const [a, b] = endsOf(contacts, k, pose, mesh);
    if (contacts.closed[k] * lengthOf(b[0] - a[0], b[1] - a[1]) < least) continue;
    for (const { ring, tension } of pressureDiagram(a, b, contacts.closed[k], contacts.stressA[k], contacts.stressB[k], height / usual, LONGEST_BEYOND * usual)) {
      const [red, green, blue] = tension ? c.tension : c.compression;
      areas.add(ring, [red, green, blue], 110);
      for (let m = 1; m < ring.length; ++m) rims.add(...ring[m - 1], ...ring[m], 1, red, green, blue);
    }
  }
  areas.upload();
  rims.upload();
}

/** A dot on each contact: by its state, or by a field of contacts; a line along it where it is a stress. */
export function drawContacts(layer: Strokes, frame: Frame, pose: Pose, mesh: Mesh, scale: Scale, size: number): void {
  const { contacts } = frame;
  const name = scale.field?.name ?? 'state';
  const values = contactValues(name, contacts) ?? contacts.state;
  const byState = name === 'state' || contactValues(name, contacts) === undefined;
  layer.clear(2 * contacts.count);
  if (isAlongFaces(name)) {
    drawFaces(layer, contacts, values, pose, mesh, scale, size);
    return;
  }
  const from = byState ? scale.states : scale.colours;
  // Contacts of one corner lie on one another: as in pictures open ones below, those that slide on top.
  for (const state of byState ? FROM_BELOW : [undefined]) {
    for (let k = 0; k < contacts.count; ++k) {
      if (byState ? contacts.state[k] !== state : contacts.state[k] === 0 && name.endsWith('force')) continue;
      const [x, y] = middleOf(contacts, k, pose, mesh);
      const step = state ?? scale.step(values[k]);
      if (state === 0) layer.add(x, y, x, y, size, 27, 31, 39);
      layer.add(x, y, x, y, state === 0 ? size - 2 : size, from[3 * step], from[3 * step + 1], from[3 * step + 2]);
    }
  }
  layer.upload();
}

/** Lines along the faces that touch and open ones with a value, the largest values on top. */
function drawFaces(layer: Strokes, contacts: Contacts, values: ArrayLike<number>, pose: Pose, mesh: Mesh, scale: Scale, size: number): void {
  const order = Array.from(contacts.state.keys()).filter((k) => (contacts.state[k] !== 0 || values[k] !== 0) && k < values.length);
  order.sort((a, b) => Math.abs(values[a]) - Math.abs(values[b]));
  const faces = order.map((k) => [...endsOf(contacts, k, pose, mesh).flat(), 3 * scale.step(values[k])]);
  for (const [ax, ay, bx, by] of faces) layer.add(ax, ay, bx, by, size, 27, 31, 39, 255, 1);
  for (const [ax, ay, bx, by, from] of faces) layer.add(ax, ay, bx, by, size, scale.colours[from], scale.colours[from + 1], scale.colours[from + 2]);
  layer.upload();
}

/** Lines along the faces that have broken, those in tension on top. */
export function drawCracks(layer: Strokes, frame: Frame, pose: Pose, mesh: Mesh, c: Palette): void {
  const { contacts } = frame;
  layer.clear(contacts.count);
  for (const [mode, ink] of [[2, c.compression], [1, c.tension]] as const) {
    for (let k = 0; k < contacts.alongA.length; ++k) {
      if (contacts.broken[k] !== mode) continue;
      const [a, b] = endsOf(contacts, k, pose, mesh);
      layer.add(...a, ...b, 3, ink[0], ink[1], ink[2]);
    }
  }
  layer.upload();
}

/** Two strokes along the principal directions of each block or zone; `length`: m of the usual stress. */
export function drawCrosses(layer: Strokes, frame: Frame, pose: Pose, mesh: Mesh, usual: number, length: number, c: Palette): void {
  layer.clear(4 * mesh.parts);
  for (let b = 0; b < mesh.parts && usual > 0; ++b) {
    if (!pose.isAlive(b) || mesh.fixed[b] || mesh.zoned[b]) continue;
    const { major, minor, angle } = principal(frame, b);
    const [x, y] = [pose.place[4 * b], pose.place[4 * b + 1]];
    for (const [stress, at] of [[major, angle], [minor, angle + Math.PI / 2]]) {
      const half = 0.5 * length * Math.min(Math.abs(stress) / usual, LONGEST);
      const [dx, dy] = [half * Math.cos(at), half * Math.sin(at)];
      stroke(layer, x - dx, y - dy, x + dx, y + dy, 1.6, stress > 0 ? c.tension : c.compression, c);
    }
  }
  layer.upload();
}

/** An arrow from the centre of each block or zone; `length`: m of one of `largest`, a few may be longer. */
export function drawArrows(layer: Strokes, x: Float32Array, y: Float32Array, pose: Pose, mesh: Mesh, largest: number, length: number, c: Palette): void {
  layer.clear(2 * mesh.parts);
  for (let b = 0; b < mesh.parts && largest > 0; ++b) {
    if (!pose.isAlive(b) || mesh.zoned[b] || lengthOf(x[b], y[b]) < 1e-3 * largest) continue;
    const [px, py] = [pose.place[4 * b], pose.place[4 * b + 1]];
    const s = length / Math.max(largest, lengthOf(x[b], y[b]) / LONGEST_BEYOND);
    stroke(layer, px, py, px + s * x[b], py + s * y[b], 1.6, c.ink, c);
  }
  layer.upload();
}

/** A force along linings, across them, positive on the side of the wall; `height`: m of the largest. */
export function drawLinings(areas: Areas, rims: Strokes, ends: LiningEnd[], places: Float64Array, largest: number, height: number, c: Palette): void {
  areas.clear();
  rims.clear(ends.length);
  const [red, green, blue] = c.compression;
  for (let k = 0; k + 1 < ends.length && largest > 0; k += 2) {
    const [ax, ay, bx, by] = places.subarray(2 * k, 2 * k + 4);
    const size = lengthOf(bx - ax, by - ay) || 1;
    const [nx, ny] = [(by - ay) / size, (ax - bx) / size];
    const [u, v] = [ends[k].value, ends[k + 1].value].map((value) => (height * value) / largest);
    const [p, q]: [number, number][] = [[ax + u * nx, ay + u * ny], [bx + v * nx, by + v * ny]];
    // Where the sign changes within the piece it is two triangles.
    const s = u / (u - v);
    const zero: [number, number] = [ax + s * (bx - ax), ay + s * (by - ay)];
    const rings = u * v < 0 ? [[[ax, ay], zero, p], [zero, [bx, by], q]] : [[[ax, ay], [bx, by], q, p]];
    for (const ring of rings) areas.add(ring as [number, number][], [red, green, blue], 90);
    rims.add(...p, ...q, 1.5, red, green, blue);
  }
  areas.upload();
  rims.upload();
}

/** Bars of the bolts, thicker and redder where they bear more; `places`: x and y of each node. */
export function drawBolts(layer: Strokes, nodes: BoltNode[], places: Float64Array, c: Palette): void {
  layer.clear(2 * nodes.length);
  for (let k = 0; k + 1 < nodes.length; ++k) {
    const [a, b] = [nodes[k], nodes[k + 1]];
    if (a.chain !== b.chain) continue;
    const used = Math.min(1, Math.max(a.utilisation, b.utilisation));
    const [r, g, blue] = c.ink.map((v, i) => v + used * (c.tension[i] - v));
    const at = [places[2 * k], places[2 * k + 1], places[2 * k + 2], places[2 * k + 3]] as const;
    const width = 2 + 4 * used;
    layer.add(...at, width, c.paper[0], c.paper[1], c.paper[2], 170, RIM);
    layer.add(...at, width, r, g, blue, a.ruptured && b.ruptured ? 70 : 255);
  }
  layer.upload();
}
