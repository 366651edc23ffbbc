// The first steps: how much of a lamp's light arrives at a small part of a wall.
import {status} from "../controls";
import {
  border,
  drawing,
  factorFromPoint,
  label,
  line,
  polygon,
  polyline,
  seen,
  type Point2,
  type Point3,
} from "./drawing";
import type {Step} from "./step";
import {addHandle} from "./handle";

const rays = 'stroke="var(--lamp)" stroke-width="1"';
const surface = 'stroke="var(--text)" stroke-width="4" stroke-linecap="round"';

export const lamp: Step = {
  name: "lamp",
  title: "A lamp and a wall",
  text: `A small lamp shines on a wall. Look at one small part of the wall, an <em>element</em>. Move it away: the light
    of the lamp spreads over a larger area, and the element gets less of it. At twice the distance the same light covers
    twice the height and twice the width. So the element gets a quarter. To light a room, we must know for each pair of
    surfaces which share of the light of one arrives at the other.`,
  paper: "known before it",
  source: "docs/light.md",
  figure(root, page) {
    const show = drawing(root, "A lamp, and an element of a wall that moves away", 400, 200);
    const found = status(root, "lamp-share");
    const draw = (distance: number) => {
      const x = 30 + 85 * distance,
        half = 20; // the cone covers the element at distance 1
      const coneAt = (to: number): Point2[] => [
        [to, 100 - (half * (to - 30)) / 85],
        [to, 100 + (half * (to - 30)) / 85],
      ];
      const [top, bottom] = coneAt(x);
      show(
        polygon([[30, 100], ...coneAt(390)], 'fill="var(--lamp)" opacity="0.2"') +
          polygon([[30, 100], top, bottom], 'fill="var(--lamp)" opacity="0.4"') +
          line(top, bottom, 'stroke="var(--quiet)" stroke-width="2"') +
          line([x, 100 - half], [x, 100 + half], surface) +
          `<circle cx="30" cy="100" r="8" fill="var(--lamp)"/>` +
          label([Math.min(x + 8, 350), 104], `d = ${distance.toFixed(1)}`, 'font-size="14"'),
      );
      const height = distance.toFixed(1);
      found.set(`The light covers ${height} × ${height} elements: each gets ${(1 / distance ** 2).toFixed(3)} of it.`);
    };
    addHandle(
      root,
      page,
      "lamp",
      {label: "Distance of the wall", range: {min: 1, max: 4, step: 0.1}, otherwise: 1.5, show: (d) => d.toFixed(1)},
      draw,
    );
  },
  question(draw) {
    const times = draw(3, 9);
    return {
      text: `The element moves to ${times} times the distance. By what number is its light divided?`,
      answer: () => times ** 2,
      tolerance: 0,
      why: `The light of the same cone covers ${times} times the height and ${times} times the width.`,
      whyNot: (value) =>
        value === times
          ? "That is how much longer the cone is. Its light spreads in two directions: up and to the side."
          : value === times ** 3
            ? "Light crosses an area, not a volume: count height and width."
            : undefined,
    };
  },
};

export const cosine: Step = {
  name: "cosine",
  title: "The cosine",
  text: `Turn the element. Fewer rays meet it, because it hides less of the beam: its height across the beam is its
    length times cos θ, where θ is the angle between the beam and the <em>normal</em>, which stands upright on the
    surface. A matt lamp has a cosine too: seen from the side, its surface looks smaller. Both cosines and the squared
    distance give the share of the light of a point that reaches a small area dA:
    <math display="block"><mi>dF</mi><mo>=</mo><mi>cos</mi><msub><mi>θ</mi><mn>1</mn></msub>
    <mi>cos</mi><msub><mi>θ</mi><mn>2</mn></msub><mi>dA</mi><mo>/</mo><mo stretchy="false">(</mo><mi>π</mi>
    <msup><mi>d</mi><mn>2</mn></msup><mo stretchy="false">)</mo></math>`,
  paper: "known before it",
  source: "reference/truth/closed_forms/README.md",
  figure(root, page) {
    const show = drawing(root, "A beam of parallel rays meets an element that turns", 400, 200);
    const found = status(root, "cosine-share");
    const draw = (degrees: number) => {
      const angle = (degrees * Math.PI) / 180,
        half = 70;
      const [dx, dy] = [half * Math.sin(angle), half * Math.cos(angle)];
      const beam = Array.from({length: 19}, (_, k) => {
        const y = 10 + 10 * k,
          isMet = Math.abs(y - 100) <= dy;
        const end = isMet ? 260 + (dx * (y - 100)) / Math.max(dy, 1e-9) : 390;
        return line([10, y], [end, y], `${rays} opacity="${isMet ? 1 : 0.25}"`);
      });
      show(
        beam.join("") +
          line([260 - dx, 100 - dy], [260 + dx, 100 + dy], surface) +
          line(
            [260, 100],
            [260 - 60 * Math.cos(angle), 100 + 60 * Math.sin(angle)],
            'stroke="var(--accent)" stroke-width="2"',
          ) +
          label([268, 96], `θ = ${degrees}°`, 'font-size="14"'),
      );
      found.set(`cos ${degrees}° = ${Math.cos(angle).toFixed(3)}: this share of the light that it gets upright.`);
    };
    addHandle(
      root,
      page,
      "cosine",
      {label: "Angle θ", range: {min: 0, max: 90, step: 1}, otherwise: 40, show: (d) => `${d}°`},
      draw,
    );
  },
  question(draw) {
    const distance = draw(2, 4);
    return {
      text: `An element is turned by 60° and moves to ${distance} times the distance. Which share of its light is left?`,
      answer: () => 0.5 / distance ** 2,
      tolerance: 0.0011,
      why: `cos 60° = 1/2, and the distance divides by ${distance}² = ${distance ** 2}.`,
      whyNot: (value) =>
        Math.abs(value - 0.5) < 0.001
          ? "That is the cosine. What does the distance do?"
          : Math.abs(value - 1 / distance ** 2) < 0.001
            ? "That is the distance. What does the turn do?"
            : Math.abs(value - 0.5 / distance) < 0.001
              ? "The light falls with the square of the distance."
              : undefined,
    };
  },
};

/** A square of side 1 at height 1, its centre at x. */
function squareAt(x: number): Point3[] {
  return [
    [x - 0.5, -0.5, 1],
    [x + 0.5, -0.5, 1],
    [x + 0.5, 0.5, 1],
    [x - 0.5, 0.5, 1],
  ];
}

function onHemisphere(point: Point3): Point3 {
  const length = Math.hypot(...point);
  return point.map((value) => value / length) as Point3;
}

function circle(of: (angle: number) => Point3, from: number, to: number): Point3[] {
  return Array.from({length: 49}, (_, k) => of(from + ((to - from) * k) / 48));
}

function nusseltDrawing(x: number): string {
  const place = (points: Point3[]) => points.map((point) => seen(point, [190, 205], 95));
  const square = border(squareAt(x), 16),
    image = square.map(onHemisphere);
  const shadow = image.map(([a, b]): Point3 => [a, b, 0]);
  const thin = 'stroke="var(--quiet)" stroke-width="1"';
  const disc = circle((t) => [Math.cos(t), Math.sin(t), 0], 0, 2 * Math.PI);
  const arcs = [0, Math.PI / 2].map((turn) =>
    circle((t) => [Math.cos(t) * Math.cos(turn), Math.cos(t) * Math.sin(turn), Math.sin(t)], 0, Math.PI),
  );
  const threads = squareAt(x).map((corner) => {
    const [a, b, c] = onHemisphere(corner);
    const [far, near, down] = place([corner, [a, b, c], [a, b, 0]]);
    return line([190, 205], far, `${thin} opacity="0.6"`) + line(near, down, `${thin} stroke-dasharray="3 3"`);
  });
  return (
    polygon(place(disc), `fill="var(--panel)" ${thin}`) +
    arcs.map((arc) => polyline(place(arc), thin)).join("") +
    polygon(place(shadow), 'fill="var(--accent)"') +
    threads.join("") +
    polygon(place(image), 'fill="var(--lamp)" opacity="0.7"') +
    polygon(place(square), 'fill="var(--lamp)" opacity="0.9" stroke="var(--text)"') +
    `<circle cx="190" cy="205" r="4" fill="var(--text)"/>`
  );
}

export const nusselt: Step = {
  name: "nusselt",
  title: "The share of light that arrives",
  text: `A matt surface sends its light into the whole half space above it. The share that arrives at another surface is
    the <em>form factor</em> F. Nusselt (1928) found how to see it: project the surface onto a hemisphere of radius 1,
    then straight down onto the disc. The first projection does what distance and tilt of the receiver do; the second
    one is the cosine at the sender. F is the share of the disc that is covered. What looks the same from the point, has
    the same form factor.`,
  paper: "known before it (Nusselt 1928)",
  source: "docs/accuracy.md",
  figure(root, page) {
    const show = drawing(root, "A square, its image on the hemisphere, and the area below it on the disc", 400, 240);
    const found = status(root, "nusselt-share");
    const draw = (x: number) => {
      show(nusseltDrawing(x));
      found.set(`The blue area is F = ${factorFromPoint([0, 0, 0], squareAt(x)).toFixed(4)} of the disc.`);
    };
    addHandle(
      root,
      page,
      "nusselt",
      {
        label: "Place of the square",
        range: {min: -1.5, max: 1.5, step: 0.05},
        otherwise: 0.3,
        show: (x) => x.toFixed(2),
      },
      draw,
    );
  },
  question(draw) {
    const degrees = [30, 45, 60][draw(0, 2)];
    const share = {30: 0.25, 45: 0.5, 60: 0.75}[degrees]!;
    return {
      text: `A round lamp lies around the axis, and its rim is seen ${degrees}° from the axis. What is F?`,
      answer: () => share,
      tolerance: 0.006,
      why: `Its image on the disc is a disc of radius sin ${degrees}°: F = sin² ${degrees}° = ${share}.`,
      whyNot: (value) =>
        Math.abs(value - Math.sqrt(share)) < 0.01
          ? `sin ${degrees}° is the radius of the blue disc. F is a share of areas.`
          : Math.abs(value - (1 - Math.cos((degrees * Math.PI) / 180))) < 0.01
            ? "That is the share of the hemisphere. The cosine at the sender is missing: project down to the disc."
            : undefined,
    };
  },
};
