// Captures of the lab: the sheets that it draws, as figures for the printer and in pixels.
import { base64 } from "./pages.js";

// painting takes code that few visits need
const pictures = () => import("./pictures.js");
const textOf = (bytes) => new TextDecoder().decode(bytes);

/** What the lab gives of captures, as functions for its messages. They save files and tell what they did. */
export function captures({ say, warn, save, tell }) {
  const sheets = []; // those of a GIF, as they come

  /** Saves what `make` paints. */
  async function paint(name, make) {
    try {
      say(`${name}: painting`);
      save(name, await make(await pictures()), "");
      say(`${name}: saved`);
    } catch (error) {
      warn(`${name}: not saved: ${error.message ?? error}`);
    }
  }

  return {
    /** A file; a picture in pixels comes as the sheet that it is painted from. */
    file({ name, scale }, bytes) {
      if (scale) paint(name, ({ png }) => png(textOf(bytes), scale));
      else save(name, bytes);
    },
    sheet: (_, bytes) => sheets.push(textOf(bytes)),
    film({ name, scale, hundredths }) {
      const all = sheets.splice(0);
      paint(name, ({ gif }) => gif(all, scale, hundredths, (done) => say(`${name}: picture ${done + 1} of ${all.length}`)));
    },
    /** Tells the page around a sheet in pixels. */
    async asked(svg, scale, request) {
      try {
        const blob = await (await pictures()).png(svg, scale);
        tell({ kind: "figure", png: `data:image/png;base64,${base64(new Uint8Array(await blob.arrayBuffer()))}`, request });
      } catch (error) {
        tell({ kind: "error", text: `no picture: ${error.message ?? error}`, request });
      }
    },
  };
}
