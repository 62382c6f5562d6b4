// One frame, as numbers (frame_bytes() in src/view/frame.cpp says how it is packed). Columns are by
// part of the mesh, zero where a block is gone.
import type { Zones } from './mesh';
import { Reader } from './reader';

/** u(X) = d + A (X - c) of each part: columns d.x d.y A.xx A.xy A.yx A.yy. */
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
  /** What has broken it: 0 nothing, 1 tension, 2 shear. */
  broken: Uint8Array;
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
  /** Part of the strength that is lost. */
  damage: Float32Array;
  /** Where water flows through joints, else of nothing: Pa, m, m2/s from a to b, m. */
  waterPressure: Float32Array;
  head: Float32Array;
  discharge: Float32Array;
  aperture: Float32Array;
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
  /** Empty without zones. */
  plastic: Float32Array;
  strength: Float32Array;
  pore: Float32Array;
  yields: Float32Array;
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

export function readMotion(bytes: Uint8Array, mesh: Beginnings): Motion {
  const columns = new Columns(new Reader(bytes), 32);
  const { blocks, zones } = mesh;
  const motion = [...columns.group(2, blocks), ...columns.group(4, blocks)];
  return withZones(motion, columns.group(2, zones.nodes), mesh);
}

/** What is needed of the mesh. */
export interface Beginnings {
  blocks: number;
  edgeBegin: Uint32Array;
  reach: Float64Array;
  zones: Zones;
}

/** The motion of all parts: zones by their nodes. */
function withZones(ofBlocks: Motion, [ux, uy]: Float32Array[], { blocks, zones }: Beginnings): Motion {
  if (zones.count === 0) return ofBlocks;
  const motion = ofBlocks.map((column) => grown(column, zones));
  const { corners, gradient } = zones;
  for (let z = 0; z < zones.count; ++z) {
    const p = blocks + z;
    for (let k = 0; k < 3; ++k) {
      const [x, y] = [ux[corners[3 * z + k]], uy[corners[3 * z + k]]];
      const [gx, gy] = [gradient[6 * z + 2 * k], gradient[6 * z + 2 * k + 1]];
      [x / 3, y / 3, x * gx, x * gy, y * gx, y * gy].forEach((part, c) => (motion[c][p] += part));
    }
  }
  return motion;
}

/** Of all parts, from what the blocks have and what the zones get. */
function grown(ofBlocks: Float32Array, zones: Zones, ofZone?: (z: number) => number): Float32Array {
  const blocks = ofBlocks.length;
  const all = new Float32Array(blocks + zones.count);
  all.set(ofBlocks);
  if (ofZone !== undefined) for (let z = 0; z < zones.count; ++z) all[blocks + z] = ofZone(z);
  return all;
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
  const none = new Float32Array(0);
  const frame = { bits, alive, datum, motion, vx, vy, omega, rotation, sxx, syy, szz, sxy, overstress, plastic: none, strength: none, pore: none, yields: none };
  if (mesh.zones.count > 0) readZones(r, columns, frame, mesh);
  return { ...frame, contacts: readContacts(r, columns, touching, mesh) };
}

/** Values of rock that has no zones. */
const NO_ZONE = { plastic: 0, strength: NaN, pore: 0, yields: 0 };

/** Makes columns of blocks those of all parts. */
function readZones(r: Reader, columns: Columns, f: Omit<Frame, 'contacts'>, mesh: Beginnings): void {
  const { zones, blocks } = mesh;
  const nodeAlive = Uint8Array.from(zones.blockOfNode, (b) => f.alive[b]);
  const zoneAlive = Uint8Array.from(zones.blockOfZone, (b) => f.alive[b]);
  const count = (flags: Uint8Array) => flags.reduce((n, is) => n + is, 0);
  const ofNodes = () => columns.group(2, count(nodeAlive)).map((c) => spread(c, nodeAlive));
  const ofZones = (n: number) => columns.group(n, count(zoneAlive)).map((c) => spread(c, zoneAlive));
  f.motion = withZones(f.motion, ofNodes(), mesh);
  for (const [name, of] of ofNodes().map((c, k) => [k === 0 ? 'vx' : 'vy', c] as const)) {
    const [corners] = [zones.corners];
    f[name] = grown(f[name], zones, (z) => (of[corners[3 * z]] + of[corners[3 * z + 1]] + of[corners[3 * z + 2]]) / 3);
  }
  const put = (name: 'sxx' | 'syy' | 'szz' | 'sxy' | 'plastic' | 'strength' | 'pore' | 'yields', of: ArrayLike<number>) => {
    const ofBlocks = name in NO_ZONE ? new Float32Array(blocks).fill(NO_ZONE[name as keyof typeof NO_ZONE]) : f[name];
    f[name] = grown(ofBlocks, zones, (z) => of[z]);
  };
  ofZones(4).forEach((c, k) => put((['sxx', 'syy', 'szz', 'sxy'] as const)[k], c));
  put('plastic', ofZones(1)[0]);
  put('strength', ofZones(1)[0].map((v) => (v < 0 ? NaN : v)));
  put('pore', ofZones(1)[0]);
  put('yields', spread(Float32Array.from(r.take(count(zoneAlive))), zoneAlive));
  for (const name of ['omega', 'rotation', 'overstress'] as const) {
    const ofBlocks = f[name];
    f[name] = grown(ofBlocks, zones, (z) => ofBlocks[zones.blockOfZone[z]]);
  }
  const alive = new Uint8Array(blocks + zones.count);
  alive.set(f.alive);
  alive.set(zoneAlive, blocks);
  f.alive = alive;
}

/** Values of those alive, by number. */
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
  const [state, broken] = [r.take(count).slice(), r.take(count).slice()];
  const some = r.left > 0;
  const group = (n: number) => (some ? columns.group(n, count) : Array.from({ length: n }, () => new Float32Array(0)));
  const [alongA, alongB, closed] = group(3);
  const [normal, shear] = group(2);
  const [opening] = group(1);
  const [slip] = group(1);
  const [stressA, stressB] = group(2);
  const [normalStress] = group(1);
  const [shearStress] = group(1);
  const [damage] = group(1);
  const wet = r.left > 0;
  const [waterPressure, head, discharge, aperture] = Array.from({ length: 4 }, () => (wet ? group(1)[0] : new Float32Array(0)));
  return { count, i, j, edge, alongA, alongB, closed, state, broken, normal, shear, opening, slip, stressA, stressB, normalStress, shearStress, damage, waterPressure, head, discharge, aperture };
}

/** The arrays behind a frame, to hand over without a copy. */
export function buffersOf(frame: Frame): ArrayBuffer[] {
  const { contacts, motion, bits: _bits, datum: _datum, ...columns } = frame;
  const { count: _count, ...touching } = contacts;
  const arrays = [...motion, ...Object.values(columns), ...Object.values(touching)];
  return [...new Set(arrays.map((a) => a.buffer as ArrayBuffer))].filter((b) => b.byteLength > 0);
}
