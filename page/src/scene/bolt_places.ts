// Where bolts and linings are drawn. Their recorded places are those of the blocks as they are; where displacements
// are drawn larger, bolts go along (as in src/report/layer_bolts.cpp).
import type { Frame, Motion } from '../data/frame';
import type { Mesh } from '../data/mesh';
import { Pose } from './pose';

/** A point of a bolt, or of a lining, whose points follow each other. */
export interface Place {
  chain: string;
  x: number;
  y: number;
}

export class BoltPlaces {
  /** The blocks as they are. */
  private readonly real: Pose;
  private readonly plain: Float32Array;
  /** The blocks in which the nodes were found last: most are still there. */
  private rows: number[] = [];

  constructor(mesh: Mesh) {
    this.real = new Pose(mesh, mesh.parts);
    this.plain = new Float32Array(mesh.parts);
  }

  /** x and y of each node from the scene's origin, in the blocks as `drawn`. */
  of(nodes: Place[], frame: Frame, datum: Motion, magnification: number, drawn: Pose): Float64Array {
    const { real } = this;
    const places = new Float64Array(2 * nodes.length);
    nodes.forEach((node, k) => places.set([node.x - real.origin[0], node.y - real.origin[1]], 2 * k));
    if (magnification === 1 || nodes.length === 0) return places;
    real.set(frame, datum, 1, this.plain);
    const rows = nodes.map((_, k) => real.blockAt(places[2 * k], places[2 * k + 1], this.rows[k]));
    this.rows = rows;
    nodes.forEach((node, k) => {
      // An end that lies on a face, a rounding outside, goes with its neighbour.
      const beside = [k, k + 1, k - 1].find((i) => nodes[i]?.chain === node.chain && rows[i] >= 0);
      if (beside === undefined) return;
      const r = real.inverse(rows[beside], places[2 * k], places[2 * k + 1]);
      places.set(drawn.point(rows[beside], ...r), 2 * k);
    });
    return places;
  }
}
