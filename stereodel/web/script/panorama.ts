/** A picture of the whole sphere on a globe: drawn by the graphics processor while it moves, by the kernel at rest. */

import { make } from "./dom.ts";
import { traceDisc, type Disc, type Pen } from "./drawing/pen.ts";
import { Raster, type MoebiusMap } from "./kernel/api.ts";
import type { Messages } from "./messages.ts";

/** Widest picture that is kept, pixels; larger ones are made smaller. */
const WIDEST = 4096;

/** Pixels of the kernel's picture for one of the screen, at rest and, without a graphics processor, while it moves. */
const SHARP = 2;
const ROUGH = 0.25;

/** How far width and height may be from two to one. */
const RATIO_ERROR = 0.01;

/** Calls `opened` with the picture of a file, or says why there is none of the whole sphere. */
export async function openPanorama(file: File, messages: Messages, opened: (picture: Painted) => void): Promise<void> {
  const bitmap = await createImageBitmap(file).catch(() => null);
  if (bitmap === null || Math.abs(bitmap.width / bitmap.height - 2) > RATIO_ERROR) {
    const size = bitmap && `is ${bitmap.width} × ${bitmap.height}; one of the whole sphere is twice as wide as high`;
    messages.show(`${file.name}:`, `the picture ${size ?? "cannot be read"}. Nothing has changed.`);
    return;
  }
  const half = Math.round(Math.min(bitmap.width, WIDEST) / 2);
  const canvas = make("canvas", { width: 2 * half, height: half });
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  bitmap.close();
  messages.close();
  opened(new Painted(file.name, context.getImageData(0, 0, canvas.width, canvas.height)));
}

export class Painted {
  readonly name: string;
  readonly #raster: Raster;
  readonly #shader: Shader | null;
  /** Inks of labels that are read on any picture. */
  readonly letters = { ink: "rgb(255, 255, 255)", accent: "rgb(245, 160, 98)", halo: "rgb(24 26 28 / 0.55)" } as const;

  constructor(name: string, pixels: ImageData) {
    this.name = name;
    this.#raster = new Raster(pixels.data, pixels.width);
    this.#shader = shaderOf(pixels);
  }

  draw(pen: Pen, disc: Disc, map: MoebiusMap, isMoving: boolean): void {
    const scale = isMoving && this.#shader === null ? ROUGH : Math.min(SHARP, devicePixelRatio);
    const size = Math.max(1, Math.ceil(2 * disc.r * scale));
    const picture = isMoving && this.#shader !== null ? this.#shader(map, size) : this.#exact(map, size);
    pen.within({ region: (path) => traceDisc(path, disc) }, () =>
      pen.picture(picture, disc.x - disc.r, disc.y - disc.r, 2 * disc.r, 2 * disc.r),
    );
  }

  #exact(map: MoebiusMap, size: number): HTMLCanvasElement {
    const canvas = make("canvas", { width: size, height: size });
    const image = new ImageData(this.#raster.painted(map, [-1, 1, 2 / size, 2 / size], size, size, false), size, size);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    return canvas;
  }
}

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

/** Draws the square round the disc, so many pixels wide; valid until the next one is drawn. */
type Shader = (map: MoebiusMap, size: number) => HTMLCanvasElement;

/** Null where the browser has no WebGL2, or its texture is too small. */
function shaderOf(pixels: ImageData): Shader | null {
  const canvas = make("canvas");
  const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: true });
  if (gl === null || gl.getParameter(gl.MAX_TEXTURE_SIZE) < pixels.width) return null;
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return ({ left, right, magnification }, size) => {
    if (canvas.width !== size) canvas.width = canvas.height = size;
    gl.viewport(0, 0, size, size);
    // Rows of the matrices are columns of the shader's: a vector to their left is turned back.
    for (const [name, { matrix }] of Object.entries({ left, right }))
      gl.uniformMatrix3fv(gl.getUniformLocation(program, name), true, new Float32Array(matrix));
    gl.uniform1f(gl.getUniformLocation(program, "magnification"), 1 / magnification);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return canvas;
  };
}
