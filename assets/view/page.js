"use strict";
// Which frame of which clip the page shows, and what changes it. screen.js draws it.

const FRAMES_AHEAD = 4;
const LINK_DELAY_MS = 250; // browsers refuse more than some changes of the address a second

let dataset = null;
const state = { clip: 0, at: 0, probe: null, zoom: 1, centre: { x: 0, y: 0 }, playing: null };
let indices = []; // of the clip's frames
let shown = null; // the frame on the screen
let asked = 0; // frames asked for so far
let drawn = 0; // the number of the one on the screen
let linkTimer = 0;

const clipNow = () => dataset.clips[state.clip];
const indexNow = () => indices[state.at];

function reportFault(text) {
  byId("fault").hidden = text === "";
  byId("fault").textContent = text;
}

function showTexts(clip, frame) {
  byId("caption").textContent = captionOf(clip, frame);
  byId("slider").setAttribute("aria-valuetext", `frame ${frame.frame}, ${frame.time_s.toFixed(2)} s`);
  showTargets(clip, frame);
}

// --- which frame

function writeLink() {
  const link = `#${new URLSearchParams({ clip: clipNow().id, frame: indexNow() })}`;
  byId("link").setAttribute("href", link);
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => history.replaceState(null, "", link), LINK_DELAY_MS);
}

/** Frames that arrive after a later one are not shown. */
async function goTo(at) {
  state.at = Math.max(0, Math.min(at, indices.length - 1));
  byId("slider").value = state.at;
  if (document.activeElement !== byId("number")) byId("number").value = indexNow();
  writeLink();
  const number = ++asked;
  const clip = clipNow();
  try {
    const frame = await loadFrame(clip.id, indexNow());
    if (number < drawn || clip !== clipNow()) return;
    drawn = number;
    shown = frame;
    if (number === asked) reportFault(""); // an earlier frame says nothing about a later one that failed
    draw();
    showTexts(clip, frame);
  } catch (error) {
    if (number === asked) {
      pause();
      reportFault(`Frame ${indexNow()} of ${clip.id} cannot be shown: ${error.message}`);
    }
  }
}

function chooseClip(place) {
  pause();
  state.clip = place;
  const clip = clipNow();
  indices = indicesOf(clip.frames);
  shown = null;
  if (state.probe !== null) setProbe(state.probe.x, state.probe.y); // within the clip's frames
  setZoom(1);
  byId("slider").max = indices.length - 1;
  byId("number").max = indices.at(-1);
  showMarks(clip, indices);
  markClip(place);
}

/** The last frame that was taken by then; the first before that. */
function placeAt(index) {
  const after = indices.findIndex((one) => one > index);
  return after < 0 ? indices.length - 1 : Math.max(0, after - 1);
}

async function openClip(place, index) {
  if (place !== state.clip || indices.length === 0) chooseClip(place);
  await goTo(placeAt(index));
}

async function followLink() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const place = wanted.has("clip") ? dataset.clips.findIndex(({ id }) => id === wanted.get("clip")) : 0;
  const index = Number.parseInt(wanted.get("frame") ?? "0", 10);
  await openClip(Math.max(0, place), Number.isNaN(index) ? 0 : index);
  if (place < 0) reportFault(`There is no clip ${wanted.get("clip")} here.`);
}

// --- playing

function pause() {
  state.playing = null;
  byId("play").textContent = "Play";
}

function play() {
  if (state.at === indices.length - 1) goTo(0);
  state.playing = { since_ms: performance.now(), index: indexNow() };
  byId("play").textContent = "Pause";
  requestAnimationFrame(advance);
}

/** Frames are due by the clip's rate; those that load too slowly are left out. */
function advance(now_ms) {
  if (state.playing === null) return;
  const { since_ms, index } = state.playing;
  const due = placeAt(index + Math.floor(Math.max(0, now_ms - since_ms) * clipNow().frame_rate_hz / 1000));
  if (due !== state.at) {
    goTo(due);
    for (let ahead = 1; ahead <= FRAMES_AHEAD && due + ahead < indices.length; ++ahead)
      loadFrame(clipNow().id, indices[due + ahead]).catch(() => {}); // reported when it is shown
  }
  if (due === indices.length - 1) pause();
  else requestAnimationFrame(advance);
}

// --- controls

function nextOf(select) {
  select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
  select.dispatchEvent(new Event("change"));
}

function toggle(id) {
  byId(id).checked = !byId(id).checked;
  draw();
}

/** A window that is not set yet is that of the frame, in whole kelvin. */
function changeSource() {
  const source = byId("source").value;
  for (const id of ["percentiles", "window"]) byId(id).hidden = source !== id;
  if (source === "window" && byId("low_k").value === "" && shown !== null) {
    const [low, high] = percentilesOf(shown.counts, [0.01, 0.99]).map((value) => value * dataset.kelvin_per_count);
    byId("low_k").value = Math.floor(low);
    byId("high_k").value = Math.ceil(high);
  }
  draw();
}

/** To the start of the next stretch of frames with labels. */
function nextTarget() {
  const next = clipNow().seen.find(([first]) => first > indexNow());
  if (next !== undefined) goTo(placeAt(next[0]));
}

const step = (frames) => {
  pause();
  goTo(state.at + frames);
};
const framesOfSecond = () => Math.max(1, Math.round(clipNow().frame_rate_hz));
const stepClips = (clips) => {
  const place = state.clip + clips;
  if (place >= 0 && place < dataset.clips.length) openClip(place, 0);
};

const ACTIONS = {
  back: () => step(-1),
  on: () => step(1),
  secondBack: () => step(-framesOfSecond()),
  secondOn: () => step(framesOfSecond()),
  first: () => step(-Infinity),
  last: () => step(Infinity),
  playOrPause: () => (state.playing === null ? play() : pause()),
  clipBefore: () => stepClips(-1),
  clipAfter: () => stepClips(1),
  nextTarget,
  boxes: () => toggle("boxes"),
  names: () => toggle("names"),
  tracks: () => toggle("tracks"),
  masks: () => toggle("masks"),
  nextPalette: () => nextOf(byId("palette")),
  nextSource: () => nextOf(byId("source")),
  closer: () => zoomBy(1),
  wider: () => zoomBy(-1),
  move: moveProbe,
};

function watchControls() {
  for (const id of ["first", "back", "on", "last", "closer", "wider"]) byId(id).addEventListener("click", ACTIONS[id]);
  byId("play").addEventListener("click", ACTIONS.playOrPause);
  for (const id of ["palette", ...OVER_FRAME]) byId(id).addEventListener("change", draw);
  for (const id of ["low_percent", "high_percent", "low_k", "high_k"])
    byId(id).addEventListener("input", () => {
      if (!Number.isNaN(byId(id).valueAsNumber)) draw();
    });
  byId("source").addEventListener("change", changeSource);
  byId("slider").addEventListener("input", () => step(byId("slider").valueAsNumber - state.at));
  byId("number").addEventListener("change", () => {
    const index = byId("number").valueAsNumber;
    if (!Number.isNaN(index)) step(placeAt(index) - state.at);
  });
  watchPointer(byId("screen"));
  addEventListener("resize", draw);
  addEventListener("hashchange", followLink);
  listenToKeys(ACTIONS);
}

/** Called by data/dataset.js. */
function takeDataset(given) {
  dataset = given;
  showHead(dataset);
  byId("palette").append(...dataset.palettes.map(({ name }) => element("option", { value: name }, words(name))));
  showClips(dataset.clips, (clip) => openClip(dataset.clips.indexOf(clip), 0));
  watchControls();
  followLink();
}
