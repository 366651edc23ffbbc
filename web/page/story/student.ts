// Numbers that are drawn for each student from a name in the address, so that neighbours get different ones.

/** A whole number from `low` to `high`. */
export type Draw = (low: number, high: number) => number;

/** FNV-1a of the characters (Fowler, Noll and Vo 1991). */
function hash(name: string): number {
  let value = 0x811c9dc5;
  for (const character of name) value = Math.imul(value ^ character.codePointAt(0)!, 0x01000193);
  return value >>> 0;
}

/** The numbers of a question: always the same for the same student. Mulberry32, a generator of 32 bits of state. */
export function numbersOf(student: string, question: string): Draw {
  let state = hash(`${student}/${question}`);
  return (low, high) => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return low + (((mixed ^ (mixed >>> 14)) >>> 0) % (high - low + 1));
  };
}
