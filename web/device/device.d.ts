// What the backends of browsers have in common.
import type {ItemBuffers, VectorArrays, VectorJson} from "../page/core";

export interface DrawingDevice<Answer> {
  /** The name of the GPU, as the browser tells it. */
  name: string;
  /** The item IDs of each face, row 0 first. Throws if the API reports an error. */
  drawVector(vector: VectorJson, arrays: VectorArrays): Answer;
  close(): void;
}
export type WebGL2Device = DrawingDevice<ItemBuffers>;
export type WebGPUDevice = DrawingDevice<Promise<ItemBuffers>>;
