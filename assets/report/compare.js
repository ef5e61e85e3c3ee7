// The page of a comparison of frames with real ones.

const SETS = [{ key: "real", name: "real", colour: SERIES[1] }, { key: "dataset", name: "dataset", colour: SERIES[0] }];
const known = (value) => value !== null && value !== undefined;
const shownValue = (value, unit) => (known(value) ? (unit === "log10" ? value.toFixed(2) : figure(value)) : "-");

function comparisonOverview(figures) {
  const set = ({ source, frames, frames_listed: listedFrames, targets }) => `${source}: ${counted(frames, "frame")} of ${count(listedFrames)}, ${counted(targets, "target")}`;
  const good = figures.measures.filter((row) => row.good).length;
  const measured = figures.measures.filter((row) => known(row.difference)).length;
  const auc = (classified) => (classified ? `${classified.auc.toFixed(3)} \u00b1 ${classified.error.toFixed(3)}` : undefined);
  return element("header", {},
    element("p", { class: "eyebrow" }, "Comparison with real frames"), element("h1", {}, figures.dataset.source),
    element("p", { class: "lead" }, `Real: ${set(figures.real)}. Dataset: ${set(figures.dataset)}.`),
    SETS.map(({ key }) => (known(figures[key].no_boxes) ? element("p", { class: "notice" }, `${figures[key].no_boxes}; measures of targets are left out.`) : null)),
    SETS.map(({ key }) => (figures[key].rejected.length > 0 ? element("p", { class: "notice" }, `Rejected: ${listed(figures[key].rejected)}.`) : null)),
    facts([["Measures within twice real against real", `${good} of ${measured}`], ["Classifier of frames (AUC)", auc(figures.frames_told_apart)],
      ["Classifier of targets (AUC)", auc(figures.crops_told_apart)]]));
}

function measuresSection({ measures, good_ratio: ratio, real, dataset }) {
  const rows = measures.filter((row) => known(row.real) || known(row.dataset));
  const columns = [{ name: "measure", text: true }, ...["unit", "real", "dataset", "difference", "real against real", "ratio"].map((name) => ({ name })), { name: "", text: true }];
  return section("measures", "Measures",
    element("p", { class: "soft" }, `Real against real is the difference between random halves of the real frames, averaged. A difference of at most ${figure(ratio)} times that is good.`),
    table("Measures of both sets", columns, rows.map((row) => ({
      bad: !row.good,
      cells: [`${row.group}: ${row.name}`, row.unit, shownValue(row.real, row.unit), shownValue(row.dataset, row.unit), shownValue(row.difference, row.unit),
        shownValue(row.real_difference), shownValue(row.ratio), row.good ? "good" : ""],
    }))),
    element("p", { class: "under" }, `Noise, real: ${real.noise_method}. Dataset: ${dataset.noise_method}.`));
}

/** A line per set; points: [x, y], without those that are unknown. */
function linesChart(description, pointsOf, x, y) {
  const settings = () => ({
    type: "line",
    data: { datasets: SETS.map(({ key, name, colour: own }) => ({ label: name, borderColor: own, backgroundColor: own, borderWidth: 2, pointRadius: 0, data: pointsOf(key).map(([at, value]) => ({ x: at, y: value })) })) },
    options: {
      interaction: { mode: "nearest", axis: "x", intersect: false },
      scales: { x: { ...x.scale, title: { display: true, text: x.title } }, y: { ...y.scale, title: { display: true, text: y.title } } },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } }, tooltip: { callbacks: { title: ([item]) => figure(item.parsed.x) } } },
    },
  });
  return chart(description, settings, 340);
}

function spectrumSection(figures) {
  const edges = figures.curve_edges_per_px;
  const points = (key) => figures[key].power_curve.map((power, k) => [Math.sqrt(edges[k] * edges[k + 1]), power]).filter(([, power]) => known(power) && power > 0).map(([at, power]) => [at, Math.log10(power)]);
  const ticks = { callback: (value) => ([0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5].some((tick) => Math.abs(tick - value) < 1e-9) ? figure(value) : null), maxRotation: 0 };
  return section("spectrum", "Spectrum",
    element("p", { class: "soft" }, "Power by spatial frequency, averaged over frames: Hann window, mean removed, scaled to 640 x 512 px."),
    element("div", { class: "card" }, linesChart("Radial power spectra of both sets", points,
      { title: "cycles a pixel", scale: { type: "logarithmic", min: 0.004, max: 0.5, ticks } }, { title: "log10 of the power", scale: {} })));
}

function levelsSection(figures) {
  const points = (key) => figures[key].histogram.map((share, level) => [level, 100 * share]);
  return section("levels", "Grey levels",
    element("div", { class: "card" }, linesChart("Shares of the grey levels in both sets", points,
      { title: "grey level", scale: { type: "linear", min: 0, max: 256, ticks: { stepSize: 32 } } }, { title: "% of the pixels", scale: { beginAtZero: true } })));
}

const boxOf = ([x, y, width, height]) => shape("rect", { x, y, width, height, class: "box", stroke: SERIES[0] });

function shownFrame(frame) {
  const overlay = shape("svg", { viewBox: `0 0 ${frame.width_px} ${frame.height_px}`, preserveAspectRatio: "none", "aria-hidden": "true" }, frame.boxes.map(boxOf));
  const button = element("button", { type: "button", class: "frame", "aria-expanded": "false", "aria-label": `Enlarge ${frame.name}` }, element("img", { src: frame.picture, alt: "" }), overlay);
  const whole = element("figure", {}, button, element("figcaption", {}, frame.name));
  button.addEventListener("click", () => button.setAttribute("aria-expanded", String(whole.classList.toggle("wide"))));
  return whole;
}

function shownFramesSection(figures) {
  const shown = element("input", { type: "checkbox", checked: true });
  const grids = SETS.map(({ key, name }) => [element("h3", {}, name), element("div", { class: "frames" }, figures[key].shown_frames.map(shownFrame))]);
  shown.addEventListener("change", () => grids.forEach(([, grid]) => grid.classList.toggle("no-boxes", !shown.checked)));
  return section("frames", "Frames", element("p", { class: "soft" }, "Click a frame to enlarge it."), element("label", { class: "switch" }, shown, "Show boxes"), grids);
}

/** A crop, four screen pixels for each of its own. */
function shownCrop(crop) {
  const picture = element("img", { src: crop.picture, alt: "" });
  const overlay = shape("svg", { viewBox: `0 0 ${crop.width_px} ${crop.height_px}`, "aria-hidden": "true" }, boxOf(crop.box));
  const whole = element("div", { class: "crop" }, picture, overlay);
  whole.style.width = `${4 * crop.width_px}px`;
  return whole;
}

function cropsSection(figures) {
  if (SETS.every(({ key }) => figures[key].shown_crops.length === 0)) return null;
  return section("targets", "Targets",
    element("p", { class: "soft" }, "Boxes with 6 pixels around them, evenly spaced among all targets, all at one scale."),
    element("div", { class: "grid" }, SETS.map(({ key, name }) => element("div", { class: "card" }, element("h3", {}, name), element("div", { class: "crops" }, figures[key].shown_crops.map(shownCrop))))));
}

function classifierTable(what, classified) {
  if (!classified) return element("p", {}, `Too few ${what} for a classifier.`);
  const halves = classified.real_halves ? ` Halves of the real ones: ${classified.real_halves.auc.toFixed(3)} \u00b1 ${classified.real_halves.error.toFixed(3)}.` : "";
  return element("div", { class: "card" }, element("h3", {}, `${what}: AUC ${classified.auc.toFixed(3)} \u00b1 ${classified.error.toFixed(3)}`), element("p", { class: "soft" }, halves),
    table(`Features that separate ${what}`, [{ name: "feature", text: true }, { name: "AUC falls by" }, { name: "AUC alone" }, { name: "real against real" }],
      classified.importances.map(({ feature, fall, alone, real_alone: halves }) => [feature, fall.toFixed(3), alone.toFixed(3), known(halves) ? halves.toFixed(3) : "-"])));
}

function toldSection(figures) {
  return section("classifier", "How well a classifier separates them",
    element("p", { class: "soft" }, "A cross-validated random forest: .5 if it cannot tell real from dataset, 1 if it always can. AUC falls by: when the feature is shuffled; features that say the same stand in for each other."),
    element("div", { class: "grid" }, classifierTable("frames", figures.frames_told_apart), classifierTable("targets", figures.crops_told_apart)));
}

function targetTables(figures) {
  const spread = ({ mean, deviation }) => `${mean.toFixed(1)} \u00b1 ${deviation.toFixed(1)}`;
  const altitudes = SETS.flatMap(({ key, name }) => figures[key].targets_by_altitude.map((row) => [name, `${row.from_m} to ${row.to_m} m`, count(row.targets), ...[row.width_px, row.height_px, row.contrast, row.ring_deviation].map(figure)]));
  const margins = SETS.flatMap(({ key, name }) => figures[key].margins_by_blob_size.map((row) => [name, known(row.to_px) ? `${row.from_px} to ${row.to_px} px` : `${row.from_px} px up`, count(row.targets), ...[row.left_px, row.right_px, row.top_px, row.bottom_px].map(spread)]));
  if (altitudes.length + margins.length === 0) return null;
  const columns = (names) => [{ name: "set", text: true }, ...names.map((name) => ({ name }))];
  return section("boxes", "Boxes",
    altitudes.length > 0 ? [element("h3", {}, "By height above ground"), table("Targets by height", columns(["height", "targets", "width, px", "height, px", "contrast", "ring deviation"]), altitudes)] : null,
    margins.length > 0 ? [element("h3", {}, "Pixels between a box and the warm blob in it, by the blob's longer side"), table("Margins of boxes", columns(["blob", "targets", "left", "right", "top", "bottom"]), margins)] : null);
}

function showComparison(figures) {
  const sections = [measuresSection(figures), spectrumSection(figures), levelsSection(figures), shownFramesSection(figures), cropsSection(figures), toldSection(figures), targetTables(figures)].filter((part) => part !== null);
  const links = sections.map((part) => element("li", {}, element("a", { href: `#${part.id}` }, part.querySelector("h2").textContent)));
  document.getElementById("page").append(comparisonOverview(figures), element("nav", { "aria-label": "Sections" }, element("ul", {}, links)), ...sections);
}

showComparison(JSON.parse(document.getElementById("figures").textContent));
drawCharts();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawCharts);
