// Sums, and numbers in words.

export function sum(values: Iterable<number>): number {
  let total = 0;
  for (const value of values) total += value;
  return total;
}

/** The largest absolute value; 0 if there is none. */
export function largestSize(values: Iterable<number>): number {
  let largest = 0;
  for (const value of values) largest = Math.max(largest, Math.abs(value));
  return largest;
}

/** Three significant digits, also of thousands. */
export function shortNumber(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/** "1 pixel", "2 pixels" */
export function plural(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}
