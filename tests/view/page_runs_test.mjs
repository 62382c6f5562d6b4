// The replay page of runs of many kinds, in a real browser: going on, older, large, with checks that fail.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync, renameSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { blank, choose, clickAt, faults, folder, page, run, serve, settled, shownValues, start, table, until, within } from './page_tools.mjs';
import { wall } from './wall.mjs';

test('says of numbers that older frames have not that there are none', async () => {
  const old = path.join(folder, 'cavern', 'frames');
  const changed = readdirSync(old).filter((f) => f.startsWith('blocks_')).map((f) => path.join(old, f));
  const kept = changed.map((f) => readFileSync(f));
  changed.forEach((f, k) => writeFileSync(f, Buffer.from(kept[k].toString('latin1').replace('Name="omega"', 'Name="omegx"'), 'latin1')));
  run('view', 'cavern', '-o', 'old.html');
  changed.forEach((f, k) => writeFileSync(f, kept[k]));
  const p = await page('old.html');
  const row = table('cavern/blocks.csv')[20];
  await clickAt(p, Number(row.x), Number(row.y));
  const shown = await shownValues(p);
  assert.equal(shown.omega.text, '\u2013');
  assert.ok(Number.isFinite(shown.rotation.value));
  await p.close();
});

test('reads names in quotes, whatever they hold', async () => {
  const file = path.join(folder, 'tunnel/stages.csv');
  const kept = readFileSync(file, 'utf8');
  const [head, first, ...others] = kept.split('\n');
  const cells = first.split(',');
  const name = head.split(',').indexOf('name');
  cells[name] = '"top, ""heading""\nand more"';
  writeFileSync(file, [head, cells.join(','), ...others].join('\n'));
  run('view', 'tunnel', '-o', 'quoted.html');
  writeFileSync(file, kept);
  const p = await page('quoted.html');
  const stages = await p.evaluate(() => edda.results.stages);
  assert.equal(stages.length, others.length);
  assert.equal(stages[0].name, 'top, "heading"\nand more');
  assert.ok(stages.every((s) => s.end > s.start));
  await p.close();
});

test('follows a run that goes on', async (t) => {
  run('example', 'rockfall');
  const going = start(t, ['run', 'rockfall.toml', '--quiet', '--set', 'solver.safety=0.01', '--set', 'output.every=0.05']);
  await until(() => existsSync(path.join(folder, 'rockfall/blocks.pvd')), 'the first frame');
  going.child.kill('SIGSTOP');  // until the page has shown it, however slow the machine
  const { server, ended, address } = await serve(t, 'rockfall');
  const p = await page(address);
  const first = await p.evaluate(() => edda.results.run.frames.length);
  going.child.kill('SIGCONT');
  await p.waitForFunction((n) => edda.results.run.frames.length > n, first, { timeout: 60000 });
  assert.equal(await within(going.ended, 'the end of the run', 120), 0);
  await p.waitForFunction(() => !document.getElementById('status').textContent.startsWith('going on'), null, { timeout: 60000 });
  const rows = table('rockfall/blocks.csv');
  await settled(p);
  assert.equal(await p.evaluate(() => edda.player.index === edda.player.end), true, 'stays at the end');
  await p.waitForFunction(() => !edda.stale);
  const [high, range] = await p.evaluate(async () => [edda.scale.high, (await edda.source.run()).fields.find((f) => f.name === 'displacement').drawn]);
  assert.equal(high, range[1], 'the colours reach as far as the values of all frames');
  const row = rows[rows.length - 1];
  await p.keyboard.press('f');
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  await clickAt(p, Number(row.x), Number(row.y));
  const shown = await shownValues(p);
  assert.equal(shown.id.text, row.id);
  assert.ok(Math.abs(shown.ux.value - Number(row.ux)) <= 1e-6 * Math.abs(Number(row.ux)) + 1e-12);
  // The same model once more, shorter, in the same folder.
  await p.evaluate(() => Object.assign(window, { earlier: true }));
  run('run', 'rockfall.toml', '--quiet', '--set', 'solver.duration=0.2', '--set', 'output.every=0.1');
  await p.waitForFunction(() => window.earlier === undefined && window.edda?.drawn > 0, null, { timeout: 60000 });
  assert.equal(await p.evaluate(() => edda.results.run.frames.length), 3);
  await p.close();
  server.kill('SIGINT');
  assert.equal(await within(ended, 'the end of the server'), 0);
});

test('waits quietly while the folder has nothing to show', async (t) => {
  run('run', 'cavern.toml', '--quiet', '-o', 'served');
  const { address } = await serve(t, 'served');
  const p = await page(address);
  await p.evaluate(() => Object.assign(window, { earlier: true }));
  const [here, away] = ['served/blocks.pvd', 'away'].map((name) => path.join(folder, name));
  const waits = (q) => q.waitForFunction(() => document.getElementById('status').textContent.startsWith('waiting: '));
  renameSync(here, away);
  await waits(p);
  // Frames and tables that are asked for meanwhile: they come later, and nobody is told of an error.
  await p.keyboard.press('End');
  assert.equal(await p.evaluate(() => edda.source.chunk('mesh').catch((error) => error.message)), 'the folder holds another run now');
  assert.ok(await p.locator('#fault').isHidden());
  const other = await blank();
  await other.goto(address);
  await waits(other);
  await other.waitForTimeout(1500);
  assert.ok(await other.locator('#fault').isHidden());
  renameSync(away, here);
  await p.waitForFunction(() => window.earlier === undefined && window.edda?.drawn > 0);
  await other.waitForFunction(() => window.edda?.drawn > 0);
  assert.doesNotMatch(await p.textContent('#status'), /waiting/);
  await p.close();
  await other.close();
});

test('small pages are kept small, and still end with exact values', async () => {
  writeFileSync(path.join(folder, 'wall.toml'), wall({ columns: 60, rows: 33, duration: 0.2, every: 0.001, historyEvery: 0.01 }));
  run('run', 'wall.toml', '--quiet');
  const said = run('view', 'wall');
  const [, frames, size] = /(\d+) frames, ([\d.]+) MB/.exec(said);
  assert.equal(frames, '201');
  assert.ok(Number(size) < 20, `${size} MB for 200 frames of 2,000 blocks`);
  assert.match(said, /1\/65534/);
  assert.match(said, /1\/4094/);
  const p = await page('wall.html');
  const row = table('wall/blocks.csv')[1500];
  await clickAt(p, Number(row.x), Number(row.y));
  const shown = await shownValues(p);
  for (const name of ['ux', 'uy', 'sxx', 'syy', 'vx']) {
    assert.ok(Math.abs(shown[name].value - Number(row[name])) <= 3e-7 * Math.abs(Number(row[name])) + 1e-30, name);
  }
  run('view', 'wall', '-o', 'thin.html', '--max-size', '2');
  const thin = await page('thin.html');
  const times = await thin.evaluate(() => edda.results.run.frames);
  assert.ok(times.length < 60 && times[0] === 0 && Math.abs(times[times.length - 1] - 0.2) < 1e-12);
  await p.close();
  await thin.close();
});

/** A slab that is thrown up from soft ground and comes back, with a pebble on it, and a block that nothing holds. */
const thrown = (pebble, loose) => `
  title = "thrown"
  [materials.rock]
  density = 2500.0
  young = 1e9
  poisson = 0.2
  [joints.bed]
  friction_angle = 30.0
  [contact]
  normal_stiffness = 1e7
  [[block]]
  name = "ground"
  fixed = true
  polygon = [[-1, -1], [12, -1], [12, 0], [-1, 0]]
  [[block]]
  name = "slab"
  velocity = [0, 2.5]
  polygon = [[0, 0], [10, 0], [10, 4], [0, 4]]
  [[block]]
  name = "pebble"
  velocity = [0, ${pebble}]
  polygon = [[11, 0], [11.1, 0], [11.1, 0.1], [11, 0.1]]
  ${loose}
  [[monitor]]
  name = "pebble"
  point = [11.05, 0.05]
  [[monitor]]
  name = "border"
  point = [5, 0]
  [solver]
  duration = 1.2
  damping = { contact = 0.7, local = 0.1 }
  [output]
  every = 0.05`;

test('opens with colours in which the last frame can be read', async () => {
  writeFileSync(path.join(folder, 'thrown.toml'), thrown(0, ''));
  run('run', 'thrown.toml', '--quiet');
  run('view', 'thrown');
  const p = await page('thrown.html');
  const field = await p.evaluate(() => edda.controls.field);
  const rows = table('thrown/blocks.csv').filter((row) => row.name !== 'ground').map((row) => Math.hypot(row.ux, row.uy));
  assert.ok(field.range[1] > 0.25, 'thrown by more than 0.2 m');
  assert.ok(Math.abs(field.last[1] - Math.max(...rows)) < 1e-6 && field.last[1] < 0.1);
  assert.equal(await p.inputValue('#range'), 'last');
  assert.equal(await p.evaluate(() => edda.scale.high), field.last[1]);
  // Of velocities nothing stays that would be looked at; what somebody has chosen stays.
  await choose(p, 'field', 'velocity');
  assert.equal(await p.inputValue('#range'), 'run');
  await choose(p, 'range', 'frame');
  await choose(p, 'field', 'displacement');
  assert.equal(await p.inputValue('#range'), 'frame');
  await p.close();
  const calm = await page('cavern.html');
  assert.equal(await calm.inputValue('#range'), 'run');
  await calm.close();
});

test('rings small blocks and does not hide them', async () => {
  const p = await page('thrown.html');
  const place = await p.evaluate(() => edda.pixelOf(11.05, 0.05));
  const painted = await p.evaluate(([x, y]) => {
    const canvas = document.getElementById('overlay');
    const ratio = canvas.width / edda.view.camera.width;
    const { data } = canvas.getContext('2d').getImageData(Math.round(x * ratio), Math.round(y * ratio), Math.round(14 * ratio), 1);
    return Array.from({ length: 14 }, (_, dx) => data[4 * Math.round(dx * ratio) + 3]);
  }, place);
  const size = 0.1 * (await p.evaluate(() => edda.view.camera.scale));
  for (let dx = 0; dx < 0.5 * size; ++dx) assert.equal(painted[dx], 0, `${dx} px from its middle`);
  assert.ok(Math.max(...painted) === 255, 'the ring');
  // On a border the monitor goes with the block that moves, as in the program.
  assert.equal(await p.evaluate(() => edda.results.mesh.id[edda.overlay.monitors.find((m) => m.name === 'border').at[0].row]), 1);
  await p.close();
});

test('shows the checks that do not hold', async () => {
  writeFileSync(path.join(folder, 'loose.toml'), thrown(0, '[[block]]\n  name = "loose"\n  polygon = [[20, 0], [21, 0], [21, 1]]'));
  const summary = () => JSON.parse(readFileSync(path.join(folder, 'loose/summary.json'), 'utf8'));
  run('run', 'loose.toml', '--quiet');
  run('view', 'loose');
  const p = await page('loose.html');
  const failed = summary().checks.filter((c) => !c.pass);
  assert.ok(failed.some((c) => c.name === 'number of blocks that rest on nothing at the start'));
  const said = await p.$$eval('#failed-checks li', (items) => items.map((li) => li.textContent));
  assert.equal(said.length, failed.length);
  failed.forEach((c, k) => assert.ok(said[k].startsWith(`${c.name} is `), said[k]));
  assert.match(await p.textContent('#status'), failed.length === 1 ? /a check does not hold/ : /checks do not hold/);
  assert.ok(await p.isVisible('#failed'));
  assert.equal(await p.getAttribute('#status', 'title'), summary().message);
  await p.close();
  const fine = await page('tunnel.html');
  assert.ok(!(await fine.isVisible('#failed')));
  assert.match(await fine.getAttribute('#status', 'title'), /^the model is in equilibrium at [\d.]+ s, [\d.]+ s after the start of stage 5/);
  await fine.close();
});

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
