// hemitex in the page: the functions of web/bindings, with types. Numbers of elements, patches and surfaces count from
// 0. All functions throw an Error for input out of range; its message says what is wrong and what to do.
import {sha256} from "@noble/hashes/sha2";
import {bytesToHex} from "@noble/hashes/utils";

export type Vec3 = [number, number, number];

/** A view of a test vector, as in vector.json (docs/backend.md). */
export interface VectorFace {
  name: string;
  eye?: Vec3;
  x: Vec3;
  y: Vec3;
  w: Vec3;
  scissor: [column: number, row: number, width: number, height: number];
  words: string; // the file of its item IDs
}
export interface VectorDraw {
  first: number;
  count: number;
  offset: number;
  back?: number | null;
  index_map?: string | null;
  width?: number;
  height?: number;
}
/** The object of vector.json. */
export interface VectorJson {
  name: string;
  catches?: string;
  channels: number[]; // bits, least significant first
  blend: "clamped-add" | "integer-add" | "replace";
  background: number;
  origin: Vec3; // of all positions, in units of the scene
  eye: Vec3;
  near: number;
  resolution: number;
  positions: string;
  texcoords: string;
  indices: string;
  draws: VectorDraw[];
  faces: VectorFace[];
}
/** The arrays of a vector, as drawVector of web/webgl2/backend.js takes them. */
export interface VectorArrays {
  positions: Float32Array;
  texcoords: Float32Array;
  indices: Uint32Array;
  maps: Record<string, Uint32Array>;
}

/** The item IDs of the faces of a vector, row 0 first. */
export type ItemBuffers = Uint32Array[];

/** A sum of offset and texel in one channel. */
export interface ChannelSum {
  bits: number;
  offset: number;
  texel: number;
  result: number;
}
/** How the visible triangle gives the item ID of a pixel. */
export interface Derivation {
  triangle: number;
  draw: number;
  clip: {cut_by: string[]};
  corners: {view: Vec3; snapped: [x: number, y: number]}[]; // snapped: in 1/256 pixel
  sample: [x: number, y: number]; // in 1/256 pixel
  faces_away: boolean;
  edges: {value: number; kind: string}[];
  inverse_depth: number;
  u: number;
  v: number;
  texel: {width: number; height: number; position: [number, number]; column: number; row: number; index: number} | null;
  sums: ChannelSum[]; // empty without a texel
  runner_up: {draw: number; inverse_depth: number} | null; // the next triangle behind
}
/** The item ID of a pixel; reference/conformance/verdict/explanation.h has more keys. */
export interface Explanation {
  column: number;
  row: number;
  word: number; // the item ID
  derivation: Derivation | null; // null: the background
}

/** A device profile; reference/conformance/verdict/device_profile.h has the keys and their defaults. */
export type Profile = Record<string, number | string | boolean>;

export interface ErrorPixel {
  face: string;
  column: number;
  row: number;
  kind: string;
  expected: number;
  found: number;
  expected_from: string | null;
  found_from: string | null;
}
/** The verdict on the item IDs of a device. */
export interface Report {
  /** Number of pixels by verdict, and examples of errors; verdict_report.h in reference/conformance has more keys. */
  json(): {pixels: Record<string, number>; errors: ErrorPixel[]};
  /** "linear filtering (99.8 % agreement): set both filters ..."; empty without errors. */
  findings(): string;
  /** The verdict of each pixel of each face: an index into core.verdicts. */
  pixels(): Uint8Array[];
  expected(): ItemBuffers;
}

export interface Fault {
  name: string;
  advice: string;
  variants: string[]; // names, some empty
}

/** A test vector: a draw list and its faces. */
export interface Vector {
  name(): string;
  /** One line: the faults that it detects. */
  catches(): string;
  json(): VectorJson;
  arrays(): VectorArrays;
  /** By the reference renderer. */
  render(): ItemBuffers;
  /** The derivation of a pixel; column and row count in the viewport, not in the scissor rectangle. */
  explain(face: string, column: number, row: number): Explanation;
  judge(found: ItemBuffers, profile: Profile): Report;
  /** A vector of one pixel and few triangles that explains an error. Throws if there is none. */
  minimize(found: ItemBuffers, profile: Profile): Vector;
  /** Removes parts as long as `fails` stays true. Calls it at most `maxRuns` times. */
  reduce(fails: (smaller: Vector) => boolean, maxRuns: number): Vector;
  /** All known faults that the vector can show. */
  faults(): Fault[];
  /** What a device with this fault draws; the numbers count in faults(). */
  drawFault(fault: number, variant: number): ItemBuffers;
}

export interface Probes {
  vectors(): Vector[];
  calibrate(answers: ItemBuffers[]): {profile: Profile; faults: string[]};
}

export interface SurfaceInfo {
  name: string;
  reflectance: Vec3; // red, green, blue; in [0, 1)
  emission: Vec3; // W/m^2
}
export interface SceneInfo {
  surfaces: SurfaceInfo[];
  camera: {eye: Vec3; look_at: Vec3; up: Vec3; fov: number}; // fov in degrees, from top to bottom
  extent: number; // in units of the scene
  square_metres: number; // of a square unit, as the file states it; 1 if it states none
}
export interface DiscretizationSettings {
  texels?: number; // columns and rows of each surface
  texel_size?: number; // alternatively, in units of the scene
  surface_texels?: Record<string, number>; // by name; 1: not discretized
  patch?: number; // texels along the side of a patch; 4
  editable?: boolean; // for solutions that are edited
}
export interface Scene {
  info(): SceneInfo;
  discretize(settings: DiscretizationSettings): Elements;
}

export interface IdSettings {
  format?: string; // a name of core.formats(); "r8g8b8a8"
  blend?: "clamped-add" | "integer-add";
  aligned?: boolean;
}
export interface DrawingSettings extends IdSettings {
  resolution?: number; // even, 2 to 4096; 256
  rotated?: boolean; // rotated per patch; only for rows of patches and for solutions
  split?: number; // parts of patches near their receivers; 1: no patch is split
  elements?: "texture" | "mesh";
}
export interface ElementsInfo {
  elements: number;
  surfaces: (SurfaceInfo & {
    columns: number; // texels
    rows: number;
    first_element: number;
    element_count: number;
  })[];
}
export interface SurfaceGeometry {
  positions: Float32Array; // nine numbers per triangle, in units of the scene
  charts: Float32Array; // six per triangle, in [0, 1]
  elementOfTexel: Uint32Array; // row-major, row 0 at v = 0; 0xffffffff: a texel without element
}
export interface HemicubeFace {
  width: number; // in pixels
  height: number;
  elements: Int32Array; // per pixel; -1: background, -2: a back
  weights: Float64Array; // delta form factors
}
export interface HemicubeView {
  faces: HemicubeFace[]; // top, then the four sides
  formFactors: Float64Array; // one per element
  background: number;
  backs: number;
}
/** How offsets and index maps make item IDs. */
export interface IdLayout {
  bits: number; // of an item ID
  index_bits: number; // k
  /** One per surface: offset, columns and rows of its index map. */
  pages: {offset: number; columns: number; rows: number}[];
}
export interface RowSettings extends DrawingSettings {
  method?: "hemicube" | "rays" | "analytic";
  samples?: number; // rays, 64 to 2^28; best a power of two
  seed?: number;
}
export interface Row {
  formFactors: Float64Array; // one per element
  standardErrors: Float64Array | null; // of rays
  background: number;
  backs: number;
  milliseconds: number;
}
export type Edit =
  | {edit: "move"; name: string; by: Vec3}
  | {edit: "remove" | "restore"; name: string}
  | {edit: "emission" | "reflectance"; name: string; to: Vec3};
export interface SolveSettings extends DrawingSettings {
  residual?: number; // ends when unshot over emitted flux is at most this; 0.001
  shots?: number; // maximum, from 0
  editable?: boolean; // may be continued by shoot and edit; needs editable elements
}
export interface SolutionInfo {
  shots: number; // of the last call
  residual: number;
  ambient: Vec3;
  energy: Record<"emitted" | "absorbed" | "unshot" | "lost", Vec3>; // flux, W/m^2 times square units; emitted is the sum of the others
  milliseconds: number; // of the last call
}
export interface Solution {
  info(): SolutionInfo;
  /** Three numbers per element, W/m^2, without the ambient estimate. */
  radiosity(): Float64Array;
  /** The unshot flux of each patch, W/m^2 times square units, bands summed. Only of an editable solution. */
  unshot(): Float64Array;
  /** The elements of the patch that shoots next. Only of an editable solution. */
  brightest(): number[];
  /** The elements after the last edit; patches may have been split. */
  elements(): Elements;
  /** Shoots at most `count` times, at least 1. */
  shoot(count: number): SolutionInfo;
  /** Applies edits, updates the light, and shoots until the residual is reached, at most `shots` times. */
  edit(edits: Edit[], shots: number): SolutionInfo;
  /** The bytes of elements.csv. */
  csv(): string;
}
export interface Elements {
  info(): ElementsInfo;
  geometry(surface: number): SurfaceGeometry;
  /** The patch of each element. */
  patchOfElement(): Uint32Array;
  areas(): Float64Array; // in squared units of the scene
  ids(settings: IdSettings): IdLayout; // throws if the elements need more item IDs than there are
  /** The hemicube over the centre of an element. */
  hemicube(element: number, settings: DrawingSettings): HemicubeView;
  /** The same as a test vector. */
  vector(element: number, settings: DrawingSettings): Vector;
  /** From an element, or from the patches of a surface. */
  row(source: {element: number} | {surface: string}, settings: RowSettings): Row;
  /** The shortest time of drawing the hemicube over an element, and the number of triangles in the draw list. */
  timeOfHemicube(
    element: number,
    settings: DrawingSettings,
    repeats: number,
  ): {milliseconds: number; triangles: number};
  solve(settings: SolveSettings): Solution;
}

export interface Core {
  /** All vectors of the suite. */
  suite(): Vector[];
  /** A vector from the files of its folder. */
  readVector(files: Record<string, Uint8Array | string>): Vector;
  probes(): Probes;
  /** The names of pixel verdicts, in the order of Report.pixels. */
  verdicts(): string[];
  /** The fault that most failing reports name, as text; empty if there is none. */
  commonFault(reports: Report[]): string;
  /** The class of a device that explains most errors, as text; empty if there is none. */
  deviceClass(reports: Report[]): string;
  /** A conformance record as the text of its file. */
  record(device: string, driver: string, profile: Profile, reports: Report[]): string;
  /** Formats of item IDs, narrowest first: bits per channel, least significant first. */
  formats(): {name: string; channels: number[]}[];
  /** The number of surfaces with index maps of `texels` texels that have aligned item IDs in a format. */
  maxSurfaces(format: string, texels: number): number;
  /** The item ID of a textured pixel: the sum of the offset and the texel. */
  blend(format: string, operation: "clamped-add" | "integer-add", offset: number, texel: number): number;
  /** `files` by name; `main` is the OBJ file. */
  loadScene(files: Record<string, string>, main: string): Scene;
}

declare const startedCore: Promise<{[name: string]: unknown}> | undefined; // without WebAssembly

/**
 * The WebAssembly module; throws if the browser does not run it. A script before this one starts it. Conformance
 * records need SHA-256.
 */
export async function startCore(): Promise<Core> {
  const functions = await startedCore?.catch(() => undefined); // the console has the reason
  if (!functions)
    throw new Error(
      "This page needs WebAssembly with SIMD and exceptions, and this browser does not run it. " +
        "Chrome 95, Firefox 100, Safari 16.4 and later versions do.",
    );
  return Object.assign(functions, {sha256: (bytes: Uint8Array) => bytesToHex(sha256(bytes))}) as unknown as Core;
}
