/**
 * The kernel as an instance of its WebAssembly module: memory, calls, failures.
 *
 * A call that fails throws a `KernelError` and takes the instance with all its memory along; the next call runs in a new
 * one, made from the same compiled module in a fraction of a millisecond. Nothing else is lost: whatever callers hold
 * are arrays of their own.
 */

/** Arrays that the module reads and fills. */
export type NumberArray = Float64Array | Int32Array | Int8Array | Uint8Array | Uint8ClampedArray;

type ArrayMaker<A extends NumberArray> = {
  new (buffer: ArrayBufferLike, offset: number, length: number): A;
  readonly BYTES_PER_ELEMENT: number;
};

/** What a function of the module takes: a number or an address, an array that is copied in or may stay, or nothing. */
export type Argument = number | NumberArray | Kept | null;

/** What the module itself says went wrong: mostly that there is no more memory. */
export class KernelError extends Error {
  override readonly name = "KernelError";
}

const OUT_OF_MEMORY = "out of memory: the kernel has 4 GiB at most; give fewer points";

/** An address or a count from the module: what is above 2 GiB comes back negative. */
export const unsigned = (value: number): number => value >>> 0;

/**
 * Bytes of arrays that stay in the module from call to call. More would spare copies of arrays that are hardly asked
 * again; a copy of as much takes some 50 ms.
 */
export const KEPT_BYTES = 2 ** 28;

/** An array that may stay in the module after the call; nobody writes to it. */
export class Kept {
  readonly values: NumberArray;

  constructor(values: NumberArray) {
    this.values = values;
  }
}

/** @internal One call after another; arrays that are handed in are given back when all are done. */
class Instance {
  readonly memory: WebAssembly.Memory;
  private readonly exports: WebAssembly.Exports;
  private readonly taken: number[] = []; // addresses, to be released after the call
  private readonly kept = new Map<NumberArray, number>(); // addresses, the array used last at the end
  private keptBytes = 0;

  constructor(module: WebAssembly.Module) {
    const fail = (kind: number, message: number): never => {
      const [what, words] = [kind, message].map((address) => this.text(unsigned(address)));
      throw new KernelError(what === "St9bad_alloc" ? OUT_OF_MEMORY : words || what);
    };
    this.exports = new WebAssembly.Instance(module, { page: { fail } }).exports;
    this.memory = this.exports["memory"] as WebAssembly.Memory;
    this.invoke("_initialize");
  }

  /** The address of as many bytes, those of an array, or which a function will fill. */
  place(bytes: number, array?: NumberArray): number {
    const address = this.allocate(bytes, array);
    this.taken.push(address);
    return address;
  }

  /** What stands at an address, as an array of its own. */
  copy<A extends NumberArray>(Type: ArrayMaker<A>, at: number, length: number): A {
    return new Type(this.memory.buffer, at, length).slice() as A;
  }

  /** Calls a function of the module. */
  call(name: string, ...given: Argument[]): number {
    return unsigned(this.invoke(name, ...given.map((argument) => this.addressOf(argument))));
  }

  /** Gives back what was handed in, and of what may stay the longest unused. */
  clean(): void {
    for (const address of this.taken.splice(0)) this.invoke("release", address);
    for (const [array, address] of this.kept) {
      if (this.keptBytes <= KEPT_BYTES) break;
      this.invoke("release", address);
      this.kept.delete(array);
      this.keptBytes -= array.byteLength;
    }
  }

  private addressOf(argument: Argument): number {
    if (argument === null || typeof argument === "number") return argument ?? 0;
    if (!(argument instanceof Kept)) return this.place(argument.byteLength, argument);
    const { values } = argument;
    const known = this.kept.get(values);
    if (known === undefined) this.keptBytes += values.byteLength;
    this.kept.delete(values); // the one used last stands at the end
    const address = known ?? this.allocate(values.byteLength, values);
    this.kept.set(values, address);
    return address;
  }

  private allocate(bytes: number, array?: NumberArray): number {
    if (bytes >= 2 ** 32) throw new KernelError(OUT_OF_MEMORY);
    const address = unsigned(this.invoke("allocate", Math.max(bytes, 1)));
    if (array) new Uint8Array(this.memory.buffer, address).set(new Uint8Array(array.buffer, array.byteOffset, bytes));
    return address;
  }

  private invoke(name: string, ...numbers: number[]): number {
    const found = this.exports[name] as ((...numbers: number[]) => number) | undefined;
    if (found === undefined) throw new KernelError(`the kernel has no ${name}: it and the script are of two versions`);
    return found(...numbers);
  }

  private text(address: number): string {
    const bytes = new Uint8Array(this.memory.buffer, address);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }
}

let module: WebAssembly.Module | null = null;
let instance: Instance | null = null;
let loading: Promise<void> | null = null;

/** What is asked of a response of `fetch`: programs without the browser's types have these. */
export interface KernelResponse {
  readonly ok: boolean;
  readonly status: number;
  readonly statusText: string;
  arrayBuffer(): Promise<ArrayBuffer>;
}

/** A compiled `WebAssembly.Module`, of which its type says nothing either. */
export interface KernelModule {
  readonly exports?: never;
}

/** The module as it comes: its bytes, a response of `fetch`, or compiled. */
export type KernelSource = ArrayBuffer | ArrayBufferView | KernelResponse | PromiseLike<KernelResponse> | KernelModule;

/**
 * Makes the kernel ready, once for the whole page.
 *
 * Further calls wait for the first one; after one that failed the next tries again.
 */
export function load(source: KernelSource): Promise<void> {
  loading ??= compiled(source)
    .then((made) => void (module = made))
    .catch((error: unknown) => {
      loading = null;
      throw error;
    });
  return loading;
}

async function compiled(source: KernelSource): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source as BufferSource);
  const response = await (source as KernelResponse | PromiseLike<KernelResponse>);
  if (!response.ok) throw new KernelError(`the kernel could not be fetched: ${response.status} ${response.statusText}`);
  // Not compileStreaming: servers that do not know the type of .wasm are many, and the module compiles in milliseconds.
  return WebAssembly.compile(await response.arrayBuffer());
}

/** @internal Runs `body`, which calls functions of the module that was loaded. */
export function run<T>(body: (session: Instance) => T): T {
  if (module === null) throw new KernelError("the kernel is not loaded: await load() first");
  const session = (instance ??= new Instance(module));
  try {
    const result = body(session);
    session.clean();
    return result;
  } catch (error) {
    instance = null;
    if (error instanceof WebAssembly.RuntimeError) throw new KernelError(`the kernel stopped: ${error.message}`);
    throw error;
  }
}

/** So many numbers that a function of the kernel fills in behind its other arguments. */
export function filled<A extends NumberArray>(
  Type: ArrayMaker<A>,
  length: number,
  name: string,
  ...given: Argument[]
): A {
  return run((session) => {
    const out = session.place(length * Type.BYTES_PER_ELEMENT);
    session.call(name, ...given, out);
    return session.copy(Type, out, length);
  });
}

/** The arrays of these types that a function of the kernel answers with. */
export function answered<T extends NumberArray[]>(
  types: readonly [...{ [K in keyof T]: ArrayMaker<T[K]> }],
  name: string,
  ...given: Argument[]
): T {
  return run((session) => {
    const answer = session.call(name, ...given);
    const arrays = types.map((Type: ArrayMaker<NumberArray>, slot) => {
      const [address, length] = Array.from(session.copy(Int32Array, answer + 8 * slot, 2), unsigned);
      return session.copy(Type, address, length);
    });
    session.call("discard", answer);
    return arrays as T;
  });
}

/** So many doubles. */
export function computed(length: number, name: string, ...given: Argument[]): Float64Array {
  return filled(Float64Array, length, name, ...given);
}
