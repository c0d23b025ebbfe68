/** What the globes of the room show: land, graticule, circles, the reader's places, a picture of the whole sphere. */

import type { Contents } from "../contents.ts";
import * as balls from "../drawing/ball.ts";
import type { Layer } from "../drawing/ball.ts";
import { drawNames, Seats, type Box, type Named } from "../drawing/names.ts";
import { cellOf, type Part, type Region } from "../drawing/parts.ts";
import type { Disc } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
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

/** A globe; `map` takes the Earth to the axes of the view. */
interface Ball {
  readonly disc: Disc;
  readonly map: MoebiusMap;
  readonly isMoving: boolean;
  readonly standing: Named["standing"];
  /** Where names would lie on a handle or on its word. */
  readonly taken: readonly Box[];
}

const NAME: LabelStyle = { ink: "ink", halo: "halo", size: 13 };

/** The reader's own places. */
export interface Places {
  /** Of the file. */
  readonly name: string;
  readonly lonlat: Float64Array;
  /** Of the places, where their file has such a column. */
  readonly names?: readonly string[] | null;
  /** Its columns of numbers. */
  readonly values?: ReadonlyMap<string, Float64Array>;
}

/** Places are drawn at their latitudes as they stand; their cells are those of the sphere that `latitude` names. */
export class GlobeScene {
  places: Places | null = null;
  latitude: Latitude = "authalic";
  picture: Painted | null = null;
  /** The place whose row the pointer or the focus is on. */
  lit: number | null = null;
  readonly #graticule = balls.arcLayer("graticule", balls.graticuleArcs(STEP));
  readonly #tissot = balls.capLayer("tissot", equalCircles());
  #coarse: Layer | null = null;
  #fine: Layer | null = null;
  #made: Made | null = null;

  /** Unpacks the land that the page carries. */
  async load(contents: Contents): Promise<void> {
    this.latitude = await contents.latitude();
    const [coarse, fine] = await Promise.all([contents.land("110m"), contents.land("50m")]);
    if (coarse !== null) this.#coarse = balls.landLayer(coarse);
    if (fine !== null) this.#fine = balls.landLayer(fine);
  }

  show(places: Places | null): void {
    [this.places, this.lit, this.#made] = [places, null, places && madeOf(places, this.latitude)];
  }

  /** The area of a place's cell, square kilometres. */
  area(place: number): number {
    return this.#made?.areas[place] ?? 0;
  }

  /** A style of labels, on a picture in inks for its tone. */
  lettered(style: LabelStyle): LabelStyle {
    if (this.picture === null) return style;
    const { ink, accent, halo } = this.picture.letters;
    return { ...style, ink: style.ink === "ink" ? ink : accent, halo };
  }

  get parts(): Part<Ball>[] {
    const { picture, places, lit, latitude } = this;
    const lonlat = places?.lonlat ?? new Float64Array(0);
    const [hasPicture, hasPlaces] = [picture !== null, places !== null];
    const kind = latitude === "spherical" ? "" : `, latitude="${latitude}"`;
    const drawn = (layer: (isMoving: boolean) => Layer | null): Pick<Part<Ball>, "draw"> => ({
      draw: (pen, { disc, map, isMoving }) => balls.drawLayers(pen, disc, map, [layer(isMoving)]),
    });
    const land = drawn((isMoving) => (isMoving ? this.#coarse : (this.#fine ?? this.#coarse)));
    const held = drawn(() => balls.dotLayer("held", lonlatToXyz(lonlat.subarray(2 * lit!, 2 * lit! + 2))));
    const isMuch = lonlat.length > 2 * MANY_PLACES;
    return [
      { draw: (pen, { disc }) => pen.ball(disc, "ocean") },
      {
        isThere: hasPicture,
        draw: (pen, { disc, map, isMoving }) => picture!.draw(pen, disc, map, isMoving),
        python: { globe: `globe.add_raster(${JSON.stringify(picture?.name)})` },
      },
      { layer: "land", isThere: !hasPicture, ...land, python: { globe: 'globe.add_land(resolution="50m")' } },
      { layer: "graticule", ...drawn(() => this.#graticule), python: { globe: `globe.add_graticule(${STEP}.0)` } },
      // The page draws coasts with the land.
      { layer: "land", isThere: !hasPicture, python: { globe: 'globe.add_coastlines(resolution="50m")' } },
      {
        layer: "tissot",
        ...drawn(() => this.#tissot),
        python: { globe: `globe.add_tissot(${STEP}.0, ${CIRCLE_RADIUS.toFixed(4)})` },
      },
      { isThere: hasPlaces, python: { globe: `places = read_points(${JSON.stringify(places?.name)}).lonlat` } },
      {
        layer: "cells",
        isThere: hasPlaces,
        always: ["geojson"], // the data of the places, whatever is drawn of it
        ...drawn((isMoving) => (isMoving && isMuch ? null : this.#made!.cells)),
        python: { globe: `globe.add_cells(SphericalVoronoi.from_lonlat(places${kind}))` },
        regions: () => this.#made?.regions ?? [],
      },
      { isThere: hasPlaces, ...drawn(() => this.#made!.dots), python: { globe: "globe.add_points(places)" } },
      { isThere: hasPlaces && lit !== null, ...held },
      { draw: (pen, { disc }) => pen.shade(disc) },
      {
        layer: "names",
        isThere: hasPlaces && Boolean(places?.names),
        draw: (pen, { disc, map, isMoving, standing, taken }) => {
          const images = map.apply(this.#made!.dots.directions);
          const named = { names: places!.names!, standing, isMoving };
          drawNames(pen, new Seats(pen, disc, taken), disc, named, images, this.lettered(NAME));
        },
      },
    ];
  }
}

/** What is made of places when it is first asked for: their dots, their cells, the areas of these. */
interface Made {
  readonly dots: Layer;
  readonly voronoi: SphericalVoronoi;
  readonly cells: Layer;
  readonly areas: Float64Array;
  readonly regions: readonly Region[];
}

function madeOf({ lonlat }: Places, latitude: Latitude): Made {
  // Points of the cells' sphere are where the globe shows them: at the latitudes of a table.
  const drawn = (xyz: Float64Array): Float64Array =>
    latitude === "spherical" ? xyz : lonlatToXyz(tableLonlat(xyzToLonlat(xyz), latitude));
  const made: Made = lazy({
    dots: () => balls.dotLayer("site", lonlatToXyz(lonlat)),
    voronoi: () => SphericalVoronoi.fromLonlat(lonlat, latitude),
    cells: () => balls.arcLayer("cell", drawn(balls.ridgeArcs(made.voronoi))),
    areas: () => made.voronoi.areas(OF_EQUAL_AREA),
    regions: () =>
      Array.from({ length: lonlat.length / 2 }, (_, site) => {
        const [longitude, latitude] = lonlat.subarray(2 * site, 2 * site + 2);
        return cellOf(made.voronoi, site, { site: site + 1, longitude, latitude });
      }).flat(),
  });
  return made;
}

/** Three points of each circle, about places some distance apart on parallels that are as far apart. */
function equalCircles(): Float64Array {
  const points: number[] = [];
  for (let lat = -90; lat <= 90; lat += STEP) {
    const count = Math.max(1, Math.round((360 / STEP) * Math.cos((lat * Math.PI) / 180)));
    for (let k = 0; k < count; ++k) {
      for (const point of balls.circlePoints(directionOf((360 * k) / count - 180, lat), CIRCLE_RADIUS))
        points.push(...point);
    }
  }
  return Float64Array.from(points);
}
