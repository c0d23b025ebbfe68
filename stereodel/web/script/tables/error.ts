/** A table that cannot be read, in the words of `stereodel.io.read_points`. */
export class TableError extends Error {}

/** No column, or several, look like what is needed: the reader is asked which. */
export class ColumnsError extends TableError {
  /** The columns there are. */
  readonly names: readonly string[];

  constructor(message: string, names: readonly string[]) {
    super(message);
    this.names = names;
  }
}
