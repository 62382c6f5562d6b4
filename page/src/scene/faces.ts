// Faces between blocks: where they are drawn, and the pressure on them, as in pictures (src/report/faces.cpp).
import { length } from '../data/fields';
import type { Contacts } from '../data/frame';
import type { Mesh } from '../data/mesh';
import type { Pose } from './pose';

export type Point = [number, number];

/** Ends of the overlap of contact k. */
export function endsOf(c: Contacts, k: number, pose: Pose, mesh: Mesh): [Point, Point] {
  const [px, py] = pose.vertex(mesh.edges[2 * c.edge[k]]);
  const [qx, qy] = pose.vertex(mesh.edges[2 * c.edge[k] + 1]);
  const at = (s: number): Point => [px + s * (qx - px), py + s * (qy - py)];
  return [at(c.alongA[k]), at(c.alongB[k])];
}

export function middleOf(c: Contacts, k: number, pose: Pose, mesh: Mesh): Point {
  const [[ax, ay], [bx, by]] = endsOf(c, k, pose, mesh);
  return [0.5 * (ax + bx), 0.5 * (ay + by)];
}

/** Part of the diagram of a face, all in compression or all in tension: from the face out and back to it. */
export interface PressureArea {
  ring: Point[];
  tension: boolean;
}

/** Across the face: upwards, of a steep one to the left, so that parallel joints have their diagrams on the same side. */
function upperSide(tx: number, ty: number): Point {
  return 0.3 * ty + tx < 0 ? [ty, -tx] : [-ty, tx];
}

/** The diagram of the pressure on a face: a trapezoid, or a triangle over `closed` of it where one end is open. Pressures
 * in Pa, compression positive; `perUnit`: m per Pa; larger ones than `most` are cut there. */
export function pressureDiagram([ax, ay]: Point, [bx, by]: Point, closed: number, pressureA: number, pressureB: number, perUnit: number, most: number): PressureArea[] {
  const size = length(bx - ax, by - ay);
  if (!(size > 0) || (pressureA === 0 && pressureB === 0)) return [];
  const [nx, ny] = upperSide((bx - ax) / size, (by - ay) / size);
  const from = { along: pressureA === 0 ? 1 - closed : 0, pressure: pressureA };
  const to = { along: pressureB === 0 ? closed : 1, pressure: pressureB };
  const stations = [from, to];
  for (const level of [0, most, -most]) {
    const [before, behind] = [from.pressure - level, to.pressure - level];
    if (before * behind < 0) stations.push({ along: from.along + (before / (before - behind)) * (to.along - from.along), pressure: level });
  }
  stations.sort((p, q) => p.along - q.along);
  const areas: PressureArea[] = [];
  let area: PressureArea = { ring: [], tension: false };
  stations.forEach(({ along, pressure }, k) => {
    const foot: Point = [ax + along * (bx - ax), ay + along * (by - ay)];
    if (k === 0) area.ring = [foot];
    if (pressure !== 0) {
      const height = perUnit * Math.max(-most, Math.min(most, pressure));
      area.ring.push([foot[0] + height * nx, foot[1] + height * ny]);
      area.tension = pressure < 0;
    }
    if (k === 0 || (pressure !== 0 && k + 1 < stations.length)) return;
    area.ring.push(foot);
    areas.push(area);
    area = { ring: [foot], tension: area.tension };
  });
  return areas;
}
