// What the replay page draws, in a real browser: colours, places, and the picture that it saves.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { choose, clickAt, faults, folder, page, run, shownValues, table } from './page_tools.mjs';

const ink = (p, x, y) =>
  p.evaluate(([a, b]) => {
    const [px, py] = edda.pixelOf(a, b);
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [edda.view.camera.width, edda.view.camera.height];
    const g = copy.getContext('2d');
    edda.view.copyTo(g, 0, 0, copy.width, copy.height);
    return [...g.getImageData(Math.round(px), Math.round(py), 1, 1).data].slice(0, 3);
  }, [x, y]);

test('paints blocks in the colour of their value', async () => {
  const p = await page('cavern.html');
  await p.locator('#edges').uncheck();
  await p.locator('#marks').uncheck();
  for (const field of ['displacement', 'principal_stress.minor', 'rotation', 'velocity.y', 'stress.xx']) {
    await choose(p, 'field', field);
    for (const row of table('cavern/blocks.csv').filter((_, k) => k % 37 === 5)) {
      await clickAt(p, Number(row.x), Number(row.y));
      const expected = await p.evaluate((f) => {
        const { scale } = edda;
        const step = scale.step(edda.valueOf(f));
        return [...scale.colours.subarray(3 * step, 3 * step + 3)];
      }, field);
      assert.deepEqual(await ink(p, Number(row.x), Number(row.y)), expected, `${field} of block ${row.id}`);
    }
  }
  await p.close();
});

/** A soft box of zones that yields under its weight, beside one without zones, on a floor. */
const zones = `
title = "zones"
[materials.soft]
density = 2000
young = "10 MPa"
poisson = 0.25
zone_size = 0.25
yield = { friction_angle = 20, cohesion = "4 kPa" }
[materials.rock]
density = 2000
young = "1 GPa"
poisson = 0.25
[joints.j]
friction_angle = 30
[[block]]
name = "floor"
material = "rock"
fixed = true
polygon = [[-1, -1], [5, -1], [5, 0], [-1, 0]]
[[block]]
name = "soft"
material = "soft"
polygon = [[0, 0], [2, 0], [2, 2], [0, 2]]
[[block]]
name = "hard"
material = "rock"
polygon = [[3, 0], [4, 0], [4, 1], [3, 1]]
[[monitor]]
name = "corner"
point = [2, 1.999999]
[[stage]]
duration = 0.15
[[stage]]
reset_displacements = true
duration = 0.1
[output]
every = 0.05
`;
const zonesPage = async () => {
  writeFileSync(path.join(folder, 'zones.toml'), zones);
  run('run', 'zones.toml', '--quiet');
  run('view', 'zones');
  return page('zones.html');
};

test('paints zones in the colour of their own value, deformed', async () => {
  const p = await zonesPage();
  await p.keyboard.press('End');
  await p.waitForFunction(() => edda.shown === edda.player.end);
  await p.locator('#edges').uncheck();
  await p.locator('#marks').uncheck();
  const soft = await p.evaluate(() => edda.results.mesh.zones.count);
  assert.ok(soft > 50, String(soft));
  for (const field of ['displacement', 'stress.yy', 'plastic_strain', 'strength_factor', 'yields']) {
    await choose(p, 'field', field);
    // Where each zone is drawn, and its colour.
    const found = await p.evaluate((f) => {
      const { mesh } = edda.results;
      const { pose, camera } = edda.view;
      const copy = document.createElement('canvas');
      [copy.width, copy.height] = [camera.width, camera.height];
      const g = copy.getContext('2d');
      edda.view.copyTo(g, 0, 0, copy.width, copy.height);
      const image = g.getImageData(0, 0, copy.width, copy.height).data;
      const values = new Set();
      let wrong = 0;
      for (let z = mesh.blocks; z < mesh.parts; z += 3) {
        const [px, py] = camera.px(...pose.point(z, 0, 0));
        edda.selected = z;
        const value = edda.valueOf(f);
        values.add(value);
        const { colours } = edda.scale;
        const step = 3 * edda.scale.step(value);
        const at = 4 * (Math.round(py) * copy.width + Math.round(px));
        wrong += [0, 1, 2].some((i) => image[at + i] !== colours[step + i]);
      }
      edda.selected = -1;
      return { wrong, values: values.size };
    }, field);
    assert.equal(found.wrong, 0, field);
    assert.ok(found.values > (field === 'yields' ? 1 : 10), `${field}: ${found.values} values`);
  }
  // The corner goes with the zone at it, over a reset of displacements, too.
  const history = readFileSync(path.join(folder, 'zones/history.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const column = (name) => history[0].indexOf(name);
  const rowAt = (t) => history.slice(1).reduce((best, row) => (Math.abs(row[0] - t) < Math.abs(best[0] - t) ? row : best));
  const beforeReset = rowAt(0.15 - 1e-9);
  for (const [frame, time] of [[2, 0.1], [5, 0.25]]) {
    await p.evaluate((k) => edda.player.go(k), frame);
    await p.waitForFunction((k) => edda.shown === k, frame);
    const at = await p.evaluate(() => {
      const { overlay, view } = edda;
      const { row, rx, ry } = overlay.monitors[0].at[0];
      const [x, y] = view.pose.point(row, rx, ry);
      return [x + view.pose.origin[0], y + view.pose.origin[1], row >= edda.results.mesh.blocks];
    });
    assert.ok(at[2], 'in a zone');
    const row = rowAt(time);
    for (const [k, name] of [[0, 'corner.ux'], [1, 'corner.uy']]) {
      const moved = Number(row[column(name)]) + (time > 0.15 ? Number(beforeReset[column(name)]) : 0);
      const start = [2, 1.999999][k];
      assert.ok(Math.abs(at[k] - start - moved) < 2e-6 + 1e-4 * Math.abs(moved), `${name} at ${time}: ${at[k] - start} for ${moved}`);
      if (k === 1) assert.ok(Math.abs(moved) > 1e-3, `${moved}`);
    }
  }
  // A click shows the zone.
  await p.evaluate(() => edda.pick(...edda.pixelOf(1, 0.3)));
  assert.match(await p.textContent('#selection-title'), /^A zone of block 1$/);
  const shown = await shownValues(p);
  assert.ok(shown.syy.value < -1e4, JSON.stringify(shown.syy));
  assert.ok(shown.strength_factor.value >= 0.99 && shown.yields.text !== '', JSON.stringify(shown));
  await p.close();
});

test('draws joints that have broken by what has broken them', async () => {
  const square = (x, y) => `[[${x}, ${y}], [${x + 1}, ${y}], [${x + 1}, ${y + 1}], [${x}, ${y + 1}]]`;
  writeFileSync(path.join(folder, 'cracks.toml'), `gravity = [0, 0]
[materials.rock]
density = 2500
young = 1e10
poisson = 0.2
[joints.j]
friction_angle = 30
cohesion = 2e5
tensile_strength = 1e5
fracture_energy = 5
shear_fracture_energy = 5
[contact]
joint = "j"
[solver]
duration = 0.2
[output]
every = 0.1
[[block]]
fixed = true
polygon = ${square(0, 0)}
[[block]]
velocity = [3, 0]
polygon = ${square(1, 0)}
`);
  run('run', 'cracks.toml', '--quiet');
  run('view', 'cracks');
  const p = await page('cracks.html');
  const drawn = () => p.evaluate(() => ({ count: edda.view.crackStrokes.count, ends: [...edda.view.crackStrokes.ends.slice(0, 4)], origin: edda.view.pose.origin }));
  await p.keyboard.press('Home');
  await p.waitForFunction(() => edda.shown === 0);
  assert.equal((await drawn()).count, 0, 'nothing has broken at the start');
  await p.keyboard.press('End');
  await p.waitForFunction(() => edda.shown === edda.player.end);
  const { count, ends, origin } = await drawn();
  assert.equal(count, 1);
  const [x, y] = [[ends[0], ends[2]], [ends[1], ends[3]]];
  assert.ok(Math.abs(x[0] - x[1]) < 1e-6 && Math.abs(Math.abs(y[0] - y[1]) - 1) < 0.01, `${ends}`);
  assert.ok(x[0] + origin[0] > 0.99, `${ends}`);
  assert.deepEqual(await p.evaluate(() => [...edda.view.crackStrokes.colours.slice(0, 3)]), await p.evaluate(() => edda.view.theme.tension));
  await p.locator('#cracks').uncheck();
  await p.waitForFunction(() => !edda.stale);
  assert.equal(await p.evaluate(() => edda.controls.cracks), false);
  await p.close();
  const plain = await page('cavern.html');
  assert.ok(await plain.locator('#cracks').isHidden());
  await plain.close();
});

test('has white at nothing, whatever the range', async () => {
  const p = await page('cavern.html');
  await choose(p, 'field', 'displacement.y');
  const scaleOf = () => p.evaluate(() => {
    const { scale } = edda;
    const colours = new Float32Array(1);
    scale.paint(Float32Array.of(0), Uint8Array.of(0), [1, 2, 3], [1, 2, 3], colours);
    return { palette: scale.palette, low: scale.low, high: scale.high, zero: scale.step(0), painted: colours[0], middle: [...scale.colours.subarray(384, 387)], steps: [scale.step(scale.low), scale.step(scale.high)] };
  });
  for (const range of ['run', 'frame', 'own']) {
    await choose(p, 'range', range);
    if (range === 'own') {
      await p.locator('#low').fill('-30');
      await p.locator('#high').fill('10');
      await p.locator('#high').blur();
    }
    await p.waitForFunction(() => !edda.stale);
    const s = await scaleOf();
    assert.equal(s.palette, 'diverging', range);
    assert.ok(s.low < 0 && s.high > 0 && Math.abs(s.low + s.high) > 0.01 * s.high, `${range}: ${s.low} to ${s.high}`);
    assert.equal(s.zero, 128, range);
    const [r, g, b] = s.middle;
    assert.equal(s.painted, 65536 * r + 256 * g + b, range);
    const larger = Math.max(-s.low, s.high);
    [s.low, s.high].forEach((v, k) => assert.equal(s.steps[k], Math.floor(128 + (127.5 * v) / larger), `${range}: ${v}`));
  }
  await p.close();
});

test('draws by what nearly all blocks reach, or by all of them', async () => {
  const p = await page('cavern.html');
  const found = await p.evaluate(async () => {
    const { run, mesh } = edda.results;
    const field = run.fields.find((f) => f.name === 'displacement');
    // A crumb far below, of the smallest block there is.
    let crumb = -1;
    for (let b = 0; b < mesh.blocks; ++b) if (!mesh.fixed[b] && edda.frame.alive[b] && (crumb < 0 || mesh.area[b] < mesh.area[crumb])) crumb = b;
    const [ux, uy] = [edda.frame.motion[0][crumb], edda.frame.motion[1][crumb]];
    edda.controls.flipMagnification(edda.results, edda.frame);
    const plain = edda.controls.magnification;
    edda.controls.setMagnification(1);
    edda.frame.motion[1][crumb] = -90;
    edda.controls.flipMagnification(edda.results, edda.frame);
    const magnified = edda.controls.magnification;
    edda.controls.setMagnification(1);
    field.range = [field.range[0], 90];
    edda.controls.changed();
    return { plain, magnified, drawn: field.drawn, crumb, ux, uy };
  });
  assert.ok(found.magnified > 0.6 * found.plain && found.magnified <= 1.7 * found.plain, `${found.magnified}, not ${found.plain}`);
  const highOf = async (range) => {
    await choose(p, 'range', range);
    await p.waitForFunction(() => !edda.stale);
    return p.evaluate(() => [edda.scale.high, edda.scale.all[1]]);
  };
  assert.deepEqual(await highOf('run'), [found.drawn[1], 90]);
  assert.deepEqual(await highOf('whole'), [90, 90]);
  assert.deepEqual(await highOf('whole-frame'), [90, 90]);
  const [high, all] = await highOf('frame');
  assert.equal(all, 90);
  assert.ok(high > 0.3 * found.drawn[1] && high < 3 * found.drawn[1], `${high}, not ${found.drawn[1]}`);
  await p.close();
});

test('magnifies displacements about the start', async () => {
  const p = await page('cavern.html');
  const row = table('cavern/blocks.csv').reduce((a, b) => (Math.hypot(a.ux, a.uy) > Math.hypot(b.ux, b.uy) ? a : b));
  await p.evaluate(() => edda.controls.setMagnification(50));
  const m = await p.evaluate(() => edda.controls.magnification);
  assert.ok(Math.abs(m - 50) < 0.5, String(m));
  await p.waitForFunction(() => !edda.stale);
  await clickAt(p, Number(row.x) + (m - 1) * Number(row.ux), Number(row.y) + (m - 1) * Number(row.uy));
  const shown = await shownValues(p);
  assert.equal(shown.id.text, row.id);
  assert.ok(Math.abs(shown.x.value - Number(row.x)) < 1e-6 * 30, 'positions stay what they are');
  await p.close();
});

test('takes bolts along with magnified displacements', async () => {
  const p = await page('tunnel.html');
  const shift = () => p.evaluate(() => {
    const { view, results, frame, controls } = edda;
    const nodes = view.shown.bolts;
    const at = view.boltPlaces.of(nodes, frame, results.datums[frame.datum], controls.magnification, view.pose);
    return nodes.map((n, k) => ({ bolt: n.bolt, x: at[2 * k], y: at[2 * k + 1], row: view.pose.blockAt(at[2 * k], at[2 * k + 1]) }));
  });
  const plain = await shift();
  assert.ok(plain.length > 10 && plain.filter((n) => n.row >= 0).length > 0.8 * plain.length);
  const motion = await p.evaluate(() => edda.frame.motion.map((c) => Array.from(c)));
  const centre = await p.evaluate(() => Array.from(edda.results.mesh.centre, (c, k) => c - edda.view.pose.origin[k % 2]));
  await p.evaluate(() => edda.controls.setMagnification(100));
  await p.waitForFunction(() => !edda.stale);
  const magnified = await shift();
  const m = await p.evaluate(() => edda.controls.magnification);
  let seen = 0;
  plain.forEach((n, k) => {
    if (n.row < 0) return;
    const [ux, uy, xx, xy, yx, yy] = motion.map((column) => column[n.row]);
    const [rx, ry] = [n.x - centre[2 * n.row] - ux, n.y - centre[2 * n.row + 1] - uy];
    const [dx, dy] = [ux + xx * rx + xy * ry, uy + yx * rx + yy * ry].map((d) => (m - 1) * d);
    const apart = Math.hypot(magnified[k].x - n.x - dx, magnified[k].y - n.y - dy);
    assert.ok(apart < 0.02 * Math.hypot(dx, dy) + 0.01, `${n.bolt}: ${apart} of ${dx}, ${dy}`);
    if (Math.hypot(dx, dy) > 0.1) ++seen;
  });
  assert.ok(seen > 5);
  await p.close();
});

test('says so of ends of the colours that are none', async () => {
  const p = await page('cavern.html');
  await choose(p, 'range', 'own');
  const invalid = () => p.$$eval('#low, #high', (inputs) => inputs.map((i) => i.getAttribute('aria-invalid')));
  const give = async (low, high) => {
    await p.locator('#low').fill(low);
    await p.locator('#high').fill(high);
    await p.locator('#high').blur();
    await p.waitForFunction(() => !edda.stale);
  };
  await give('5', '5');
  assert.deepEqual(await invalid(), ['true', 'true']);
  assert.match(await p.textContent('#own-fault'), /^the lower end must be below/);
  await give('', '5');
  assert.match(await p.textContent('#own-fault'), /^give two numbers/);
  await give('1', '5');
  assert.deepEqual(await invalid(), ['false', 'false']);
  assert.ok(await p.locator('#own-fault').isHidden());
  await choose(p, 'range', 'run');
  await p.close();
});

test('names and colours states of contacts as edda plot does', async () => {
  const p = await page('cavern.html');
  await choose(p, 'field', 'state');
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  const { states, colours, drawn, asked } = await p.evaluate(() => {
    const { view, frame, scale, results: { run } } = edda;
    const layer = view.contactDots;
    const of = (k) => [...layer.colours.subarray(4 * k, 4 * k + 3)].join();
    return { states: run.states, colours: [0, 1, 2, 3].map((k) => [...scale.states.subarray(3 * k, 3 * k + 3)].join()), drawn: Array.from({ length: layer.count }, (_, k) => of(k)), asked: [...frame.contacts.state] };
  });
  assert.deepEqual(states, ['open', 'stick', 'slide', 'bonded']);
  colours.forEach((c, k) => assert.equal(drawn.filter((d) => d === c).length, asked.filter((s) => s === k).length, states[k]));
  const slide = drawn.indexOf(colours[2]);
  assert.ok(slide < 0 || drawn.slice(slide).every((d) => d === colours[2]), 'those that slide lie on top');
  await p.close();
});

test('moves and zooms under the pointer', async () => {
  const p = await page('cavern.html');
  const box = await p.locator('#overlay').boundingBox();
  const at = () => p.evaluate(() => edda.view.camera.at(300, 200));
  const held = await at();
  await p.mouse.move(box.x + 300, box.y + 200);
  const far = await p.evaluate(() => edda.view.camera.scale);
  await p.mouse.wheel(0, -400);
  await p.waitForFunction((s) => edda.view.camera.scale > 1.5 * s, far);
  // The page may lie between pixels, and a wheel's place is a whole one.
  (await at()).forEach((v, k) => assert.ok(Math.abs(v - held[k]) < 1 / far));
  const before_ = await at();
  await p.mouse.down();
  await p.mouse.move(box.x + 350, box.y + 260);
  await p.mouse.up();
  const scale = await p.evaluate(() => edda.view.camera.scale);
  const now = await p.evaluate(() => edda.view.camera.at(350, 260));
  now.forEach((v, k) => assert.ok(Math.abs(v - before_[k]) < 0.1 / scale));
  assert.equal(await p.evaluate(() => edda.selected), -1, 'a drag selects nothing');
  await p.close();
});

test('saves a picture', async () => {
  const p = await page('cavern.html');
  // What is drawn counts, not what is still to come.
  await p.evaluate(() => {
    edda.controls.setMagnification(50);
    const { draw } = edda.view;
    Object.assign(window, { widths: [] });
    edda.view.draw = () => {
      window.widths.push(edda.view.canvas.width);
      draw.call(edda.view);
    };
  });
  await p.waitForFunction(() => !edda.stale);
  assert.match(await p.evaluate(() => ((edda.player.index = 3), edda.pictureTime())), /t = 0\.05 s +displacements \u00d7 49\.9$/);
  const [download] = await Promise.all([p.waitForEvent('download'), p.click('#save')]);
  assert.match(download.suggestedFilename(), /^Cavern.*-10\.png$/);
  assert.ok((await p.evaluate(() => window.widths)).includes(2 * (await p.evaluate(() => edda.view.camera.width))), 'blocks are drawn as fine as the picture');
  const bytes = readFileSync(await download.path());
  assert.deepEqual([...bytes.subarray(1, 4)], [...Buffer.from('PNG')]);
  const [width, height] = await p.evaluate(() => [edda.view.camera.width, edda.view.camera.height]);
  assert.equal(bytes.readUInt32BE(16), 2 * width);
  assert.equal(bytes.readUInt32BE(20), 2 * (height + 34));
  // A long title goes on in further lines, and no line is squeezed.
  const long = await p.evaluate(async () => {
    const { fillText } = CanvasRenderingContext2D.prototype;
    const lines = [];
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y, most) {
      if (this.font.includes('15px')) lines.push([text, this.measureText(text).width / most]);
      fillText.call(this, text, x, y, most);
    };
    const of = (title) => {
      lines.length = 0;
      edda.results.run.title = title;
      edda.save();
      return [...lines];
    };
    const found = [of('cavern in jointed rock '.repeat(8).trim()), of('cavern '.repeat(300)), of('x'.repeat(2000))];
    CanvasRenderingContext2D.prototype.fillText = fillText;
    return found;
  });
  assert.deepEqual(long.map((lines) => lines.length <= 3 && lines.length > 1 && lines.every(([, part]) => part <= 1)), [true, true, true], JSON.stringify(long));
  assert.ok(!JSON.stringify(long[0]).includes('\u2026') && long[1][2][0].includes('\u2026'));
  for (const lines of long) assert.match(lines.map(([text]) => text).join(' '), /t\s=\s0\.05\ss\s+displacements\s\u00d7\s49\.9$/);
  await p.close();
});

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
