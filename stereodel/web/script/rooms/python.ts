/** The Python lines that draw the picture of a room: texts of `lines/`, with values and the lines for what is shown. */

import type { IsOn, Switch } from "../drawing/parts.ts";
import GLOBE from "../lines/globe.txt";
import LIFT from "../lines/lift.txt";
import SPHERE from "../lines/sphere.txt";
import { writeNumber } from "../link.ts";
import { lonLatOf, type Vector } from "../space.ts";
import type { View } from "../view/view.ts";
import type { GlobeScene } from "./globe_scene.ts";
import type { GlobeState } from "./globe_state.ts";
import type { LiftPicture, LiftScene } from "./lift_drawing.ts";
import { poleSeen, type SphereScene } from "./sphere_drawing.ts";
import type { SphereState } from "./sphere_state.ts";

/** Sites beyond which the lines name a file in place of the places. */
const MOST_WRITTEN = 200;

/** The page's sets that are in the package, by their names. */
const LARGE = "cities().lonlat[cities().population >= 2_000_000]";
const NEAR = `SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${LARGE})`;
const SETS: Readonly<Record<string, string>> = {
  cities: LARGE,
  airports: `airports().lonlat[np.unique(${NEAR})]`,
  stars: "stars().lonlat[stars().magnitude <= 3.0]",
};

/** Where sites come from: a set of the page, or a file that they are in. */
export interface Origin {
  readonly set: string;
  readonly file: string;
}

type Values = Readonly<Record<string, string | number>>;
type Marks = Readonly<Record<string, unknown>>;

/** Lines that draw the ball and the plane. @param sizes Of both pictures, as the text names them. */
export function spherePython(scene: SphereScene, state: SphereState, origin: Origin, sizes: Values): string {
  const { sites, view, bubble, aim, step } = scene;
  const pole = poleSeen(scene.map, scene.twin);
  const isOn = (layer: Switch): boolean => step === null && scene.isOn(layer);
  const held = [...((isOn("bubble") && bubble?.sites) || []), ...(step === null ? scene.held : [step.site])];
  const marks = {
    facets: sites.facetCount > 0,
    hemisphere: sites.hasClosing,
    step: step !== null && step.before.dimension === 2,
    aimed: bubble !== null,
    held: held.length > 0,
    pole: pole !== null,
    front: pole !== null && pole[2] >= 0,
    hatched: isOn("seeing") || (isOn("closing") && sites.hasClosing),
  };
  const values = {
    ...sizes,
    sites: SETS[origin.set] ?? coordinates(sites.lonlat, `${readPoints(origin.file)}.lonlat`),
    pole: numbers(state.pole),
    view: numbers(view.middle),
    aim: lonLatOf(aim).join(", "),
    lens: `(${numbers(lonLatOf(state.lens.focus))}), magnification=${state.lens.magnification}`,
    held: held.join(", "),
    step: step === null ? "" : step.site + 1,
  };
  return filled(SPHERE, values, marks, isOn);
}

/** Lines that draw the sheet or the ball. @param sides Of the rectangle, where it is not the smallest one. */
export function liftPython(scene: LiftScene, picture: LiftPicture, origin: Origin, sides?: readonly number[]): string {
  const { sites, sheet, view, isOn } = scene;
  const [p, q] = [scene.p, scene.q].filter((site) => site !== null);
  const { contact, height } = picture;
  const box = sites.count === 0 ? [3, 2] : sides;
  const marks = {
    facets: sites.delaunay.dimension === 2,
    flat: sheet.isFlat,
    area: sites.rectangle.width > 0 && sites.rectangle.height > 0,
    letters: p !== undefined,
    pair: q !== undefined && p !== q,
    pole: picture.seenPole !== null,
  };
  const values = {
    points: coordinates(
      sites.places,
      `np.loadtxt(${JSON.stringify(origin.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`,
    ),
    corners: box ? `np.array([[-1, -1], [1, 1]]) * [${numbers(box)}] / 2` : "points.min(axis=0), points.max(axis=0)",
    view: numbers(view.middle),
    width: picture.width,
    height,
    scale: picture.scale,
    contact: `${contact[0]}, ${height - contact[1]}`,
    corner: sheet.corner,
    pair: [p, q].join(", "),
    shown: JSON.stringify(picture.grounds),
  };
  return filled(LIFT, values, marks, isOn);
}

/** Lines that draw the globe, or both of a bubble. @param width Of a disc. @param isPointed Whether the pointer has its circle. */
export function globePython(state: GlobeState, scene: GlobeScene, isOn: IsOn, width: number, pointed: boolean): string {
  const { lens, sight, from, to, before, after, pointer } = state;
  const { places, latitude, picture, resolution } = scene;
  const bubble = lens === "bubble";
  const { owner, names, lonlat = new Float64Array(0) } = places ?? {};
  const file = readPoints(places?.name ?? "");
  const kind = places === null || latitude === "spherical" ? "" : `, latitude="${latitude}"`;
  const at = (direction: Vector): string => {
    const place = `(${numbers(lonLatOf(direction))})`;
    return kind === "" ? place : `lonlat_to_xyz(${place}${kind})`;
  };
  const seen = ({ middle, roll }: View): string => numbers([...middle, roll]).replace(/, -?0$/, "");
  const values = {
    focus: at(sight.lens.focus),
    magnification: numbers([sight.lens.magnification]),
    taken: `${at(from.center)}, ${numbers([from.radius])}`,
    filled: `${at(to.center)}, ${numbers([to.radius])}`,
    title: "",
    ...owner?.lines,
    file,
    places: coordinates(lonlat, `${file}.lonlat`),
    words: lonlat.length > 2 * MOST_WRITTEN ? `${file}.column("name")` : JSON.stringify(names),
    latitude: kind,
    picture: JSON.stringify(picture?.name ?? ""),
    resolution,
    pointer: at(pointer),
    before: seen(before),
    view: seen(bubble ? after : sight.view),
    width: numbers([1.03 * width * (bubble ? 2 : 1)]),
  };
  const { points, scale } = owner?.lines ?? {};
  return filled(GLOBE, values, { bubble, picture, places, pointed, owned: points, scaled: scale, named: names }, isOn);
}

/**
 * A text with its values, `{name}`. A line that begins with `[a b]` is there where a and b hold or are switched on, with
 * `[!a]` where a does not; and names are imported for lines that are there alone.
 */
function filled(text: string, values: Values, marks: Marks, isOn: IsOn): string {
  const holds = (name: string): boolean => (name in marks ? Boolean(marks[name]) : isOn(name as Switch));
  const lines = text.split("\n").flatMap((line) => {
    const [, names, rest] = /^(?:\[([!a-z ]+)\] )?(.*)$/.exec(line)!;
    const isThere = names?.split(" ").every((name) => (name.startsWith("!") ? !holds(name.slice(1)) : holds(name)));
    return isThere === false ? [] : [rest];
  });
  const whole = lines.join("\n").replace(/\{(\w+)\}/g, (found, name: string) => String(values[name] ?? found));
  const body = whole.replace(/^(from|import) .*\n/gm, "");
  const isUsed = (name: string): boolean => new RegExp(`\\b${name.split(" as ").pop()}\\b`).test(body);
  return whole.replace(/^((?:from \S+ )?import )(.*)\n/gm, (_, begin: string, names: string) => {
    const used = names.split(", ").filter(isUsed);
    return used.length === 0 ? "" : `${begin}${used.join(", ")}\n`;
  });
}

/** Pairs of coordinates as an array (n, 2) of Python, in lines of at most 88 letters; of many what reads their file. */
function coordinates(values: Float64Array, file: string): string {
  if (values.length > 2 * MOST_WRITTEN) return `${file}  # the page draws over 1000 lines weaker where dense`;
  const rows = Array.from({ length: values.length / 2 }, (_, k) => `[${values[2 * k]}, ${values[2 * k + 1]}]`);
  const lines = rows.join(", ").replace(/(.{1,82}\],) /g, "$1\n    ");
  return rows.length === 0 ? "np.zeros((0, 2))" : `np.array([\n    ${lines},\n])`;
}

const readPoints = (file: string): string => `read_points(${JSON.stringify(file)})`;

/** Numbers to seven digits behind the point, as links have them. */
function numbers(values: readonly number[]): string {
  return values.map((value) => writeNumber(value, 7)).join(", ");
}
