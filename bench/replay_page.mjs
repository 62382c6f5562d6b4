// How fast the replay page draws: frames a second and script a frame, shown one after another as fast as they come.
//   node bench/replay_page.mjs EDDA PACKAGES [BLOCKS ...]      default 2000 20000 100000
// PACKAGES: build/page_tests, which the target page_check makes.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { launch, open } from '../tests/view/browser.mjs';
import { wall } from '../tests/view/wall.mjs';

const [edda, packages] = process.argv.slice(2, 4).map((p) => path.resolve(p));
const sizes = process.argv.length > 4 ? process.argv.slice(4).map(Number) : [2000, 20000, 100000];
const folder = mkdtempSync(path.join(os.tmpdir(), 'edda-rates-'));

/** A wall of about so many bricks, ten frames of it shaking. */
function write(blocks) {
  const rows = Math.round(Math.sqrt(blocks / 2.5));
  const columns = Math.round(blocks / rows);
  const file = path.join(folder, `wall${blocks}.toml`);
  writeFileSync(file, wall({ columns, rows, duration: 0.009, every: 0.001, historyEvery: 0.001 }));
  return file;
}

async function rates(page, seconds) {
  return page.evaluate(async (length) => {
    const { player, frames } = edda;
    player.speed = 0;
    for (let k = 0; k <= player.end; ++k) await frames.want(k);
    const drawn = edda.drawn;
    const start = performance.now();
    edda.scriptTimes.length = 0;
    while (performance.now() - start < 1000 * length) {
      if (!player.playing) player.toggle();
      await new Promise((resolve) => setTimeout(resolve, 5));
    }
    const passed = performance.now() - start;
    const times = [...edda.scriptTimes].sort((a, b) => a - b);
    return { rate: (1000 * (edda.drawn - drawn)) / passed, script: times[times.length >> 1], software: edda.view.software };
  }, seconds);
}

const browser = await launch(packages);
for (const blocks of sizes) {
  const model = write(blocks);
  const name = path.basename(model, '.toml');
  execFileSync(edda, ['run', model, '--quiet'], { cwd: folder, stdio: 'ignore' });
  execFileSync(edda, ['view', name, '--max-size', '1000'], { cwd: folder, stdio: 'ignore' });
  const start = performance.now();
  const page = await open(browser, `file://${folder}/${name}.html`, []);
  const opened = performance.now() - start;
  const runs = [];
  for (let k = 0; k < 3; ++k) runs.push(await rates(page, 4));
  runs.sort((a, b) => a.rate - b.rate);
  const { rate, script, software } = runs[1];
  const size = statSync(path.join(folder, `${name}.html`)).size;
  console.log(`${blocks} blocks: ${rate.toFixed(1)} frames/s, ${script.toFixed(1)} ms of script a frame, opened in ${(opened / 1000).toFixed(1)} s, ` +
    `${(size / 1e6).toFixed(1)} MB for 10 frames${software ? ', drawn by the processor' : ''}`);
  await page.close();
  rmSync(path.join(folder, name), { recursive: true });
}
await browser.close();
rmSync(folder, { recursive: true, force: true });
