/** Values as Python writes them, so that messages of the page are those of `stereodel.io` to the letter. */

/** `str` of a float: exponents from 1e16 on and below 1e-4, with two digits; whole numbers with a zero behind. */
export function floatText(value: number): string {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value < 0 ? "-inf" : "inf";
  if (Object.is(value, -0)) return "-0.0";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e16 || size < 1e-4)) {
    return value.toExponential().replace(/e([+-])(\d)$/, "e$10$2");
  }
  const text = String(value);
  return text.includes(".") ? text : `${text}.0`;
}

/** `repr` of text: in single quotes, unless only these are in it. */
export function quoted(text: string): string {
  const quote = text.includes("'") && !text.includes('"') ? '"' : "'";
  const named: Record<string, string> = { "\n": "\\n", "\r": "\\r", "\t": "\\t", "\\": "\\\\", [quote]: `\\${quote}` };
  const body = Array.from(
    text,
    (letter) => named[letter] ?? (/\p{C}|(?! )\p{Z}/u.test(letter) ? escaped(letter) : letter),
  );
  return quote + body.join("") + quote;
}

function escaped(letter: string): string {
  const code = letter.codePointAt(0)!;
  const hex = code.toString(16);
  if (code < 0x100) return `\\x${hex.padStart(2, "0")}`;
  return code < 0x10000 ? `\\u${hex.padStart(4, "0")}` : `\\U${hex.padStart(8, "0")}`;
}

/** `repr` of what JSON holds. */
export function repr(value: unknown): string {
  if (value === null || value === undefined) return "None";
  if (typeof value === "string") return quoted(value);
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "number") return Number.isSafeInteger(value) ? String(value) : floatText(value);
  if (Array.isArray(value)) return `[${value.map(repr).join(", ")}]`;
  return `{${Object.entries(value)
    .map(([name, entry]) => `${quoted(name)}: ${repr(entry)}`)
    .join(", ")}}`;
}

/** `str` of what JSON holds. */
export function str(value: unknown): string {
  return typeof value === "string" ? value : repr(value);
}
