// The blocks as they lie in the first frame (mesh_bytes() in src/view/mesh.hpp). What is drawn are parts: blocks of one
// colour, and the zones of others, each of which moves as a block does. Arrays of parts have those of the blocks first,
// with a place for each block with zones, too: its mean.
import { Reader } from './reader';

export interface Mesh {
  /** Blocks; these and zones; vertices. */
  blocks: number;
  parts: number;
  vertices: number;
  /** [2 np] of each part, m. */
  centre: Float64Array;
  /** [2 nv] from the part's centre, m. */
  vertex: Float32Array;
  /** [np] */
  id: Int32Array;
  material: Int32Array;
  /** [nv] part of each vertex: zones have theirs alone. */
  row: Uint32Array;
  /** [np] block of each part. */
  block: Uint32Array;
  /** [np] 1: a block with zones, which are drawn in its place. */
  zoned: Uint8Array;
  zones: Zones;
  /** Three vertices each. */
  triangles: Uint32Array;
  /** Two vertices each, block by block, counter-clockwise. */
  edges: Uint32Array;
  /** [nb + 1] first edge of each block. */
  edgeBegin: Uint32Array;
  /** [np] 1: held. */
  fixed: Uint8Array;
  /** [np] farthest that a vertex is from the centre in x or y, m. */
  reach: Float64Array;
  /** [np] m2 */
  area: Float64Array;
}

/** How nodes move zones: zone z is part nb + z. */
export interface Zones {
  /** Of blocks with zones, block by block. */
  nodes: number;
  count: number;
  /** [nodes], [count] */
  blockOfNode: Uint32Array;
  blockOfZone: Uint32Array;
  /** [3 count] nodes. */
  corners: Uint32Array;
  /** [6 count] gradients of the three area coordinates, 1/m. */
  gradient: Float64Array;
}

/** As it is packed: `zoned` blocks have their nodes as vertices. */
interface Packed {
  vertex: Float32Array;
  begin: Uint32Array;
  triangles: Uint32Array;
  edges: Uint32Array;
}

export function readMesh(bytes: Uint8Array): Mesh {
  const r = new Reader(bytes);
  const [blocks, vertices, triangles, edges] = [r.u32(), r.u32(), r.u32(), r.u32()];
  const centre = r.f64s(2 * blocks);
  const vertex = r.f32s(2 * vertices);
  const id = new Int32Array(r.u32s(blocks));
  const material = new Int32Array(r.u32s(blocks));
  const packed: Packed = { vertex, begin: r.u32s(blocks + 1), triangles: r.u32s(3 * triangles), edges: r.u32s(2 * edges) };
  const [fixed, zoned] = [r.take(blocks).slice(), r.take(blocks).slice()];
  const row = new Uint32Array(vertices);
  for (let b = 0; b < blocks; ++b) row.fill(b, packed.begin[b], packed.begin[b + 1]);
  const mesh: Mesh = {
    blocks, parts: blocks, vertices, centre, vertex, id, material, fixed, zoned, row,
    block: Uint32Array.from(id, (_, b) => b),
    zones: noZones(),
    triangles: packed.triangles,
    edges: packed.edges,
    edgeBegin: new Uint32Array(blocks + 1),
    reach: new Float64Array(blocks),
    area: new Float64Array(blocks),
  };
  measure(mesh);
  for (let e = 0; e < edges; ++e) ++mesh.edgeBegin[row[mesh.edges[2 * e]] + 1];
  for (let b = 0; b < blocks; ++b) mesh.edgeBegin[b + 1] += mesh.edgeBegin[b];
  if (zoned.includes(1)) divide(mesh, packed);
  return mesh;
}

const noZones = (): Zones => ({ nodes: 0, count: 0, blockOfNode: new Uint32Array(), blockOfZone: new Uint32Array(), corners: new Uint32Array(), gradient: new Float64Array() });

/** Reach and area of all parts. */
function measure(mesh: Mesh): void {
  const { vertex, row, triangles } = mesh;
  for (let v = 0; v < mesh.vertices; ++v) {
    const b = row[v];
    mesh.reach[b] = Math.max(mesh.reach[b], Math.abs(vertex[2 * v]), Math.abs(vertex[2 * v + 1]));
  }
  for (let t = 0; t < triangles.length; t += 3) mesh.area[row[triangles[t]]] += 0.5 * Math.abs(twiceArea(vertex, triangles, t));
}

function twiceArea(vertex: Float32Array, triangles: Uint32Array, t: number): number {
  const [p, q, s] = [0, 1, 2].map((k) => 2 * triangles[t + k]);
  return (vertex[q] - vertex[p]) * (vertex[s + 1] - vertex[p + 1]) - (vertex[s] - vertex[p]) * (vertex[q + 1] - vertex[p + 1]);
}

/** Puts the zones in the place of the blocks that have them. */
function divide(mesh: Mesh, packed: Packed): void {
  const { blocks, zoned } = mesh;
  const { vertex, begin, triangles, edges } = packed;
  const row = mesh.row;
  const isZone = (t: number) => zoned[row[triangles[t]]] === 1;
  const node = new Int32Array(mesh.vertices).fill(-1);
  const blockOfNode: number[] = [];
  for (let b = 0; b < blocks; ++b) {
    for (let v = begin[b]; zoned[b] && v < begin[b + 1]; ++v) node[v] = blockOfNode.push(b) - 1;
  }
  const first: number[] = []; // of the corners of each zone in `triangles`
  for (let t = 0; t < triangles.length; t += 3) if (isZone(t)) first.push(t);
  const count = first.length;
  const parts = blocks + count;
  const grown = <T extends Int32Array | Uint8Array>(of: T, zone: (b: number) => number): T => {
    const all = new (of.constructor as new (n: number) => T)(parts);
    all.set(of);
    first.forEach((t, z) => (all[blocks + z] = zone(row[triangles[t]])));
    return all;
  };
  const zones: Zones = {
    nodes: blockOfNode.length, count,
    blockOfNode: Uint32Array.from(blockOfNode),
    blockOfZone: Uint32Array.from(first, (t) => row[triangles[t]]),
    corners: new Uint32Array(3 * count),
    gradient: new Float64Array(6 * count),
  };
  const centre = new Float64Array(2 * parts);
  centre.set(mesh.centre);
  // Vertices of blocks without zones stay where they are; those of zones come after all others.
  const all = new Float32Array(vertex.length + 6 * count);
  const part = new Uint32Array(mesh.vertices + 3 * count);
  all.set(vertex);
  part.set(row);
  const drawn: number[] = [];
  const ofEdge = new Map<number, number>(); // vertex of a zone at the beginning of its edge from a to b; next: its end
  const key = (a: number, b: number) => a * mesh.vertices + b;
  for (let t = 0; t < triangles.length; t += 3) if (!isZone(t)) drawn.push(triangles[t], triangles[t + 1], triangles[t + 2]);
  first.forEach((t, z) => {
    const p = blocks + z;
    const b = row[triangles[t]];
    const corner = [0, 1, 2].map((k) => triangles[t + k]);
    const at = corner.map((v) => [vertex[2 * v], vertex[2 * v + 1]]);
    const middle = [0, 1].map((i) => (at[0][i] + at[1][i] + at[2][i]) / 3);
    const twice = twiceArea(vertex, triangles, t);
    [0, 1].forEach((i) => (centre[2 * p + i] = mesh.centre[2 * b + i] + middle[i]));
    corner.forEach((v, k) => {
      const own = mesh.vertices + 3 * z + k;
      const [next, after] = [at[(k + 1) % 3], at[(k + 2) % 3]];
      all.set([at[k][0] - middle[0], at[k][1] - middle[1]], 2 * own);
      part[own] = p;
      zones.corners[3 * z + k] = node[v];
      zones.gradient.set([(next[1] - after[1]) / twice, (after[0] - next[0]) / twice], 6 * z + 2 * k);
      drawn.push(own);
      ofEdge.set(key(v, corner[(k + 1) % 3]), own);
    });
  });
  const outline = edges.slice();
  for (let e = 0; e < edges.length; e += 2) {
    const own = ofEdge.get(key(edges[e], edges[e + 1]));
    if (own === undefined) continue;
    outline.set([own, mesh.vertices + 3 * Math.floor((own - mesh.vertices) / 3) + ((own - mesh.vertices + 1) % 3)], e);
  }
  Object.assign(mesh, {
    parts, centre, zones,
    vertices: mesh.vertices + 3 * count,
    vertex: all,
    row: part,
    id: grown(mesh.id, (b) => mesh.id[b]),
    material: grown(mesh.material, (b) => mesh.material[b]),
    fixed: grown(mesh.fixed, (b) => mesh.fixed[b]),
    zoned: grown(mesh.zoned, () => 0),
    block: Uint32Array.from({ length: parts }, (_, p) => (p < blocks ? p : zones.blockOfZone[p - blocks])),
    triangles: Uint32Array.from(drawn),
    edges: outline,
    reach: new Float64Array(parts),
    area: new Float64Array(parts),
  });
  measure({ ...mesh, triangles: Uint32Array.from([...triangles, ...drawn.slice(drawn.length - 3 * count)]) });
}
