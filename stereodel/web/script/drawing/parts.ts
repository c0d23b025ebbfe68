/** What a room shows as one list of parts, the lowest first: canvas, SVG and GeoJSON read it. */

import type { SphericalVoronoi } from "../kernel/api.ts";
import { row, type Vector } from "../space.ts";
import type { Pen } from "./pen.ts";

/** What the reader can switch on and off: of sites, and of globes. */
type OfSites = "bubble" | "cells" | "closing" | "fills" | "isolines" | "names" | "rays" | "seeing" | "triangles";
export type Switch = OfSites | "graticule" | "land" | "tissot";

export type IsOn = (layer: Switch) => boolean;

/** A region of the sphere and what GeoJSON says of it: the left of a ring of great-circle sides, or without corners all. */
export interface Region {
  readonly properties: Readonly<Record<string, unknown>>;
  readonly corners: readonly Vector[];
}

/** A part of what is shown on one kind of surface. */
export interface Part<Surface> {
  /** Its switch; without one it is shown whenever it is there. */
  readonly layer?: Switch;
  /** Whether the picture has it in this state, as it has unless this is false. */
  readonly isThere?: boolean;
  /** Whether it lies over all others and follows the pointer, so that it is drawn alone. */
  readonly isOver?: boolean;
  draw?(pen: Pen, surface: Surface): void;
  /** Of GeoJSON, whatever the picture shows. */
  regions?(): readonly Region[];
}

export function drawParts<S>(pen: Pen, surface: S, parts: readonly Part<S>[], isOn: IsOn): void {
  for (const { layer, isThere = true, draw } of parts) {
    if (isThere && (layer === undefined || isOn(layer))) draw?.(pen, surface);
  }
}

/** Regions for GeoJSON, those of the topmost part first. */
export function regionsOf(parts: readonly Part<never>[]): Region[] {
  return parts
    .flatMap((part) => (part.regions ? [part.regions()] : []))
    .reverse()
    .flat();
}

/** The cell of a site; none where it has no corners. */
export function cellOf(voronoi: SphericalVoronoi, site: number, properties: Region["properties"]): Region[] {
  const corners = Array.from(voronoi.region(site), (vertex) => row(voronoi.vertices, vertex));
  return corners.length < 3 ? [] : [{ properties, corners }];
}
