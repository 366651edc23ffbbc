// Lists the slots of a view whose sums are not 0, in ascending order, with their sums; then sets these to 0. One
// workgroup per view: each invocation lists a part of the slots, behind those of the invocations before it.

layout(local_size_x = 256) in;
shared uint ends[256];  // of the parts, in the list of the view
shared uint first;      // of the list

void main() {
  uint view = gl_WorkGroupID.x, part = gl_LocalInvocationIndex;
  uint perPart = (words + 255) / 256, begin = min(part * perPart, words), end = min(begin + perPart, words);
  uint count = 0;
  for (uint w = begin; w < end; ++w) count += bitCount(touched[view * words + w]);
  ends[part] = count;
  for (uint step = 1; step < 256; step *= 2) {
    barrier();
    uint more = part >= step ? ends[part - step] : 0;
    barrier();
    ends[part] += more;
  }
  if (part == 255) {
    first = atomicAdd(listed, ends[part]);
    lists[view] = uvec2(first, ends[part]);
  }
  barrier();
  uint place = first + ends[part] - count;
  for (uint w = begin; w < end; ++w) {
    for (uint bits = touched[view * words + w]; bits != 0; bits &= bits - 1) {
      uint slot = 32 * w + uint(findLSB(bits)), sum = view * (back + 2) + slot;
      listedSlots[place] = slot;
      listedSums[place++] = uvec2(sums[2 * sum], sums[2 * sum + 1]);
      sums[2 * sum] = sums[2 * sum + 1] = 0;
    }
    touched[view * words + w] = 0;
  }
}
