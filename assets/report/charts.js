// Charts, drawn by Chart.js. Each has a function that is called again when the colour scheme of the page changes.

// Okabe and Ito's colours (Color Universal Design, 2008), which people with any colour vision can distinguish. Further
// categories share a grey.
const SERIES = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#0072b2", "#f0e442"];
const OTHERS = "#8d939a";
const seriesColour = (place) => SERIES[place] ?? OTHERS;

const makers = [];
let drawn = [];

function drawCharts() {
  drawn.forEach((chart) => chart.destroy());
  Object.assign(Chart.defaults, { color: colour("soft"), borderColor: colour("line"), animation: false, maintainAspectRatio: false });
  Chart.defaults.font.size = 13;
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  drawn = makers.map(({ canvas, settings }) => new Chart(canvas, settings()));
}

/** An element that holds a chart; `description` is its text for screen readers. */
function chart(description, settings, height) {
  const canvas = element("canvas", { role: "img", "aria-label": description });
  makers.push({ canvas, settings });
  const frame = element("div", { class: "chart" }, canvas);
  if (height) frame.style.height = `${height}px`;
  return frame;
}

const tickCount = { precision: 0, maxTicksLimit: 6, callback: (value) => count(value) };

/** Horizontal stacked bars, one per row; parts: {name, colour (a variable of the style sheet), values}. */
function rowsOfBars(description, rows, parts, unit) {
  const settings = () => ({
    type: "bar",
    data: { labels: rows, datasets: parts.map((part) => ({ label: part.name, data: part.values, backgroundColor: colour(part.colour) })) },
    options: {
      indexAxis: "y",
      scales: { x: { stacked: true, ticks: tickCount, title: { display: true, text: unit } }, y: { stacked: true, grid: { display: false }, ticks: { autoSkip: false } } },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } }, tooltip: { mode: "index", axis: "y" } },
    },
  });
  return chart(description, settings, 110 + 30 * rows.length);
}

/** Legend entries of the categories. */
function seriesKeys(categories) {
  const keys = categories.slice(0, SERIES.length).map((name, k) => ({ name: words(name), colour: seriesColour(k) }));
  return categories.length > SERIES.length ? [...keys, { name: listed(categories.slice(SERIES.length).map(words)), colour: OTHERS }] : keys;
}

// --- histograms: the x axis counts bins, and its ticks are at the edges of bins

/** One series per category for the first seven, and one for the rest. */
function seriesOf(histogram, categories) {
  const series = histogram.counts.slice(0, SERIES.length).map((data, k) => ({ name: words(categories[k]), data, colour: seriesColour(k) }));
  const rest = histogram.counts.slice(SERIES.length);
  if (rest.length > 0) series.push({ name: "others", data: rest[0].map((_, bin) => rest.reduce((sum, data) => sum + data[bin], 0)), colour: OTHERS });
  return series.filter(({ data }) => data.some((value) => value > 0));
}

const isDecade = (value) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6;

/** Indices of at most eight edges with a tick: decades on wide logarithmic axes, otherwise round values. */
function tickedEdges(edges, logarithmic) {
  const bins = edges.length - 1;
  if (logarithmic) return placesWhere(edges, bins > 9 ? isDecade : () => true);
  const width = edges[1] - edges[0];
  const isWhole = (value) => Math.abs(value - Math.round(value)) < 1e-6;
  const powers = [0, 1, 2].flatMap((power) => [1, 2, 5].map((k) => k * 10 ** (power + Math.floor(Math.log10(width) + 1e-9))));
  const spacing = powers.find((step) => isWhole(step / width) && (bins * width) / step <= 8) ?? bins * width;
  return placesWhere(edges, (value) => isWhole(value / spacing));
}

const placesWhere = (edges, fits) => edges.map((_, k) => k).filter((k) => fits(edges[k]));

/** Position of a value on the axis of bins, or null if it is outside. */
function placeOf(value, edges, logarithmic) {
  const at = (v) => (logarithmic ? Math.log(v) : v);
  const place = ((at(value) - at(edges[0])) / (at(edges.at(-1)) - at(edges[0]))) * (edges.length - 1);
  return place >= 0 && place <= edges.length - 1 ? place : null;
}

/** Dashed vertical lines with labels at values of the x axis. */
const markLines = (marks) => ({
  id: "marks",
  afterDatasetsDraw({ ctx, chartArea, scales }) {
    ctx.save();
    Object.assign(ctx, { fillStyle: colour("ink"), lineJoin: "round", font: `${Chart.defaults.font.size}px ${Chart.defaults.font.family}` });
    marks.forEach(({ place, text }, k) => {
      Object.assign(ctx, { strokeStyle: colour("ink"), lineWidth: 1 });
      const x = scales.x.getPixelForValue(place);
      const left = x + ctx.measureText(text).width + 8 > chartArea.right;
      ctx.textAlign = left ? "right" : "left";
      ctx.setLineDash([4, 3]);
      ctx.beginPath();
      ctx.moveTo(x, chartArea.top);
      ctx.lineTo(x, chartArea.bottom);
      ctx.stroke();
      const at = [text, x + (left ? -5 : 5), chartArea.top + 12 + 16 * k];
      ctx.setLineDash([]);
      Object.assign(ctx, { strokeStyle: colour("card"), lineWidth: 4 });
      ctx.strokeText(...at);
      ctx.fillText(...at);
    });
    ctx.restore();
  },
});

function histogramSettings(histogram, categories, { unit, logarithmic, marks = [] }) {
  const { edges } = histogram;
  const ticks = tickedEdges(edges, logarithmic);
  const lines = marks.map(({ value, text }) => ({ place: placeOf(value, edges, logarithmic), text })).filter(({ place }) => place !== null);
  const range = ([{ parsed }]) => {
    const bin = Math.floor(parsed.x);
    if (bin === 0 && histogram.below > 0) return `below ${figure(edges[1])} ${unit}`;
    if (bin === edges.length - 2 && histogram.above > 0) return `from ${figure(edges[bin])} ${unit} up`;
    return `${figure(edges[bin])} to ${figure(edges[bin + 1])} ${unit}`;
  };
  return {
    type: "bar",
    data: {
      datasets: seriesOf(histogram, categories).map(({ name, data, colour: own }) => ({
        label: name, backgroundColor: own, barPercentage: 0.94, categoryPercentage: 1, data: data.map((y, bin) => ({ x: bin + 0.5, y })),
      })),
    },
    options: {
      scales: {
        x: {
          type: "linear", stacked: true, offset: false, min: 0, max: edges.length - 1, grid: { offset: false, drawOnChartArea: false },
          afterBuildTicks: (axis) => { axis.ticks = ticks.map((value) => ({ value })); },
          ticks: { callback: (place) => figure(edges[place]), maxRotation: 0, autoSkip: true },
          title: { display: true, text: unit },
        },
        y: { stacked: true, beginAtZero: true, ticks: tickCount },
      },
      plugins: { legend: { display: false }, tooltip: { mode: "index", callbacks: { title: range }, filter: (item) => item.parsed.y > 0 } },
    },
    plugins: [markLines(lines)],
  };
}

/** A card with a histogram. */
function histogramCard(histogram, categories, quantity) {
  const heading = element("h3", {}, quantity.title);
  const { known, of, below, above } = histogram;
  const [least, median, most] = [histogram.least, histogram.median, histogram.most].map(quantity.say ?? ((value) => `${figure(value)} ${quantity.unit}`));
  const tails = below + above > 0 ? `; the ${counted(below + above, "label")} beyond the axis ${below + above === 1 ? "counts" : "count"} at its ends` : "";
  const summary = `From ${least} to ${most}, median ${median}${known < of ? `; known for ${count(known)} of ${counted(of, "label")}` : ""}${tails}.`;
  return element("div", { class: "card" }, heading,
    chart(`Histogram: ${quantity.title}. ${summary}`, () => histogramSettings(histogram, categories, quantity)),
    element("p", { class: "under" }, summary, quantity.note ? ` ${quantity.note}` : null));
}

/** Spread of each term on a logarithmic axis, with the NETD for comparison. */
function termChart(terms, netd_mk) {
  const least = 0.1;
  const description = `Spread of each term in millikelvin beside the NETD of ${figure(netd_mk)} mK`;
  const settings = () => ({
    type: "bar",
    data: {
      labels: terms.map(({ term }) => term),
      datasets: [["kept", true], ["dropped", false]].map(([name, kept]) => ({
        label: name, backgroundColor: colour(name), data: terms.map((term) => (term.kept === kept ? Math.max(term.spread_mk, least) : null)),
      })).filter(({ data }) => data.some((value) => value !== null)),
    },
    options: {
      indexAxis: "y",
      scales: {
        x: { type: "logarithmic", min: least, ticks: { maxTicksLimit: 7, callback: (value) => (isDecade(value) ? count(value) : null) }, title: { display: true, text: "spread over the pictures, mK" } },
        y: { stacked: true, grid: { display: false }, ticks: { autoSkip: false } },
      },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } }, tooltip: { callbacks: { label: (item) => `${item.dataset.label}: ${figure(terms[item.dataIndex].spread_mk)} mK` } } },
    },
    plugins: [markLines([{ place: netd_mk, text: "NETD" }])],
  });
  return chart(description, settings, 110 + 30 * terms.length);
}

/** Fills the hours in which something flies. */
const shadeHours = (spans) => ({
  id: "hours",
  beforeDatasetsDraw({ ctx, chartArea, scales }) {
    ctx.save();
    ctx.fillStyle = colour("line");
    for (const [from, to] of spans) {
      const left = Math.max(scales.x.getPixelForValue(from), chartArea.left);
      const right = Math.min(scales.x.getPixelForValue(to), chartArea.right);
      ctx.fillRect(left, chartArea.top, Math.max(right - left, 2), chartArea.bottom - chartArea.top);
    }
    ctx.restore();
  },
});

const clock = (hour) => `${String(Math.floor(hour)).padStart(2, "0")}:${hour % 1 ? "30" : "00"}`;

/** Temperatures of surfaces above the air over a day; surfaces: names in the order of their colours. */
function dayChart(day, surfaces) {
  const hours = day.air_k.map((_, k) => k * day.step_h);
  const spans = day.flown_h.flatMap(([from, to]) => [[from, to], [from - 24, to - 24]]).filter(([from, to]) => from <= 24 && to >= 0);
  const lines = surfaces.map((name, k) => ({
    label: words(name), borderColor: seriesColour(k), backgroundColor: seriesColour(k), borderWidth: 2, pointRadius: 0,
    data: day.materials_k[name].map((value, at) => ({ x: hours[at], y: value - day.air_k[at] })),
  }));
  const settings = () => ({
    type: "line",
    data: { datasets: lines },
    options: {
      interaction: { mode: "index", intersect: false },
      scales: {
        x: { type: "linear", min: 0, max: 24, ticks: { stepSize: 3, maxRotation: 0, callback: clock }, title: { display: true, text: "local solar time" } },
        y: { title: { display: true, text: "K above the air" } },
      },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } }, tooltip: { callbacks: { title: ([item]) => clock(item.parsed.x) } } },
    },
    plugins: [shadeHours(spans)],
  });
  return chart(`Temperatures of ${listed(surfaces.map(words))} above the air over a day in ${day.season}`, settings, 320);
}
