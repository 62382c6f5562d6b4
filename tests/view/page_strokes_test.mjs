// The strokes of the replay page and their legend, in a real browser: arrows, stresses, forces, pressures.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { choose, faults, folder, page, run, settled, table } from './page_tools.mjs';
import { wall } from './wall.mjs';

/** Arrows and crosses with the block that each is drawn on, and what scales them. */
const drawnStrokes = (p) => p.evaluate(() => {
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

function assertArrowsFollowDisplacements(found) {
  for (const { ends: [x0, y0, x1, y1], of } of found.arrows) {
    const length = (2.5 * found.size) / Math.max(found.largest, Math.hypot(of.ux, of.uy) / 1.5);
    for (const [drawn, u] of [[x1 - x0, of.ux], [y1 - y0, of.uy]]) assert.ok(Math.abs(drawn - length * u) < 1e-3 * found.size, `${drawn}, not ${length * u}`);
  }
}

function assertCrossesFollowStresses(found) {
  for (const { ends: [x0, y0, x1, y1], colour, of } of found.crosses) {
    const size = Math.hypot(x1 - x0, y1 - y0);
    if (size < 0.05 * found.size) continue;
    const [nx, ny] = [(x1 - x0) / size, (y1 - y0) / size];
    const across = of.sxx * nx * nx + 2 * of.sxy * nx * ny + of.syy * ny * ny;
    const wanted = (0.8 * found.size * Math.min(Math.abs(across) / found.usual.stress, 4));
    assert.ok(Math.abs(size - wanted) < 0.02 * found.size, `cross of ${size}, not ${wanted}`);
    assert.deepEqual(colour, across > 0 ? found.tension : found.compression);
  }
}

/** The resultant of the forces that are drawn on each block, over their sum. */
const resultantsOfForces = (p) => p.evaluate(() => {
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

const longestArrow = (p) => p.evaluate(() => {
  const { count, ends } = edda.view.arrowStrokes;
  return Math.max(0, ...Array.from({ length: count }, (_, k) => Math.hypot(ends[4 * k + 2] - ends[4 * k], ends[4 * k + 3] - ends[4 * k + 1])));
});

test('draws strokes along what they stand for', async () => {
  const p = await page('cavern.html');
  for (const id of ['forces', 'crosses']) await p.locator(`#${id}`).check();
  await choose(p, 'vectors', 'displacement');
  await p.waitForFunction(() => !edda.stale && !edda.overlayStale);
  const found = await drawnStrokes(p);
  assert.ok(found.arrows.length > 50 && found.crosses.length > 100 && found.forces > 100);
  assertArrowsFollowDisplacements(found);
  assertCrossesFollowStresses(found);
  // Forces along the strokes must hold each block against its weight, or nearly: Newton's second law.
  const law = await resultantsOfForces(p);
  assert.ok(law.strokes > 100 && law.against < 0.05 * law.strokes, JSON.stringify(law));
  assert.ok(law.blocks > 30 && law.median < 0.15, JSON.stringify(law));
  // One scale for all frames: what moved less has shorter arrows.
  const end = await longestArrow(p);
  await p.locator('#scrub').fill('1');
  await settled(p);
  await p.waitForFunction(() => !edda.stale && edda.shown === 1);
  assert.ok(await longestArrow(p) < 0.9 * end);
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
  const most = closed.reduce((a, b) => (Number(a.normal_stress) > Number(b.normal_stress) ? a : b));
  assert.ok(Number(most.normal_stress) >= high && high > low, 'compression is positive');
  assert.equal(drawn[drawn.length - 1].colour, colours[colours.length - 1], 'the largest is on top');
  assert.equal(await p.locator('#field option[value=normal_stress]').textContent(), 'normal stress on joints');
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
    const [pa, pb] = [Number(row.normal_stress_a), Number(row.normal_stress_b)];
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

const lined = `
[materials.rock]
density = 2600
young = "2 GPa"
poisson = 0.25
[materials.concrete]
density = 2400
young = "20 GPa"
poisson = 0.2
strength = { ucs = "20 MPa", tension = "2 MPa" }
[joints.j]
friction_angle = 35
kn = "20 GPa/m"
[contact]
joint = "j"
[domain]
outline = [[-8, -8], [8, -8], [8, 8], [-8, 8]]
material = "rock"
[[joint_set]]
angle = 40
spacing = 2
[[opening]]
name = "tunnel"
shape = { kind = "circle", at = [0, 0], width = 5 }
[[lining]]
name = "shell"
opening = "tunnel"
material = "concrete"
thickness = "20 cm"
[initial_stress]
k0 = 0.6
surface_y = 60
[[boundary]]
type = "fixed"
sides = ["left", "right", "bottom", "top"]
[[stage]]
until = "equilibrium"
`;

test('draws forces of linings across them, positive on the side of the wall', async () => {
  writeFileSync(path.join(folder, 'lined.toml'), lined);
  run('run', 'lined.toml', '--quiet');
  run('view', 'lined');
  const p = await page('lined.html');
  assert.ok(await p.locator('#lining').isVisible());
  await p.keyboard.press('End');
  await p.waitForFunction(() => edda.shown === edda.player.end);
  const rows = table('lined/linings.csv');
  const last = rows.filter((r) => r.time === rows[rows.length - 1].time);
  for (const quantity of ['thrust', 'moment', 'shear', 'utilisation']) {
    await choose(p, 'lining', quantity);
    const { tips, extent, size, origin } = await p.evaluate(() => {
      const { liningRims: layer, blockSize, pose } = edda.view;
      const { extent } = edda.results.linings;
      return { tips: Array.from(layer.ends.subarray(0, 4 * layer.count)), extent, size: blockSize, origin: pose.origin };
    });
    assert.equal(tips.length, 2 * last.length);
    assert.ok(Math.abs(extent - 4.8) < 0.05);
    const largest = Math.max(...rows.map((r) => Math.abs(Number(r[quantity]))));
    assert.ok(largest > 0);
    last.forEach((r, k) => {
      const [dx, dy] = [tips[2 * k] + origin[0] - r.x, tips[2 * k + 1] + origin[1] - r.y];
      const out = (dx * r.x + dy * r.y) / Math.hypot(r.x, r.y);
      const wanted = (0.2 * extent * Number(r[quantity])) / largest;
      assert.ok(Math.abs(out - wanted) < 0.02 * size, `${quantity}: ${out}, not ${wanted}`);
    });
  }
  await choose(p, 'lining', 'none');
  assert.equal(await p.evaluate(() => edda.view.liningRims.count), 0);
  await p.close();
  const plain = await page('cavern.html');
  assert.ok(!(await plain.locator('#lining').isVisible()));
  assert.equal(await plain.locator('#field option[value=water_pressure]').count(), 0);
  await plain.close();
});

const wet = `
[flow]
[materials.rock]
density = 2600
young = "5 GPa"
poisson = 0.25
[joints.j]
friction_angle = 40
kn = "20 GPa/m"
aperture = "0.2 mm"
[contact]
joint = "j"
[domain]
outline = [[0, 0], [6, 0], [6, 4], [0, 4]]
material = "rock"
[[joint_set]]
angle = 0
spacing = 1
[[joint_set]]
angle = 90
spacing = 1
[[water]]
table = [[-1, 4], [7, 2]]
[[boundary]]
type = "fixed"
sides = ["bottom"]
[solver]
duration = 0.01
`;

test('draws water in joints along them', async () => {
  writeFileSync(path.join(folder, 'wet.toml'), wet);
  run('run', 'wet.toml', '--quiet');
  run('view', 'wet');
  const p = await page('wet.html');
  for (const field of ['water_pressure', 'head', 'discharge', 'aperture']) {
    await choose(p, 'field', field);
    const { drawn, values, range } = await p.evaluate((f) => ({
      drawn: edda.view.contactDots.count,
      values: Array.from(edda.frame.contacts[f === 'water_pressure' ? 'waterPressure' : f]),
      range: edda.results.run.fields.find((of) => of.name === f).range,
    }), field);
    const sizes = field === 'discharge' ? values.map(Math.abs) : values;
    assert.ok(drawn > 20 && range[1] > range[0], `${field}: ${drawn} lines, ${range}`);
    const step = Math.max(...range.map(Math.abs)) / 127;
    assert.ok(Math.max(...sizes) <= range[1] + step && Math.min(...sizes) >= range[0] - step, field);
  }
  await p.close();
});

test('nothing was said to the console, nothing asked of the network', () => {
  assert.deepEqual(faults, []);
});
