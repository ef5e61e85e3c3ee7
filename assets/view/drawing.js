"use strict";
// Draws a frame: its counts through a palette, and over it what is known of it.

/** Colours of levels 0 to 255, coldest first, as pixels of ImageData. */
function coloursOf(palette) {
  const rgb = bytesOf(palette.colours);
  const rgba = new Uint8ClampedArray(4 * 256).fill(255);
  for (let level = 0; level < 256; ++level) rgba.set(rgb.subarray(3 * level, 3 * level + 3), 4 * level);
  return new Uint32Array(rgba.buffer);
}

/** The counts up to which the shares of pixels lie, each share from 0 to 1. */
function percentilesOf(counts, shares) {
  const histogram = new Uint32Array(65536);
  for (const value of counts) ++histogram[value];
  return shares.map((share) => {
    let left = Math.max(1, Math.ceil(share * counts.length));
    let value = 0;
    while ((left -= histogram[value]) > 0) ++value;
    return value;
  });
}

/** Colours of all counts, spread evenly from `low` to `high`. */
function coloursOfCounts(colours, low, high) {
  const spread = Math.max(high - low, 1e-9);
  const ofCounts = new Uint32Array(65536);
  for (let value = 0; value < ofCounts.length; ++value)
    ofCounts[value] = colours[Math.min(255, Math.max(0, Math.floor((256 * (value - low)) / spread)))];
  return ofCounts;
}

/** Fills a canvas of the frame's own size. */
function paintCounts(canvas, counts, colours) {
  const context = canvas.getContext("2d");
  const image = context.createImageData(canvas.width, canvas.height);
  const pixels = new Uint32Array(image.data.buffer);
  for (let k = 0; k < pixels.length; ++k) pixels[k] = colours[counts[k]];
  context.putImageData(image, 0, 0);
}

// --- over the frame. `to`: how places of the frame become places of the screen: {x_px, y_px, scale, line_px, text_px}

/** A dark line below a light one, so that one of them is seen on anything. */
function strokeTwice(context, path, colour, line_px) {
  context.strokeStyle = "rgb(0 0 0 / 0.55)";
  context.lineWidth = 2 * line_px;
  context.stroke(path);
  context.strokeStyle = colour;
  context.lineWidth = line_px;
  context.stroke(path);
}

/** The inner edge of the line is where the box ends. */
function drawBox(context, to, box, colour, dashed) {
  const [x, y, width, height] = box.map((value) => value * to.scale);
  const path = new Path2D();
  path.rect(x - to.x_px - to.line_px / 2, y - to.y_px - to.line_px / 2, width + to.line_px, height + to.line_px);
  context.setLineDash(dashed ? [3 * to.line_px, 3 * to.line_px] : []);
  strokeTwice(context, path, colour, to.line_px);
  context.setLineDash([]);
}

function drawMask(context, to, label, height, colour) {
  label.outline ??= outlineOf(label.mask, height);
  const path = new Path2D();
  path.addPath(label.outline, new DOMMatrix([to.scale, 0, 0, to.scale, -to.x_px, -to.y_px]));
  strokeTwice(context, path, colour, to.line_px / 2);
}

/** Draws outside of a box only. */
function drawAround(context, to, box, draw) {
  const [x, y, width, height] = box.map((value) => value * to.scale);
  const path = new Path2D();
  path.rect(0, 0, context.canvas.width, context.canvas.height);
  path.rect(x - to.x_px, y - to.y_px, width, height);
  context.save();
  context.clip(path, "evenodd");
  draw();
  context.restore();
}

/** Points x, y, age one after another, oldest first; older ones are fainter. */
function drawTrail(context, to, points, colour) {
  const at = (k) => [points[k] * to.scale - to.x_px, points[k + 1] * to.scale - to.y_px];
  for (let k = 3; k < points.length; k += 3) {
    const path = new Path2D();
    path.moveTo(...at(k - 3));
    path.lineTo(...at(k));
    context.globalAlpha = Math.max(0.15, 1 - points[k + 2] / dataset.trail_s);
    strokeTwice(context, path, colour, to.line_px);
  }
  context.globalAlpha = 1;
}

/** Place and size of text on a plate that stays on the screen. `x`, `y`: its lower left corner. */
function plateOf(context, to, text, x, y) {
  context.font = `${to.text_px}px system-ui, "DejaVu Sans", sans-serif`;
  const pad = Math.round(to.text_px / 4);
  const [width, height] = [context.measureText(text).width + 2 * pad, to.text_px + 2 * pad];
  const left = Math.max(0, Math.min(x, context.canvas.width - width));
  const top = Math.max(0, Math.min(y - height, context.canvas.height - height));
  return { text, left, top, width, height, pad };
}

/** Light text on black. */
function drawPlate(context, plate, colour) {
  context.fillStyle = "#000";
  context.fillRect(plate.left, plate.top, plate.width, plate.height);
  context.fillStyle = colour;
  context.textBaseline = "middle";
  context.fillText(plate.text, plate.left + plate.pad, plate.top + plate.height / 2);
}

const overlap = (a, b) =>
  a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height && b.top < a.top + a.height;

/** Names above, below or beside their boxes, where they hide no box and no other name; left out where there is no place. */
function drawNames(context, to, clip, labels, colourOf) {
  const boxes = labels.map(({ box: [x, y, width, height] }) => (
    { left: x * to.scale - to.x_px, top: y * to.scale - to.y_px, width: width * to.scale, height: height * to.scale }));
  const taken = [...boxes];
  labels.forEach((label, k) => {
    const { left, top, width, height } = boxes[k];
    const gap = 2 * to.line_px;
    const line = 1.5 * to.text_px;
    const x = left - gap / 2;
    const corners = [[x, top - gap], [x, top + height + gap + line], [left + width + gap, top + line]];
    const places = corners.map((corner) => plateOf(context, to, tagOf(clip, label), ...corner));
    const plate = places.find((place) => !taken.some((other) => overlap(place, other)));
    if (plate === undefined) return;
    taken.push(plate);
    drawPlate(context, plate, colourOf(label));
  });
}

/** Four lines around a pixel of the frame, which stays free. */
function drawCrosshair(context, to, probe) {
  const [left, top] = [probe.x * to.scale - to.x_px, probe.y * to.scale - to.y_px];
  const path = new Path2D();
  const gap = 2 * to.line_px;
  const arm = 6 * to.line_px;
  const [x, y] = [left + to.scale / 2, top + to.scale / 2];
  for (const side of [-1, 1]) {
    const edge = side * (to.scale / 2 + gap);
    path.moveTo(x + edge, y);
    path.lineTo(x + edge + side * arm, y);
    path.moveTo(x, y + edge);
    path.lineTo(x, y + edge + side * arm);
  }
  strokeTwice(context, path, "#fff", to.line_px / 2);
}

function tagOf(clip, label) {
  const name = words(clip.categories[label.category].name);
  return label.track === undefined ? name : `${name} ${label.track}`;
}

/** `shown`: {boxes, names, tracks, masks}. */
function drawLabels(context, to, clip, frame, shown) {
  const colourOf = ({ category }) => clip.categories[category].colour;
  if (shown.tracks) {
    for (const trail of frame.trails) {
      const target = frame.labels.find((label) => label.track === trail.track);
      drawAround(context, to, target?.box ?? [0, 0, 0, 0], () => drawTrail(context, to, trail.points, colourOf(trail)));
    }
  }
  for (const label of frame.labels) {
    if (shown.masks && label.mask) drawMask(context, to, label, clip.height_px, colourOf(label));
    if (shown.boxes) drawBox(context, to, label.box, colourOf(label), label.ignore);
  }
  if (shown.names) drawNames(context, to, clip, frame.labels, colourOf);
}
