import type {WebGL2Device} from "../device/device";

/** Throws if the browser has no WebGL2. */
export function openDevice(): WebGL2Device;
