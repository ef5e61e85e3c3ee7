// Pictures: sample frames with boxes, the heat map of boxes, and the map with flights.

// --- frames

function boxTitle(box, categories) {
  const parts = [words(categories[box.category]), box.size];
  if (box.track !== undefined) parts.push(`track ${box.track}`);
  if (box.visibility !== undefined) parts.push(`${percent(box.visibility)} visible`);
  if (box.contrast_noise !== undefined) parts.push(`contrast ${figure(box.contrast_noise)} x noise`);
  if (box.range_m !== undefined) parts.push(`${figure(box.range_m)} m away`);
  if (box.truncated) parts.push("cut by the border");
  if (box.ignore) parts.push("ignored");
  return parts.join(", ");
}

function boxShapes(box, categories) {
  const [x, y, width, height] = box.box;
  const place = { x, y, width, height };
  return [
    shape("rect", { ...place, class: "halo" }),
    shape("rect", { ...place, class: box.ignore ? "box ignored" : "box", stroke: seriesColour(box.category) },
      shape("title", {}, boxTitle(box, categories))),
  ];
}

function frameFigure(frame, categories) {
  const picture = element("img", { src: frame.picture, alt: "", loading: "lazy" });
  const overlay = shape("svg", { viewBox: `0 0 ${frame.width_px} ${frame.height_px}`, preserveAspectRatio: "none" },
    frame.boxes.map((box) => boxShapes(box, categories)));
  const name = `${frame.video}, frame ${frame.frame}`;
  const button = element("button", { type: "button", class: "frame", "aria-expanded": "false", "aria-label": `Enlarge ${name}: ${counted(frame.boxes.length, "label")}` }, picture, overlay);
  const labels = frame.boxes.length > 0 ? counted(frame.boxes.length, "label") : "no labels";
  const whole = element("figure", {}, button,
    element("figcaption", {}, element("b", {}, frame.video), ` frame ${count(frame.frame)}`, element("br"), frame.why === "no labels" ? labels : `${labels} (${frame.why})`));
  button.addEventListener("click", () => button.setAttribute("aria-expanded", String(whole.classList.toggle("wide"))));
  return whole;
}

/** Describes which frames are shown; with many clips, there are fewer of each, and none of some. */
function whichFrames(frames, clips) {
  const shown = distinct(frames.map((frame) => frame.video)).length;
  const whose = shown < clips ? `Of ${shown} of the ${clips} clips` : "Of each clip";
  const kinds = { "most labels": "the frame with most labels", median: "one with the median number", "no labels": "the first without any" };
  return `${whose} ${listed(Object.keys(kinds).filter((why) => frames.some((frame) => frame.why === why)).map((why) => kinds[why]))}.`;
}

function framesSection({ samples, labels }) {
  const grid = element("div", { class: "frames" }, samples.frames.map((frame) => frameFigure(frame, labels.categories)));
  const shown = element("input", { type: "checkbox", checked: true });
  shown.addEventListener("change", () => grid.classList.toggle("no-boxes", !shown.checked));
  const present = new Set(samples.frames.flatMap((frame) => frame.boxes.map((box) => Math.min(box.category, SERIES.length))));
  const keys = seriesKeys(labels.categories).filter((_, k) => present.has(k));
  if (samples.frames.some((frame) => frame.boxes.some((box) => box.ignore))) keys.push({ name: "ignored", dashed: true });
  return section("frames", "Frames",
    element("p", { class: "soft" }, `${whichFrames(samples.frames, labels.videos.length)} Click a frame to enlarge it; point at a box for details.`),
    samples.missing.length > 0 ? element("p", { class: "notice" }, `${counted(samples.missing.length, "picture")} could not be read: ${listed(samples.missing)}.`) : null,
    samples.frames.length > 0 ? [element("label", { class: "switch" }, shown, "Show boxes"), legend(keys), grid] : null);
}

// --- where boxes are

// From black through violet and orange to pale yellow, with increasing brightness.
const RAMP = [[0, 0, 4], [60, 9, 101], [139, 34, 105], [212, 72, 66], [251, 155, 6], [252, 255, 164]];

function rampColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
  const below = Math.min(Math.floor(at), RAMP.length - 2);
  const mix = RAMP[below].map((value, k) => Math.round(value + (at - below) * (RAMP[below + 1][k] - value)));
  return `rgb(${mix.join(" ")})`;
}

/** Share of the area covered by boxes that is in the middle ninth of the picture. */
function middleShare({ columns, rows, boxes_over }) {
  const inMiddle = (cell, cells) => cell + 0.5 > cells / 3 && cell + 0.5 < (2 * cells) / 3;
  const all = boxes_over.reduce((sum, value) => sum + value, 0);
  const middle = boxes_over.filter((_, k) => inMiddle(k % columns, columns) && inMiddle(Math.floor(k / columns), rows)).reduce((sum, value) => sum + value, 0);
  return middle / all;
}

function heatSection({ heat, labels }) {
  const title = "Where boxes are";
  if (labels === 0) return section("places", title, element("p", {}, "There are no labels."));
  if (heat.boxes_over === undefined) return section("places", title, element("p", {}, "The labels do not state the size of the pictures."));
  const most = Math.max(...heat.boxes_over);
  const cells = heat.boxes_over.map((value, k) => shape("rect", { x: k % heat.columns, y: Math.floor(k / heat.columns), width: 1, height: 1, fill: rampColour(value / most) },
    shape("title", {}, `${figure(value)} boxes on average`)));
  const steps = 48;
  const ramp = Array.from({ length: steps }, (_, k) => shape("rect", { x: k, width: 1.1, height: 1, fill: rampColour(k / (steps - 1)) }));
  return section("places", title,
    element("p", { class: "soft" }, `The number of boxes that cover each part of the picture, averaged over all pictures. ${percent(middleShare(heat))} of the covered area is in the middle ninth; for an even distribution it would be ${percent(1 / 9)}.`),
    element("div", { class: "card heat" },
      shape("svg", { viewBox: `0 0 ${heat.columns} ${heat.rows}`, role: "img", "aria-label": "Heat map of boxes over the picture", "shape-rendering": "crispEdges" }, cells),
      element("div", { class: "ramp" }, "0", shape("svg", { viewBox: `0 0 ${steps} 1`, preserveAspectRatio: "none", "aria-hidden": "true", "shape-rendering": "crispEdges" }, ramp), `${figure(most)} boxes`)));
}

// --- flights over the map: x east, y north, so the sign of y changes

// Alternately dark and light, all distinct from the map's greens on a white casing.
const TRACKS = ["#0072b2", "#d55e00", "#101010", "#aa3377", "#009e73", "#8c510a", "#5b2a86"];

const pointsOf = (points) => points.map(([x, y]) => `${x},${-y}`).join(" ");

function trackShapes({ points_m: points, seen_m: seen, clip }, own, showSeen, size_m) {
  if (points.length === 0) return [];
  const line = { points: pointsOf(points) };
  const [x, y] = points[0];
  return [
    showSeen && seen.length > 0 ? shape("polygon", { class: "seen", points: pointsOf(seen), fill: own, stroke: own }) : null,
    shape("polyline", { ...line, class: "casing" }),
    shape("polyline", { ...line, class: "track", stroke: own }, shape("title", {}, clip)),
    shape("circle", { cx: x, cy: -y, r: 0.011 * size_m, fill: own, stroke: "#fff", "stroke-width": 0.005 * size_m }, shape("title", {}, `${clip}: start`)),
  ];
}

/** A square that contains all tracks. */
function windowRound(tracks) {
  const [x, y] = [0, 1].map((axis) => tracks.flatMap((track) => track.points_m.map((point) => point[axis])));
  const [west, east, south, north] = [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y)];
  const side_m = 1.4 * Math.max(east - west, north - south) + 60;
  return { west_m: 0.5 * (west + east - side_m), south_m: 0.5 * (south + north - side_m), side_m };
}

const viewOf = ({ west_m, south_m, side_m }) => `${west_m} ${-(south_m + side_m)} ${side_m} ${side_m}`;

const groundOf = ({ west_m, south_m, side_m, picture }) => (picture
  ? shape("image", { href: picture, x: west_m, y: -(south_m + side_m), width: side_m, height: side_m, preserveAspectRatio: "none" })
  : shape("rect", { x: west_m, y: -(south_m + side_m), width: side_m, height: side_m, fill: "#d9d3c0" }));

/** A bar of a round length, about a quarter of a window's side. */
function scaleBar({ side_m }) {
  const power = 10 ** Math.floor(Math.log10(0.3 * side_m));
  const length_m = [5, 2, 1].map((k) => k * power).find((k) => k <= 0.3 * side_m);
  const bar = element("div", { class: "scale" }, `${figure(length_m)} m`);
  bar.style.width = `${(100 * length_m) / side_m}%`;
  return bar;
}

function mapOf(ground, description, ...shapes) {
  return element("div", { class: "map" },
    shape("svg", { viewBox: viewOf(ground), role: "img", "aria-label": description }, groundOf(ground), shapes),
    scaleBar(ground), element("div", { class: "north", "aria-hidden": "true" }, "N", element("br"), "\u2191"));
}

function frameOf({ west_m, south_m, side_m }) {
  const place = { x: west_m, y: -(south_m + side_m), width: side_m, height: side_m };
  return [shape("rect", { ...place, class: "place dark" }), shape("rect", { ...place, class: "place" })];
}

/** A colour for each track: its own, or that of its season if there are many. */
function trackColours(tracks, seasons) {
  if (tracks.length <= TRACKS.length) return tracks.map((track, k) => ({ name: track.clip, colour: TRACKS[k] }));
  return tracks.map((track) => (seasons.get(track.clip) === "summer" ? { name: "summer", colour: TRACKS[1] } : { name: "winter", colour: TRACKS[0] }));
}

function flightsSection({ flights, record }) {
  const flown = flights.tracks.filter((track) => track.points_m.length > 0);
  if (flown.length === 0) return section("flights", "Flights", element("p", {}, flights.map.absent));
  const colours = trackColours(flown, new Map(record.clips.map((clip) => [clip.id, clip.season])));
  const ground = flights.map.window ?? windowRound(flown);
  const showSeen = flights.map.window !== undefined && flown.length <= TRACKS.length;
  const lines = flown.map((track, k) => trackShapes(track, colours[k].colour, showSeen, ground.side_m));
  const keys = [...new Map(colours.map((entry) => [entry.name, entry])).values()];
  const close = element("figure", {}, mapOf(ground, "Flights over the ground", lines), legend(keys));
  const place = flights.map.place
    ? element("figure", {}, mapOf(flights.map.place, "The whole place", frameOf(ground)), element("figcaption", {}, `The whole place, ${figure(flights.map.place.side_m / 1000)} km wide; the frame marks the other map.`))
    : null;
  return section("flights", "Flights",
    element("p", { class: "soft" }, `The path of the camera, starting at the dot${showSeen ? "; dashed: the ground in view halfway, assumed to be level" : ""}. ${flights.map.window ? "Green: dense vegetation; pale: open ground; blue: water." : ""}`),
    flights.map.absent ? element("p", { class: "notice" }, flights.map.absent) : null,
    element("div", { class: place ? "maps" : "maps alone" }, close, place));
}
