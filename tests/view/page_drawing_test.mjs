// What the replay page draws, in a real browser: colours, places, strokes, and the picture that it saves.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { choose, clickAt, faults, folder, page, run, settled, shownValues, table } from './page_tools.mjs';
import { wall } from './wall.mjs';

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
  await p.evaluate(() => edda.controls.setMagnification(100));
  await p.waitForFunction(() => !edda.stale);
  const magnified = await shift();
  const m = await p.evaluate(() => edda.controls.magnification);
  let seen = 0;
  plain.forEach((n, k) => {
    if (n.row < 0) return;
    const [dx, dy] = [motion[0][n.row], motion[1][n.row]].map((d) => (m - 1) * d);
    const apart = Math.hypot(magnified[k].x - n.x - dx, magnified[k].y - n.y - dy);
    assert.ok(apart < 0.3 * Math.hypot(dx, dy) + 0.05, `${n.bolt}: ${apart} of ${dx}, ${dy}`);
    if (Math.hypot(dx, dy) > 0.1) ++seen;
  });
  assert.ok(seen > 5);
  await p.close();
});

test('draws strokes along what they stand for', async () => {
  const p = await page('cavern.html');
  for (const id of ['forces', 'crosses']) await p.locator(`#${id}`).check();
  await choose(p, 'vectors', 'displacement');
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  const found = await p.evaluate(() => {
    const { view, frame, results: { mesh, run } } = edda;
    // Each stroke is drawn twice, the second time with its colour.
    const strokes = (layer) => Array.from({ length: layer.count / 2 }, (_, k) => ({ ends: [...layer.ends.subarray(8 * k + 4, 8 * k + 8)], colour: [...layer.colours.subarray(8 * k + 4, 8 * k + 7)] }));
    const nearest = (x, y) => {
      let best = 0;
      for (let b = 0; b < mesh.blocks; ++b) {
        const of = (i) => Math.hypot(view.pose.place[4 * i] - x, view.pose.place[4 * i + 1] - y);
        if (of(b) < of(best)) best = b;
      }
      return { b: best, ux: frame.motion[0][best], uy: frame.motion[1][best], sxx: frame.sxx[best], syy: frame.syy[best], sxy: frame.sxy[best] };
    };
    const arrows = strokes(view.arrowStrokes).map((s) => ({ ...s, of: nearest(s.ends[0], s.ends[1]) }));
    const crosses = strokes(view.crossStrokes).map((s) => ({ ...s, of: nearest(0.5 * (s.ends[0] + s.ends[2]), 0.5 * (s.ends[1] + s.ends[3])) }));
    // The resultant of each block's contacts, as its strokes have it: on block i along the stroke, on j against it.
    const forces = strokes(view.forceStrokes);
    return { arrows, crosses, forces: forces.length, largest: run.fields.find((f) => f.name === 'displacement').drawn[1], usual: run.usual, tension: view.theme.tension, compression: view.theme.compression, size: view.blockSize };
  });
  assert.ok(found.arrows.length > 50 && found.crosses.length > 100 && found.forces > 100);
  for (const { ends: [x0, y0, x1, y1], of } of found.arrows) {
    const length = (2.5 * found.size) / Math.max(found.largest, Math.hypot(of.ux, of.uy) / 1.5);
    for (const [drawn, u] of [[x1 - x0, of.ux], [y1 - y0, of.uy]]) assert.ok(Math.abs(drawn - length * u) < 1e-3 * found.size, `${drawn}, not ${length * u}`);
  }
  for (const { ends: [x0, y0, x1, y1], colour, of } of found.crosses) {
    const size = Math.hypot(x1 - x0, y1 - y0);
    if (size < 0.05 * found.size) continue;
    const [nx, ny] = [(x1 - x0) / size, (y1 - y0) / size];
    const across = of.sxx * nx * nx + 2 * of.sxy * nx * ny + of.syy * ny * ny;
    const wanted = (0.8 * found.size * Math.min(Math.abs(across) / found.usual.stress, 4));
    assert.ok(Math.abs(size - wanted) < 0.02 * found.size, `cross of ${size}, not ${wanted}`);
    assert.deepEqual(colour, across > 0 ? found.tension : found.compression);
  }
  // Forces along the strokes must hold each block against its weight, or nearly: Newton's second law.
  const law = await p.evaluate(() => {
    const { view, frame, results: { mesh } } = edda;
    const c = frame.contacts;
    const sum = new Float64Array(2 * mesh.blocks);
    const size = new Float64Array(mesh.blocks);
    const layer = view.forceStrokes;
    let stroke = 0;
    const usual = edda.results.run.usual.force;
    let against = 0;
    for (let k = 0; k < c.normal.length; ++k) {
      const force = Math.hypot(c.normal[k], c.shear[k]);
      if (c.state[k] === 0 || force / usual <= 1e-3) continue;
      const at = 8 * stroke++ + 4;
      const [dx, dy] = [layer.ends[at + 2] - layer.ends[at], layer.ends[at + 3] - layer.ends[at + 1]];
      const drawn = Math.hypot(dx, dy);
      const [fx, fy] = [(force * dx) / drawn, (force * dy) / drawn];
      const { i, j } = { i: c.i[k], j: c.j[k] };
      for (const [b, sign] of [[i, 1], [j, -1]]) {
        sum[2 * b] += sign * fx;
        sum[2 * b + 1] += sign * fy;
        size[b] += force;
      }
      // Compression pushes block i away from block j, or across the edge at least.
      const [cx, cy] = [view.pose.place[4 * i] - view.pose.place[4 * j], view.pose.place[4 * i + 1] - view.pose.place[4 * j + 1]];
      if (c.normal[k] > 0 && cx * dx + cy * dy < 0) ++against;
    }
    const rest = [];
    for (let b = 0; b < mesh.blocks; ++b) if (!mesh.fixed[b] && size[b] > usual) rest.push(Math.hypot(sum[2 * b], sum[2 * b + 1]) / size[b]);
    rest.sort((a, b) => a - b);
    return { strokes: stroke, against, median: rest[rest.length >> 1], blocks: rest.length };
  });
  assert.ok(law.strokes > 100 && law.against < 0.05 * law.strokes, JSON.stringify(law));
  assert.ok(law.blocks > 30 && law.median < 0.15, JSON.stringify(law));
  // One scale for all frames: what moved less has shorter arrows.
  const longest = () => p.evaluate(() => {
    const { count, ends } = edda.view.arrowStrokes;
    return Math.max(0, ...Array.from({ length: count }, (_, k) => Math.hypot(ends[4 * k + 2] - ends[4 * k], ends[4 * k + 3] - ends[4 * k + 1])));
  });
  const end = await longest();
  await p.locator('#scrub').fill('1');
  await settled(p);
  await p.waitForFunction(() => !edda.stale && edda.shown === 1);
  assert.ok(await longest() < 0.9 * end);
  await p.close();
});

test('sets arrows off by an even rim', async () => {
  const p = await page('cavern.html');
  await choose(p, 'vectors', 'displacement');
  await p.locator('#edges').uncheck();
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  const found = await p.evaluate(() => {
    const ratio = 4;
    const { view } = edda;
    // One arrow alone, by what all are drawn with.
    const layer = view.arrowStrokes;
    const [x0, y0, x1, y1] = [[-40, 0], [40, 25]].flatMap(([x, y]) => [view.camera.x + x / view.camera.scale, view.camera.y + y / view.camera.scale]);
    const drawn = (count) => {
      layer.count = Math.min(count, layer.count);
      layer.ends.set([x0, y0, x1, y1, x0, y0, x1, y1]);
      layer.colours.set([255, 0, 255, 255], 0); // the rim, where the ground is as white
      layer.upload();
      const [width, height] = [view.camera.width, view.camera.height];
      const copy = document.createElement('canvas');
      [copy.width, copy.height] = [120 * ratio, 80 * ratio];
      const g = copy.getContext('2d');
      g.translate(-(width / 2 - 60) * ratio, -(height / 2 - 40) * ratio);
      view.copyTo(g, 0, 0, width * ratio, height * ratio, ratio);
      return g.getImageData(0, 0, copy.width, copy.height).data;
    };
    const size = 120 * ratio * 80 * ratio;
    const [both, rim, none] = [2, 1, 0].map(drawn);
    const differs = (a, b, k) => [0, 1, 2].some((c) => a[4 * k + c] !== b[4 * k + c]);
    const [inked, rimmed] = [[], []];
    for (let k = 0; k < size; ++k) {
      const at = [k % (120 * ratio), Math.floor(k / (120 * ratio))];
      if (differs(both, rim, k)) inked.push(at);
      if (differs(rim, none, k)) rimmed.push(at);
    }
    const covered = new Set(rimmed.map(([x, y]) => 1000 * x + y));
    const bare = inked.filter(([x, y]) => !covered.has(1000 * x + y)).length;
    const far = rimmed.map(([x, y]) => Math.min(...inked.map(([u, v]) => Math.hypot(x - u, y - v))) / ratio).sort((a, b) => a - b);
    return { ink: inked.length, rim: rimmed.length, bare, farthest: far[far.length - 1], usual: far[Math.floor(0.99 * far.length)] };
  });
  assert.ok(found.ink > 1000 && found.bare === 0, JSON.stringify(found));
  // At the head's point, where the rim is mitred, it reaches 2 px.
  assert.ok(found.farthest > 0.8 && found.farthest < 2.3 && found.usual < 1.6, JSON.stringify(found));
  await p.close();
});

test('draws the stress of joints from end to end of each face', async () => {
  const p = await page('tunnel.html');
  const joints = table('tunnel/joints.csv');
  await choose(p, 'field', 'normal_stress');
  const { drawn, origin, low, high, colours, size } = await p.evaluate(() => {
    const { view: { contactDots: layer, pose, blockSize }, scale } = edda;
    // Below are their rims.
    const of = (k) => ({ ends: [...layer.ends.subarray(4 * k, 4 * k + 4)], colour: [...layer.colours.subarray(4 * k, 4 * k + 3)].join(), width: layer.widths[2 * k] });
    const all = Array.from({ length: layer.count }, (_, k) => of(k));
    return { drawn: all.slice(all.length / 2), origin: pose.origin, low: scale.low, high: scale.high, size: blockSize,
      colours: Array.from({ length: scale.steps }, (_, k) => [...scale.colours.subarray(3 * k, 3 * k + 3)].join()) };
  });
  const closed = joints.filter((row) => row.state !== 'open');
  assert.equal(drawn.length, closed.length);
  for (const row of closed) {
    const ends = [row.x_a - origin[0], row.y_a - origin[1], row.x_b - origin[0], row.y_b - origin[1]];
    const line = drawn.find((d) => d.ends.every((v, k) => Math.abs(v - ends[k]) < 5e-3 * size));
    assert.ok(line !== undefined, `no line from ${row.x_a}, ${row.y_a} to ${row.x_b}, ${row.y_b}`);
  }
  assert.ok(drawn.every((d) => d.width >= 4), 'thicker than outlines');
  const least = closed.reduce((a, b) => (Number(a.normal_stress) < Number(b.normal_stress) ? a : b));
  assert.ok(Number(least.normal_stress) <= low && high > low);
  assert.equal(drawn[drawn.length - 1].colour, colours[0], 'the largest is on top');
  await p.close();
});

test('draws the pressure on a joint as a trapezoid or a triangle over what bears', async () => {
  const p = await page('tunnel.html');
  await p.locator('#forces').check();
  await settled(p);
  const joints = table('tunnel/joints.csv').filter((row) => row.state !== 'open');
  const { areas, rims, origin, usual, height, size, legend } = await p.evaluate(() => {
    const { view: { pressureAreas, pressureRims, pose, blockSize }, results: { run } } = edda;
    const corners = [];
    for (let k = 0; k < pressureAreas.corners.length; k += 2) corners.push([pressureAreas.corners[k], pressureAreas.corners[k + 1]]);
    return { areas: corners, rims: pressureRims.count, origin: pose.origin, usual: run.usual.pressure, height: 0.45 * blockSize, size: blockSize, legend: edda.legend().strokes };
  });
  const corner = ([x, y]) => areas.some(([u, v]) => Math.hypot(u - x, v - y) < 5e-3 * size);
  let [trapezoids, triangles] = [0, 0];
  for (const row of joints) {
    const [a, b] = [[row.x_a - origin[0], row.y_a - origin[1]], [row.x_b - origin[0], row.y_b - origin[1]]];
    const [pa, pb] = [-row.normal_stress_a, -row.normal_stress_b];
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const most = Math.max(pa, pb);
    if (Math.min(pa, pb) < 0 || most === 0 || most > 1.5 * usual || row.closed_length < 0.02 * size || length < 0.02 * size) continue;
    const [tx, ty] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    // Above, or on the left of steep ones.
    const up = 0.3 * ty + tx < 0 ? -1 : 1;
    const top = (end, pressure) => [end[0] - up * (pressure / usual) * height * ty, end[1] + up * (pressure / usual) * height * tx];
    const part = row.closed_length / row.length;
    const along = (s) => [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
    const wanted = pa > 0 && pb > 0 ? [a, top(a, pa), top(b, pb), b] : pa > 0 ? [a, top(a, pa), along(part)] : [along(1 - part), top(b, pb), b];
    wanted.forEach((point) => assert.ok(corner(point), `${JSON.stringify(row)}: no corner at ${point}`));
    if (wanted.length === 4) ++trapezoids;
    else ++triangles;
  }
  assert.ok(trapezoids > 100 && triangles > 5, `${trapezoids} trapezoids, ${triangles} triangles`);
  assert.ok(rims >= 3 * trapezoids + 2 * triangles);
  const entry = legend.find((s) => s.text.startsWith('pressure'));
  assert.ok(Math.abs(entry.perPixel * height * (await p.evaluate(() => edda.view.camera.scale)) - usual) < 1e-6 * usual);
  await p.close();
});

test('says where strokes are cut', async () => {
  // One brick of forty bears a hundred times the weight of each.
  const pressed = `${wall({ columns: 40, rows: 1, duration: 0.1, every: 0.02, historyEvery: 0.02 })}
  [[load]]
  point = [20.5, 0.5]
  force = [0.0, -1e6]`;
  writeFileSync(path.join(folder, 'pressed.toml'), pressed);
  run('run', 'pressed.toml', '--quiet');
  run('view', 'pressed');
  for (const [name, cut] of [['pressed.html', true], ['cavern.html', false]]) {
    const p = await page(name);
    for (const id of ['forces', 'crosses']) await p.locator(`#${id}`).check();
    await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
    const { strokes, run: { usual, largest } } = await p.evaluate(() => ({ strokes: edda.legend().strokes, run: edda.results.run }));
    const at = (text) => strokes.find((s) => s.text.startsWith(text)).cutAt;
    const wanted = (of) => (largest[of] > 4 * usual[of] ? 4 * usual[of] : undefined);
    assert.equal(at('force'), wanted('force'));
    assert.equal(at('tension'), wanted('stress'));
    assert.equal(at('force') > 0 && largest.force > at('force'), cut, `${name}: ${JSON.stringify([usual, largest])}`);
    await p.close();
  }
});

test('has an entry for joints in tension where there are any', async () => {
  // A brick hangs from another, and holds a third.
  writeFileSync(path.join(folder, 'hung.toml'), `[materials.rock]
density = 2500
young = 1e9
poisson = 0.2
[joints.mortar]
friction_angle = 30
cohesion = 1e6
tensile_strength = 1e6
[contact]
joint = 'mortar'
[[block]]
fixed = true
polygon = [[0, 2], [1, 2], [1, 3], [0, 3]]
[[block]]
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[solver]
duration = 0.01
[output]
every = 0.005
`);
  run('run', 'hung.toml', '--quiet');
  run('view', 'hung');
  for (const [name, pulls] of [['hung.html', true], ['cavern.html', false]]) {
    const p = await page(name);
    for (const id of ['forces', 'crosses']) await p.locator(`#${id}`).check();
    await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
    const { strokes, drawn, largest } = await p.evaluate(() => ({ strokes: edda.legend().strokes, drawn: edda.view.pressureRims.count, largest: edda.results.run.largest }));
    const entry = strokes.find((s) => s.text.startsWith('in tension'));
    assert.equal(entry !== undefined, pulls, JSON.stringify(strokes));
    assert.ok(drawn > 0 && largest.tension > 0 === pulls);
    if (pulls) assert.equal(entry.colour, strokes.find((s) => s.text === 'tension').colour);
    await p.close();
  }
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

test('has all of its legend in small windows, with strokes as long as they are drawn', async () => {
  const p = await page('tunnel.html');
  for (const id of ['forces', 'crosses']) await p.locator(`#${id}`).check();
  await choose(p, 'vectors', 'displacement');
  const legend = () => p.evaluate(async () => {
    const { prototype } = CanvasRenderingContext2D;
    const { roundRect, lineTo, moveTo } = prototype;
    const seen = { lengths: [] };
    let from = 0;
    prototype.roundRect = function (x, y, w, h, r) {
      const m = this.getTransform();
      seen.box = [m.a * x + m.e, m.d * y + m.f, m.a * (x + w) + m.e, m.d * (y + h) + m.f].map((v) => v / devicePixelRatio);
      roundRect.call(this, x, y, w, h, r);
    };
    prototype.moveTo = function (x, y) {
      from = x;
      moveTo.call(this, x, y);
    };
    prototype.lineTo = function (x, y) {
      if (seen.box !== undefined && this.lineWidth === 3) seen.lengths.push(((x - from) * this.getTransform().a) / devicePixelRatio);
      lineTo.call(this, x, y);
    };
    edda.paintLegend(document.getElementById('overlay').getContext('2d'));
    Object.assign(prototype, { roundRect, lineTo, moveTo });
    const { width, height } = edda.view.camera;
    return { ...seen, width, height, per: edda.view.valuePerPixel('forces') };
  });
  for (const [width, height] of [[1280, 800], [700, 500], [320, 300]]) {
    await p.setViewportSize({ width, height });
    await p.waitForFunction(() => edda.view.camera.height === document.getElementById('stage').clientHeight && !edda.stale && !edda.overlayStale);
    const { box: [x0, y0, x1, y1], lengths, per, ...stage } = await legend();
    assert.ok(x0 >= 0 && y0 >= 0 && x1 <= stage.width && y1 <= stage.height, `${width} x ${height}: ${[x0, y0, x1, y1]} in ${stage.width} x ${stage.height}`);
    // The second line is as long as a round force, the first is the sample of its colour.
    const force = lengths[1] * per;
    const round = Number(force.toPrecision(1));
    assert.ok(Math.abs(force - round) < 1e-2 * force && '125'.includes(String(round)[0]), `${force} N`);
  }
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
