#!/usr/bin/env node
// Draws the pictures of docs/view.md: the replay page as a browser shows it.
//   tools/page-pictures.mjs [EDDA] [PACKAGES]      default: build/edda build/page_tests, which the target page_check makes
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');
const { launch, open } = await import(path.join(root, 'tests/view/browser.mjs'));
const edda = path.resolve(process.argv[2] ?? path.join(root, 'build/edda'));
const packages = path.resolve(process.argv[3] ?? path.join(root, 'build/page_tests'));
const folder = mkdtempSync(path.join(os.tmpdir(), 'edda-pictures-'));
const run = (...args) => execFileSync(edda, args, { cwd: folder, stdio: 'ignore' });

/** Name of the picture, the example, and what is done on its page. */
const pictures = [
  ['view-cavern', 'cavern', async (page) => {
    await page.evaluate(() => edda.controls.flipMagnification(edda.results, edda.frame));
    await page.evaluate(() => edda.pick(...edda.pixelOf(...edda.results.run.monitors[0].points[0])));
  }],
  ['view-tunnel', 'tunnel', async (page) => {
    await page.selectOption('#field', 'principal_stress.minor');
    await page.check('#crosses');
    await page.keyboard.press('t');
    await page.mouse.move(400, 430);
    await page.mouse.wheel(0, -600);
  }],
  ['view-pressure', 'tunnel', async (page) => {
    await page.selectOption('#field', 'none');
    await page.check('#forces');
    await page.mouse.move(400, 430);
    await page.mouse.wheel(0, -600);
  }],
  ['view-zones', 'squeezing', async (page) => {
    await page.keyboard.press('End');
    await page.selectOption('#field', 'strength_factor');
    await page.evaluate(() => edda.controls.flipMagnification(edda.results, edda.frame));
    await page.mouse.move(375, 400);
    await page.mouse.wheel(0, -600);
  }],
];

const browser = await launch(packages);
for (const [name, example, arrange] of pictures) {
  if (!existsSync(path.join(folder, `${example}.html`))) {
    run('example', example);
    run('run', `${example}.toml`, '--quiet');
    run('view', example);
  }
  const page = await open(browser, `file://${folder}/${example}.html`, []);
  await arrange(page);
  await page.waitForTimeout(500);
  await page.screenshot({ path: path.join(root, 'docs/figures', `${name}.png`) });
  console.log(`docs/figures/${name}.png`);
  await page.close();
}
await browser.close();
rmSync(folder, { recursive: true, force: true });
