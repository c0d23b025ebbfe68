/** What scripts that run later use of the page's first one, by name; `tools/bundle_web.mjs` writes this module. */
declare module "page:shared" {
  export const shared: Readonly<Record<string, unknown>>;
}

/** Texts that are bundled as they are. */
declare module "*.txt" {
  const text: string;
  export default text;
}
