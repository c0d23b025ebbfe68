/** An object whose values are made when they are first asked for. */
export function lazy<T extends object>(makers: { [Name in keyof T]: () => T[Name] }): T {
  const made: Partial<T> = {};
  const found = {} as T;
  for (const name of Object.keys(makers) as (keyof T)[]) {
    const get = (): T[keyof T] => (name in made ? made[name]! : (made[name] = makers[name]()));
    Object.defineProperty(found, name, { enumerable: true, get });
  }
  return found;
}
