"use strict";
// Loads frames one by one. A page from a file may not fetch() files beside it, but may add scripts: each frame is a
// script that calls takeFrame(), which is gone once the frame is decoded.

const FRAMES_KEPT = 32;
const arrived = new Map(); // what scripts have brought, by its key
const decoded = new Map(); // promises of frames by their key, the one used last at the end

const keyOf = (clip, index) => `${index}/${clip}`;

function takeFrame(frame) {
  arrived.set(keyOf(frame.clip, frame.frame), frame);
}

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

function runScript(source) {
  return new Promise((resolve, reject) => {
    const script = element("script", { src: source });
    const end = (settle) => () => {
      script.remove();
      settle();
    };
    script.onload = end(resolve);
    script.onerror = end(() => reject(new Error(`cannot read ${source}`)));
    document.head.append(script);
  });
}

async function readFrame(clip, index) {
  const source = `data/${encodeURIComponent(clip)}/${String(index).padStart(6, "0")}.js`;
  await runScript(source);
  const key = keyOf(clip, index);
  const { ir8, ir16, ...frame } = arrived.get(key) ?? {};
  arrived.delete(key);
  if (ir8 === undefined) throw new Error(`${source} has no frame ${index} of ${clip}`);
  const [levels, counts] = await Promise.all([ir8, ir16].map((file) => decodePng(bytesOf(file))));
  return { ...frame, levels: levels.counts, counts: counts.counts };
}

/** A promise of {clip, frame, time_s, labels, trails, levels, counts, …}, from memory if it was used lately. */
function loadFrame(clip, index) {
  const key = keyOf(clip, index);
  const frame = decoded.get(key) ?? readFrame(clip, index);
  decoded.delete(key);
  decoded.set(key, frame);
  frame.catch(() => decoded.delete(key)); // to be tried again
  if (decoded.size > FRAMES_KEPT) decoded.delete(decoded.keys().next().value);
  return frame;
}
