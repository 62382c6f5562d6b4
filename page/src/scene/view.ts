// The drawing: layers over blocks, redrawn once per frame of the screen when something has changed.
import type { BoltNode } from '../data/bolts';
import type { LiningEnd } from '../data/linings';
import type { Frame, Motion } from '../data/frame';
import type { Mesh } from '../data/mesh';
import type { Scale } from '../data/scale';
import { Areas } from './areas';
import { Blocks, WIDTH } from './blocks';
import { BoltPlaces } from './bolt_places';
import { Camera } from './camera';
import * as layers from './layers';
import { Pose } from './pose';
import { Strokes } from './strokes';

export type Vectors = 'none' | 'displacement' | 'velocity';

/** What is shown of a frame. */
export interface Shown {
  frame: Frame;
  datum: Motion;
  values: Float32Array;
  magnification: number;
  scale: Scale;
  edges: boolean;
  contacts: boolean;
  forces: boolean;
  /** N of a stroke of the usual length; forces of all frames share a scale. */
  usualForce: number;
  /** Pa, of a pressure of the usual height. */
  usualPressure: number;
  cracks: boolean;
  crosses: boolean;
  /** Pa, the same for stresses. */
  usualStress: number;
  vectors: Vectors;
  /** Value of the longest arrow. */
  largestVector: number;
  bolts: BoltNode[];
  /** A force along linings, and its largest size in all frames. */
  linings: LiningEnd[];
  largestOfLinings: number;
  /** m, of that size. */
  heightOfLinings: number;
}

export interface Theme extends layers.Palette {
  edge: number[];
  held: number[];
  none: number[];
}

/** Edges of blocks smaller than this on the screen, px, would be a grey haze. */
const LEAST_EDGE = 4;

/** Lengths of usual strokes and of the longest arrow, in sizes of a block. */
const FORCE = 0.7;
const PRESSURE = 0.45;
const CROSS = 0.8;
/** A corner that leans on an edge has a force, but no length to draw a pressure over. */
const LEAST_LENGTH = 0.01;
const ARROW = 2.5;

export class View {
  readonly camera = new Camera();
  readonly pose: Pose;
  readonly software: boolean;
  private readonly gl: WebGL2RenderingContext;
  private readonly blocks: Blocks;
  private readonly contactDots: Strokes;
  private readonly forceStrokes: Strokes;
  private readonly pressureAreas: Areas;
  private readonly pressureRims: Strokes;
  private readonly crackStrokes: Strokes;
  private readonly crossStrokes: Strokes;
  private readonly arrowStrokes: Strokes;
  private readonly boltStrokes: Strokes;
  private readonly blockSize: number;
  private readonly colours: Float32Array;
  private readonly boltPlaces: BoltPlaces;
  private readonly liningAreas: Areas;
  private readonly liningRims: Strokes;
  private readonly liningPlaces: BoltPlaces;
  private shown?: Shown;

  constructor(readonly canvas: HTMLCanvasElement, private readonly mesh: Mesh, private theme: Theme) {
    this.software = isSoftware();
    const gl = canvas.getContext('webgl2', { antialias: !this.software, alpha: false });
    if (gl === null) throw new Error('this browser draws no WebGL 2: switch on hardware acceleration, or use another one');
    this.gl = gl;
    this.blocks = new Blocks(gl, mesh);
    this.pose = new Pose(mesh, WIDTH * this.blocks.rows);
    this.colours = new Float32Array(mesh.parts);
    this.contactDots = new Strokes(gl);
    this.forceStrokes = new Strokes(gl);
    this.pressureAreas = new Areas(gl);
    this.pressureRims = new Strokes(gl);
    this.crackStrokes = new Strokes(gl);
    this.crossStrokes = new Strokes(gl);
    this.arrowStrokes = new Strokes(gl, 4);
    this.boltStrokes = new Strokes(gl);
    this.boltPlaces = new BoltPlaces(mesh);
    this.liningAreas = new Areas(gl);
    this.liningRims = new Strokes(gl);
    this.liningPlaces = new BoltPlaces(mesh);
    this.blockSize = typicalSize(mesh);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    if (this.shown !== undefined) this.show(this.shown);
  }

  show(shown: Shown): void {
    this.shown = shown;
    const { frame, theme } = { frame: shown.frame, theme: this.theme };
    shown.scale.paint(shown.values, this.mesh.fixed, theme.held, theme.none, this.colours);
    this.pose.set(frame, shown.datum, shown.magnification, this.colours);
    this.blocks.setPose(this.pose);
    const size = this.blockSize;
    if (shown.contacts) layers.drawContacts(this.contactDots, frame, this.pose, this.mesh, shown.scale, 5);
    if (shown.forces) {
      layers.drawPressures(this.pressureAreas, this.pressureRims, frame, this.pose, this.mesh, shown.usualPressure, PRESSURE * size, LEAST_LENGTH * size, theme);
      layers.drawForces(this.forceStrokes, frame, this.pose, this.mesh, shown.usualForce, FORCE * size, theme);
    }
    if (shown.cracks) layers.drawCracks(this.crackStrokes, frame, this.pose, this.mesh, theme);
    if (shown.crosses) layers.drawCrosses(this.crossStrokes, frame, this.pose, this.mesh, shown.usualStress, CROSS * size, theme);
    if (shown.vectors !== 'none') {
      const [x, y] = shown.vectors === 'velocity' ? [frame.vx, frame.vy] : frame.motion;
      layers.drawArrows(this.arrowStrokes, x, y, this.pose, this.mesh, shown.largestVector, ARROW * size, theme);
    }
    const places = this.boltPlaces.of(shown.bolts, frame, shown.datum, shown.magnification, this.pose);
    layers.drawBolts(this.boltStrokes, shown.bolts, places, theme);
    const along = this.liningPlaces.of(shown.linings, frame, shown.datum, shown.magnification, this.pose);
    layers.drawLinings(this.liningAreas, this.liningRims, shown.linings, along, shown.largestOfLinings, shown.heightOfLinings, theme);
  }

  draw(): void {
    const { gl, camera, theme, shown } = this;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    const [r, g, b] = theme.paper;
    gl.clearColor(r / 255, g / 255, b / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (shown === undefined) return;
    const view = {
      u_centre: [camera.x, camera.y],
      u_zoom: [(2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height],
      u_pixel: [2 / camera.width, 2 / camera.height],
    };
    const unit = (c: number[]) => c.map((v) => v / 255);
    this.blocks.draw(view);
    const size = this.blockSize * camera.scale;
    if (shown.edges && size > LEAST_EDGE) {
      const fade = Math.min(1, (size - LEAST_EDGE) / 12);
      this.blocks.drawEdges(view, [...unit(theme.edge), 0.15 + 0.6 * fade]);
    }
    if (shown.cracks) this.crackStrokes.draw(view);
    if (shown.crosses) this.crossStrokes.draw(view);
    if (shown.forces) {
      this.pressureAreas.draw(view);
      this.pressureRims.draw(view);
      this.forceStrokes.draw(view);
    }
    if (shown.contacts) this.contactDots.draw(view);
    if (shown.vectors !== 'none') this.arrowStrokes.draw(view);
    this.liningAreas.draw(view);
    this.liningRims.draw(view);
    this.boltStrokes.draw(view);
  }

  /** What a pixel of a stroke stands for. */
  valuePerPixel(of: 'forces' | 'pressures' | 'crosses' | 'arrows' | 'linings'): number {
    const px = this.blockSize * this.camera.scale;
    if (of === 'forces') return (this.shown?.usualForce ?? 0) / (FORCE * px);
    if (of === 'pressures') return (this.shown?.usualPressure ?? 0) / (PRESSURE * px);
    if (of === 'linings') return (this.shown?.largestOfLinings ?? 0) / ((this.shown?.heightOfLinings ?? 1) * this.camera.scale);
    if (of === 'crosses') return (this.shown?.usualStress ?? 0) / (CROSS * px);
    return (this.shown?.largestVector ?? 0) / (ARROW * px);
  }

  /** The drawing, as it is now, over `g`; drawn anew with so many pixels for each of the screen's. */
  copyTo(g: CanvasRenderingContext2D, x: number, y: number, width: number, height: number, ratio = 1): void {
    const { canvas, camera } = this;
    const [before, after] = [[canvas.width, canvas.height], [camera.width, camera.height].map((n) => Math.round(n * ratio))];
    [canvas.width, canvas.height] = after;
    this.draw();
    g.drawImage(canvas, x, y, width, height);
    [canvas.width, canvas.height] = before;
    this.draw();
  }

  resize(width: number, height: number, ratio: number): void {
    const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    this.camera.resize(width, height);
  }
}

/** Median over the free parts of the root of their area, m. */
function typicalSize(mesh: Mesh): number {
  const area = mesh.area.filter((_, b) => !mesh.zoned[b]);
  const free = mesh.area.filter((_, b) => !mesh.zoned[b] && !mesh.fixed[b]);
  const sorted = (free.length > 0 ? free : area).sort();
  return Math.sqrt(sorted[sorted.length >> 1] ?? 1);
}

/** Whether WebGL is drawn by the processor. Asked of a context of its own: antialiasing is chosen by it. */
function isSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

