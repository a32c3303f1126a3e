// Writes zip files: names sorted, one time for all, so that the same files give the same bytes. The format is PKWARE's
// APPNOTE 6.3.10, of which a course pack needs three records; Node has what they hold, deflate and CRC-32.
import { deflateRawSync } from "node:zlib";

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});

/** CRC-32; Node has one of its own from version 22 on. */
export function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = TABLE[(crc ^ byte) & 0xff] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}

// the first day that the format knows: 1980-01-01, 0:00
const [TIME, DATE] = [0, 0x21];
const [DEFLATED, UTF8, VERSION] = [8, 0x800, 20];

/** A record of little-endian numbers, each as [size in bytes, value]. */
function record(...fields) {
  const bytes = Buffer.alloc(fields.reduce((sum, [size]) => sum + size, 0));
  let at = 0;
  for (const [size, value] of fields) at = bytes.writeUIntLE(value, at, size);
  return bytes;
}

/** The zip of files, as a map from names to contents. */
export function zip(files) {
  const [local, central] = [[], []];
  let offset = 0;
  for (const name of [...files.keys()].sort()) {
    const contents = Buffer.from(files.get(name));
    const [path, packed] = [Buffer.from(name), deflateRawSync(contents, { level: 9 })];
    const shared = [
      [2, VERSION], [2, UTF8], [2, DEFLATED], [2, TIME], [2, DATE],
      [4, crc32(contents)], [4, packed.length], [4, contents.length], [2, path.length], [2, 0],
    ];
    const head = record([4, 0x04034b50], ...shared);
    // no comment, disk 0, no attributes
    central.push(record([4, 0x02014b50], [2, VERSION], ...shared, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]), path);
    local.push(head, path, packed);
    offset += head.length + path.length + packed.length;
  }
  const directory = Buffer.concat(central);
  const end = record([4, 0x06054b50], [2, 0], [2, 0], [2, files.size], [2, files.size], [4, directory.length], [4, offset], [2, 0]);
  return Buffer.concat([...local, directory, end]);
}
