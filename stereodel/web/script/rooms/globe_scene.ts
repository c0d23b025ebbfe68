/** What the globes of the room show: land, graticule, circles, the reader's places, a picture of the whole sphere. */

import type { Contents } from "../contents.ts";
import {
  arcLayer,
  capLayer,
  circlePoints,
  dotLayer,
  drawLayers,
  graticuleArcs,
  landLayer,
  ridgeArcs,
  type Layer,
} from "../drawing/ball.ts";
import type { Disc, Pen } from "../drawing/pen.ts";
import { lonlatToXyz, SphericalVoronoi, xyzToLonlat, type Latitude, type MoebiusMap } from "../kernel/api.ts";
import { tableLonlat } from "../kernel/coordinates.ts";
import { lazy } from "../kernel/lazy.ts";
import type { Painted } from "../panorama.ts";
import { directionOf } from "../space.ts";

/** The radius of the equal circles on Earth, kilometres, and in degrees of a sphere with the Earth's mean radius. */
const CIRCLE_KILOMETRES = 150;
const EARTH = 6371.0088;
export const CIRCLE_RADIUS = ((CIRCLE_KILOMETRES / EARTH) * 180) / Math.PI;

/** The radius of the sphere with the area of the ellipsoid, kilometres. */
const OF_EQUAL_AREA = 6371.007180918474;

/** Degrees between the lines of the graticule, and between the circles. */
export const STEP = 10;

/** Places beyond which their cells are left out while the globe moves. */
const MANY_PLACES = 10_000;

/** Whether something is drawn. */
type IsOn = (name: "land" | "graticule" | "tissot" | "cells") => boolean;

/** The reader's own places. */
export interface Places {
  /** Of the file. */
  readonly name: string;
  readonly lonlat: Float64Array;
  /** Of the places, where their file has such a column. */
  readonly names?: readonly string[] | null;
}

/** Places are drawn at their latitudes as they stand; their cells are those of the sphere that `latitude` names. */
export class GlobeScene {
  places: Places | null = null;
  latitude: Latitude = "authalic";
  picture: Painted | null = null;
  /** The place whose row the pointer or the focus is on. */
  lit: number | null = null;
  readonly #graticule = arcLayer("graticule", graticuleArcs(STEP));
  readonly #tissot = capLayer("tissot", equalCircles());
  #coarse: Layer | null = null;
  #fine: Layer | null = null;
  #made: Made | null = null;

  /** Unpacks the land that the page carries. */
  async load(contents: Contents): Promise<void> {
    this.latitude = await contents.latitude();
    const [coarse, fine] = await Promise.all([contents.land("110m"), contents.land("50m")]);
    if (coarse !== null) this.#coarse = landLayer(coarse);
    if (fine !== null) this.#fine = landLayer(fine);
  }

  show(places: Places): void {
    [this.places, this.lit, this.#made] = [places, null, madeOf(places, this.latitude)];
  }

  /** The area of a place's cell, square kilometres. */
  area(place: number): number {
    return this.#made?.areas[place] ?? 0;
  }

  /** Draws a globe; `map` takes the Earth to the axes of the view. */
  draw(pen: Pen, disc: Disc, map: MoebiusMap, isOn: IsOn, isMoving: boolean): void {
    pen.ball(disc, "ocean");
    if (this.picture !== null) this.picture.draw(pen, disc, map, isMoving);
    const layers = this.#parts(isOn, isMoving).map(([, layer]) => layer());
    drawLayers(pen, disc, map, layers);
    pen.shade(disc);
  }

  /** The lines of Python that draw the same. */
  python(isOn: IsOn): string[] {
    const raster = this.picture === null ? [] : [`globe.add_raster(${JSON.stringify(this.picture.name)})`];
    return [...raster, ...this.#parts(isOn, false).flatMap(([, , line]) => line ?? [])];
  }

  /** What is drawn over the ground and a picture: whether it is, its layer, and its line of Python. */
  #parts(isOn: IsOn, isMoving: boolean): readonly [boolean, () => Layer | null, string?][] {
    const { places, lit, latitude } = this;
    const hasPlaces = places !== null;
    const hasLand = isOn("land") && this.picture === null;
    const isMuch = isMoving && hasPlaces && places.lonlat.length > 2 * MANY_PLACES;
    const kind = latitude === "spherical" ? "" : `, latitude="${latitude}"`;
    const held = (): Layer => dotLayer("held", lonlatToXyz(places!.lonlat.subarray(2 * lit!, 2 * lit! + 2)));
    const parts: [boolean, () => Layer | null, string?][] = [
      [hasLand, () => (isMoving ? this.#coarse : (this.#fine ?? this.#coarse)), 'globe.add_land(resolution="50m")'],
      [isOn("graticule"), () => this.#graticule, `globe.add_graticule(${STEP}.0)`],
      [hasLand, () => null, 'globe.add_coastlines(resolution="50m")'], // which the page draws with the land
      [isOn("tissot"), () => this.#tissot, `globe.add_tissot(${STEP}.0, ${CIRCLE_RADIUS.toFixed(4)})`],
      [hasPlaces, () => null, `places = read_points(${JSON.stringify(places?.name)}).lonlat`],
      [
        hasPlaces && isOn("cells"),
        () => (isMuch ? null : this.#made!.cells),
        `globe.add_cells(SphericalVoronoi.from_lonlat(places${kind}))`,
      ],
      [hasPlaces, () => this.#made!.dots, "globe.add_points(places)"],
      [hasPlaces && lit !== null, held],
    ];
    return parts.filter(([isThere]) => isThere);
  }
}

/** What is made of places when it is first asked for: their dots, the sides and the areas of their cells. */
interface Made {
  readonly dots: Layer;
  readonly voronoi: SphericalVoronoi;
  readonly cells: Layer;
  readonly areas: Float64Array;
}

function madeOf({ lonlat }: Places, latitude: Latitude): Made {
  // Points of the cells' sphere are where the globe shows them: at the latitudes of a table.
  const drawn = (xyz: Float64Array): Float64Array =>
    latitude === "spherical" ? xyz : lonlatToXyz(tableLonlat(xyzToLonlat(xyz), latitude));
  const made: Made = lazy({
    dots: () => dotLayer("site", lonlatToXyz(lonlat)),
    voronoi: () => SphericalVoronoi.fromLonlat(lonlat, latitude),
    cells: () => arcLayer("voronoi", drawn(ridgeArcs(made.voronoi))),
    areas: () => made.voronoi.areas(OF_EQUAL_AREA),
  });
  return made;
}

/** Three points of each circle, about places some distance apart on parallels that are as far apart. */
function equalCircles(): Float64Array {
  const points: number[] = [];
  for (let lat = -90; lat <= 90; lat += STEP) {
    const count = Math.max(1, Math.round((360 / STEP) * Math.cos((lat * Math.PI) / 180)));
    for (let k = 0; k < count; ++k) {
      for (const point of circlePoints(directionOf((360 * k) / count - 180, lat), CIRCLE_RADIUS)) points.push(...point);
    }
  }
  return Float64Array.from(points);
}
