// The devices that the page judges: the visitor's GPU, and simulated devices with a known fault.
import {openDevice as openWebGL2} from "../../webgl2/backend.js";
import {openDevice as openWebGPU} from "../../webgpu/backend.js";
import type {Option} from "../controls";
import type {ItemBuffers, Vector} from "../core";
import {drawWithFault} from "../faulty_device";

export interface Device {
  name: string;
  driver: string;
  draw(vector: Vector): ItemBuffers | Promise<ItemBuffers>;
  close(): void;
}

/** Faults of simulated devices, by their names in Vector.faults. */
const simulatedFaults = [
  "sample at the pixel corner",
  "wrong fill rule",
  "depth test off",
  "linear filtering",
  "affine instead of perspective interpolation",
  "index map upside down",
  "wrap instead of clamp",
  "dithering",
];

const simulated = "simulated: ";

export const deviceChoices: readonly Option[] = [
  ["webgl2", "this GPU, with WebGL2"],
  ["webgpu", "this GPU, with WebGPU"],
  ...simulatedFaults.map((fault): Option => [simulated + fault, `a broken device: ${fault}`]),
];

function simulatedDevice(fault: string): Device {
  return {
    name: `simulated device: ${fault}`,
    driver: "hemitex",
    draw: (vector) => drawWithFault(vector, fault),
    close() {},
  };
}

/** Opens a device of deviceChoices. Throws if the browser has none. */
export async function openDevice(choice: string): Promise<Device> {
  if (choice.startsWith(simulated)) return simulatedDevice(choice.slice(simulated.length));
  const isWebGPU = choice === "webgpu";
  const device = isWebGPU ? await openWebGPU() : openWebGL2();
  return {
    name: device.name,
    driver: `${isWebGPU ? "WebGPU" : "WebGL2"}, ${navigator.userAgent}`,
    draw: (vector) => device.drawVector(vector.json(), vector.arrays()),
    close: device.close,
  };
}
