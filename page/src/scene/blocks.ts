// Layers of the blocks: filled, and their edges. One draw call each.
import * as twgl from 'twgl.js';
import type { Mesh } from '../data/mesh';
import type { Pose } from './pose';

/** Texels of a row of the blocks' textures. */
export const WIDTH = 2048;

const PLACE = `
uniform sampler2D u_place, u_rest;
uniform vec2 u_centre, u_zoom;
struct Block { vec4 place, rest; };
Block block_of(uint row) {
  ivec2 at = ivec2(int(row) % ${WIDTH}, int(row) / ${WIDTH});
  return Block(texelFetch(u_place, at, 0), texelFetch(u_rest, at, 0));
}
vec4 placed(Block b, vec2 r) {
  vec2 x = b.place.xy + vec2(dot(b.place.zw, r), dot(b.rest.xy, r));
  // A block that is gone is clipped away.
  return b.rest.w == 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : vec4((x - u_centre) * u_zoom, 0.0, 1.0);
}`;

const FILL = `#version 300 es
precision highp float;
precision highp int;
in vec2 a_r;
in uint a_row;
flat out vec3 v_colour;
${PLACE}
void main() {
  Block b = block_of(a_row);
  gl_Position = placed(b, a_r);
  uint colour = uint(b.rest.z);
  v_colour = vec3(colour >> 16u, colour >> 8u & 255u, colour & 255u) / 255.0;
}`;

const FLAT = `#version 300 es
precision mediump float;
flat in vec3 v_colour;
out vec4 colour;
void main() { colour = vec4(v_colour, 1.0); }`;

const EDGE = `#version 300 es
precision highp float;
precision highp int;
in vec2 a_r;
in uint a_row;
${PLACE}
void main() { gl_Position = placed(block_of(a_row), a_r); }`;

const ONE = `#version 300 es
precision mediump float;
uniform vec4 u_colour;
out vec4 colour;
void main() { colour = u_colour; }`;

export type Uniforms = Record<string, unknown>;

export class Blocks {
  private readonly fill: twgl.ProgramInfo;
  private readonly edge: twgl.ProgramInfo;
  private readonly fillBuffers: twgl.BufferInfo;
  private readonly edgeBuffers: twgl.BufferInfo;
  private readonly fillArrays: twgl.VertexArrayInfo;
  private readonly edgeArrays: twgl.VertexArrayInfo;
  private readonly place: WebGLTexture;
  private readonly rest: WebGLTexture;
  readonly rows: number;

  constructor(private readonly gl: WebGL2RenderingContext, mesh: Mesh) {
    this.rows = Math.max(1, Math.ceil(mesh.parts / WIDTH));
    this.fill = twgl.createProgramInfo(gl, [FILL, FLAT]);
    this.edge = twgl.createProgramInfo(gl, [EDGE, ONE]);
    const r = { numComponents: 2, data: mesh.vertex };
    const row = { numComponents: 1, data: mesh.row };
    this.fillBuffers = twgl.createBufferInfoFromArrays(gl, {
      a_r: r, a_row: row, indices: { numComponents: 3, data: mesh.triangles },
    });
    this.edgeBuffers = twgl.createBufferInfoFromArrays(gl, {
      a_r: { numComponents: 2, buffer: this.fillBuffers.attribs!.a_r.buffer, type: gl.FLOAT },
      a_row: { numComponents: 1, buffer: this.fillBuffers.attribs!.a_row.buffer, type: gl.UNSIGNED_INT },
      indices: { numComponents: 2, data: mesh.edges },
    } as unknown as twgl.Arrays);
    this.fillArrays = twgl.createVertexArrayInfo(gl, this.fill, this.fillBuffers);
    this.edgeArrays = twgl.createVertexArrayInfo(gl, this.edge, this.edgeBuffers);
    const src = new Float32Array(4 * WIDTH * this.rows);
    const texture = { src, width: WIDTH, height: this.rows, internalFormat: gl.RGBA32F, minMag: gl.NEAREST, auto: false };
    this.place = twgl.createTexture(gl, texture);
    this.rest = twgl.createTexture(gl, texture);
  }

  setPose(pose: Pose): void {
    this.upload(this.place, pose.place);
    this.upload(this.rest, pose.rest);
  }
  private upload(texture: WebGLTexture, texels: Float32Array): void {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, this.rows, gl.RGBA, gl.FLOAT, texels);
  }

  draw(view: Uniforms): void {
    const { gl } = this;
    gl.useProgram(this.fill.program);
    gl.bindVertexArray(this.fillArrays.vertexArrayObject!);
    twgl.setUniforms(this.fill, { ...view, u_place: this.place, u_rest: this.rest });
    twgl.drawBufferInfo(gl, this.fillArrays);
  }
  drawEdges(view: Uniforms, colour: number[]): void {
    const { gl } = this;
    gl.useProgram(this.edge.program);
    gl.bindVertexArray(this.edgeArrays.vertexArrayObject!);
    twgl.setUniforms(this.edge, { ...view, u_place: this.place, u_rest: this.rest, u_colour: colour });
    twgl.drawBufferInfo(gl, this.edgeArrays, gl.LINES);
  }
}
