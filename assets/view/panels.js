"use strict";
// What is beside the frame: clips, the pixel at the crosshair, targets, temperatures of the colours, the timeline.

const byId = (id) => document.getElementById(id);

/** Frame indices of runs [first, count]. */
const indicesOf = (runs) => runs.flatMap(([first, number]) => Array.from({ length: number }, (_, k) => first + k));

const framesIn = (clip) => clip.frames.reduce((sum, [, number]) => sum + number, 0);
const signed = (value, digits) => `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(digits)}`;

function targetsOf(clip) {
  if (clip.targets.length === 0) return "no targets";
  const kinds = clip.targets.map((target) => `${words(clip.categories[target.category].name)} ${count(target.count)}`);
  const all = clip.targets.reduce((sum, target) => sum + target.count, 0);
  return `${counted(all, "target")} (${kinds.join(", ")})`;
}

function showHead(dataset) {
  const frames = dataset.clips.reduce((sum, clip) => sum + framesIn(clip), 0);
  document.title = `${dataset.name} · Veldt view`;
  byId("name").textContent = dataset.name;
  byId("about").textContent = `${counted(dataset.clips.length, "clip")}, ${counted(frames, "frame")}`;
  byId("not-made").hidden = dataset.not_made.length === 0;
  byId("not-made").textContent = `Left out, because not made: ${listed(dataset.not_made)}.`;
}

function showClips(clips, choose) {
  byId("clips").replaceChildren(...clips.map((clip) => {
    const facts = [words(clip.season), counted(framesIn(clip), "frame"), targetsOf(clip)];
    const button = element("button", { type: "button" }, element("b", {}, clip.id), element("span", {}, facts.join(" · ")));
    button.addEventListener("click", () => choose(clip));
    return element("li", {}, button);
  }));
}

function markClip(place) {
  const list = byId("clips");
  [...list.querySelectorAll("button")].forEach((button, k) => {
    if (k === place) button.setAttribute("aria-current", "true");
    else button.removeAttribute("aria-current");
  });
  const { offsetTop, offsetHeight } = list.children[place];
  list.scrollTop = Math.min(offsetTop, Math.max(list.scrollTop, offsetTop + offsetHeight - list.clientHeight));
}

/** What marks of the timeline mean; those that the clip has. */
function showMeanings(clip) {
  const size = { width: 14, height: 8 };
  const entry = (kind, name) => element("li", {},
    shape("svg", { ...size, "aria-hidden": "true" }, shape("rect", { ...size, class: kind })), name);
  const has = { seen: clip.seen.length > 0, closed: clip.closed.length > 0, gap: clip.frames.length > 1 };
  const names = { seen: "targets", closed: "shutter closed", gap: "frames skipped" };
  byId("meanings").replaceChildren(...Object.keys(names).filter((kind) => has[kind]).map((kind) => entry(kind, names[kind])));
}

/** Parts of the timeline: frames with labels below, closed shutter above; lines where frames were skipped. */
function showMarks(clip, indices) {
  const marks = byId("marks");
  marks.setAttribute("viewBox", `0 0 ${indices.length} 4`);
  const placeOf = new Map(indices.map((index, k) => [index, k]));
  const rectangles = (runs, kind, y, height) => runs.map(([first, number]) =>
    shape("rect", { class: kind, x: placeOf.get(first), y, width: number, height }));
  const gaps = clip.frames.slice(1).map(([first]) =>
    shape("rect", { class: "gap", x: placeOf.get(first) - 0.1, y: 0, width: 0.2, height: 4 }));
  showMeanings(clip);
  marks.replaceChildren(...rectangles(clip.seen, "seen", 2, 2), ...rectangles(clip.closed, "closed", 0, 2), ...gaps);
}

function captionOf(clip, frame) {
  return [
    clip.id,
    words(clip.season),
    `frame ${frame.frame}`,
    `${frame.time_s.toFixed(2)} s`,
    frame.agl_m === undefined ? null : `${frame.agl_m.toFixed(1)} m above ground`,
    clip.camera,
    `gain control ${clip.agc_mode}`,
    frame.closed ? "shutter closed: the image is frozen" : null,
  ].filter((part) => part !== null && part !== "").join(" · ");
}

function describeFrame(clip, frame) {
  const targets = distinct(frame.labels.map((label) => tagOf(clip, label)));
  const shutter = frame.closed ? "; shutter closed" : "";
  return `Frame ${frame.frame} of ${clip.id}: ${targets.length === 0 ? "no targets" : listed(targets)}${shutter}`;
}

/** Temperatures where the colours begin and end, in K; nothing where that is not known. */
function showEnds(low_k, high_k) {
  const known = low_k !== undefined && low_k < high_k;
  byId("coldest").textContent = known ? `${low_k.toFixed(1)} K` : "cold";
  byId("hottest").textContent = known ? `${high_k.toFixed(1)} K` : "hot";
}

function showBar(colours) {
  const canvas = byId("bar");
  paintCounts(canvas, Uint8Array.from({ length: 256 }, (_, level) => level), colours);
}

// --- the pixel at the crosshair

const holds = ([x, y, width, height], probe) =>
  probe.x + 0.5 >= x && probe.x + 0.5 <= x + width && probe.y + 0.5 >= y && probe.y + 0.5 <= y + height;

/** Boxes around a pixel, the smallest first. */
const labelsAt = (frame, probe) => frame.labels.filter((label) => holds(label.box, probe))
  .sort((a, b) => a.box[2] * a.box[3] - b.box[2] * b.box[3]);

/** What is known of a target, in one line. */
function lineOf(clip, label) {
  const parts = [tagOf(clip, label)];
  if (label.range_m !== undefined) parts.push(`${label.range_m.toFixed(1)} m away`);
  if (label.temperature_k !== undefined) parts.push(`${label.temperature_k.toFixed(1)} K`);
  if (label.contrast_k !== undefined) parts.push(`${signed(label.contrast_k, 1)} K against its surroundings`);
  return parts.join(" · ");
}

/** Digits of a temperature that counts can tell apart. */
const digitsOf = (kelvin_per_count) => Math.min(9, Math.max(0, Math.ceil(-Math.log10(kelvin_per_count))));

function showProbe(clip, frame, probe, kelvin_per_count) {
  if (probe === null) return;
  const place = probe.y * clip.width_px + probe.x;
  const value = frame.counts[place];
  byId("kelvin").textContent = `${(value * kelvin_per_count).toFixed(digitsOf(kelvin_per_count))} K`;
  byId("place").textContent = `x ${probe.x}, y ${probe.y} · ir16 ${value} · ir8 ${frame.levels[place]}`;
  const lines = labelsAt(frame, probe).map((label) => element("li", {}, lineOf(clip, label)));
  byId("under").replaceChildren(...(lines.length > 0 ? lines : [element("li", {}, "no target")]));
}

function showTargets(clip, frame) {
  const digits = (value, number) => (value === undefined ? "" : value.toFixed(number));
  const share = (value) => (value === undefined ? "" : percent(value));
  const names = ["target", "distance, m", "temperature, K", "contrast, K", "visible"];
  const columns = names.map((name, k) => ({ name, text: k === 0 }));
  const rows = frame.labels.map((label) => [
    label.ignore ? `${tagOf(clip, label)} (ignored)` : tagOf(clip, label),
    digits(label.range_m, 1), digits(label.temperature_k, 1),
    label.contrast_k === undefined ? "" : signed(label.contrast_k, 1), share(label.visibility),
  ]);
  byId("targets").replaceChildren(rows.length > 0
    ? table("Targets in this frame", columns, rows)
    : element("p", { class: "soft" }, "There are no labels in this frame."));
}
