// The blocks as they lie in the first frame (mesh_bytes() in src/view/mesh.hpp).
import { Reader } from './reader';

export interface Mesh {
  /** Blocks and vertices. */
  blocks: number;
  vertices: number;
  /** [2 nb] of each block, m. */
  centre: Float64Array;
  /** [2 nv] from the block's centre, m. */
  vertex: Float32Array;
  /** [nb] */
  id: Int32Array;
  material: Int32Array;
  /** [nb + 1] first vertex of each block. */
  begin: Uint32Array;
  /** [nv] block of each vertex. */
  row: Uint32Array;
  /** Three vertices each. */
  triangles: Uint32Array;
  /** Two vertices each, block by block, counter-clockwise. */
  edges: Uint32Array;
  /** [nb + 1] first edge of each block. */
  edgeBegin: Uint32Array;
  /** [nb] 1: held. */
  fixed: Uint8Array;
  /** [nb] farthest that a vertex is from the centre in x or y, m. */
  reach: Float64Array;
  /** [nb] m2 */
  area: Float64Array;
}

export function readMesh(bytes: Uint8Array): Mesh {
  const r = new Reader(bytes);
  const [blocks, vertices, triangles, edges] = [r.u32(), r.u32(), r.u32(), r.u32()];
  const centre = r.f64s(2 * blocks);
  const vertex = r.f32s(2 * vertices);
  const id = new Int32Array(r.u32s(blocks));
  const material = new Int32Array(r.u32s(blocks));
  const begin = r.u32s(blocks + 1);
  const mesh = {
    blocks, vertices, centre, vertex, id, material, begin,
    row: new Uint32Array(vertices),
    triangles: r.u32s(3 * triangles),
    edges: r.u32s(2 * edges),
    edgeBegin: new Uint32Array(blocks + 1),
    fixed: r.take(blocks).slice(),
    reach: new Float64Array(blocks),
    area: new Float64Array(blocks),
  };
  for (let b = 0; b < blocks; ++b) mesh.row.fill(b, begin[b], begin[b + 1]);
  for (let v = 0; v < vertices; ++v) {
    const b = mesh.row[v];
    mesh.reach[b] = Math.max(mesh.reach[b], Math.abs(vertex[2 * v]), Math.abs(vertex[2 * v + 1]));
  }
  const corner = (k: number) => 2 * mesh.triangles[k];
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const [p, q, s] = [corner(t), corner(t + 1), corner(t + 2)];
    const twice = (vertex[q] - vertex[p]) * (vertex[s + 1] - vertex[p + 1]) - (vertex[s] - vertex[p]) * (vertex[q + 1] - vertex[p + 1]);
    mesh.area[mesh.row[mesh.triangles[t]]] += 0.5 * Math.abs(twice);
  }
  for (let e = 0; e < edges; ++e) ++mesh.edgeBegin[mesh.row[mesh.edges[2 * e]] + 1];
  for (let b = 0; b < blocks; ++b) mesh.edgeBegin[b + 1] += mesh.edgeBegin[b];
  return mesh;
}
