"use strict";
// What the pages of `hemitex tradeoff` and `hemitex paper` are made with. It comes before all other scripts, so that no
// fault of theirs is missed.

const faults = [];
addEventListener("error", event => faults.push(event.message));

/// The JSON that the page carries in the script element with this id.
const carried = id => JSON.parse(document.getElementById(id).textContent);

/// How numbers are said with so many digits.
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

/// A cell is a text, or a text and what stands small below it, or with a class; `classOf` gives the class of a row.
function table(made, head, rows, classOf = () => "") {
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

/// A figure with a PNG file, given as letters.
function picture(parent, png, alt, caption) {
  const figure = element(parent, "figure");
  const image = element(figure, "img");
  image.alt = alt;
  image.src = "data:image/png;base64," + png;
  element(figure, "figcaption", caption);
}

/// Charts are there at once and as large as their places.
function setUpCharts() {
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
}

/// Points and painted pixels of each chart, by the id of its canvas.
const drawn = {};
function drawChart(canvas, settings) {
  const chart = new Chart(canvas, settings);
  const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let points = 0, painted = 0;
  for (let i = 0; i < chart.data.datasets.length; ++i) points += chart.getDatasetMeta(i).data.length;
  for (let i = 3; i < pixels.length; i += 4) painted += pixels[i] > 0;
  drawn[canvas.id] = { points, painted };
}

/// What came of it, for those who check the page without looking at it (tests/page_check.cmake).
function tellDrawn() {
  const report = element(document.body, "pre", JSON.stringify({ faults, drawn, pictures: document.images.length }));
  report.id = "drawn";
  report.hidden = true;
}
