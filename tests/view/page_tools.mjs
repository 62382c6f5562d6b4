// What the tests of the replay page share: pages of two examples, a browser, and hands.
//   node TEST.mjs EDDA PACKAGES      PACKAGES: the folder with node_modules
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before } from 'node:test';
import { pathToFileURL } from 'node:url';
import { blank as blankOf, launch, open } from './browser.mjs';

export const [edda, packages] = process.argv.slice(2).map((p) => path.resolve(p));
if (!existsSync('/usr/bin/chromium')) {
  console.log('no chromium here: skipped');
  process.exit(77);
}

export const folder = mkdtempSync(path.join(os.tmpdir(), 'edda-page-'));
export const run = (...args) => execFileSync(edda, args, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], timeout: 120000, env: { ...process.env, OMP_NUM_THREADS: '1' } });
/** edda, beside the test `t`, and never longer. */
export function start(t, args, stdout = 'ignore') {
  const child = spawn(edda, args, { cwd: folder, stdio: ['ignore', stdout, 'inherit'] });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const kill = () => child.kill('SIGKILL');
  process.on('exit', kill);
  t.after(async () => {
    kill();
    await ended;
    process.off('exit', kill);
  });
  return { child, ended };
}
/** The address of a server of results in `name`, for the test `t`. */
export async function serve(t, name) {
  const { child, ended } = start(t, ['view', name, '--serve', '--port', '0'], 'pipe');
  const address = new Promise((resolve) => child.stdout.on('data', (text) => resolve(/http:\S+/.exec(String(text))[0])));
  return { server: child, ended, address: await within(Promise.race([address, ended]), 'an address') };
}
/** What is waited for, or a failure that names it. */
export async function within(promise, what, seconds = 60) {
  let timer;
  const late = new Promise((_, reject) => (timer = setTimeout(() => reject(new Error(`${what}: not within ${seconds} s`)), 1000 * seconds)));
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}
export async function until(holds, what, seconds = 60) {
  const end = Date.now() + 1000 * seconds;
  while (!holds()) {
    if (Date.now() > end) throw new Error(`${what}: not within ${seconds} s`);
    await new Promise((r) => setTimeout(r, 20));
  }
}
export const table = (file) => {
  const [head, ...rows] = readFileSync(path.join(folder, file), 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(row.map((cell, k) => [head[k], cell])));
};

let browser;
export const faults = [];
export const page = async (name) => open(browser, name.startsWith('http') ? name : pathToFileURL(path.join(folder, name)).href, faults);

export const blank = async () => blankOf(browser, faults);

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
/** Chooses, and waits until what is drawn follows. */
export async function choose(p, id, value) {
  await p.locator(`#${id}`).selectOption(value);
  await settled(p);
}
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
