/** A picture of the whole sphere through a map, by the graphics processor. */

import type { MoebiusMap } from "./kernel/api.ts";

const VERTEX = `#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`;

/** Back from the view to the sphere: rotation, fisheye of 1/S, rotation. Gradients leave out the jump at 180°. */
const FRAGMENT = `#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;

export class PanoramaShader {
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;

  private constructor(canvas: HTMLCanvasElement, gl: WebGL2RenderingContext, program: WebGLProgram) {
    this.#canvas = canvas;
    this.#gl = gl;
    this.#program = program;
  }

  /** Null where the browser has no WebGL2, or its texture is too small. */
  static of(pixels: ImageData): PanoramaShader | null {
    const canvas = document.createElement("canvas");
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: true });
    if (gl === null || gl.getParameter(gl.MAX_TEXTURE_SIZE) < pixels.width) return null;
    const program = linked(gl);
    if (program === null) return null;
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return new PanoramaShader(canvas, gl, program);
  }

  /** The square round the disc, so many pixels wide; valid until the next one is drawn. */
  draw(map: MoebiusMap, size: number): HTMLCanvasElement {
    const gl = this.#gl;
    if (this.#canvas.width !== size) this.#canvas.width = this.#canvas.height = size;
    gl.viewport(0, 0, size, size);
    gl.useProgram(this.#program);
    // Rows of the matrices are columns of the shader's: a vector to their left is turned back.
    const matrix = (name: string, rotation: { readonly matrix: Float64Array }): void =>
      gl.uniformMatrix3fv(gl.getUniformLocation(this.#program, name), true, new Float32Array(rotation.matrix));
    matrix("left", map.left);
    matrix("right", map.right);
    gl.uniform1f(gl.getUniformLocation(this.#program, "magnification"), 1 / map.magnification);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return this.#canvas;
  }
}

function linked(gl: WebGL2RenderingContext): WebGLProgram | null {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(kind);
    if (shader === null) return null;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}
