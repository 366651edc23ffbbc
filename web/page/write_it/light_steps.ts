// The steps after the rasterizer: from delta form factors to a lit room (Cohen and Greenberg 1985; Cohen, Chen, Wallace
// and Greenberg 1988).
import {
  ambientTask,
  brightestTask,
  refineTask,
  rowTask,
  sharesTask,
  shootTask,
  textureTask,
  wholeTask,
  type LightTask,
} from "./light_tasks";

export interface LightStep {
  title: string;
  text: string; // HTML
  light: LightTask;
  added: string; // to the solution of the step before
}

export const lightSteps: LightStep[] = [
  {
    title: "Delta form factors",
    text: `Your item buffers are right: now the light. Write <code>pixelShares(resolution, isSide)</code>, the shares of
      light of the pixels of a face, row by row. The top face goes from −1 to 1 in x and y at height 1:
      ΔF = ΔA / (π (x² + y² + 1)²) in the middle of a pixel of area ΔA. A side goes from −1 to 1 in x and from 0, its
      first row, to 1 in height z: ΔF = z ΔA / (π (x² + z² + 1)²).`,
    light: sharesTask,
    added: `
function pixelShares(resolution, isSide) {
  const size = 2 / resolution, count = resolution * resolution / (isSide ? 2 : 1);
  return Array.from({length: count}, (_, k) => {
    const x = (k % resolution + 0.5) * size - 1, y = (Math.floor(k / resolution) + 0.5) * size - (isSide ? 0 : 1);
    return (isSide ? y : 1) * size * size / (Math.PI * (x * x + y * y + 1) ** 2);
  });
}
`,
  },
  {
    title: "A row of form factors",
    text: `Write <code>row(ids, shares, count)</code>. Both lists have an entry for each face: the elements that its
      pixels show, where −1 is no element, and the shares of the pixels. Return <code>count</code> numbers: for each
      element the sum of the shares of its pixels.`,
    light: rowTask,
    added: `
function row(ids, shares, count) {
  const factors = new Float64Array(count);
  ids.forEach((face, f) => face.forEach((id, k) => {
    if (id >= 0) factors[id] += shares[f][k];
  }));
  return factors;
}
`,
  },
  {
    title: "The brightest element",
    text: `<code>elements</code> has lists with a number per element: <code>area</code>, <code>reflectance</code>,
      <code>emission</code>, <code>radiosity</code> and <code>unshot</code>, the part of the radiosity that has not been
      shot. Write <code>brightest(elements)</code>: the number of the element with the most unshot <em>flux</em>, which
      is radiosity times area.`,
    light: brightestTask,
    added: `
function brightest({unshot, area}) {
  return unshot.reduce((best, value, k) => value * area[k] > unshot[best] * area[best] ? k : best, 0);
}
`,
  },
  {
    title: "One shot",
    text: `Write <code>shoot(elements, source, row)</code>. The source sends its unshot flux along its row, and has none
      left. Element k receives the share <code>row[k]</code> and reflects the part <code>reflectance[k]</code> of it.
      This flux over its own area is added to its <code>radiosity</code> and to its <code>unshot</code> radiosity.`,
    light: shootTask,
    added: `
function shoot({area, reflectance, radiosity, unshot}, source, row) {
  const flux = unshot[source] * area[source];
  unshot[source] = 0;
  row.forEach((factor, k) => {
    const gain = reflectance[k] * factor * flux / area[k];
    radiosity[k] += gain;
    unshot[k] += gain;
  });
}
`,
  },
  {
    title: "Progressive refinement",
    text: `Write <code>refine(elements, rowOf, residual)</code>. Shoot from the brightest element along
      <code>rowOf(source)</code>, again and again, until the unshot flux of all elements is at most
      <code>residual</code> times the flux that they emit.`,
    light: refineTask,
    added: `
function refine(elements, rowOf, residual) {
  const flux = values => sum(values.map((value, k) => value * elements.area[k]));
  while (flux(elements.unshot) > residual * flux(elements.emission)) {
    const source = brightest(elements);
    shoot(elements, source, rowOf(source));
  }
}
`,
  },
  {
    title: "The ambient estimate",
    text: `Before all light is shot, pictures are too dark. Write <code>ambient(elements)</code>, which estimates what is
      missing: all unshot flux spread evenly over a room of the same area that absorbs as much. That is the unshot flux
      over the sum of area · (1 − reflectance).`,
    light: ambientTask,
    added: `
function ambient({unshot, area, reflectance}) {
  return sum(unshot.map((value, k) => value * area[k])) / sum(area.map((value, k) => value * (1 - reflectance[k])));
}
`,
  },
  {
    title: "The texture",
    text: `Write <code>filtered(texture, u, v)</code>, where a texture has <code>width</code>, <code>height</code> and
      <code>values</code>, row by row. The centre of texel (column, row) is at ((column + 1/2) / width, (row + 1/2) /
      height). Between four centres, go linearly along u and then along v. Beyond the outermost centres take their
      values.`,
    light: textureTask,
    added: `
function filtered({width, height, values}, u, v) {
  const clamp = (value, size) => Math.min(size - 1, Math.max(0, value));
  const x = clamp(u * width - 0.5, width), y = clamp(v * height - 0.5, height);
  const at = (column, row) => values[clamp(row, height) * width + clamp(column, width)];
  const between = (p, q, t) => p + t * (q - p), left = Math.floor(x), low = Math.floor(y);
  const along = row => between(at(left, row), at(left + 1, row), x - left);
  return between(along(low), along(low + 1), y - low);
}
`,
  },
  {
    title: "The whole method",
    text: `Write <code>light(elements, {views, indexBits, tables}, residual)</code>, which returns the radiosity.
      <code>views[k]</code> are the five faces over element k for your <code>draw</code>, the top first. The lowest
      <code>indexBits</code> bits of an item ID are the index, the others the surface:
      <code>tables[surface][index]</code> is the element; where there is no entry, the pixel shows none. Keep rows that
      you have computed. Your functions light the Cornell box, in red, green and blue.`,
    light: wholeTask,
    added: `
function light(elements, {views, indexBits, tables}, residual) {
  const elementOf = id => tables[id >> indexBits]?.[id & 2 ** indexBits - 1] ?? -1;
  const rows = [], shares = views[0].map((view, face) => pixelShares(view.resolution, face > 0));
  const rowOf = source => rows[source] ??=
    row(views[source].map(view => Array.from(draw(view), elementOf)), shares, elements.area.length);
  refine(elements, rowOf, residual);
  return elements.radiosity;
}
`,
  },
];
