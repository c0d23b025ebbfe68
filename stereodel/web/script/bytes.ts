/** Bytes as text, and whole numbers as bytes, as the page's contents and links hold them. */

/** The bytes of base64. */
export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

/** Numbers of seven bits a byte, the lowest first; the last is NaN where the bytes end amid one. */
export function wholeNumbers(bytes: Uint8Array): number[] {
  const numbers: number[] = [];
  let [number, weight] = [0, 1];
  for (const byte of bytes) {
    number += (byte % 128) * weight; // products and not shifts, which end at 32 bits
    weight *= 128;
    if (byte >= 128) continue;
    numbers.push(number);
    [number, weight] = [0, 1];
  }
  return weight === 1 ? numbers : [...numbers, NaN];
}

/** A number whose sign is its last bit. */
export function signed(zigzag: number): number {
  return zigzag % 2 === 1 ? -(zigzag + 1) / 2 : zigzag / 2;
}
