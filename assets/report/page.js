// Assembles the page.

function showPage(figures) {
  const ours = figures.record !== undefined;
  const sections = [
    framesSection(figures),
    countsSection(figures),
    figures.labels.labels > 0 ? histogramsSection(figures) : null,
    heatSection(figures.labels),
    ours ? flightsSection(figures) : null,
    clipsSection(figures),
    ours ? physicsSection(figures) : null,
    ours ? daySection(figures) : null,
    ours ? provenanceSection(figures) : null,
  ].filter((part) => part !== null);
  const links = sections.map((part) => element("li", {}, element("a", { href: `#${part.id}` }, part.querySelector("h2").textContent)));
  document.getElementById("page").append(overview(figures), element("nav", { "aria-label": "Sections" }, element("ul", {}, links)), ...sections);
}

showPage(JSON.parse(document.getElementById("figures").textContent));
drawCharts();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawCharts);
