// Pages that hold a run: written by this one, and read back.

/** Bytes in letters. */
export const base64 = (bytes) => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
};

// a log of any run that a page can hold is far smaller
const MOST_BYTES = 256 * 1024 * 1024;

/** What comes out of a stream, bounded: a few bytes may stand for any number of others. */
async function through(bytes, stream) {
  const chunks = [];
  let size = 0;
  for (const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(chunks).arrayBuffer());
    size += value.length;
    if (size > MOST_BYTES) {
      reader.cancel();
      throw new Error(`it unpacks to more than ${MOST_BYTES} bytes`);
    }
    chunks.push(value);
  }
}

/** A page that holds the run of these parts, as the simulator alone (`light`) writes it: the program writes the same bytes. */
export async function savedPage(light, parts, files) {
  const fetched = async (name) => {
    const response = await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
    return new Uint8Array(await response.arrayBuffer());
  };
  const template = new TextDecoder().decode(await fetched(files.saved));
  return light.run_page(parts, template, await fetched(files.lightWasm));
}

/** The log in the text of such a page; an earlier one's was not compressed. */
export async function logOfSavedPage(text) {
  const held = /<script type="text\/plain" id="bytes">([^<]*)</.exec(text)?.[1];
  if (!held) throw new Error("it is no page that holds a run");
  const bytes = Uint8Array.from(atob(held), (c) => c.charCodeAt(0));
  return bytes[0] === 0x1f && bytes[1] === 0x8b ? through(bytes, new DecompressionStream("gzip")) : bytes;
}
