// What the shaders of sums share: the twin of vulkan_sums.cpp. Stands in front of the text of each.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
#ifdef ADDS_INT64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#define Sum uint64_t
#else
#define Sum uvec2  // the low word first
#endif

struct Face {
  uint width, height;
  uint weights;  // the first of its table
  uint view;
};

struct Block {
  uint count, first, table;
};

layout(binding = 0) uniform utexture2DArray ids;  // a layer per face
layout(std430, binding = 1) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 2) readonly buffer Weights { Sum weights[]; };
layout(std430, binding = 3) readonly buffer Blocks { Block blocks[]; };
layout(std430, binding = 4) readonly buffer Slots { uint slots[]; };
#ifdef ADDS_INT64
layout(std430, binding = 5) buffer Sums { uint64_t sums[]; };  // of the slots of each view, 0 between views
#else
layout(std430, binding = 5) buffer Sums { uint sums[]; };
#endif
layout(std430, binding = 6) buffer Touched { uint touched[]; };  // a bit per slot: its sum is not 0
layout(std430, binding = 7) buffer Lists {
  uint listed;  // in all views
  uint unused;
  uvec2 lists[];  // first and number of the listed sums of each view
};
layout(std430, binding = 8) buffer ListedSlots { uint listedSlots[]; };
layout(std430, binding = 9) buffer ListedSums { Sum listedSums[]; };

layout(push_constant) uniform Table {
  uint bits;
  uint blockCount;
  uint backId;
  uint back;
  uint words;  // of touched, per view
};
