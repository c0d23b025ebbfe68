/** The conformal maps of the sphere that keep orientation: Möbius transformations. */

import { asDirections, asLonlat, asScalar, type Numbers } from "./checks.ts";
import { computed, Kept } from "./instance.ts";
import { asDirection, Rotation } from "./rotation.ts";

const Z_AXIS = [0, 0, 1];
/** Half a turn about x: it turns the fisheye of magnification 1/S along z into that of S, exactly. */
const FLIP = [0, 1, 0, 0];
/** Largest S (and largest 1/S) that can be evaluated. */
const LARGEST_MAGNIFICATION = 1e100;

/** Directions that stay in the kernel's memory while a map changes, as those of a picture from frame to frame. */
export class Directions {
  readonly xyz: Float64Array;
  /** @internal For the kernel. */
  readonly kept: Kept;

  /** @param xyz Vectors of any length but zero, row after row; not copied, and not to be written to. */
  constructor(xyz: Numbers) {
    this.xyz = asDirections(xyz, "xyz");
    this.kept = new Kept(this.xyz);
  }
}

/**
 * A conformal map of the sphere: rotation `right`, then the fisheye along +z, then rotation `left`. Images and scales
 * are equal to those of the Python class of the same name, bit for bit.
 *
 * @example
 * const lens = MoebiusMap.fisheye([0, 40], 4);
 * lens.scaleFactor(lens.focus); // 4
 */
export class MoebiusMap {
  readonly left: Rotation;
  /** S > 0, the scale at the focus: tan(Ξ/2) = S tan(χ/2) takes the angular distance χ from the focus to Ξ. */
  readonly magnification: number;
  readonly right: Rotation;
  private parts: Float64Array | null = null;

  constructor(left: Rotation, magnification: number, right: Rotation) {
    asScalar(magnification, "magnification", 0);
    CHECK: if (magnification < 1 / LARGEST_MAGNIFICATION || magnification > LARGEST_MAGNIFICATION) {
      throw new RangeError(
        `magnification is ${magnification}, outside the range 1e-100 to 1e+100 that can be evaluated`,
      );
    }
    this.left = left;
    this.magnification = magnification;
    this.right = right;
  }

  /** The map that moves nothing. */
  static identity(): MoebiusMap {
    return new MoebiusMap(Rotation.identity(), 1, Rotation.identity());
  }

  /** A rotation as a map. */
  static rotation(rotation: Rotation): MoebiusMap {
    return new MoebiusMap(Rotation.identity(), 1, rotation);
  }

  /**
   * The map that enlarges the surroundings of a focus S times and lets the rest shrink.
   *
   * @param focus (longitude, latitude) in degrees, or a direction x, y, z.
   */
  static fisheye(focus: Numbers, magnification: number): MoebiusMap {
    const right = Rotation.between(asDirection(focus, "focus"), Z_AXIS);
    return new MoebiusMap(right.inverse(), magnification, right);
  }

  /** The point of scale S, a unit vector; largest scale when S > 1. */
  get focus(): Float64Array {
    return this.right.inverse().apply(Z_AXIS);
  }

  /**
   * Images of directions as unit vectors, row after row.
   *
   * @param xyz Vectors of any length but zero, row after row; `Directions` if they are asked for again and again.
   */
  apply(xyz: Numbers | Directions): Float64Array {
    return this.evaluate("moebius_images", xyz, 3);
  }

  /** Local scales at directions, the same in all directions of the map: S / (cos²(χ/2) + S² sin²(χ/2)). */
  scaleFactor(xyz: Numbers | Directions): Float64Array {
    return this.evaluate("moebius_scales", xyz, 1);
  }

  /** Images of rows (longitude, latitude) in degrees, longitude in [-180, 180). */
  lonlat(lonlat: Numbers): Float64Array {
    const rows = asLonlat(lonlat);
    return computed(rows.length, "moebius_lonlat", this.forKernel, rows, rows.length / 2);
  }

  /** First `other`, then this one: the exact composition with its parameters rounded once. */
  after(other: MoebiusMap): MoebiusMap {
    const product = computed(9, "moebius_product", this.numbers, other.numbers);
    return new MoebiusMap(new Rotation(product.slice(0, 4)), product[4], new Rotation(product.slice(5)));
  }

  /** The exact inverse; its focus is where this map is smallest. */
  inverse(): MoebiusMap {
    const flip = new Rotation(FLIP);
    return new MoebiusMap(this.right.inverse().after(flip), this.magnification, flip.after(this.left.inverse()));
  }

  /** All that the kernel composes. */
  private get numbers(): Float64Array {
    return Float64Array.of(...this.left.quaternion, this.magnification, ...this.right.quaternion);
  }

  private evaluate(name: string, xyz: Numbers | Directions, width: number): Float64Array {
    const rows = xyz instanceof Directions ? xyz.kept : asDirections(xyz, "xyz");
    const count = (rows instanceof Kept ? rows.values : rows).length / 3;
    return computed(width * count, name, this.forKernel, rows, count);
  }

  /** Both matrices, each with what its doubles leave, and the magnification between them. */
  private get forKernel(): Float64Array {
    return (this.parts ??= Float64Array.of(...this.left.exactMatrix, this.magnification, ...this.right.exactMatrix));
  }
}
