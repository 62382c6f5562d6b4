// The plots of the replay page, in a real browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { choose, clickAt, faults, page, run, settled, table } from './page_tools.mjs';

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

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
