// One frame, as numbers (frame_bytes() in src/view/frame.cpp says how it is packed). Columns are by
// row of the mesh, zero where a block is gone.
import { Reader } from './reader';

/** u(X) = d + A (X - c) of each block: columns d.x d.y A.xx A.xy A.yx A.yy. */
export type Motion = Float32Array[];

export interface Contacts {
  count: number;
  /** Rows of the mesh. */
  i: Uint32Array;
  j: Uint32Array;
  /** Edge of block j, of the mesh; where on it the ends of the overlap lie, 0 to 1; part of the overlap that bears. On the
   * way from a to b block j lies on the left. */
  edge: Uint32Array;
  alongA: Float32Array;
  alongB: Float32Array;
  closed: Float32Array;
  /** 0 open, 1 stick, 2 slide, 3 bonded. */
  state: Uint8Array;
  /** N; compression positive. */
  normal: Float32Array;
  shear: Float32Array;
  /** m */
  opening: Float32Array;
  slip: Float32Array;
  /** Pa, compression positive: at the ends, and the mean over the overlap. */
  stressA: Float32Array;
  stressB: Float32Array;
  normalStress: Float32Array;
  shearStress: Float32Array;
}

export interface Frame {
  /** Bits that a number was stored in. */
  bits: number;
  alive: Uint8Array;
  datum: number;
  /** Displacement since the datum, m. */
  motion: Motion;
  /** m/s */
  vx: Float32Array;
  vy: Float32Array;
  /** rad/s */
  omega: Float32Array;
  /** rad */
  rotation: Float32Array;
  /** Pa, tension positive. */
  sxx: Float32Array;
  syy: Float32Array;
  szz: Float32Array;
  sxy: Float32Array;
  overstress: Float32Array;
  contacts: Contacts;
}

class Columns {
  constructor(private readonly r: Reader, private readonly bits: number) {}

  group(columns: number, count: number): Float32Array[] {
    const scale = this.bits === 16 ? this.r.f32() : 1;
    const read = () => (this.bits === 16 ? this.r.whole16(count, scale) : this.r.single(count));
    return Array.from({ length: columns }, read);
  }
}

export function readMotion(bytes: Uint8Array, blocks: number): Motion {
  const columns = new Columns(new Reader(bytes), 32);
  return [...columns.group(2, blocks), ...columns.group(4, blocks)];
}

/** Of the mesh: where the edges of each block begin, [nb + 1], and its reach. */
export interface Beginnings {
  edgeBegin: Uint32Array;
  reach: Float64Array;
}

export function readFrame(bytes: Uint8Array, mesh: Beginnings): Frame {
  const r = new Reader(bytes);
  const [bits, blocks, count, datum, touching] = [r.u32(), r.u32(), r.u32(), r.u32(), r.u32()];
  const flags = r.take(Math.ceil(blocks / 8));
  const alive = new Uint8Array(blocks);
  for (let b = 0; b < blocks; ++b) alive[b] = (flags[b >> 3] >> (b & 7)) & 1;

  const columns = new Columns(r, bits);
  const group = (n: number) => columns.group(n, count).map((c) => spread(c, alive));
  const motion = [...group(2), ...group(4)];
  // With 16 bits A is times the block's reach.
  if (bits === 16) for (const a of motion.slice(2)) for (let b = 0; b < blocks; ++b) a[b] /= mesh.reach[b];
  const [vx, vy] = group(2);
  const [omega] = group(1);
  const [rotation] = group(1);
  const [sxx, syy, szz, sxy] = group(4);
  const [overstress] = group(1);
  const contacts = readContacts(r, columns, touching, mesh);
  return { bits, alive, datum, motion, vx, vy, omega, rotation, sxx, syy, szz, sxy, overstress, contacts };
}

/** Values of the blocks alive, by row. */
function spread(values: Float32Array, alive: Uint8Array): Float32Array {
  if (values.length === alive.length) return values;
  const all = new Float32Array(alive.length);
  for (let b = 0, k = 0; b < alive.length; ++b) if (alive[b]) all[b] = values[k++];
  return all;
}

function readContacts(r: Reader, columns: Columns, count: number, mesh: Beginnings): Contacts {
  const [i, j, edge] = Array.from({ length: 3 }, () => new Uint32Array(count));
  for (let k = 0, row = 0; k < count; ++k) i[k] = row += r.varint();
  for (let k = 0; k < count; ++k) j[k] = i[k] + r.zigzag();
  for (let k = 0; k < count; ++k) edge[k] = mesh.edgeBegin[j[k]] + r.varint();
  const state = r.take(count).slice();
  const some = r.left > 0;
  const group = (n: number) => (some ? columns.group(n, count) : Array.from({ length: n }, () => new Float32Array(0)));
  const [alongA, alongB, closed] = group(3);
  const [normal, shear] = group(2);
  const [opening] = group(1);
  const [slip] = group(1);
  const [stressA, stressB] = group(2);
  const [normalStress] = group(1);
  const [shearStress] = group(1);
  return { count, i, j, edge, alongA, alongB, closed, state, normal, shear, opening, slip, stressA, stressB, normalStress, shearStress };
}

/** The arrays behind a frame, to hand over without a copy. */
export function buffersOf(frame: Frame): ArrayBuffer[] {
  const { contacts, motion, bits: _bits, datum: _datum, ...columns } = frame;
  const { count: _count, ...touching } = contacts;
  const arrays = [...motion, ...Object.values(columns), ...Object.values(touching)];
  return [...new Set(arrays.map((a) => a.buffer as ArrayBuffer))].filter((b) => b.byteLength > 0);
}
