// The replay page in a real browser, used as a person does: values, playing, keys, fields, stages.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, clickAt, faults, page, run, settled, shownValues, table } from './page_tools.mjs';

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
  for (const name of named.filter((n) => !['id', 'principal_stress', 'overstress', 'plastic_strain', 'yields', 'strength_factor', 'pore_pressure', 'water_pressure', 'head', 'discharge', 'aperture'].includes(n))) assert.ok(offered.includes(name), name);
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
  await p.waitForFunction(() => document.getElementById('selection-title').textContent.endsWith('excavated'));
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
  const stresses = await p.evaluate(() => ({ high: edda.scale.high, all: edda.scale.all, most: Math.max(...edda.frame.contacts.normalStress) }));
  assert.equal(stresses.all[1], stresses.most);
  assert.ok(stresses.high <= stresses.most && stresses.high > 0.2 * stresses.most, JSON.stringify(stresses));
  await choose(p, 'range', 'last');
  const last = await p.evaluate(() => edda.scale.high);
  assert.ok(Math.abs(last - stresses.high) < 0.05 * Math.abs(last), `${last}, not ${stresses.high}`);
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

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
