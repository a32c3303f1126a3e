/** What the pages may load and do: nothing from elsewhere, and within them only the script and the style of these hashes. */
export const policy = (script, style) =>
  `default-src 'none'; script-src 'self' '${script}' 'wasm-unsafe-eval'; style-src 'self' '${style}'; img-src 'self' data: blob:; ` +
  "connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'";
