"use strict";
// Creates elements. Values from the figures become text nodes or attributes, never markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== false) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

const element = (tag, attributes = {}, ...children) => fill(document.createElement(tag), attributes, children);
const shape = (tag, attributes = {}, ...children) => fill(document.createElementNS(SVG, tag), attributes, children);

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// --- numbers and words

const count = (value) => value.toLocaleString("en");
const counted = (value, one, many = `${one}s`) => `${count(value)} ${value === 1 ? one : many}`;
const words = (name) => name.replaceAll("_", " ");
const percent = (share) => `${(100 * share).toLocaleString("en", { maximumFractionDigits: share < 0.1 ? 1 : 0 })} %`;
const distinct = (values) => [...new Set(values)];
const shortened = (text) => (text.length > 16 ? `${text.slice(0, 15)}\u2026` : text);
const listed = (names) => (names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`);

/** A number with about three digits, without an exponent if possible. */
function figure(value) {
  const size = Math.abs(value);
  if (size > 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(1);
  const digits = size >= 100 || size === 0 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
  return value.toLocaleString("en", { maximumFractionDigits: digits });
}

function duration(seconds) {
  if (seconds < 60) return `${figure(seconds)} s`;
  const minutes = Math.floor(seconds / 60);
  return minutes < 60 ? `${minutes} min ${Math.round(seconds % 60)} s` : `${figure(seconds / 3600)} h`;
}

// --- parts of a page

function facts(pairs) {
  const known = pairs.filter(([, value]) => value !== undefined && value !== "");
  return element("dl", { class: "facts" },
    known.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, String(value)))));
}

function pairs(entries) {
  const known = entries.filter(([, value]) => value !== undefined);
  return element("dl", { class: "pairs" },
    known.map(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

/** A scrollable table. columns: {name, text?, wrap?}; rows: lists of cells (strings or nodes), or {bad, cells}. */
function table(label, columns, rows) {
  const kind = ({ text, wrap }) => [text && "text", wrap && "wrap"].filter(Boolean).join(" ") || undefined;
  const cells = (row) => row.cells ?? row;
  return element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
    element("table", {},
      element("thead", {}, element("tr", {}, columns.map((column) => element("th", { scope: "col", class: kind(column) }, column.name)))),
      element("tbody", {}, rows.map((row) => element("tr", { class: row.bad ? "bad" : undefined },
        cells(row).map((cell, k) => element(k === 0 ? "th" : "td", { scope: k === 0 ? "row" : undefined, class: kind(columns[k]) }, cell)))))));
}

function section(id, title, ...children) {
  return element("section", { id, "aria-labelledby": `${id}-title` }, element("h2", { id: `${id}-title` }, title), children);
}

const folded = (title, ...children) => element("details", {}, element("summary", {}, title), children);

function legend(entries) {
  const swatch = (entry) => shape("svg", { width: 16, height: 16, "aria-hidden": "true" },
    shape("rect", entry.dashed
      ? { x: 2, y: 2, width: 12, height: 12, fill: "none", stroke: "currentColor", "stroke-width": 2, "stroke-dasharray": "3 3" }
      : { width: 16, height: 16, rx: 3, fill: entry.colour }));
  return element("ul", { class: "legend" }, entries.map((entry) => element("li", {}, swatch(entry), entry.name)));
}
