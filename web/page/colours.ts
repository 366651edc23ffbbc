// Colours of numbers, in sRGB.

export type Rgb = [number, number, number]; // in [0, 1]

/** Encodes a linear value in [0, 1] (IEC 61966-2-1). */
export function encodeSrgb(linear: number): number {
  const value = Math.min(1, Math.max(0, linear));
  return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
}

/** From lightness, chroma, and hue in [0, 1) (Ottosson 2020, A perceptual color space for image processing). */
export function okLch(lightness: number, chroma: number, hue: number): Rgb {
  const a = chroma * Math.cos(2 * Math.PI * hue);
  const b = chroma * Math.sin(2 * Math.PI * hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    encodeSrgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    encodeSrgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    encodeSrgb(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

// Multiples of the golden ratio are far apart on the circle of hues, also for neighbouring IDs.
const goldenRatio = 0.6180339887498949;

/** A colour of its own for each item ID. */
export function idColour(id: number): Rgb {
  const step = (id * goldenRatio) % 1;
  return okLch(0.6 + 0.1 * (id % 4), 0.14, step);
}

/** From dark blue to bright yellow; lightness grows evenly with `value` in [0, 1]. */
export function valueColour(value: number): Rgb {
  const t = Math.min(1, Math.max(0, value));
  return okLch(0.18 + 0.77 * t, 0.05 + 0.2 * t * (1 - t) + 0.08 * t, 0.78 - 0.48 * t);
}

/**
 * Display colours of elements, as hemitex's render.png: linear colour = exposure * radiosity, encoded as sRGB.
 * @param radiosity three numbers per element, W/m^2
 * @param exposure shows the median of the lit elements as middle grey, 0.18, if absent
 */
export function litColours(radiosity: Float64Array, exposure = exposureOf(radiosity)): Float32Array {
  return Float32Array.from(radiosity, (value) => encodeSrgb(exposure * value));
}

/** Shows the median of the lit elements as middle grey. */
export function exposureOf(radiosity: Float64Array): number {
  const means: number[] = [];
  for (let i = 0; i < radiosity.length; i += 3) {
    const mean = (radiosity[i] + radiosity[i + 1] + radiosity[i + 2]) / 3;
    if (mean > 0) means.push(mean);
  }
  means.sort((a, b) => a - b);
  return means.length ? 0.18 / means[means.length >> 1] : 1;
}
