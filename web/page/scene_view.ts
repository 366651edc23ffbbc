// The scene in 3-D, with one colour per element.
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  DataTexture,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  MOUSE,
  PerspectiveCamera,
  Raycaster,
  Scene as Group,
  ShaderMaterial,
  SRGBColorSpace,
  TOUCH,
  Vector2,
  WebGLRenderer,
} from "three";
import {OrbitControls} from "three/addons/controls/OrbitControls.js";
import {encodeSrgb} from "./colours";
import {element as child} from "./controls";
import type {Elements, Scene, Vec3} from "./core";

// The colour of the texel. Alpha is 0 in marked texels; they have an outline, white outside and black inside.
const fragmentShader = `
uniform sampler2D texels;
varying vec2 chart;

bool isMarked(ivec2 texel, ivec2 size) {
  return texel == clamp(texel, ivec2(0), size - 1) && texelFetch(texels, texel, 0).a < 0.5;
}

void main() {
  ivec2 size = textureSize(texels, 0);
  vec2 place = chart * vec2(size), pixel = fwidth(place);
  ivec2 texel = clamp(ivec2(floor(place)), ivec2(0), size - 1);
  gl_FragColor = vec4(texelFetch(texels, texel, 0).rgb, 1.0);
  if (!isMarked(texel, size)) return;
  vec2 low = (place - vec2(texel)) / pixel, high = (vec2(texel) + 1.0 - place) / pixel;
  float border = 1e9;  // distance to the border, in pixels of the screen
  if (!isMarked(texel - ivec2(1, 0), size)) border = min(border, low.x);
  if (!isMarked(texel + ivec2(1, 0), size)) border = min(border, high.x);
  if (!isMarked(texel - ivec2(0, 1), size)) border = min(border, low.y);
  if (!isMarked(texel + ivec2(0, 1), size)) border = min(border, high.y);
  if (border < 4.0) gl_FragColor.rgb = vec3(border < 2.0 ? 1.0 : 0.0);
}`;

const vertexShader = `
varying vec2 chart;
void main() {
  chart = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const noElement = 0xffffffff;

interface SurfaceMesh {
  mesh: Mesh<BufferGeometry, ShaderMaterial>;
  texture: DataTexture;
  elementOfTexel: Uint32Array;
}

interface SceneViewOptions {
  label: string;
  scene: Scene;
  elements: Elements;
}

/** Draws when something has changed, and only then. */
export class SceneView {
  readonly canvas: HTMLCanvasElement;
  private readonly box: HTMLElement;
  private readonly hint: HTMLElement;
  private readonly renderer: WebGLRenderer | undefined; // none without WebGL2: the rest of the lesson still works
  private readonly camera: PerspectiveCamera;
  private readonly controls: OrbitControls;
  private readonly sizeObserver: ResizeObserver;
  private readonly group = new Group();
  private readonly pictures = new Group(); // that stand in the scene
  private surfaces: SurfaceMesh[] = [];
  private readonly removed: SurfaceMesh[] = []; // freed after the next picture, so that their shader stays compiled
  private drawing = 0;
  private picked: ((element: number) => void) | null = null;

  constructor(parent: HTMLElement, {label, scene, elements}: SceneViewOptions) {
    this.box = child(parent, "div", {className: "scene-view"});
    this.canvas = child(this.box, "canvas", {role: "application", ariaLabel: label, tabIndex: 0});
    this.canvas.ariaRoleDescription = "view of the scene";
    child(this.box, "div", {className: "centre-cross"});
    this.hint = child(parent, "p", {className: "hint"});
    this.hint.textContent = "Drag or arrow keys: turn. Wheel, two fingers, + or -: zoom.";
    const context = this.canvas.getContext("webgl2");
    if (context) this.renderer = new WebGLRenderer({canvas: this.canvas, context});
    else this.showNoView();
    this.camera = new PerspectiveCamera();
    // Before the listeners of OrbitControls, so that a drag that picks does not turn the view.
    this.listen();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.mouseButtons = {LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.ROTATE};
    this.controls.touches = {ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_ROTATE};
    this.controls.addEventListener("change", () => this.requestDrawing());
    this.placeCamera(scene);
    this.setElements(elements);
    this.sizeObserver = new ResizeObserver(() => this.resize());
    this.sizeObserver.observe(this.box);
  }

  /** After an edit. Colours start as reflectance. */
  setElements(elements: Elements): void {
    this.removeSurfaces();
    const info = elements.info();
    this.surfaces = info.surfaces.map(({columns, rows}, surface) => {
      const {positions, charts, elementOfTexel} = elements.geometry(surface);
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(positions, 3));
      geometry.setAttribute("uv", new BufferAttribute(charts, 2));
      const texture = new DataTexture(new Uint8Array(4 * columns * rows).fill(255), columns, rows);
      texture.needsUpdate = true;
      const material = new ShaderMaterial({vertexShader, fragmentShader, uniforms: {texels: {value: texture}}});
      const mesh = new Mesh(geometry, material);
      this.group.add(mesh);
      return {mesh, texture, elementOfTexel};
    });
    const colours = new Float32Array(3 * info.elements);
    for (const {first_element, element_count, reflectance} of info.surfaces)
      for (let i = 0; i < element_count; ++i) colours.set(reflectance.map(encodeSrgb), 3 * (first_element + i));
    this.setColours(colours);
  }

  /** @param rgb three numbers per element in [0, 1], sRGB */
  setColours(rgb: Float32Array): void {
    this.changeTexels((data, start, element) => {
      for (let band = 0; band < 3; ++band) data[start + band] = Math.round(255 * rgb[3 * element + band]);
    });
  }

  /** Outlines these elements. */
  mark(elements: number[]): void {
    const marked = new Set(elements);
    this.changeTexels((data, start, element) => {
      data[start + 3] = marked.has(element) ? 0 : 255;
    });
  }

  /** Puts a picture into the scene: a parallelogram with its lower left corner, and its lower and left edges. */
  addPicture(picture: HTMLCanvasElement, corner: Vec3, lower: Vec3, left: Vec3): void {
    const at = (x: number, y: number) => corner.map((value, axis) => value + x * lower[axis] + y * left[axis]);
    const places: [number, number][] = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]];
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places.flatMap(([x, y]) => at(x, y))), 3));
    geometry.setAttribute("uv", new BufferAttribute(Float32Array.from(places.flat()), 2));
    const map = new CanvasTexture(picture);
    map.colorSpace = SRGBColorSpace;
    this.pictures.add(new Mesh(geometry, new MeshBasicMaterial({map, side: DoubleSide})));
    this.requestDrawing();
  }

  /** Calls `picked` when the pointer is pressed or dragged on an element, or Enter is pressed. */
  onPick(picked: (element: number) => void): void {
    this.picked = picked;
    this.hint.textContent =
      "Press or drag: choose an element; Enter: that at the centre. Right button, two fingers, arrow keys: turn. " +
      "Wheel, + or -: zoom.";
  }

  dispose(): void {
    this.sizeObserver.disconnect();
    cancelAnimationFrame(this.drawing);
    this.controls.dispose();
    this.removeSurfaces();
    this.freeRemoved();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss(); // browsers limit the number of contexts
    this.box.remove();
    this.hint.remove();
  }

  private showNoView(): void {
    this.canvas.hidden = this.hint.hidden = true;
    child(this.box, "p", {textContent: "The view in 3-D needs WebGL2. This browser has none, or it is switched off."});
  }

  private removeSurfaces(): void {
    this.removed.push(...this.surfaces.splice(0));
    this.group.clear();
  }

  private freeRemoved(): void {
    for (const {mesh, texture} of this.removed.splice(0)) {
      mesh.geometry.dispose();
      mesh.material.dispose();
      texture.dispose();
    }
  }

  /** Calls `change` with the four bytes of each texel, from `start`. */
  private changeTexels(change: (data: Uint8Array, start: number, element: number) => void): void {
    for (const {texture, elementOfTexel} of this.surfaces) {
      const data = texture.image.data as Uint8Array;
      for (let i = 0; i < elementOfTexel.length; ++i)
        if (elementOfTexel[i] !== noElement) change(data, 4 * i, elementOfTexel[i]);
      texture.needsUpdate = true;
    }
    this.requestDrawing();
  }

  private placeCamera(scene: Scene): void {
    const {camera, extent} = scene.info();
    this.camera.up.set(...camera.up);
    this.camera.position.set(...camera.eye);
    this.camera.fov = camera.fov;
    const distance = this.camera.position.distanceTo(this.controls.target.set(...camera.look_at));
    this.camera.near = extent / 1000;
    this.camera.far = 10 * (extent + distance);
    this.controls.update();
  }

  private resize(): void {
    const {clientWidth: width, clientHeight: height} = this.box;
    if (!width || !height) return;
    this.renderer?.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer?.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw(); // at once: a canvas with a new size is blank
  }

  private requestDrawing(): void {
    this.drawing ||= requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.drawing = 0;
    this.group.add(this.pictures);
    this.renderer?.render(this.group, this.camera);
    this.freeRemoved();
  }

  /** The element at a place of the canvas; x and y in [-1, 1]. */
  private elementAt(x: number, y: number): number | null {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), this.camera);
    const hit = ray.intersectObjects(this.surfaces.map(({mesh}) => mesh))[0];
    const surface = this.surfaces.find(({mesh}) => mesh === hit?.object);
    if (!surface || !hit.uv) return null;
    const {width, height} = surface.texture.image;
    const column = Math.min(width - 1, Math.floor(hit.uv.x * width));
    const row = Math.min(height - 1, Math.floor(hit.uv.y * height));
    const element = surface.elementOfTexel[row * width + column];
    return element === noElement ? null : element;
  }

  private pick(event: PointerEvent): boolean {
    if (!this.picked) return false;
    const box = this.canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    const element = this.elementAt(x, y);
    if (element !== null) this.picked(element);
    return element !== null;
  }

  private listen(): void {
    let picking: number | null = null; // the pointer that picks
    const setPicking = (pointer: number | null) => {
      picking = pointer;
      this.controls.enableRotate = picking === null;
    };
    // A second finger ends picking, and OrbitControls takes both.
    this.canvas.addEventListener("pointerdown", (event) => {
      const picks = event.button === 0 && event.isPrimary && this.pick(event);
      setPicking(picks ? event.pointerId : null);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.pointerId === picking) this.pick(event);
    });
    for (const end of ["pointerup", "pointercancel"] as const)
      this.canvas.addEventListener(end, () => setPicking(null));
    // After a reset of the GPU
    this.canvas.addEventListener("webglcontextrestored", () => this.requestDrawing());
    this.canvas.addEventListener("keydown", (event) => {
      const action = this.keyAction(event.key);
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  private keyAction(key: string): (() => void) | undefined {
    const step = Math.PI / 36;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.turn(step, 0),
      ArrowRight: () => this.turn(-step, 0),
      ArrowUp: () => this.turn(0, -step),
      ArrowDown: () => this.turn(0, step),
      "+": () => this.zoom(0.9),
      "-": () => this.zoom(1 / 0.9),
      Enter: () => {
        const element = this.elementAt(0, 0);
        if (element !== null) this.picked?.(element);
      },
    };
    return actions[key];
  }

  /** Turns the camera about the point that it looks at. */
  private turn(azimuth: number, polar: number): void {
    this.controls.rotateLeft(azimuth);
    this.controls.rotateUp(polar);
  }

  private zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  }
}
