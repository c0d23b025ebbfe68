/**
 * Fields of a state, and how a link tells them. A state is always what its link tells: whatever a hand sets is read from
 * its own text, so that the link shows the same pixels.
 */

import { LinkError, numberOf, writeNumber, type LinkValues } from "./link.ts";
import { directionOf, lonLatOf, type Vector } from "./space.ts";
import { View } from "./view/view.ts";
import { wrap } from "./words.ts";

/** Longitude and latitude, degrees. */
export type Place = readonly [number, number];

/** Digits behind the point of degrees and scales: finer than any pixel. */
const DIGITS = 7;

export interface Field<T> {
  /** The value in a link. */
  write(value: T): Record<string, string>;
  /** The value of a link, or `otherwise` where it says nothing of it. @throws LinkError where it cannot be read. */
  read(values: LinkValues, otherwise: T): T;
}

/** Several fields, which have names of their own in links; what is read is as it would be written again. */
export interface Fields<S> extends Field<S> {
  write(state: Partial<S>): Record<string, string>;
  /** A new state as a link tells it. */
  settle(state: S): S;
}

export function fields<S extends object>(parts: { readonly [K in keyof S]: Field<S[K]> }): Fields<S> {
  const names = Object.keys(parts) as (keyof S)[];
  const write = (state: Partial<S>): Record<string, string> =>
    Object.assign({}, ...names.map((name) => (name in state ? parts[name].write(state[name] as S[keyof S]) : {})));
  const read = (values: LinkValues, otherwise: S): S =>
    Object.fromEntries(names.map((name) => [name, parts[name].read(values, otherwise[name])])) as S;
  const settle = (state: S): S => read(new Map(Object.entries(write(state))), state);
  return { write, settle, read: (values, otherwise) => settle(read(values, otherwise)) };
}

/** A number; what is beyond its range is its end. */
export function number(name: string, low: number, high: number, digits = DIGITS): Field<number> {
  return {
    write: (value) => ({ [name]: writeNumber(Math.max(low, Math.min(high, value)), digits) }),
    read: (values, otherwise) => {
      const value = values.has(name) ? numberOf(values.get(name)!) : otherwise;
      if (!(value >= low && value <= high)) throw new LinkError(`${name} is not a number from ${low} to ${high}`);
      return value;
    },
  };
}

/** A whole number from 1 on, or null. @param shift What is added to it in links. */
export function whole(name: string, most: number, shift = 0): Field<number | null> {
  return {
    write: (value) => (value === null ? {} : { [name]: String(value + shift) }),
    read: (values, otherwise) => {
      if (!values.has(name)) return otherwise;
      const value = number(name, 1, most).read(values, 1);
      if (!Number.isInteger(value)) throw new LinkError(`${name} is not a whole number`);
      return value - shift;
    },
  };
}

/** Whether something is so; links that do not name it say no. */
export function flag(name: string): Field<boolean> {
  return { write: (value) => (value ? { [name]: "1" } : {}), read: (values) => values.has(name) };
}

/** One of some words. */
export function word<T extends string>(name: string, words: readonly T[]): Field<T> {
  return {
    write: (value) => ({ [name]: value }),
    read: (values, otherwise) => {
      const found = words.find((each) => each === (values.get(name) ?? otherwise));
      if (found === undefined) throw new LinkError(`${name} is not one of ${words.join(", ")}`);
      return found;
    },
  };
}

/** A longitude and a latitude, whose names begin alike. */
export function place(name: string, digits = DIGITS): Field<Place> {
  const [east, north] = [number(`${name}lon`, -360, 360, digits), number(`${name}lat`, -90, 90, digits)];
  return {
    write: ([lon, lat]) => ({ ...east.write(wrap(Number(lon.toFixed(digits)))), ...north.write(lat) }),
    read: (values, [lon, lat]) => [east.read(values, lon), north.read(values, lat)],
  };
}

export function direction(name: string, digits = DIGITS): Field<Vector> {
  const { write, read } = place(name, digits);
  return {
    write: (value) => write(lonLatOf(value)),
    read: (values, otherwise) => directionOf(...read(values, lonLatOf(otherwise))),
  };
}

export function view(name: string): Field<View> {
  const [middle, roll] = [place(name), number(`${name}roll`, -360, 360)];
  return {
    write: (value) => ({ ...middle.write(value.middle), ...(value.roll === 0 ? {} : roll.write(value.roll)) }),
    read: (values, otherwise) => View.above(...middle.read(values, otherwise.middle), roll.read(values, 0)),
  };
}
