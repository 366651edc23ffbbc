"use strict";
// The common functions of the pages of `hemitex solve`, `bench`, `tradeoff` and `paper`. This script comes first, so that
// it records the errors of all others.

const faults = [];
addEventListener("error", event => faults.push(event.message));

const byId = id => document.getElementById(id);
/// The JSON that the page shows.
const readResult = () => JSON.parse(byId("result").textContent);
const distinct = values => [...new Set(values)];
const byX = points => points.sort((a, b) => a.x - b.x);

/// Formats numbers with this number of significant digits.
function numbers(digits) {
  const short = value => String(Number(value.toPrecision(digits)));
  return {
    short,
    time: value => value < 0.1 ? short(1000 * value) + " ms" : short(value) + " s",
    many: value => value >= 1e6 ? short(value / 1e6) + " M" : value >= 1e3 ? short(value / 1e3) + " k" : short(value),
  };
}

function element(parent, tag, text, className) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  parent.append(made);
  return made;
}

/// Fills the table with this id. A cell is a text, or an object with a text, a small text below it and a class. `classOf`
/// returns the class of a row.
function table(id, head, rows, classOf = () => "") {
  const made = byId(id);
  const top = element(made, "tr");
  for (const cell of head) element(top, "th", cell);
  rows.forEach((cells, i) => {
    const row = element(made, "tr", undefined, classOf(i));
    for (const cell of cells) {
      const { text, small, className } = typeof cell === "object" ? cell : { text: cell };
      const td = element(row, "td", text, className);
      if (small) element(td, "small", small);
    }
  });
}

/// Adds a figure with a PNG file, given in base64.
function picture(parent, png, alt, caption) {
  const figure = element(parent, "figure");
  const image = element(figure, "img");
  image.alt = alt;
  image.src = "data:image/png;base64," + png;
  element(figure, "figcaption", caption);
}

/// Draws charts without animation, in the size of their elements.
function setUpCharts() {
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.font.size = 13;
}

/// The ticks of a logarithmic axis: powers of ten and, on short axes, 2 and 5 times these.
function ticks(format) {
  return {
    autoSkip: false, maxRotation: 0,
    callback(value) {
      const digit = Math.round(value / 10 ** Math.floor(Math.log10(value) + 1e-9));
      const span = Math.log10(this.max / this.min);
      return digit === 1 || span < 3 && (digit === 2 || digit === 5) ? format(value) : "";
    },
  };
}

const axis = (text, format, limits) => ({ ...limits, type: "logarithmic", title: { display: true, text },
                                          ticks: ticks(format), grid: { color: "#eee" } });

/// A curve through points {x, y, label}; the tooltip shows the label.
const line = (label, color, data, more) => ({ label, data, showLine: true, borderColor: color, backgroundColor: color,
                                              borderWidth: 2, pointRadius: 4, ...more });
/// The style of a second kind of curve, with square points so that the legend differs.
const dashed = { borderDash: [6, 4], pointStyle: "rect" };

/// Curves of at least two points.
const curves = datasets => datasets.filter(set => set.data.length > 1);

/// Number of points and of painted pixels of each plot, by the id of its canvas.
const drawn = {};

/// Adds a plot in a new canvas with an id to the element `parent`. `x` and `y` are the arguments of `axis`.
/// Adds nothing without datasets.
function plot(parent, id, title, x, y, datasets) {
  if (datasets.length === 0) return;
  const canvas = element(element(byId(parent), "div", undefined, "plot"), "canvas");
  canvas.id = id;
  const chart = new Chart(canvas, {
    type: "scatter",
    data: { datasets },
    options: {
      scales: { x: axis(...x), y: axis(...y) },
      plugins: {
        title: { display: true, text: title, font: { size: 15 } },
        legend: { position: "bottom", labels: { usePointStyle: true, boxHeight: 7 } },
        tooltip: { callbacks: { label: item => item.raw.label ?? item.dataset.label } },
      },
    },
  });
  const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let points = 0, painted = 0;
  for (let i = 0; i < chart.data.datasets.length; ++i) points += chart.getDatasetMeta(i).data.length;
  for (let i = 3; i < pixels.length; i += 4) painted += pixels[i] > 0;
  drawn[canvas.id] = { points, painted };
}

/// Writes the errors and counts into the page, for tests/pages/page_check.cmake.
function tellDrawn() {
  const report = element(document.body, "pre", JSON.stringify({ faults, drawn, pictures: document.images.length }));
  report.id = "drawn";
  report.hidden = true;
}
