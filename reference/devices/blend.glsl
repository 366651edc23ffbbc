// docs/item-buffers.md, "blend".

uint clampedAdd(uint a, uint b) {
  uint sum = 0;
  int low = 0;
  for (uint ends = view.channelEnds; ends != 0; ends &= ends - 1) {
    int bits = findLSB(ends) + 1 - low;
    uint largest = bitfieldExtract(~0u, low, bits);
    uint y = bitfieldExtract(b, low, bits);
    sum |= y + min(bitfieldExtract(a, low, bits), largest - y) << low;
    low += bits;
  }
  return sum;
}

uint blended(uint offset, uint texel) {
  if (view.blend == 0) return clampedAdd(offset, texel);
  if (view.blend == 1) return offset + texel & ~0u >> 31 - findMSB(view.channelEnds);
  return texel;
}

