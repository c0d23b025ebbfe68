/** The script of files: points and pictures that are opened, drawings and data that are taken along. */

import { sheetPng, sheetSvg } from "./drawing/sheet.ts";
import { copy, download } from "./export.ts";
import { placesGeojson, sitesGeojson } from "./geojson.ts";
import { openPoints } from "./opening.ts";
import { openPanorama } from "./panorama.ts";
import { globePython, liftPython, spherePython } from "./rooms/python.ts";

const exchange = {
  copy,
  download,
  globePython,
  liftPython,
  openPanorama,
  openPoints,
  placesGeojson,
  sheetPng,
  sheetSvg,
  sitesGeojson,
  spherePython,
};

export type Exchange = typeof exchange;

Object.assign(document.currentScript!, { offers: exchange });
