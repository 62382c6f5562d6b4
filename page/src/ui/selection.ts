// Values of what was clicked. Names are those of blocks.csv.
import { principal } from '../data/fields';
import type { Frame, Motion } from '../data/frame';
import type { Mesh } from '../data/mesh';
import type { Run } from '../data/run';
import { quantity } from '../data/units';
import { byId, make } from './dom';

export interface ValueRow {
  name: string;
  value: number | string;
  unit: string;
}

/** How a zone yields, by number. */
export const yieldsIn = ['no', 'in shear', 'in tension', 'along its foliation'];

/** Of a block or zone `b` at a frame. Positions as they are, whatever the magnification. */
export function valuesOf(run: Run, mesh: Mesh, frame: Frame, datum: Motion, b: number): ValueRow[] {
  const [ux, uy] = [frame.motion[0][b], frame.motion[1][b]];
  const p = principal(frame, b);
  const m = frame.motion.map((column, k) => column[b] + datum[k][b]);
  const rows: [string, number | string, string][] = [
    ['id', String(mesh.id[b]), ''],
    ['material', run.materials[mesh.material[b]] ?? '', ''],
    ['x', mesh.centre[2 * b] + m[0], 'm'],
    ['y', mesh.centre[2 * b + 1] + m[1], 'm'],
    ['area', mesh.area[b] * ((1 + m[2]) * (1 + m[5]) - m[3] * m[4]), 'm\u00b2'],
    ['ux', ux, 'm'],
    ['uy', uy, 'm'],
    ['rotation', frame.rotation[b], 'rad'],
    ['vx', frame.vx[b], 'm/s'],
    ['vy', frame.vy[b], 'm/s'],
    ['omega', frame.omega[b], 'rad/s'],
    ['sxx', frame.sxx[b], 'Pa'],
    ['syy', frame.syy[b], 'Pa'],
    ['szz', frame.szz[b], 'Pa'],
    ['sxy', frame.sxy[b], 'Pa'],
    ['largest principal', p.major, 'Pa'],
    ['smallest principal', p.minor, 'Pa'],
    ['overstress', frame.overstress[b], ''],
  ];
  if (b >= mesh.blocks) {
    rows.push(['plastic_strain', frame.plastic[b], ''], ['strength_factor', frame.strength[b], ''], ['pore_pressure', frame.pore[b], 'Pa'], ['yields', yieldsIn[frame.yields[b]] ?? '', '']);
  }
  return rows.map(([name, value, unit]) => ({ name, value, unit }));
}

/** Digits that a number of the frame has. */
export function digitsOf(frame: Frame): number {
  return frame.bits === 16 ? 4 : 6;
}

export function showValues(title: string, rows: ValueRow[], digits: number): void {
  byId('selection-title').textContent = title;
  byId('selection-hint').hidden = rows.length > 0;
  byId('values').replaceChildren(
    ...rows.map(({ name, value, unit }) => {
      const row = make('tr', '', { 'data-name': name });
      const text = typeof value === 'string' ? value : quantity(value, unit, digits);
      row.append(make('td', name), make('td', text, typeof value === 'number' ? { 'data-value': String(value) } : {}));
      return row;
    }),
  );
}
