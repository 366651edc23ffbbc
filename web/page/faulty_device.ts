// A simulated device with a known fault.
import type {ItemBuffers, Vector} from "./core";

/**
 * What a device with this fault draws. A vector that cannot show the fault is drawn by the rules.
 * @param variant of the fault; empty: the first one
 */
export function drawWithFault(vector: Vector, name: string, variant = ""): ItemBuffers {
  const faults = vector.faults();
  const fault = faults.findIndex((known) => known.name === name);
  const variants = faults[fault]?.variants ?? [];
  const number = variant ? variants.indexOf(variant) : 0;
  return number in variants ? vector.drawFault(fault, number) : vector.render();
}
