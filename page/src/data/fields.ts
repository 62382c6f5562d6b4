// Fields by name: one number per part (block or zone) or contact of a frame. The names, labels and units are those
// of edda plot; the run's header lists them.
import type { Contacts, Frame } from './frame';
import type { Mesh } from './mesh';

export interface Principal {
  /** Larger and smaller stress in the plane, Pa, tension positive. */
  major: number;
  minor: number;
  /** Of the larger one, rad from +x. */
  angle: number;
}

export function principal(f: Frame, b: number): Principal {
  const mean = 0.5 * (f.sxx[b] + f.syy[b]);
  const half = 0.5 * (f.sxx[b] - f.syy[b]);
  const radius = Math.sqrt(half * half + f.sxy[b] * f.sxy[b]);
  return { major: mean + radius, minor: mean - radius, angle: 0.5 * Math.atan2(f.sxy[b], half) };
}

/** Math.hypot guards against overflow, at ten times the price. */
export const length = (x: number, y: number) => Math.sqrt(x * x + y * y);

type OfBlock = (f: Frame, b: number, mesh: Mesh) => number;

const ofBlocks: Record<string, OfBlock> = {
  id: (_, b, mesh) => mesh.id[b],
  material: (_, b, mesh) => mesh.material[b],
  displacement: (f, b) => length(f.motion[0][b], f.motion[1][b]),
  'displacement.x': (f, b) => f.motion[0][b],
  'displacement.y': (f, b) => f.motion[1][b],
  velocity: (f, b) => length(f.vx[b], f.vy[b]),
  'velocity.x': (f, b) => f.vx[b],
  'velocity.y': (f, b) => f.vy[b],
  rotation: (f, b) => (f.rotation[b] * 180) / Math.PI,
  stress: (f, b) => 0.5 * (f.sxx[b] + f.syy[b]),
  'stress.xx': (f, b) => f.sxx[b],
  'stress.yy': (f, b) => f.syy[b],
  'stress.zz': (f, b) => f.szz[b],
  'stress.xy': (f, b) => f.sxy[b],
  principal_stress: (f, b) => principal(f, b).minor,
  'principal_stress.major': (f, b) => principal(f, b).major,
  'principal_stress.minor': (f, b) => principal(f, b).minor,
  overstress: (f, b) => f.overstress[b],
  plastic_strain: (f, b) => f.plastic[b],
  yields: (f, b) => f.yields[b],
  strength_factor: (f, b) => f.strength[b],
  pore_pressure: (f, b) => f.pore[b],
};

const ofContacts: Record<string, (c: Contacts) => ArrayLike<number>> = {
  normal_force: (c) => c.normal,
  shear_force: (c) => c.shear,
  opening: (c) => c.opening,
  slip: (c) => c.slip,
  state: (c) => c.state,
  normal_stress: (c) => c.normalStress,
  shear_stress: (c) => c.shearStress,
  damage: (c) => c.damage,
  water_pressure: (c) => c.waterPressure,
  head: (c) => c.head,
  discharge: (c) => c.discharge.map(Math.abs),
  aperture: (c) => c.aperture,
};
/** Drawn as lines along the faces; the others as dots. */
const alongFaces = ['normal_stress', 'shear_stress', 'damage', 'water_pressure', 'head', 'discharge', 'aperture'];

/** A field's label without its sign convention, where there is no room for it. */
export const withoutSign = (label: string) => label.replace(/ \((tension|compression) positive\)$/, '');

export const isAlongFaces = (name: string) => alongFaces.includes(name);

export function isKnown(name: string): boolean {
  return name in ofBlocks || name in ofContacts;
}

/** Of block `b`; NaN where the field is none of blocks. */
export function blockValue(name: string, f: Frame, b: number, mesh: Mesh): number {
  return ofBlocks[name]?.(f, b, mesh) ?? NaN;
}

/** Of all parts, into `values`. */
export function blockValues(name: string, f: Frame, mesh: Mesh, values: Float32Array): void {
  const value = ofBlocks[name];
  if (value === undefined) {
    values.fill(NaN);
    return;
  }
  for (let b = 0; b < mesh.parts; ++b) values[b] = value(f, b, mesh);
}

export function contactValues(name: string, c: Contacts): ArrayLike<number> | undefined {
  return ofContacts[name]?.(c);
}
