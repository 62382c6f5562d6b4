// A layer of filled convex areas. One draw call.
import * as twgl from 'twgl.js';
import type { Uniforms } from './blocks';
import type { Point } from './faces';

const AREA = `#version 300 es
precision highp float;
in vec2 a_at;  // m
in vec4 a_colour;
uniform vec2 u_centre, u_zoom;
out vec4 v_colour;
void main() {
  gl_Position = vec4((a_at - u_centre) * u_zoom, 0.0, 1.0);
  v_colour = a_colour;
}`;

const COLOUR = `#version 300 es
precision mediump float;
in vec4 v_colour;
out vec4 colour;
void main() { colour = v_colour; }`;

export class Areas {
  private readonly program: twgl.ProgramInfo;
  private readonly buffers: twgl.BufferInfo;
  private readonly arrays: twgl.VertexArrayInfo;
  private corners: number[] = [];
  private colours: number[] = [];

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.program = twgl.createProgramInfo(gl, [AREA, COLOUR]);
    this.buffers = twgl.createBufferInfoFromArrays(gl, {
      a_at: { numComponents: 2, data: new Float32Array(2), drawType: gl.DYNAMIC_DRAW },
      a_colour: { numComponents: 4, data: new Uint8Array(4), normalize: true, drawType: gl.DYNAMIC_DRAW },
    });
    this.arrays = twgl.createVertexArrayInfo(gl, this.program, this.buffers);
  }

  clear(): void {
    this.corners = [];
    this.colours = [];
  }
  add(ring: Point[], [r, g, b]: number[], alpha: number): void {
    for (let k = 1; k + 1 < ring.length; ++k) {
      for (const [x, y] of [ring[0], ring[k], ring[k + 1]]) {
        this.corners.push(x, y);
        this.colours.push(r, g, b, alpha);
      }
    }
  }
  /** After the last add(). */
  upload(): void {
    const { gl } = this;
    const parts: [string, ArrayBufferView][] = [['a_at', new Float32Array(this.corners)], ['a_colour', new Uint8Array(this.colours)]];
    for (const [name, data] of parts) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.attribs![name].buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    }
  }
  draw(view: Uniforms): void {
    const count = this.corners.length / 2;
    if (count === 0) return;
    const { gl } = this;
    gl.useProgram(this.program.program);
    gl.bindVertexArray(this.arrays.vertexArrayObject!);
    twgl.setUniforms(this.program, view);
    gl.drawArrays(gl.TRIANGLES, 0, count);
  }
}
