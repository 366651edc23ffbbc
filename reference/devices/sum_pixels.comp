// Adds the pixels of faces to the sums of their slots. An invocation takes some pixels of a row, and adds a run of
// equal item IDs at once: the difference of two running sums of weights.

layout(local_size_x = 4, local_size_y = 16) in;
const uint pixelsAtOnce = 32;

uint slotOf(uint id) {
  uint number = id >> bits, index = id - (number << bits), background = back + 1;
  uint other = id == backId ? back : background;
  if (number >= blockCount) return other;
  Block block = blocks[number];
  if (index >= block.count) return other;
  return block.table == ~0u ? block.first + index : min(slots[block.table + index], background);
}

// Adds to a sum. The first addend finds 0 there, because all sums of a view are below 2^63.
void add(uint view, uint slot, Sum from, Sum to) {
  uint place = view * (back + 2) + slot;
#ifdef ADDS_INT64
  if (from == to) return;
  bool mayBeFirst = atomicAdd(sums[place], to - from) == 0;
#else
  if (from == to) return;
  uint low = to.x - from.x, high = to.y - from.y - uint(to.x < from.x);
  uint old = atomicAdd(sums[2 * place], low);
  high += uint(old + low < old);
  if (high != 0) atomicAdd(sums[2 * place + 1], high);
  bool mayBeFirst = old == 0;
#endif
  if (mayBeFirst) atomicOr(touched[view * words + slot / 32], 1u << slot % 32);
}

void main() {
  uint layer = gl_GlobalInvocationID.z;
  Face face = faces[layer];
  int row = int(gl_GlobalInvocationID.y), first = int(gl_GlobalInvocationID.x * pixelsAtOnce);
  if (row >= int(face.height) || first >= int(face.width)) return;
  int end = min(first + int(pixelsAtOnce), int(face.width));
  uint before = face.weights + uint(row) * face.width;
  uint id = texelFetch(ids, ivec3(first, row, layer), 0).x;
  for (int column = first + 1; column < end; ++column) {
    uint next = texelFetch(ids, ivec3(column, row, layer), 0).x;
    if (next == id) continue;
    add(face.view, slotOf(id), weights[before + first], weights[before + column]);
    first = column;
    id = next;
  }
  add(face.view, slotOf(id), weights[before + first], weights[before + end]);
}
