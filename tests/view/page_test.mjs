// The replay page in a real browser, used as a person does.
import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { blank, choose, clickAt, faults, folder, page, run, serve, settled, shownValues, start, table, until, within } from './page_tools.mjs';
import { wall } from './wall.mjs';

test('shows the values that blocks.csv has, of any block', async () => {
  const p = await page('cavern.html');
  const rows = table('cavern/blocks.csv');
  let seen = 0;
  for (const row of rows.filter((_, k) => k % 23 === 0)) {
    await clickAt(p, Number(row.x), Number(row.y));
    const shown = await shownValues(p);
    assert.equal(shown.id.text, row.id);
    assert.equal(shown.material.text, row.material);
    for (const name of ['x', 'y', 'ux', 'uy', 'rotation', 'vx', 'vy', 'omega', 'sxx', 'syy', 'szz', 'sxy']) {
      const expected = Number(row[name]);
      assert.ok(Math.abs(shown[name].value - expected) <= 3e-7 * Math.max(Math.abs(expected), 1e-12) + 1e-30, `${name}: ${shown[name].value}, not ${expected}`);
    }
    assert.ok(Math.abs(shown.area.value - Number(row.area)) <= 1e-6 * Number(row.area), `area: ${shown.area.value}`);
    ++seen;
  }
  assert.ok(seen >= 9);
  // And in digits, with a unit that people read.
  const last = rows[23];
  await clickAt(p, Number(last.x), Number(last.y));
  const { sxx } = await shownValues(p);
  const [number, unit] = sxx.text.replace('\u2212', '-').split(' ');
  const factor = { Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9 }[unit];
  assert.equal((Number(number) * factor).toPrecision(6), Number(last.sxx).toPrecision(6));
  await p.close();
});

test('plays from the first frame to the last, and pauses', async () => {
  const p = await page('cavern.html');
  // A frame lasts two and a half seconds, then one, so that a busy machine sees each.
  await choose(p, 'speed', '0.1');
  const icon = () => p.$$eval('#play svg', (icons) => icons.filter((i) => i.getBoundingClientRect().width > 0).map((i) => i.getAttribute('class')));
  assert.deepEqual(await icon(), ['playing-not']);
  await p.click('#play');
  await p.waitForFunction(() => document.getElementById('time').textContent === 't = 0 s');
  assert.deepEqual(await icon(), ['playing-only']);
  // Not every font has the signs of a player.
  assert.equal((await p.$$eval('footer button', (buttons) => buttons.map((b) => b.textContent).join(''))).trim(), '');
  await choose(p, 'speed', '0.25');
  await p.waitForFunction(() => edda.player.index === 2);
  await p.click('#play');
  const paused = await p.evaluate(() => edda.player.index);
  await p.waitForTimeout(300);
  assert.equal(await p.evaluate(() => edda.player.index), paused);
  await choose(p, 'speed', '4');
  await p.click('#play');
  await p.waitForFunction(() => !edda.player.playing, null, { timeout: 20000 });
  assert.equal(await p.evaluate(() => edda.player.index), 10);
  await p.close();
});

test('scrubs, and answers keys', async () => {
  const p = await page('cavern.html');
  await p.locator('#scrub').fill('4');
  await p.waitForFunction(() => !edda.stale);
  assert.match(await p.textContent('#time'), /^t = 0\.02 s$/);
  await p.locator('#overlay').focus();
  for (const [key, frame] of [['ArrowRight', 5], ['ArrowLeft', 4], ['Home', 0], ['ArrowLeft', 0], ['End', 10]]) {
    await p.keyboard.press(key);
    assert.equal(await p.evaluate(() => edda.player.index), frame, key);
  }
  await choose(p, 'speed', '0.1');
  await p.keyboard.press('Home');
  await p.keyboard.press(' ');
  assert.equal(await p.evaluate(() => edda.player.playing), true);
  await p.keyboard.press('End');
  assert.equal(await p.evaluate(() => edda.player.playing), false, 'there is nothing left to play');
  await p.keyboard.press('?');
  assert.ok(await p.locator('#keys').isVisible());
  await p.keyboard.press('Escape');
  const light = await p.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await p.keyboard.press('t');
  assert.notEqual(await p.evaluate(() => getComputedStyle(document.body).backgroundColor), light);
  await p.close();
});

test('knows every field that edda plot knows', async () => {
  const p = await page('cavern.html');
  const offered = await p.$$eval('#field option', (options) => options.map((o) => o.value));
  const named = await p.evaluate(() => edda.results.run.fields.map((f) => f.name));
  for (const name of named.filter((n) => !['id', 'principal_stress', 'overstress'].includes(n))) assert.ok(offered.includes(name), name);
  for (const name of offered) {
    await choose(p, 'field', name);
    await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  }
  await p.close();
});

test('has no overstress of rock without a strength', async () => {
  const p = await page('cavern.html');
  assert.ok(!(await p.$$eval('#field option', (options) => options.map((o) => o.value))).includes('overstress'));
  await p.close();
  const strength = ['--set', 'materials.rock.strength={ucs = 9e7, tension = 6e6}', '--set', 'solver.duration=0.001'];
  run('run', 'cavern.toml', '--quiet', ...strength, '-o', 'judged');
  run('view', 'judged');
  const judged = await page('judged.html');
  await choose(judged, 'field', 'overstress');
  await judged.close();
  run('plot', 'judged', '--field', 'overstress', '-o', 'judged.png');
  assert.throws(() => run('plot', 'cavern', '--field', 'overstress', '-o', 'none.png'), (e) => e.status === 2);
  assert.throws(() => run('plot', 'cavern.toml', '--field', 'overstress', '-o', 'none.png'), (e) => e.status === 2);
});

test('follows a monitor and plots its history', async () => {
  const p = await page('cavern.html');
  const history = table('cavern/history.csv');
  const monitor = await p.evaluate(() => edda.results.run.monitors[0]);
  const last = history[history.length - 1];
  const at = [monitor.points[0][0] + Number(last[`${monitor.name}.ux`]), monitor.points[0][1] + Number(last[`${monitor.name}.uy`])];
  await clickAt(p, ...at);
  assert.match(await p.textContent('#selection-title'), new RegExp(`Monitor ${monitor.name}`));
  assert.equal(await p.inputValue('#plot-of'), `monitor:${monitor.name}:displacement`);
  const plotted = await p.evaluate(() => edda.plots.plot.plot.data.map((c) => Array.from(c)));
  assert.equal(plotted[0].length, history.length);
  const unit = await p.evaluate(() => edda.plots.plot.key);
  const factor = unit.includes('"mm"') ? 1e3 : unit.includes('\u00b5m') ? 1e6 : 1;
  history.forEach((row, k) => assert.ok(Math.abs(plotted[2][k] - factor * Number(row[`${monitor.name}.uy`])) <= 1e-9 * factor));
  // A name may hold anything.
  await p.evaluate(() => {
    const { run, history } = edda.results;
    run.monitors.push({ ...run.monitors[0], name: 'a: b' });
    history.names.push('a: b.ux', 'a: b.uy');
    history.columns.push(history.columns[0].map(() => 7), history.columns[0].map(() => 8));
    edda.plots.refresh();
  });
  await choose(p, 'plot-of', 'monitor:a: b:displacement');
  assert.deepEqual(await p.evaluate(() => edda.plots.plot.plot.data.slice(1).map((c) => c[0])), [7, 8]);
  await choose(p, 'plot-of', 'energy');
  assert.ok(await p.locator('#plot canvas').isVisible());
  await p.close();
});

test('tells the times of a plot apart, however short the run, however far it is zoomed', async () => {
  run('run', 'cavern.toml', '--quiet', '--set', 'solver.duration=0.001', '--set', 'output.every=0.0005', '-o', 'blink');
  run('view', 'blink');
  const p = await page('blink.html');
  await choose(p, 'plot-of', 'energy');
  const times = () => p.evaluate(() => edda.plots.plot.plot.axes[0]._values.filter((v) => v !== null));
  for (const [low, high, least] of [[0, 0.001, 3], [0.0004, 0.0005, 2], [0.00049999, 0.00050001, 2], [900, 900.001, 2]]) {
    await p.evaluate(([min, max]) => new Promise((drawn) => {
      const { plot } = edda.plots.plot;
      plot.setScale('x', { min, max });
      setTimeout(drawn, 100);
    }), [low, high]);
    const texts = await times();
    const read = texts.map((text) => Number(text.replaceAll('\u2212', '-')));
    assert.ok(texts.length >= least && new Set(texts).size === texts.length, texts.join(' '));
    const step = read[1] - read[0];
    read.forEach((t, k) => {
      assert.ok(t > low - 0.01 * step && t < high + 0.01 * step, texts.join(' '));
      if (k > 0) assert.ok(Math.abs(t - read[k - 1] - step) < 0.01 * step, `even steps: ${texts.join(' ')}`);
    });
  }
  await p.close();
});

test('has the values at the shown time below a plot, else those under the mouse', async () => {
  const p = await page('cavern.html');
  const history = table('cavern/history.csv');
  await choose(p, 'plot-of', 'drift');
  const below = () => p.$$eval('#plot .u-value', (cells) => cells.map((c) => c.textContent));
  const wanted = (row) => [`${Number(Number(row.time).toPrecision(7))} s`, Number(row.drift)];
  const holds = async (row) => {
    const [time, drift] = await below();
    const [t, d] = wanted(row);
    assert.equal(time, t);
    assert.ok(Math.abs(Number(drift.replaceAll('\u2212', '-')) - d) <= 1e-4 * Math.abs(d), `${drift}, not ${d}`);
  };
  await holds(history[history.length - 1]);
  await p.locator('#scrub').fill('4');
  await settled(p);
  const shown = history.find((row) => Math.abs(Number(row.time) - 0.02) < 1e-9);
  await holds(shown);
  const over = await p.locator('#plot .u-over').boundingBox();
  await p.mouse.move(over.x + 1, over.y + 20);
  await holds(history[0]);
  await p.mouse.move(over.x + 1, over.y - 300);
  await holds(shown);
  await p.close();
});

test('plots the unbalanced force over its powers of ten', async () => {
  const p = await page('tunnel.html');
  await choose(p, 'plot-of', 'unbalanced');
  const { marks, log, values } = await p.evaluate(() => {
    const { plot } = edda.plots.plot;
    return { marks: plot.axes[1]._values, log: plot.scales.y.distr, values: Array.from(plot.data[1]) };
  });
  assert.equal(log, 3);
  assert.ok(values.every((v) => v === null || v > 0) && values.some((v) => v !== null));
  assert.ok(marks.length >= 3 && marks.length <= 11, marks.join(' '));
  for (const text of marks) assert.match(text, /^(10*|0\.0*1|1e[\u2212+]?\d+)$/);
  await choose(p, 'plot-of', 'energy');
  assert.equal(await p.evaluate(() => edda.plots.plot.plot.scales.y.distr), 1);
  await p.close();
});

test('names monitors where nothing is hidden, or not at all', async () => {
  const p = await page('cavern.html');
  const found = await p.evaluate(() => {
    const { overlay, view } = edda;
    const box = view.pose.box();
    const place = (x, y) => [{ row: -1, rx: x + view.pose.origin[0], ry: y + view.pose.origin[1] }];
    overlay.monitors.splice(0);
    // A dozen close together, and one beside the legend.
    for (let k = 0; k < 12; ++k) overlay.monitors.push({ name: `monitor ${k}`, at: place(0.5 * (box.x0 + box.x1) + (k % 4) * 12 / view.camera.scale, 0.5 * (box.y0 + box.y1) + (k >> 2) * 9 / view.camera.scale) });
    overlay.monitors.push({ name: 'beside the legend', at: place(...view.camera.at(view.camera.width - 190, 60)) });
    const options = edda.overlayOptions();
    const g = document.createElement('canvas').getContext('2d');
    const texts = [];
    g.fillText = (text, x, y) => g.font.includes('600') && texts.push({ text, x0: x, x1: x + g.measureText(text).width, y0: y - 9, y1: y + 2 });
    const style = { ink: '#000', faint: '#000', halo: '#fff', accent: '#000', font: 'sans-serif' };
    const drawn = (monitor) => {
      texts.length = 0;
      overlay.paint(g, view.camera, view.pose, style, { ...options, axes: false, monitor });
      return [...texts];
    };
    return { plain: drawn(''), selected: drawn('monitor 6'), legend: options.legend };
  });
  for (const texts of [found.plain, found.selected]) {
    assert.ok(texts.length > 3 && texts.length < 13, String(texts.length));
    [...texts, found.legend].forEach((a, i, all) => all.slice(0, i).forEach((b) =>
      assert.ok(a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0, `${a.text} over ${b.text}`)));
  }
  assert.ok(found.plain.some((t) => t.text === 'beside the legend'));
  assert.equal(found.selected[0].text, 'monitor 6');
  await p.close();
});

test('plots a block over the frames', async () => {
  const p = await page('cavern.html');
  const row = table('cavern/blocks.csv')[120];
  await choose(p, 'field', 'stress.yy');
  await clickAt(p, Number(row.x), Number(row.y));
  assert.equal(await p.inputValue('#plot-of'), 'block');
  await p.waitForFunction(() => edda.plots.plot.plot?.data[1].length === 11 && edda.plots.plot.plot.data[1].every((v) => v !== null));
  const { data, key } = await p.evaluate(() => ({ data: edda.plots.plot.plot.data.map((c) => Array.from(c)), key: edda.plots.plot.key }));
  const factor = { MPa: 1e-6, kPa: 1e-3, Pa: 1 }[JSON.parse(key)[0]];
  assert.equal(data[1].length, 11);
  assert.ok(Math.abs(data[1][10] - factor * Number(row.syy)) <= 1e-5 * Math.abs(factor * Number(row.syy)));
  await p.close();
});

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

test('shows stages, bolts and rock that is taken out', async () => {
  const p = await page('tunnel.html');
  const stages = table('tunnel/stages.csv');
  assert.equal(await p.locator('#marks-of-stages i').count(), stages.length - 1);
  assert.match(await p.textContent('#time'), new RegExp(stages[stages.length - 1].name));
  assert.ok(await p.locator('#bolts').isVisible());
  assert.ok(await p.evaluate(() => edda.view.boltStrokes.count) > 10);
  await clickAt(p, 0.5, 2.0);
  assert.equal(await p.evaluate(() => edda.selected), -1, 'the heading is open in the end');
  await p.keyboard.press('Home');
  await settled(p);
  await clickAt(p, 0.5, 2.0);
  assert.ok(await p.evaluate(() => edda.selected) >= 0, 'and rock at the start');
  await p.keyboard.press('End');
  await settled(p);
  await p.waitForFunction(() => document.getElementById('selection-title').textContent.endsWith('taken out'));
  for (const id of ['contacts', 'forces', 'crosses']) await p.locator(`#${id}`).check();
  for (const what of ['velocity', 'displacement']) await choose(p, 'vectors', what);
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  // Fields of contacts have ranges of their own frame, too.
  await choose(p, 'field', 'normal_force');
  const highOf = async (range) => {
    await choose(p, 'range', range);
    await p.waitForFunction(() => !edda.stale);
    return p.evaluate(() => [edda.scale.high, Math.max(...edda.frame.contacts.normal)]);
  };
  const [high, most] = await highOf('frame');
  assert.equal(high, most);
  // Stresses of joints by the lengths of their faces: of all frames as pictures have it, of this one by the same rule.
  await choose(p, 'field', 'normal_stress');
  await choose(p, 'range', 'frame');
  const stresses = await p.evaluate(() => ({ low: edda.scale.low, all: edda.scale.all, least: Math.min(...edda.frame.contacts.normalStress) }));
  assert.equal(stresses.all[0], stresses.least);
  assert.ok(stresses.low >= stresses.least && stresses.low < 0.2 * stresses.least, JSON.stringify(stresses));
  await choose(p, 'range', 'last');
  const last = await p.evaluate(() => edda.scale.low);
  assert.ok(Math.abs(last - stresses.low) < 0.05 * Math.abs(last), `${last}, not ${stresses.low}`);
  await choose(p, 'field', 'normal_force');
  await p.keyboard.press('Home');
  await p.waitForFunction(() => !edda.stale && edda.shown === 0);
  const [first, mostAtFirst] = await highOf('frame');
  assert.equal(first, mostAtFirst);
  assert.notEqual(first, high);
  assert.ok((await highOf('run'))[0] >= (1 - 1e-6) * Math.max(first, high));
  await p.keyboard.press('End');
  await settled(p);
  const strokes = await p.evaluate(() => ['contactDots', 'forceStrokes', 'crossStrokes', 'arrowStrokes'].map((k) => edda.view[k].count));
  assert.ok(strokes.every((n) => n > 50), String(strokes));
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

test('plots every energy that history.csv has', async () => {
  const p = await page('cavern.html');
  await p.evaluate(() => {
    const { history } = edda.results;
    history.columns[history.names.indexOf('step_change')].fill(7e3);
    edda.plots.refresh();
  });
  await choose(p, 'plot-of', 'energy');
  const shown = await p.evaluate(() => edda.plots.plot.plot.series.map((s) => s.label));
  const columns = await p.evaluate(() => {
    const { names, columns: all } = edda.results.history;
    const energies = names.slice(names.indexOf('kinetic'), names.indexOf('drift'));
    return energies.filter((n) => all[names.indexOf(n)].some((v) => v !== 0));
  });
  assert.deepEqual(shown.slice(1), columns);
  assert.ok(columns.includes('step_change'));
  await p.close();
});

test('follows a run that goes on', async (t) => {
  run('example', 'rockfall');
  const going = start(t, ['run', 'rockfall.toml', '--quiet', '--set', 'solver.safety=0.05', '--set', 'output.every=0.05']);
  await until(() => existsSync(path.join(folder, 'rockfall/blocks.pvd')), 'the first frame');
  const { server, ended, address } = await serve(t, 'rockfall');
  const p = await page(address);
  const first = await p.evaluate(() => edda.results.run.frames.length);
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
  assert.match(await fine.getAttribute('#status', 'title'), /^at rest at [\d.]+ s, [\d.]+ s after the start of stage 4/);
  await fine.close();
});

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
