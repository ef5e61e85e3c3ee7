"use strict";
// The frame on the screen: levels and colours, what is over it, the crosshair and the zoom. Its state is page.js's.

const ZOOMS = [1, 2, 4, 8];
const OVER_FRAME = ["boxes", "names", "tracks", "masks"];
const picture = document.createElement("canvas"); // a frame in its own size

/** Colours by count, and the temperatures where they end. */
function lookOf(frame) {
  const clip = clipNow();
  const colours = coloursOf(dataset.palettes[byId("palette").selectedIndex]);
  const source = byId("source").value;
  if (source === "ir8") {
    const [low_k, high_k] = frame.levels_k ?? [];
    return { counts: frame.levels, colours: clip.black_hot ? colours.toReversed() : colours, low_k, high_k };
  }
  const unit = dataset.kelvin_per_count;
  const [low, high] = source === "window"
    ? ["low_k", "high_k"].map((id) => byId(id).valueAsNumber / unit)
    : percentilesOf(frame.counts, ["low_percent", "high_percent"].map((id) => byId(id).valueAsNumber / 100));
  const ofCounts = coloursOfCounts(colours, low, high);
  return { counts: frame.counts, colours: ofCounts, low_k: low * unit, high_k: high * unit };
}

/** The part of the frame that is on the screen, in its pixels. */
function visiblePart(clip) {
  const [width, height] = [clip.width_px / state.zoom, clip.height_px / state.zoom];
  const within = (middle, side, all) => Math.min(Math.max(middle - side / 2, 0), all - side);
  const x = within(state.centre.x, width, clip.width_px);
  return { x, y: within(state.centre.y, height, clip.height_px), width, height };
}

function fitScreen(clip) {
  const screen = byId("screen");
  const width = screen.parentElement.clientWidth;
  const tallest = Math.max(240, innerHeight - 250);
  const side = Math.min(width, (tallest * clip.width_px) / clip.height_px);
  const ratio = devicePixelRatio;
  screen.style.width = `${Math.floor(side)}px`;
  screen.width = Math.round(Math.floor(side) * ratio);
  screen.height = Math.round((screen.width * clip.height_px) / clip.width_px);
  return ratio;
}

function draw() {
  if (shown === null) return;
  const clip = clipNow();
  const look = lookOf(shown);
  const ratio = fitScreen(clip);
  const screen = byId("screen");
  const context = screen.getContext("2d");
  const part = visiblePart(clip);
  const scale = screen.width / part.width;
  Object.assign(picture, { width: clip.width_px, height: clip.height_px });
  paintCounts(picture, look.counts, look.colours);
  context.imageSmoothingEnabled = scale < 1;
  context.drawImage(picture, part.x, part.y, part.width, part.height, 0, 0, screen.width, screen.height);
  const [line_px, text_px] = [2, 12].map((size) => Math.max(1, Math.round(size * ratio)));
  const to = { x_px: part.x * scale, y_px: part.y * scale, scale, line_px, text_px };
  drawLabels(context, to, clip, shown, Object.fromEntries(OVER_FRAME.map((name) => [name, byId(name).checked])));
  if (shown.closed) {
    const plate = plateOf(context, to, "shutter closed (FFC)", screen.width / 2 - 70 * ratio, 32 * ratio);
    drawPlate(context, plate, "#ffc400");
  }
  if (state.probe !== null) drawCrosshair(context, to, state.probe);
  screen.setAttribute("aria-label", describeFrame(clip, shown));
  showBar(coloursOf(dataset.palettes[byId("palette").selectedIndex]));
  showEnds(look.low_k, look.high_k);
  showProbe(clip, shown, state.probe, dataset.kelvin_per_count);
}

// --- crosshair and zoom

function setProbe(x, y) {
  const clip = clipNow();
  const within = (value, side) => Math.min(Math.max(value, 0), side - 1);
  state.probe = { x: within(Math.floor(x), clip.width_px), y: within(Math.floor(y), clip.height_px) };
}

function moveProbe(dx, dy) {
  const clip = clipNow();
  const from = state.probe ?? { x: clip.width_px / 2, y: clip.height_px / 2 };
  setProbe(from.x + dx, from.y + dy);
  const part = visiblePart(clip);
  const { x, y } = state.probe;
  const isVisible = x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
  if (!isVisible) state.centre = { x, y };
  draw();
}

function setZoom(zoom) {
  state.zoom = zoom;
  state.centre = state.probe ?? { x: clipNow().width_px / 2, y: clipNow().height_px / 2 };
  byId("screen").classList.toggle("zoomed", zoom > 1);
  byId("zoom").textContent = `zoom ${zoom}×`;
}

function zoomBy(steps) {
  const place = ZOOMS.indexOf(state.zoom) + steps;
  if (place < 0 || place >= ZOOMS.length) return;
  setZoom(ZOOMS[place]);
  draw();
}

/** The pointer sets the crosshair; pressed, in a zoomed frame, it moves the frame. */
function watchPointer(screen) {
  const point = (event) => {
    if (shown === null) return;
    const clip = clipNow();
    const part = visiblePart(clip);
    const scale = part.width / screen.clientWidth;
    const [x, y] = [part.x + part.width / 2, part.y + part.height / 2];
    if (state.zoom > 1 && event.buttons === 1 && event.type === "pointermove")
      state.centre = { x: x - event.movementX * scale, y: y - event.movementY * scale };
    else setProbe(part.x + event.offsetX * scale, part.y + event.offsetY * scale);
    draw();
  };
  screen.addEventListener("pointermove", point);
  screen.addEventListener("pointerdown", point);
}
