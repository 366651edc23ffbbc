// Sums of two doubles that are not rounded to one: sums and products of doubles without error (Knuth 1997, 4.2.2; Dekker
// 1971), and of pairs with relative errors of at most 2^-100 of their largest part.

struct Pair {
  double high, low;  // |low| is at most half of the last bit of high
};

Pair sum(double a, double b) {
  precise double s = a + b, t = s - a;
  precise double low = (a - (s - t)) + (b - t);
  return Pair(s, low);
}

// The upper half of the bits.
double upper(double a) {
  precise double c = 134217729.0LF * a;  // 2^27 + 1
  precise double high = c - (c - a);
  return high;
}

Pair product(double a, double b) {
  precise double p = a * b, aHigh = upper(a), bHigh = upper(b), aLow = a - aHigh, bLow = b - bHigh;
  precise double low = ((aHigh * bHigh - p) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  return Pair(p, low);
}

Pair add(Pair a, Pair b) {
  Pair high = sum(a.high, b.high), low = sum(a.low, b.low);
  precise double rest = high.low + low.high;
  Pair total = sum(high.high, rest);
  precise double last = total.low + low.low;
  return sum(total.high, last);
}

Pair times(Pair a, double b) {
  Pair p = product(a.high, b);
  precise double low = p.low + a.low * b;
  return sum(p.high, low);
}

Pair times(Pair a, Pair b) {
  Pair p = product(a.high, b.high);
  precise double low = p.low + (a.high * b.low + a.low * b.high);
  return sum(p.high, low);
}
