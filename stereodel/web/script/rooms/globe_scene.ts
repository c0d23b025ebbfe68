/** What the globes of the room show: land, graticule, circles, the reader's places, a picture of the whole sphere. */

import type { Contents, Rings } from "../contents.ts";
import * as balls from "../drawing/ball.ts";
import type { Layer } from "../drawing/ball.ts";
import { drawNames, Seats, type Box, type Named } from "../drawing/names.ts";
import { cellOf, type Part } from "../drawing/parts.ts";
import type { Disc } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { Directions, lonlatToXyz, SphericalDelaunay, SphericalVoronoi, xyzToLonlat } from "../kernel/api.ts";
import type { Latitude, MoebiusMap } from "../kernel/api.ts";
import { tableLonlat } from "../kernel/coordinates.ts";
import { lazy, once } from "../kernel/lazy.ts";
import type { Painted } from "../panorama.ts";
import { angle, directionOf, lonLatOf, row, type Vector } from "../space.ts";
import type { Column, Owner } from "./owner.ts";

/** The Earth's mean radius, kilometres, and the radius of the equal circles of 150 kilometres on it, degrees. */
const EARTH = 6371.0088;
export const CIRCLE_RADIUS = ((150 / EARTH) * 180) / Math.PI;

/** The radius of the sphere with the area of the ellipsoid, kilometres. */
const OF_EQUAL_AREA = 6371.007180918474;

/** Degrees between the lines of the graticule, and between the circles. */
export const STEP = 10;

/** Places beyond which their cells are left out while the globe moves. */
const MANY_PLACES = 10_000;

/** Places of which dots are drawn at the most while the globe moves: of more, every second, third and so on. */
const MOST_MOVING = 25_000;

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
  /** Its columns of numbers, or what its owner chose. */
  readonly values?: ReadonlyMap<string, Column>;
  /** What their owner says of them, and lines of equal values. */
  readonly owner?: Owner | null;
  readonly isolines?: Rings | null;
}

/** Places are drawn at their latitudes as they stand; their cells are those of the sphere that `latitude` names. */
export class GlobeScene {
  places: Places | null = null;
  latitude: Latitude;
  picture: Painted | null = null;
  /** The place whose row the pointer or the focus is on, and those that are selected. */
  lit: number | null = null;
  selected: readonly number[] = [];
  /** Shapes of the data on the land. */
  layers: readonly Layer[] = [];

  constructor(latitude: Latitude) {
    this.latitude = latitude;
  }

  readonly #graticule = balls.arcLayer("graticule", balls.graticuleArcs(STEP));
  readonly #tissot = balls.capLayer("tissot", equalCircles());
  #coarse: Layer | null = null;
  #fine: Layer | null = null;
  #made: ReturnType<typeof madeOf> | null = null;

  /** Unpacks the land that the page carries. */
  async load(contents: Contents): Promise<void> {
    const [coarse, fine] = await Promise.all([contents.rings("land-110m"), contents.rings("land-50m")]);
    if (coarse !== null) this.#coarse = balls.landLayer(coarse);
    if (fine !== null) this.#fine = balls.landLayer(fine);
  }

  /** Of the land that is drawn at rest. */
  get resolution(): "50m" | "110m" {
    return this.#fine === null ? "110m" : "50m";
  }

  show(places: Places | null): void {
    [this.places, this.lit, this.#made] = [places, null, places && madeOf(places, this.latitude)];
  }

  /** The area of a place's cell, square kilometres. */
  area(place: number): number {
    return this.#made?.areas[place] ?? 0;
  }

  /** A style of labels, on a picture in its inks. */
  lettered(style: LabelStyle): LabelStyle {
    if (this.picture === null) return style;
    const { ink, accent, halo } = this.picture.letters;
    return { ...style, ink: style.ink === "ink" ? ink : accent, halo };
  }

  /** What lies around a place: how many cells share a side with its own, and which place is nearest. */
  around(place: number): { neighbours: number; nearest: number | null; kilometres: number } {
    const { voronoi, delaunay } = this.#made!;
    const { points } = delaunay;
    const { regionOffsets, regionNeighbors } = voronoi;
    const kept = regionOffsets[place + 1] > regionOffsets[place] ? place : voronoi.pointRegion[place];
    const beyond = regionNeighbors.subarray(regionOffsets[kept], regionOffsets[kept + 1]);
    const neighbours = new Set(beyond).size;
    const at = row(points, place);
    const two = points.length > 3 ? delaunay.nearest(at, 2) : [];
    const nearest = [...two].find((site) => site !== place) ?? null;
    const kilometres = nearest === null ? 0 : (angle(at, row(points, nearest)) * Math.PI * EARTH) / 180;
    return { neighbours, nearest, kilometres };
  }

  /** The place that is nearest to a direction, where it is drawn, and the radius of its dot; null without places. */
  nearest(to: Vector): { place: number; at: Vector; radius: number } | null {
    const { places, latitude } = this;
    if (places === null || places.lonlat.length === 0) return null;
    const [place] = this.#made!.delaunay.nearest(lonlatToXyz(lonLatOf(to), latitude));
    const at = row(lonlatToXyz(places.lonlat.subarray(2 * place, 2 * place + 2)), 0);
    return { place, at, radius: places.owner?.radii?.[place] ?? 0 };
  }

  /** What is drawn of the places that are lit or selected. */
  get held(): Layer | null {
    const { places, lit, selected } = this;
    if (places === null) return null;
    const held = [...selected, lit ?? []].flat();
    const lonlat = held.flatMap((k) => [...places.lonlat.subarray(2 * k, 2 * k + 2)]);
    return balls.dotLayer("held", lonlatToXyz(Float64Array.from(lonlat)));
  }

  get parts(): Part<Ball>[] {
    const { picture, places } = this;
    const lonlat = places?.lonlat ?? new Float64Array(0);
    const [hasPicture, hasPlaces] = [picture !== null, places !== null];
    const drawn = (layers: (isMoving: boolean) => readonly (Layer | null)[]): Pick<Part<Ball>, "draw"> => ({
      draw: (pen, { disc, map, isMoving }) => balls.drawLayers(pen, disc, map, layers(isMoving)),
    });
    const land = (isMoving: boolean): Layer | null => (isMoving ? this.#coarse : (this.#fine ?? this.#coarse));
    const isMuch = lonlat.length > 2 * MANY_PLACES;
    return [
      { draw: (pen, { disc }) => pen.ball(disc, "ocean") },
      {
        isThere: hasPicture,
        draw: (pen, { disc, map, isMoving }) => picture!.draw(pen, disc, map, isMoving),
      },
      { layer: "land", isThere: !hasPicture, ...drawn((isMoving) => [land(isMoving)]) },
      {
        layer: "fills",
        isThere: places?.owner?.inks !== undefined,
        ...drawn((isMoving) => (isMoving && isMuch ? [] : [...this.#made!.fills, land(isMoving)?.outlines ?? null])),
      },
      drawn(() => this.layers),
      { layer: "graticule", ...drawn(() => [this.#graticule]) },
      { layer: "tissot", ...drawn(() => [this.#tissot]) },
      {
        layer: "cells",
        isThere: hasPlaces,
        ...drawn((isMoving) => (isMoving && isMuch ? [] : [this.#made!.cells])),
        regions: () => this.#made?.regions ?? [],
      },
      { layer: "isolines", isThere: !!places?.isolines, ...drawn(() => this.#made!.isolines) },
      { isThere: hasPlaces, ...drawn((isMoving) => [this.#made![isMoving ? "sparse" : "dots"]]) },
      { draw: (pen, { disc }) => pen.shade(disc) },
      {
        layer: "names",
        isThere: hasPlaces && Boolean(places?.names),
        draw: (pen, { disc, map, isMoving, standing, taken }) => {
          const { directions, ...named } = this.#made!.named;
          const seats = new Seats(pen, disc, taken);
          drawNames(seats, { ...named, standing, isMoving }, map.apply(directions), this.lettered(NAME));
        },
      },
    ];
  }
}

/** What is made of places when it is first asked for: their dots, their cells, the areas of these. */
function madeOf({ lonlat, names, values, owner, isolines }: Places, latitude: Latitude) {
  const delaunay = once(() => new SphericalDelaunay(lonlatToXyz(lonlat, latitude)));
  const voronoi = once(() => new SphericalVoronoi(delaunay()));
  // Points of the cells' sphere are where the globe shows them: at the latitudes of a table.
  const drawn = (xyz: Float64Array): Float64Array =>
    latitude === "spherical" ? xyz : lonlatToXyz(tableLonlat(xyzToLonlat(xyz), latitude));
  /** The cells of one ink, as one region. */
  const tint = (ink: string, number: number): Layer[] => {
    const { pointRegion, vertices } = voronoi();
    const sites = [...pointRegion.keys()].filter((k) => owner?.ink?.[k] === number && voronoi().region(k).length > 2);
    if (sites.length === 0) return [];
    const offsets = [0];
    const corners = sites.flatMap((site) => {
      const region = [...voronoi().region(site)];
      offsets.push(offsets[offsets.length - 1] + region.length);
      return region.flatMap((vertex) => row(vertices, vertex));
    });
    const place = row(lonlatToXyz(lonlat.subarray(2 * sites[0], 2 * sites[0] + 2)), 0);
    return [balls.regionLayer("tint", null, drawn(Float64Array.from(corners)), offsets, place, true, ink)];
  };
  /** Dots of one place of so many. */
  const dotsOf = (of: number): Layer => {
    const { inks, ink = [], radii = [] } = owner ?? {};
    const some = <T>(all: readonly T[]): readonly T[] => all.filter((_, k) => k % of === 0);
    const xyz = lonlatToXyz(lonlat.filter((_, k) => (k >> 1) % of === 0));
    if (inks === undefined) return balls.dotLayer("site", xyz);
    return balls.spotLayer(
      xyz,
      some(radii),
      some(ink).map((number) => inks[number]),
    );
  };
  const dots = once(() => dotsOf(1));
  return lazy({
    delaunay,
    voronoi,
    dots,
    /** Those that are drawn while the globe moves. */
    sparse: () => (lonlat.length > 2 * MOST_MOVING ? dotsOf(Math.ceil(lonlat.length / (2 * MOST_MOVING))) : dots()),
    named: () => {
      const radii = owner?.radii ?? [];
      const order = [...(names ?? []).keys()].filter((k) => radii[k] !== 0);
      order.sort((a, b) => (radii[b] ?? 0) - (radii[a] ?? 0)); // the largest first, else as they come
      const points = order.flatMap((k) => row(lonlatToXyz(lonlat.subarray(2 * k, 2 * k + 2)), 0));
      const of = <T>(all: ArrayLike<T>): T[] => order.map((k) => all[k]);
      return { names: of(names ?? []), radii: of(radii), directions: new Directions(Float64Array.from(points)) };
    },
    fills: () => (owner?.inks ?? []).flatMap((ink, number) => tint(ink, number)),
    isolines: () => {
      const arcs = balls.lineArcs(isolines!);
      return [balls.arcLayer("isoline-halo", arcs), balls.arcLayer("isoline", arcs)];
    },
    cells: () => balls.arcLayer("cell", drawn(balls.ridgeArcs(voronoi()))),
    areas: () => voronoi().areas(OF_EQUAL_AREA),
    regions: () =>
      Array.from({ length: lonlat.length / 2 }, (_, site) => {
        const [longitude, latitude] = lonlat.subarray(2 * site, 2 * site + 2);
        const own = Object.fromEntries([...(values ?? [])].map(([title, column]) => [title, column[site]]));
        const name = names ? { name: names[site] } : {};
        return cellOf(voronoi(), site, { site: site + 1, ...name, longitude, latitude, ...own });
      }).flat(),
  });
}

/** Three points of each circle, about places some distance apart on parallels that are as far apart. */
function equalCircles(): Float64Array {
  const points: number[] = [];
  for (let lat = -90; lat <= 90; lat += STEP) {
    const count = Math.max(1, Math.round((360 / STEP) * Math.cos((lat * Math.PI) / 180)));
    for (let k = 0; k < count; ++k) {
      points.push(...balls.circlePoints(directionOf((360 * k) / count - 180, lat), CIRCLE_RADIUS).flat());
    }
  }
  return Float64Array.from(points);
}
