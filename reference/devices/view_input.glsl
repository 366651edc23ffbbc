// The view of the vertex and of the fragment shader.

#ifdef VULKAN
#define vertexNumber gl_VertexIndex
layout(push_constant) uniform Views {
#else
#define vertexNumber gl_VertexID
layout(std140, binding = 0) uniform Views {
#endif
  View view;
};

const int maxVertices = 6;  // of a clipped triangle: each plane adds at most one
