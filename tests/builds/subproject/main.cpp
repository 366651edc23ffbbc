/// Draws one triangle with the rasterizer of the hemitex inside this project; returns 0 if the item IDs are right.
#include "../one_triangle.h"

int main() { return isRight(drawTriangle()) ? 0 : 1; }
