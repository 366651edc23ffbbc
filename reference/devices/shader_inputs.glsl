// The inputs of all shaders that draw: the twins of shader_inputs.h. Stands in front of the text of each.
#version 450

struct Corner {
  float x, y, z;  // in clip space x, y, w
  float clipZ;
  float u, v;
  uint draw;
  uint number;
};

struct Draw {
  uint offset;
  uint back;
  uint hasBack;
  uint firstTexel;
  int width, height;
  int cull;  // raster::Cull
};

layout(std430, binding = 0) readonly buffer Corners { Corner corners[]; };
layout(std430, binding = 1) readonly buffer Draws { Draw draws[]; };
layout(std430, binding = 2) readonly buffer Texels { uint texels[]; };

struct View {
  vec3 eye;
  float near;
  vec3 x;
  float sampleOffset;
  vec3 y;
  uint channelEnds;
  vec3 w;
  int blend;  // raster::Blend
  vec2 scissor;
  vec2 size;
  vec2 viewport;
  int value;      // raster::PixelValue
  int clipDepth;  // raster::ClipDepth
  float depthScale;
  float depthOffset;
};
