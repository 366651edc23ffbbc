// Broken devices whose fault the student finds. All of these faults were shipped by drivers, engines or tools.

export interface HiddenDevice {
  fault: string; // a name in Vector.faults
  variant: string; // of the fault; empty: the first one
  vector: string; // a vector that shows it
  others: string[]; // names of other faults to choose from
  story: string;
  source: string; // the address that tells it
}

export const hiddenDevices: HiddenDevice[] = [
  {
    fault: "picture upside down",
    variant: "",
    vector: "five-faces",
    others: [
      "y of the view flipped",
      "picture mirrored",
      "faces swapped",
      "index map upside down",
      "matrix transposed",
    ],
    story:
      "The OpenGL renderers of SDL reversed the rows of everything that they read back. The rows of a target texture " +
      "were in the right order already, so that its picture came out upside down (fixed in 2016).",
    source: "https://github.com/libsdl-org/SDL/issues/2182",
  },
  {
    fault: "sample at the pixel corner",
    variant: "",
    vector: "perspective-floor",
    others: [
      "half-texel shift",
      "wrong fill rule",
      "vertices snapped to fewer bits",
      "viewport scaled by a pixel ratio",
      "affine instead of perspective interpolation",
    ],
    story:
      "Programs for Direct3D 8 and 9 shift their pictures by half a pixel to meet the pixel centres; later versions " +
      "need no shift. d3d8to11, which translates one to the other, does not compensate for it (reported in 2025).",
    source: "https://github.com/michael-fadely/d3d8to11/issues/25",
  },
  {
    fault: "sRGB encoding",
    variant: "target encoded",
    vector: "layout-r8g8b8a8",
    others: ["dithering", "premultiplied alpha", "alpha forced to opaque", "wrap instead of clamp", "byte order"],
    story:
      "The GPU picking example of three.js writes an object's number as a colour. When colour management came, the " +
      "numbers were encoded as sRGB colours and picking broke (fixed in 2023).",
    source: "https://github.com/mrdoob/three.js/pull/25952",
  },
  {
    fault: "padded rows",
    variant: "index maps to 4 bytes, pixels of 3, read",
    vector: "unaligned-clamped-add",
    others: [
      "index map transposed",
      "width and height of the index map exchanged",
      "repeat instead of clamp",
      "linear filtering",
      "half-texel shift",
    ],
    story:
      "OpenGL reads the rows of a texture from addresses that are multiples of 4 bytes, unless UNPACK_ALIGNMENT says " +
      "otherwise. Moai did not set it: textures of some widths were distorted (2012).",
    source: "https://github.com/moai/moai-dev/issues/601",
  },
  {
    fault: "16-bit depth",
    variant: "",
    vector: "depth-range",
    others: [
      "depth test off",
      "depth test reversed",
      "equal depths pass the depth test",
      "depth not cleared between faces",
      "triangles missing",
    ],
    story:
      "OpenTK changed its default depth buffer from 24 to 16 bits. A program then had Z-fighting on some laptops: of " +
      "surfaces that are close to each other, the wrong one shows (reported in 2018).",
    source: "https://github.com/opentk/opentk/issues/780",
  },
  {
    fault: "multisampling",
    variant: "",
    vector: "crossing",
    others: ["linear filtering", "dithering", "wrong fill rule", "sample at the pixel corner", "blending left on"],
    story:
      "dune3d draws the numbers of what can be selected into a picture. On macOS it was drawn with several samples " +
      "per pixel: at edges, averages of two numbers selected a third thing (2024).",
    source: "https://github.com/dune3d/dune3d/pull/79",
  },
  {
    fault: "blending left on",
    variant: "",
    vector: "layout-r8g8b8a8",
    others: ["premultiplied alpha", "modulate instead of add", "background not cleared", "sRGB encoding", "dithering"],
    story:
      "A sample of Cinder draws the numbers of objects as colours, for picking. Blending is on by default there, and " +
      "changed the numbers (fixed in 2015).",
    source: "https://github.com/cinder/Cinder/issues/1049",
  },
  {
    fault: "channels swapped in the target (BGRA)",
    variant: "",
    vector: "layout-r8g8b8a8",
    others: [
      "channels swapped in the texture (BGRA)",
      "channels swapped in the offset (BGRA)",
      "byte order",
      "alpha forced to opaque",
      "item IDs cut to fewer bits",
    ],
    story:
      "angrylion-rdp-plus, a renderer for emulators, passed its picture on as BGRA. On one machine red and blue came " +
      "out exchanged; a comment suspects the graphics driver (2018).",
    source: "https://github.com/ata4/angrylion-rdp-plus/issues/77",
  },
  {
    fault: "colour from the wrong provoking vertex",
    variant: "",
    vector: "shared-vertices",
    others: [
      "indices cut to fewer bits",
      "depth test reversed",
      "equal depths pass the depth test",
      "wrong fill rule",
      "front and back exchanged",
    ],
    story:
      "A flat triangle takes the colour of one of its corners. PPSSPP's software renderer reversed corners to cull, " +
      "and so took the colour of another one (fixed in 2018).",
    source: "https://github.com/hrydgard/ppsspp/pull/11577",
  },
];
