/** A table that cannot be read; the message begins with the row where there is one. */
export class TableError extends Error {}

/** No column, or several, look like what is needed: the reader is asked which. */
export class ColumnsError extends TableError {
  /** The columns there are. */
  readonly names: readonly string[];

  constructor(names: readonly string[]) {
    super("the table has no two columns of coordinates");
    this.names = names;
  }
}
