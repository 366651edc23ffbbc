// The measured profile of a device, in words.
import {element} from "../controls";
import type {Profile} from "../core";

type Row = [property: string, value: string, meaning: string];

const snappings: Record<string, string> = {
  nearest: "to the nearest grid point",
  truncate: "down to a grid point",
  none: "corners stay between grid points",
};

function snappingRows(profile: Profile): Row[] {
  const bits = Number(profile.subpixel_bits);
  const rounding = String(profile.snap_rounding);
  return [
    ["sub-pixel bits", String(bits), `corners lie on a grid of 1/${2 ** bits} pixel`],
    ["snapping", rounding, snappings[rounding]],
  ];
}

function fillRuleRow(profile: Profile): Row {
  const isTopLeft = profile.edge_rule === "top-left";
  const meaning = isTopLeft
    ? "a triangle has the samples on its top and left edges"
    : "samples on edges follow no top-left rule";
  return ["fill rule", String(profile.edge_rule), meaning];
}

/** 1/256 for a power of two. */
function fraction(value: number): string {
  if (value === 0) return "0";
  return Number.isInteger(1 / value) ? `1/${1 / value}` : value.toPrecision(3);
}

function textureRows(profile: Profile): Row[] {
  const roundings = Number(profile.interpolation_error);
  return [
    ["texture precision", fraction(Number(profile.texel_precision)), "error of small coordinates, in texels"],
    ["interpolation", roundings.toPrecision(3), "error of large coordinates, in r"],
  ];
}

const depthFormats: Record<string, string> = {
  float32: "32-bit floats",
  unorm24: "as fine as 24-bit integers",
  unorm16: "16-bit integers",
};

function rowsOf(profile: Profile): Row[] {
  const format = String(profile.depth_format);
  return [
    ...snappingRows(profile),
    fillRuleRow(profile),
    ...textureRows(profile),
    ["depth format", format, depthFormats[format]],
  ];
}

/** A table of the properties that the probes measured. */
export function showProfile(parent: HTMLElement, profile: Profile): void {
  const table = element(parent, "table");
  for (const [property, value, meaning] of rowsOf(profile)) {
    const row = element(table, "tr");
    element(row, "th", {scope: "row", textContent: property});
    element(row, "td", {textContent: value}).dataset.testid = `profile ${property}`;
    element(row, "td", {textContent: meaning});
  }
}
