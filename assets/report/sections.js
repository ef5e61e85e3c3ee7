// The sections with text, tables and charts.

const madeClips = (record) => record.clips.filter((clip) => clip.status === "done");
const missingClips = (record) => record.clips.filter((clip) => clip.status !== "done");

// --- overview

function sensorFacts({ sensor, camera }) {
  if (!sensor) return [];
  const field = ({ width_px, fx_px = camera.focal_length_m / (camera.pixel_pitch_um * 1e-6), cx_px = width_px / 2 }) =>
    ((Math.atan(cx_px / fx_px) + Math.atan((width_px - cx_px) / fx_px)) * 180) / Math.PI;
  const flown = camera?.focal_length_m ? `${figure(camera.focal_length_m * 1000)} mm, ${figure(field(camera))}\u00b0 wide` : undefined;
  return [["Sensor", sensor.preset], ["Model", sensor.model ?? "published"], ["Response", sensor.response],
    ["NETD", sensor.netd_mk === undefined ? undefined : `${figure(sensor.netd_mk)} mK`], ["Lens", flown]];
}

function lengthOf(labels) {
  const known = labels.videos.filter((video) => video.frame_rate_hz > 0);
  return known.length > 0 ? duration(known.reduce((sum, video) => sum + video.images / video.frame_rate_hz, 0)) : undefined;
}

function unfinishedNotice(record) {
  const missing = missingClips(record);
  if (missing.length === 0) return null;
  const names = missing.slice(0, 8).map((clip) => `${clip.id} (${clip.status}${clip.reason ? `: ${clip.reason}` : ""})`);
  return element("p", { class: "notice", role: "status" },
    `This dataset is unfinished: ${missing.length} of ${counted(record.clips.length, "clip")} ${missing.length === 1 ? "is" : "are"} missing: ${listed(names)}${missing.length > names.length ? " \u2026" : ""}. All figures describe the other clips.`);
}

function overview({ name, labels, record }) {
  const made = record ? madeClips(record) : [];
  const lead = `${counted(labels.images, "frame")} in ${counted(labels.videos.length, record ? "clip" : "video")}, with ${counted(labels.labels, "label")}${labels.categories.length > 0 ? ` of ${listed(labels.categories.map(words))}` : ""}.`;
  const negatives = labels.videos.reduce((sum, video) => sum + video.negatives, 0);
  return element("header", {},
    element("p", { class: "eyebrow" }, record ? "Veldt dataset" : "Labelled pictures"), element("h1", {}, name), element("p", { class: "lead" }, lead),
    record ? unfinishedNotice(record) : null,
    facts([
      ["Seasons", listed(distinct(made.map((clip) => clip.season)))],
      ["Pictures", labels.sizes.map(([width, height]) => `${width} x ${height}`).join(", ")],
      ["Frame rate", distinct(labels.videos.map((video) => video.frame_rate_hz)).filter((rate) => rate > 0).map((rate) => `${figure(rate)} Hz`).join(", ")],
      ["Length", lengthOf(labels)],
      ["Frames without labels", labels.images > 0 ? `${count(negatives)} (${percent(negatives / labels.images)})` : undefined],
      ["Tracks", count(labels.videos.reduce((sum, video) => sum + video.tracks, 0))],
      ...(record ? sensorFacts(record.config) : []),
    ]));
}

// --- labels

const SIZES = ["small", "medium", "large"];

function countsSection({ labels }) {
  const { categories, counts } = labels;
  if (categories.length === 0) return section("labels", "Labels", element("p", {}, "There are no labels."));
  const parts = SIZES.map((size) => ({ name: size, colour: size, values: counts.map((entry) => entry[size]) }));
  const columns = [{ name: "category", text: true }, ...[...SIZES, "all", "tracks", "cut by border", "occluded", "noisy", "ignored"].map((name) => ({ name }))];
  const row = (entry) => [...SIZES.map((size) => entry[size]), entry.small + entry.medium + entry.large, entry.tracks, entry.truncated, entry.occluded, entry.noisy, entry.ignored].map((value) => (value === null ? "unknown" : count(value)));
  const total = Object.fromEntries(Object.keys(counts[0]).map((key) => [key, counts.some((entry) => entry[key] !== null) ? counts.reduce((sum, entry) => sum + entry[key], 0) : null]));
  const sizes = categories.map((name, k) => `${words(name)} ${SIZES.map((size) => `${counts[k][size]} ${size}`).join(", ")}`).join("; ");
  return section("labels", "Labels",
    element("p", { class: "soft" }, "Size classes apply to whole tracks, by the mean area of their boxes: small below 200 px, large above 2,000 px (Bondi et al. 2018)."),
    element("div", { class: "card" }, rowsOfBars(`Labels by category and size: ${sizes}`, categories.map((name) => shortened(words(name))), parts, "labels")),
    table("Labels by category", columns, [...categories.map((name, k) => [words(name), ...row(counts[k])]), ["all", ...row(total)]]),
    labels.unused_categories.length > 0 ? element("p", { class: "under" }, `Without labels: ${listed(labels.unused_categories.map(words))}.`) : null);
}

/** Title, unit and texts of each quantity; marks and notes come from the config of the dataset. */
function quantities({ sensor, labels: bounds } = {}, ours) {
  const old = (what) => (ours ? `No label has a value for ${what}: it was not measured when this dataset was made.` : `These labels do not include ${what}.`);
  const visible = bounds ? [{ value: bounds.occluded_below_visibility, text: "occluded below" }, { value: bounds.ignore_below_visibility, text: "ignored below" }].filter(({ value }) => value > 0) : [];
  return {
    area_px: { title: "Area of boxes", unit: "px", logarithmic: true, marks: [{ value: 200, text: "200 px" }, { value: 2000, text: "2,000 px" }], absent: "There are no labels.", note: "Dashed: boundaries of the size classes." },
    visibility: { title: "Visibility", unit: "visible share", say: percent, marks: visible, absent: ours ? "No label has a value for visibility: measuring it needs the actor layer of the passes (render.actor_layer), which this dataset does not have." : old("visibility") },
    contrast_k: { title: "Contrast against the surroundings", unit: "K", absent: old("contrast") },
    contrast_noise: { title: "Contrast relative to noise", unit: "times the noise of a pixel", say: (value) => `${figure(value)} times`, marks: [{ value: 1, text: "noise" }], absent: old("contrast"), note: sensor ? `The noise of this sensor: NETD ${figure(sensor.netd_mk)} mK.` : undefined },
    range_m: { title: "Range", unit: "m", absent: ours ? "No label has a value for range: measuring it needs depth in the passes." : old("range") },
    temperature_k: { title: "Apparent temperature", unit: "K", absent: old("temperature") },
  };
}

function histogramsSection({ labels, record }) {
  const described = quantities(record?.config, record !== undefined);
  const entries = Object.entries(described).map(([key, quantity]) => ({ quantity, histogram: labels.histograms[key] }));
  const absent = distinct(entries.filter(({ histogram }) => histogram.known === 0).map(({ quantity }) => quantity.absent));
  return section("distributions", "Distributions", element("p", { class: "soft" }, "All labels by category, including ignored ones."),
    legend(seriesKeys(labels.categories)),
    element("div", { class: "grid" }, entries.filter(({ histogram }) => histogram.known > 0).map(({ histogram, quantity }) => histogramCard(histogram, labels.categories, quantity))),
    absent.map((sentence) => element("p", { class: "under absent" }, sentence)));
}

// --- clips

function clipRow(clip, labels, track) {
  const video = labels.videos.find(({ name }) => name === clip.id);
  if (clip.status !== "done" || !video) return { bad: true, cells: [clip.id, clip.status, "", "", "", "", "", "", clip.reason ?? "not made yet"] };
  const height = distinct((track?.agl_m ?? []).map(figure)).join(" to ");
  const sum = element("code", { title: clip.pixels_sha256 }, clip.pixels_sha256.slice(0, 12));
  return [clip.id, clip.season, count(clip.frames), video.frame_rate_hz > 0 ? duration(video.images / video.frame_rate_hz) : "", count(video.labels), count(video.tracks), count(video.negatives), height, sum];
}

function clipsSection({ labels, record, flights }) {
  const numbers = ["frames", "length", "labels", "tracks", "frames without"].map((name) => ({ name }));
  if (!record) {
    const row = (video) => [video.name, count(video.images), video.frame_rate_hz > 0 ? duration(video.images / video.frame_rate_hz) : "", count(video.labels), count(video.tracks), count(video.negatives)];
    return section("clips", "Videos", table("Videos", [{ name: "video", text: true }, ...numbers], labels.videos.map(row)));
  }
  const tracks = new Map(flights.tracks.map((track) => [track.clip, track]));
  const columns = [{ name: "clip", text: true }, { name: "season", text: true }, ...numbers, { name: "height above ground, m" }, { name: "SHA-256 of pixels", text: true }];
  return section("clips", "Clips", table("Clips", columns, record.clips.map((clip) => clipRow(clip, labels, tracks.get(clip.id)))));
}

// --- physics

const TERMS = {
  place: "ground and leaves are as warm as shade, sky view and moisture make them",
  facing: "surfaces are as warm as the direction that they face makes them",
  variation: "the temperature of ground and plants varies in space",
  parts: "parts of a body have their own temperatures",
  sky: "surfaces reflect the sky and their surroundings",
  angular: "emissivity decreases towards grazing angles",
  path: "air between surface and camera absorbs and emits radiance",
  mirror: "water reflects what stands around it",
  smear: "the picture moves while a pixel integrates",
  falloff: "the lens gathers less light off axis, so noise increases there",
};

function physicsSection({ record }) {
  const { physics, config } = record;
  const terms = physics?.terms ?? [];
  const published = (config.sensor?.model ?? "published") === "published";
  if (terms.length === 0) return section("physics", "Physics", element("p", {}, "The dataset does not state which physical terms it includes."));
  const rows = terms.map((term) => [words(term.term), TERMS[term.term] ?? "", term.choice, figure(term.spread_mk), figure(term.actor_shift_mk), term.kept ? "kept" : "dropped"]);
  const columns = [{ name: "term", text: true }, { name: "what it adds", text: true, wrap: true }, { name: "choice", text: true }, { name: "spread, mK" }, { name: "largest on an actor, mK" }, { name: "outcome", text: true }];
  const words_of = published
    ? "The published model: emission only, with one temperature per material. The table shows what each term would have added."
    : `An automatic term is kept if its effect varies across the pictures by more than a third of the NETD. Total of the dropped terms: ${figure(physics.dropped_mk)} mK.`;
  const weighed = terms.some((term) => term.spread_mk > 0);
  return section("physics", "Physics", element("p", { class: "soft" }, words_of),
    weighed ? element("div", { class: "card" }, termChart(terms, config.sensor?.netd_mk ?? 40)) : element("p", {}, "According to the manifests, none of the terms would change these pictures, so there is no chart."),
    table("Physical terms", columns, rows));
}

// --- the day

// Surfaces of the chart, if the dataset's materials include them; the table has all.
const SHOWN = ["soil", "grass", "water", "rock", "acacia", "road", "shrub"];

function daySection({ days }) {
  if (!days?.length) return null;
  const parts = days.map((day) => {
    const hours = day.air_k.map((_, k) => k).filter((k) => (k * day.step_h) % 3 === 0 && k * day.step_h < 24);
    const row = (name, values) => [words(name), ...hours.map((k) => figure(values[k]))];
    const columns = [{ name: "surface", text: true }, ...hours.map((k) => ({ name: clock(k * day.step_h) }))];
    const rows = [row("air", day.air_k), ...Object.entries(day.materials_k).map(([name, values]) => row(name, values))];
    return [
      element("h3", {}, day.season),
      element("div", { class: "card" }, dayChart(day, SHOWN.filter((name) => name in day.materials_k))),
      folded("All surfaces, in kelvin", table(`Temperatures over a day in ${day.season}`, columns, rows)),
    ];
  });
  return section("day", "Temperatures over the day",
    element("p", { class: "soft" }, "Open, level surfaces by the heat balance; leaves in the middle of their crowns. The shaded hours are flown."), ...parts);
}

// --- provenance

function provenanceSection({ record }) {
  const { config } = record;
  const flown = config.clips?.some((clip) => clip.flight) || (config.flights ?? []).length > 0;
  const command = flown ? "veldt generate config.json --out dataset" : "veldt convert PASSES\u2026 --config config.json --out dataset";
  const drawn = [...new Set((config.clips ?? []).flatMap((clip) => clip.drawn ?? []))].sort();
  return section("provenance", "Provenance",
    pairs([
      ["Made by", `Veldt ${record.veldt_version ?? "of an unknown version"}`],
      ["Status", record.status],
      ["Seed", String(config.seed)],
      ["Drawn for each clip", drawn.length > 0 ? listed(drawn) : undefined],
      ["Pixels, SHA-256", element("code", {}, record.pixels_sha256 ?? "unknown")],
      ["Labels, SHA-256", element("code", {}, record.annotations_sha256 ?? "unknown")],
      ["To reproduce it", element("span", {}, "save the config below as config.json, then run ", element("code", {}, command))],
    ]),
    folded("The whole config, with all defaults", element("pre", { tabindex: "0" }, JSON.stringify(config, null, 2))));
}
