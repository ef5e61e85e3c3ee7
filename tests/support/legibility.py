"""Scripts for a page in a browser: can everything on it be read and touched?"""

# Things to tap that are nearer than their sides say, and those lower or narrower than 24 px (WCAG 2.2, 2.5.8).
TARGETS = """
const nodes = [...document.querySelectorAll("a, button, summary, label.switch")].filter((node) => node.checkVisibility());
const boxes = nodes.map((node) => node.getBoundingClientRect());
const name = (k) => nodes[k].textContent.trim().slice(0, 40) || nodes[k].getAttribute("aria-label");
const overlaps = [];
boxes.forEach((a, k) => boxes.forEach((b, other) => {
  if (other > k && a.left < b.right - 0.5 && b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5) overlaps.push([name(k), name(other)]);
}));
return { count: nodes.length, overlaps, small: boxes.map((box, k) => [Math.min(box.width, box.height), name(k)]).filter(([side]) => side < 24) };
"""

# Contrast of text with what is behind it (WCAG 2.2, 1.4.3), for text on plain colours.
CONTRAST = """
const parse = (text) => (text.match(/[\\d.]+/g) ?? []).map(Number);
const luminance = ([r, g, b]) => [r, g, b].map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
  .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
const behind = (node) => { for (let at = node; at; at = at.parentElement) { const c = parse(getComputedStyle(at).backgroundColor); if (c.length === 3 || c[3] > 0) return c; } return [255, 255, 255]; };
return Math.min(...[...document.querySelectorAll("h1, h2, h3, p, th, td, dt, dd, a, figcaption, summary, li, pre, label, span, button, b, kbd, select, input[type=number]")]
  .filter((node) => node.checkVisibility() && ([...node.childNodes].some((child) => child.nodeType === 3 && child.data.trim()) || node.matches("select, input"))).map((node) => {
  const [a, b] = [luminance(parse(getComputedStyle(node).color)), luminance(behind(node))].sort((x, y) => y - x);
  return (a + 0.05) / (b + 0.05);
}));
"""
