// What the tests of the replay page share: pages of two examples, a browser, and hands.
//   node TEST.mjs EDDA PACKAGES      PACKAGES: the folder with node_modules
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before } from 'node:test';
import { launch, open } from './browser.mjs';

export const [edda, packages] = process.argv.slice(2).map((p) => path.resolve(p));
if (!existsSync('/usr/bin/chromium')) {
  console.log('no chromium here: skipped');
  process.exit(77);
}

export const folder = mkdtempSync(path.join(os.tmpdir(), 'edda-page-'));
export const run = (...args) => execFileSync(edda, args, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], env: { ...process.env, OMP_NUM_THREADS: '1' } });
export const table = (file) => {
  const [head, ...rows] = readFileSync(path.join(folder, file), 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(row.map((cell, k) => [head[k], cell])));
};

let browser;
export const faults = [];
export const page = async (name) => open(browser, name.startsWith('http') ? name : `file://${folder}/${name}`, faults);

/** Clicks where a point of the model is drawn. */
export async function clickAt(p, x, y) {
  const [px, py] = await p.evaluate(([a, b]) => edda.pixelOf(a, b), [x, y]);
  const box = await p.locator('#overlay').boundingBox();
  await p.mouse.click(box.x + px, box.y + py);
}
/** What the panel says: name -> { text, value }. */
export const shownValues = (p) =>
  p.$$eval('#values tr', (rows) =>
    Object.fromEntries(rows.map((r) => [r.dataset.name, { text: r.cells[1].textContent, value: Number(r.cells[1].dataset.value) }])));
/** Until the frame that was asked for is drawn. */
export const settled = (p) => p.waitForFunction(() => !edda.stale && !edda.overlayStale && edda.shown === edda.player.index);
export const choose = (p, id, value) => p.locator(`#${id}`).selectOption(value);
before(async () => {
  run('example', 'cavern');
  run('run', 'cavern.toml', '--quiet');
  run('view', 'cavern');
  run('example', 'tunnel');
  run('run', 'tunnel.toml', '--quiet');
  run('view', 'tunnel');
  browser = await launch(packages);
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});
