"use strict";
// Decodes grey PNG files of 8 or 16 bits to their counts, because browsers reduce 16 bits to 8.
// Source: PNG specification (ISO/IEC 15948). `veldt view` has verified the files' checksums.

const PNG_SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];

/** Width and height in pixels, bytes of a pixel, and the pieces of the compressed data. */
function readChunks(file) {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  if (PNG_SIGNATURE.some((byte, k) => file[k] !== byte)) throw new Error("not a PNG file");
  const picture = { pieces: [] };
  for (let at = PNG_SIGNATURE.length; at + 12 <= file.length; ) {
    const length = view.getUint32(at);
    const kind = String.fromCharCode(...file.subarray(at + 4, at + 8));
    const body = at + 8;
    if (kind === "IHDR") {
      const [bits, colours, , , interlace] = file.subarray(body + 8, body + 13);
      const isPlain = colours === 0 && bits % 8 === 0 && interlace === 0;
      if (!isPlain) throw new Error("not a plain grey PNG file of 8 or 16 bits");
      Object.assign(picture, { width: view.getUint32(body), height: view.getUint32(body + 4), bytes: bits / 8 });
    }
    if (kind === "IDAT") picture.pieces.push(file.subarray(body, body + length));
    at = body + length + 4; // a checksum follows
  }
  return picture;
}

async function inflate(pieces) {
  const bytes = new Blob(pieces).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(bytes).arrayBuffer());
}

function paeth(left, above, corner) {
  const guess = left + above - corner;
  const [a, b, c] = [Math.abs(guess - left), Math.abs(guess - above), Math.abs(guess - corner)];
  return a <= b && a <= c ? left : b <= c ? above : corner;
}

// By the number of a filter: what it expects of a byte, from those to the left, above, and above to the left.
const PREDICTIONS = [() => 0, (left) => left, (left, above) => above, (left, above) => (left + above) >> 1, paeth];

/** Undoes the filters: rows of a filter's number and then its bytes, to rows of bytes alone. */
function unfilter(rows, width, height, step) {
  const out = new Uint8Array(width * height);
  const nothing = new Uint8Array(width);
  for (let y = 0; y < height; ++y) {
    const predict = PREDICTIONS[rows[y * (width + 1)]];
    const from = rows.subarray(y * (width + 1) + 1, (y + 1) * (width + 1));
    const to = out.subarray(y * width, (y + 1) * width);
    const above = y > 0 ? out.subarray((y - 1) * width, y * width) : nothing;
    for (let x = 0; x < step; ++x) to[x] = from[x] + predict(0, above[x], 0);
    for (let x = step; x < width; ++x) to[x] = from[x] + predict(to[x - step], above[x], above[x - step]);
  }
  return out;
}

/** {width, height, counts}: an Uint8Array or Uint16Array, row by row from the top. */
async function decodePng(file) {
  const { width, height, bytes, pieces } = readChunks(file);
  const rows = await inflate(pieces);
  if (rows.length !== (width * bytes + 1) * height) throw new Error("a PNG file of another size than it says");
  const out = unfilter(rows, width * bytes, height, bytes);
  if (bytes === 1) return { width, height, counts: out };
  const counts = new Uint16Array(width * height);
  for (let k = 0; k < counts.length; ++k) counts[k] = (out[2 * k] << 8) | out[2 * k + 1];
  return { width, height, counts };
}
