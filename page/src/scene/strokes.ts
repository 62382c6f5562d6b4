// A layer of straight strokes, with or without heads: forces, stress crosses, bolts, arrows; and of
// dots, which are strokes of no length. One draw call.
import * as twgl from 'twgl.js';
import type { Uniforms } from './blocks';

// Corners of a stroke: along (0 or 1), across (-1 or 1), head (0 or 1).
const STROKE = `#version 300 es
precision highp float;
in vec3 a_corner;
in vec4 a_ends;      // from and to, m
in vec4 a_colour;
in vec2 a_width;     // and how far a rim goes beyond it, px
uniform vec2 u_centre, u_zoom, u_pixel;
uniform float u_head;  // length of a head over the stroke's width; 0: none
out vec4 v_colour;
out vec2 v_round;      // of a dot: place in the unit circle
void main() {
  vec2 from = (a_ends.xy - u_centre) * u_zoom / u_pixel;
  vec2 to = (a_ends.zw - u_centre) * u_zoom / u_pixel;
  vec2 along = to - from;
  float length_px = length(along);
  bool dot_only = length_px < 1e-6;
  vec2 t = dot_only ? vec2(1.0, 0.0) : along / length_px;
  vec2 n = vec2(-t.y, t.x);
  float rim = a_width.y;
  float half_width = 0.5 * a_width.x + rim;
  float head = min(u_head * a_width.x, length_px);
  // A head is as long as it is wide: moved out by the rim, its tip goes ahead by rim / sin(atan(1 / 2)).
  float tip = u_head > 0.0 ? sqrt(5.0) * rim : 0.0;
  float back = u_head > 0.0 ? rim : 0.0;
  float shaft = max(length_px - head - back, 0.0);
  vec2 at;
  if (a_corner.z == 0.0) {
    at = from + t * shaft * a_corner.x + n * half_width * a_corner.y;
    if (dot_only) at = from + t * half_width * (2.0 * a_corner.x - 1.0) + n * half_width * a_corner.y;
  } else {
    float base = 1.0 - a_corner.x;
    at = to + t * tip + (n * 0.5 * a_corner.y - t) * (head + back + tip) * base;
  }
  gl_Position = vec4(at * u_pixel, 0.0, 1.0);
  v_colour = a_colour;
  v_round = dot_only ? vec2(2.0 * a_corner.x - 1.0, a_corner.y) : vec2(0.0);
}`;

const COLOUR = `#version 300 es
precision mediump float;
in vec4 v_colour;
in vec2 v_round;
out vec4 colour;
void main() {
  if (dot(v_round, v_round) > 1.0) discard;
  colour = v_colour;
}`;

// Shaft: two triangles; head: one.
const CORNERS = new Float32Array([
  0, -1, 0, 1, -1, 0, 1, 1, 0, 0, -1, 0, 1, 1, 0, 0, 1, 0,
  0, -1, 1, 1, 0, 1, 0, 1, 1,
]);

export class Strokes {
  private readonly program: twgl.ProgramInfo;
  private readonly buffers: twgl.BufferInfo;
  private readonly arrays: twgl.VertexArrayInfo;
  private ends = new Float32Array(0);
  private colours = new Uint8Array(0);
  private widths = new Float32Array(0);
  count = 0;

  constructor(private readonly gl: WebGL2RenderingContext, private readonly head = 0) {
    this.program = twgl.createProgramInfo(gl, [STROKE, COLOUR]);
    const each = { drawType: gl.DYNAMIC_DRAW, divisor: 1 };
    this.buffers = twgl.createBufferInfoFromArrays(gl, {
      a_corner: { numComponents: 3, data: CORNERS },
      a_ends: { numComponents: 4, data: new Float32Array(4), ...each },
      a_colour: { numComponents: 4, data: new Uint8Array(4), normalize: true, ...each },
      a_width: { numComponents: 2, data: new Float32Array(2), ...each },
    });
    this.arrays = twgl.createVertexArrayInfo(gl, this.program, this.buffers);
  }

  /** Empties the layer; there will be at most `most` strokes. */
  clear(most: number): void {
    this.count = 0;
    if (2 * most <= this.widths.length) return;
    this.ends = new Float32Array(4 * most);
    this.colours = new Uint8Array(4 * most);
    this.widths = new Float32Array(2 * most);
  }
  add(x0: number, y0: number, x1: number, y1: number, width: number, r: number, g: number, b: number, a = 255, rim = 0): void {
    const k = this.count++;
    this.ends.set([x0, y0, x1, y1], 4 * k);
    this.colours.set([r, g, b, a], 4 * k);
    this.widths.set([width, rim], 2 * k);
  }
  /** After the last add(). */
  upload(): void {
    const { gl } = this;
    const parts: [string, ArrayBufferView][] = [
      ['a_ends', this.ends.subarray(0, 4 * this.count)],
      ['a_colour', this.colours.subarray(0, 4 * this.count)],
      ['a_width', this.widths.subarray(0, 2 * this.count)],
    ];
    for (const [name, data] of parts) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.attribs![name].buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    }
  }
  draw(view: Uniforms): void {
    if (this.count === 0) return;
    const { gl } = this;
    gl.useProgram(this.program.program);
    gl.bindVertexArray(this.arrays.vertexArrayObject!);
    twgl.setUniforms(this.program, { ...view, u_head: this.head });
    gl.drawArraysInstanced(gl.TRIANGLES, 0, this.head > 0 ? 9 : 6, this.count);
  }
}
