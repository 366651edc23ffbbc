// Plots of series of points.
import {
  Chart,
  Legend,
  LinearScale,
  LineElement,
  LogarithmicScale,
  PointElement,
  ScatterController,
  Tooltip,
} from "chart.js";
import {element} from "./controls";
import {shortNumber} from "./numbers";

Chart.register(Legend, LinearScale, LineElement, LogarithmicScale, PointElement, ScatterController, Tooltip);

interface PlotOptions {
  label: string;
  x: string;
  y: string;
  logarithmicX?: boolean;
  logarithmicY?: boolean;
}

export type Point = [x: number, y: number];

export interface Series {
  name: string;
  points: Point[];
  isMarked?: boolean; // its points are large, and in front
}

// Okabe and Ito 2008, Color Universal Design; those with contrast on light and on dark.
const seriesColours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7f7f7f", "#e69f00"];

/** On logarithmic axes only 1, 2 and 5 times a power of ten have a label. */
const isRound = (value: number) => /^[125]e/.test(value.toExponential());

export class Plot {
  private readonly chart: Chart<"scatter">;
  private readonly textColour: string;

  constructor(parent: HTMLElement, {label, x, y, logarithmicX, logarithmicY}: PlotOptions) {
    const box = element(parent, "div", {className: "plot"});
    const canvas = element(box, "canvas", {role: "img", ariaLabel: label});
    const style = getComputedStyle(parent);
    this.textColour = style.color;
    const axis = (title: string, logarithmic = false) => ({
      type: logarithmic ? ("logarithmic" as const) : ("linear" as const),
      title: {display: true, text: title, color: style.color},
      ticks: {
        color: style.color,
        maxTicksLimit: 8,
        callback: (tick: string | number) => (logarithmic && !isRound(Number(tick)) ? null : shortNumber(Number(tick))),
      },
      grid: {color: "rgb(128 128 128 / 0.25)"},
    });
    this.chart = new Chart(canvas, {
      type: "scatter",
      data: {datasets: []},
      options: {
        animation: false,
        maintainAspectRatio: false,
        font: {family: style.fontFamily},
        scales: {x: axis(x, logarithmicX), y: axis(y, logarithmicY)},
        plugins: {legend: {labels: {color: style.color, boxWidth: 12}}},
      },
    });
  }

  set(series: Series[]): void {
    const colours = series.map(({isMarked}, index) =>
      isMarked ? this.textColour : seriesColours[index % seriesColours.length],
    );
    this.chart.data.datasets = series.map(({name, points, isMarked}, index) => ({
      label: name,
      data: points.map(([x, y]) => ({x, y})),
      showLine: !isMarked,
      borderColor: colours[index],
      backgroundColor: colours[index],
      borderWidth: 2,
      pointRadius: isMarked ? 7 : points.length > 50 ? 0 : 3,
      pointStyle: isMarked ? "rectRot" : "circle",
      order: isMarked ? 0 : 1,
    }));
    this.chart.options.plugins!.legend!.display = series.length > 1;
    this.chart.update();
  }

  dispose(): void {
    this.chart.destroy();
  }
}
