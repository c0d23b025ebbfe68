/** What is made when it is first asked for. */
export function once<T>(make: () => T): () => T {
  let made: { readonly value: T } | null = null;
  return () => (made ??= { value: make() }).value;
}

/** An object whose values are made when they are first asked for. */
export function lazy<T extends object>(makers: { [Name in keyof T]: () => T[Name] }): T {
  const found = {} as T;
  for (const name of Object.keys(makers) as (keyof T)[])
    Object.defineProperty(found, name, { enumerable: true, get: once(makers[name]) });
  return found;
}
