"use strict";
// Keys, and the help that lists them. `does`: functions of the page by their names.

const KEYS = [
  { keys: ["ArrowLeft"], shown: "←", help: "one frame back", does: "back" },
  { keys: ["ArrowRight"], shown: "→", help: "one frame on", does: "on" },
  { keys: ["PageUp"], shown: "Page Up", help: "one second back", does: "secondBack" },
  { keys: ["PageDown"], shown: "Page Down", help: "one second on", does: "secondOn" },
  { keys: ["Home"], shown: "Home", help: "first frame", does: "first" },
  { keys: ["End"], shown: "End", help: "last frame", does: "last" },
  { keys: [" "], shown: "Space", help: "play or pause", does: "playOrPause" },
  { keys: ["["], shown: "[", help: "clip before", does: "clipBefore" },
  { keys: ["]"], shown: "]", help: "clip after", does: "clipAfter" },
  { keys: ["n"], shown: "N", help: "on to the next target that appears", does: "nextTarget" },
  { keys: ["b"], shown: "B", help: "boxes", does: "boxes" },
  { keys: ["a"], shown: "A", help: "names", does: "names" },
  { keys: ["t"], shown: "T", help: "tracks of the last 5 s", does: "tracks" },
  { keys: ["m"], shown: "M", help: "outlines of masks", does: "masks" },
  { keys: ["p"], shown: "P", help: "next palette", does: "nextPalette" },
  { keys: ["l"], shown: "L", help: "levels: ir8, ir16 by percentiles, ir16 in a window", does: "nextSource" },
  { keys: ["+", "="], shown: "+", help: "zoom in at the crosshair", does: "closer" },
  { keys: ["-"], shown: "−", help: "zoom out", does: "wider" },
];

// With Shift, an arrow moves the crosshair by a pixel.
const MOVES = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const MOVE_HELP = { shown: "Shift + arrow", help: "crosshair by one pixel" };

function showKeys() {
  const entry = ({ shown, help }) => element("div", {}, element("dt", {}, element("kbd", {}, shown)), element("dd", {}, help));
  byId("keys").replaceChildren(...[...KEYS, MOVE_HELP].map(entry));
}

/** Whether a control that has the focus uses the key itself. */
function isTaken(target, key) {
  if (target.matches("select, input[type=number]")) return true;
  if (key === " ") return target.matches("button, a, input[type=checkbox]");
  return false;
}

/** `actions`: by the names in KEYS, and move(dx, dy). */
function listenToKeys(actions) {
  showKeys();
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || isTaken(event.target, event.key)) return;
    const move = event.shiftKey ? MOVES[event.key] : undefined;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const entry = KEYS.find(({ keys }) => keys.includes(name));
    if (move === undefined && entry === undefined) return;
    event.preventDefault();
    if (move !== undefined) actions.move(...move);
    else actions[entry.does]();
  });
}
