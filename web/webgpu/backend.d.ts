import type {WebGPUDevice} from "../device/device";

/** Throws if the browser has no WebGPU, or WebGPU no GPU. */
export function openDevice(): Promise<WebGPUDevice>;
