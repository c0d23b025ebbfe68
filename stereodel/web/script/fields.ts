/**
 * Fields of a state, and how a link tells them. A state is always what its link tells: whatever a hand sets is read from
 * its own text, so that the link shows the same pixels.
 */

import { LinkValues, writeNumber } from "./link.ts";
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
  /**
   * The value of a link, as it would be written again.
   * @param otherwise Where the link says nothing of it.
   * @throws LinkError where it cannot be read.
   */
  read(values: LinkValues, otherwise: T): T;
  /** A new value as a link tells it. @param before The one that it follows, which is so already. */
  settle(value: T, before: T): T;
}

/** Several fields, which have names of their own in links. */
export interface Fields<S> extends Field<S> {
  write(state: Partial<S>): Record<string, string>;
}

export function fields<S extends object>(parts: { readonly [K in keyof S]: Field<S[K]> }): Fields<S> {
  const names = Object.keys(parts) as (keyof S)[];
  const state = (value: <K extends keyof S>(name: K) => S[K]): S =>
    Object.fromEntries(names.map((name) => [name, value(name)])) as S;
  return {
    write: (state) =>
      Object.assign({}, ...names.map((name) => (name in state ? parts[name].write(state[name] as S[keyof S]) : {}))),
    read: (values, otherwise) => state((name) => parts[name].read(values, otherwise[name])),
    settle: (after, before) =>
      after === before ? before : state((name) => parts[name].settle(after[name], before[name])),
  };
}

function field<T>(write: Field<T>["write"], read: Field<T>["read"]): Field<T> {
  const again = (value: T): T => read(new LinkValues(Object.entries(write(value))), value);
  return {
    write,
    read: (values, otherwise) => again(read(values, otherwise)),
    settle: (value, before) => (value === before ? before : again(value)),
  };
}

/** A number; what is beyond its range is its end. */
export function number(name: string, low: number, high: number, digits = DIGITS): Field<number> {
  return field(
    (value) => ({ [name]: writeNumber(Math.max(low, Math.min(high, value)), digits) }),
    (values, otherwise) => values.number(name, low, high, otherwise),
  );
}

/** A whole number from 1 on, or null where the link has none. @param shift What is added to it in links. */
export function whole(name: string, most: number, shift = 0): Field<number | null> {
  return field<number | null>(
    (value) => (value === null ? {} : { [name]: String(value + shift) }),
    (values) => (values.has(name) ? values.whole(name, 1, most) - shift : null),
  );
}

/** Whether something is so; links that do not name it say no. */
export function flag(name: string): Field<boolean> {
  return field<boolean>(
    (value) => (value ? { [name]: "1" } : {}),
    (values) => values.has(name),
  );
}

/** One of some words. */
export function word<T extends string>(name: string, words: readonly T[]): Field<T> {
  return field<T>(
    (value) => ({ [name]: value }),
    (values, otherwise) => values.word(name, words, otherwise),
  );
}

/** A longitude and a latitude, whose names begin alike. */
export function place(name: string, digits = DIGITS): Field<Place> {
  return field<Place>(
    ([lon, lat]) => {
      const east = Number(wrap(lon).toFixed(digits));
      const north = Math.max(-90, Math.min(90, lat));
      return { [`${name}lon`]: String(east === -180 ? 180 : east), [`${name}lat`]: writeNumber(north, digits) };
    },
    (values, [lon, lat]) => [values.number(`${name}lon`, -360, 360, lon), values.number(`${name}lat`, -90, 90, lat)],
  );
}

export function direction(name: string, digits = DIGITS): Field<Vector> {
  const { write, read } = place(name, digits);
  return field<Vector>(
    (value) => write(lonLatOf(value)),
    (values, otherwise) => directionOf(...read(values, lonLatOf(otherwise))),
  );
}

export function view(name: string): Field<View> {
  const [middle, roll] = [place(name), number(`${name}roll`, -360, 360)];
  return field<View>(
    (value) => ({ ...middle.write(value.middle), ...(value.roll === 0 ? {} : roll.write(value.roll)) }),
    (values, otherwise) => View.above(...middle.read(values, otherwise.middle), roll.read(values, 0)),
  );
}
