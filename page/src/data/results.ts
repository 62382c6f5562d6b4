// Everything of a run but its frames: names, mesh, datums, tables.
import { BoltRows } from './bolts';
import { LiningRows } from './linings';
import { type Motion, readMotion } from './frame';
import { type Mesh, readMesh } from './mesh';
import type { Run } from './run';
import type { Source } from './source';
import { type Table, readTable } from './table';

export interface Stage {
  name: string;
  start: number;
  end: number;
}

export interface Results {
  run: Run;
  mesh: Mesh;
  datums: Motion[];
  history?: Table;
  stages: Stage[];
  bolts: BoltRows;
  linings: LiningRows;
}

export async function readResults(source: Source): Promise<Results> {
  const run = await source.run();
  const bytes = await source.chunk('mesh');
  if (bytes === undefined) throw new Error('the page holds no blocks');
  const results: Results = { run, mesh: readMesh(bytes), datums: [], stages: [], bolts: new BoltRows(undefined), linings: new LiningRows(undefined) };
  await refresh(source, results);
  return results;
}

/** Takes in what has come since. */
export async function refresh(source: Source, results: Results): Promise<void> {
  const text = async (name: string) => {
    const bytes = await source.chunk(name);
    return bytes === undefined || bytes.length === 0 ? undefined : readTable(new TextDecoder().decode(bytes));
  };
  for (let k = results.datums.length; k < results.run.datums; ++k) {
    results.datums.push(readMotion((await source.chunk(`datum-${k}`))!, results.mesh));
  }
  results.history = await text('history.csv');
  results.bolts = new BoltRows(await text('bolts.csv'));
  results.linings = new LiningRows(await text('linings.csv'));
  results.stages = stagesOf(await text('stages.csv'));
}

function stagesOf(table: Table | undefined): Stage[] {
  if (table === undefined) return [];
  const column = (name: string) => table.columns[table.names.indexOf(name)] ?? [];
  const [name, start, end] = [column('name'), column('start'), column('end')];
  return name.map((n, k) => ({ name: String(n) || `stage ${k + 1}`, start: Number(start[k]), end: Number(end[k]) }));
}
