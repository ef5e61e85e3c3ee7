"use strict";
// Outlines of masks, from COCO's compressed run lengths: runs of pixels off and on, in columns from the left.

/** Each length: groups of five bits, low group first, and from the fourth on its difference from the one two before. */
function runLengths(text) {
  const runs = [];
  for (let at = 0; at < text.length; ) {
    let value = 0;
    let shift = 0;
    let group;
    do {
      group = text.charCodeAt(at++) - 48;
      value |= (group & 31) << shift;
      shift += 5;
    } while (group & 32);
    if (group & 16) value |= -1 << shift; // negative
    runs.push(runs.length > 2 ? value + runs.at(-2) : value);
  }
  return runs;
}

/** Pixels of a mask that are on, as numbers in columns: x * height + y. */
function pixelsOfMask(text, height) {
  const pixels = new Set();
  let at = 0;
  runLengths(text).forEach((length, k) => {
    if (k % 2 === 1) for (let pixel = at; pixel < at + length; ++pixel) pixels.add(pixel);
    at += length;
  });
  return pixels;
}

/** Sides of pixels of a mask beyond which it ends, in pixels of the frame. */
function outlineOf(text, height) {
  const pixels = pixelsOfMask(text, height);
  const path = new Path2D();
  const line = (x0, y0, x1, y1) => {
    path.moveTo(x0, y0);
    path.lineTo(x1, y1);
  };
  for (const pixel of pixels) {
    const x = Math.floor(pixel / height);
    const y = pixel % height;
    if (!pixels.has(pixel - height)) line(x, y, x, y + 1);
    if (!pixels.has(pixel + height)) line(x + 1, y, x + 1, y + 1);
    if (y === 0 || !pixels.has(pixel - 1)) line(x, y, x + 1, y);
    if (y === height - 1 || !pixels.has(pixel + 1)) line(x, y + 1, x + 1, y + 1);
  }
  return path;
}
