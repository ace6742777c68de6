// The geometry and mechanics of the pictures, without a browser: identities, closed forms, and the program's own reports.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import * as so3 from "../page/explore/rotations.js";
import { advance, between, inBody, inSpace, weight } from "../page/explore/mechanics.js";
import { loop } from "../page/explore/holonomy.js";
import { parallelogram } from "../page/explore/torsion.js";
import { geodesic } from "../page/explore/geodesics.js";
import { level, film as bookFilm } from "../page/explore/book.js";
import { MOMENTS } from "../page/explore/solids.js";
import { screw, twist } from "../page/explore/screw.js";
import { fraction, turned } from "../page/explore/parallel.js";

const COMMAND = process.env.AFFINOR_COMMAND;
const needsCommand = { skip: !COMMAND && "AFFINOR_COMMAND names no program" };
const affinor = (...words) => execFileSync(COMMAND, words, { encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
/** Rows of numbers of a table. */
const rows = (csv) => csv.trim().split("\n").slice(1).map((line) => line.split(",").map(Number));

let seed = 1;
/** A number between -1 and 1. */
const random = () => (seed = seed * 48271 % 2147483647) / 1073741823.5 - 1;
const vector = (size = 1) => [size * random(), size * random(), size * random()];
const near = (a, b, bound, words = "") => a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) <= bound, `${words} ${a} is not ${b}`));
/** A positive symmetric matrix. */
const metric = () => {
  const rows = [vector(), vector(), vector()];
  return [0, 1, 2].map((i) => [0, 1, 2].map((j) => so3.dot(rows[i], rows[j]) + (i === j ? 0.5 : 0)));
};

test("exp and log are inverse, and the matrix is a homomorphism", () => {
  for (let k = 0; k < 100; k++) {
    const [x, y] = [vector(1.8), vector(1e-5 ** (k % 2))];
    near(so3.log(so3.exp(x)), x, 1e-13);
    near(so3.log(so3.exp(y)), y, 1e-13);
    const [a, b] = [so3.exp(x), so3.exp(y)], v = vector();
    near(so3.apply(so3.matrix(so3.compose(a, b)), v), so3.apply(so3.matrix(a), so3.apply(so3.matrix(b), v)), 1e-14);
  }
});

test("the tangent of a rotation vector is the difference quotient along a left-invariant field", () => {
  for (const size of [1.7, 1, 1e-2, 1e-4]) {
    for (let k = 0; k < 30; k++) {
      const [x, u, h] = [vector(size), vector(), 1e-5];
      const at = (s) => so3.log(so3.compose(so3.exp(x), so3.exp(so3.scale(u, s))));
      near(so3.tangent(x, u), so3.scale(so3.add(at(h), at(-h), -1), 1 / (2 * h)), 1e-8);
    }
  }
});

test("plus is right translation, minus left translation, and zero the square roots of both", () => {
  for (let k = 0; k < 50; k++) {
    const [x, u] = [vector(2), vector()];
    near(so3.carry(so3.family(0), x, u), u, 0);
    near(so3.carry(so3.family(1), x, u), inBody(so3.exp(x), u), 1e-12);
    near(so3.carry(so3.family(0.5), x, u), inBody(so3.exp(so3.scale(x, 0.5)), u), 1e-12);
  }
});

test("the Levi-Civita connection preserves its metric, has no torsion, and is zero for the bi-invariant metric", () => {
  for (let k = 0; k < 50; k++) {
    const J = metric(), by = so3.leviCivita(J), [x, y, u] = [vector(2), vector(), vector()];
    const length = (v) => so3.dot(v, so3.apply(J, v));
    assert.ok(Math.abs(length(so3.carry(by, x, u)) - length(u)) < 1e-10 * length(u));
    near(so3.add(so3.apply(by(x), y), so3.apply(by(y), x), -1), so3.cross(x, y), 1e-11);
    const once = so3.leviCivita([[2, 0, 0], [0, 2, 0], [0, 0, 2]])(x);
    once.forEach((row, i) => near(row, so3.family(0.5)(x)[i], 1e-14));
  }
});

test("transport agrees with the engine, by the canonical connections and by metrics that are not diagonal", needsCommand, () => {
  for (let k = 0; k < 12; k++) {
    const J = metric(), u = vector(), arcs = [vector(1.5), vector(1.5), vector(1.5)];
    const text = `[${J.map((row) => `[${row.map((x) => x.toFixed(17)).join(",")}]`).join(",")}]`;
    for (const [name, connection] of [["plus", so3.family(1)], ["zero", so3.family(0.5)], ["minus", so3.family(0)], ["lambda=1/3", so3.family(1 / 3)], ["levi-civita", so3.leviCivita(J)]]) {
      const words = ["transport", "so3", ...arcs.flatMap((x) => ["--along", x.map((part) => part.toFixed(17)).join(",")]), "--connection", name, "--format", "csv"];
      const [expected] = rows(affinor(...words, ...(name === "levi-civita" ? ["--metric", text] : []), `--`, u.map((part) => part.toFixed(17)).join(" ")));
      near(arcs.reduce((v, x) => so3.carry(connection, x, v), u), expected, 1e-9, name);
    }
  }
});

test("a path goes through its points, and its vectors are carried arc by arc", () => {
  for (let k = 0; k < 30; k++) {
    const [p, q, u] = [vector(1.7), vector(1.7), vector()], path = new so3.Path([[0, 0, 0], p, q, [0, 0, 0]]);
    near(path.point(path.lengths[0] / path.length), p, 1e-12);
    near(path.point((path.lengths[0] + path.lengths[1]) / path.length), q, 1e-12);
    near(path.point(1), [0, 0, 0], 1e-12);
    const by = so3.family(0.3);
    near(path.carried(by, u, 1), path.arcs.reduce((v, x) => so3.carry(by, x, v), u), 1e-12);
    // the flat connections return the vector
    for (const lambda of [0, 1]) near(path.carried(so3.family(lambda), u, 1), u, 1e-12);
  }
});

test("the turn of a loop is a quarter of its area, for any loop and size", () => {
  for (let k = 0; k < 40; k++) {
    const { area, turn } = loop(0.2 + 0.8 * Math.abs(random()), vector(1.6));
    assert.ok(Math.abs(turn - area / 4) < 2e-4 * (0.01 + area), `${turn} ${area / 4}`);
  }
});

test("the gap of small parallelograms is s^2 (2 lambda - 1) [x, y]", () => {
  for (let k = 0; k <= 24; k++) {
    const s = 1e-3, { gap } = parallelogram(k / 24, s);
    near(so3.scale(gap, 1 / s ** 2), [0, 0, 2 * k / 24 - 1], 2e-3);
  }
});

test("geodesics of the round metric are straight, and all have their Levi-Civita acceleration zero", () => {
  const way = [0.6, 0, 0.8];
  for (const x of geodesic(1, way)) near(so3.cross(x, way), [0, 0, 0], 1e-9);
  for (const third of [0.3, 2.2]) {
    const J = [[1, 0, 0], [0, 1, 0], [0, 0, third]], by = so3.leviCivita(J), points = geodesic(third, way).map(so3.exp), h = Math.PI / 90;
    const w = points.slice(1).map((g, k) => so3.scale(so3.log(so3.compose(so3.inverse(points[k]), g)), 1 / h));
    for (let k = 1; k < w.length; k++) {
      const mean = so3.scale(so3.add(w[k], w[k - 1]), 0.5);
      near(so3.add(so3.scale(so3.add(w[k], w[k - 1], -1), 1 / h), so3.apply(by(mean), mean)), [0, 0, 0], 2e-3);
    }
  }
});

test("a free body keeps its energy and its momentum in space", () => {
  let motion = { g: so3.exp([0.3, 0, 0.2]), w: [0.1, 2, 0.1] };
  const J = [0.6, 1, 1.5], momentum = ({ g, w }) => inSpace(g, w.map((x, i) => J[i] * x)), energy = ({ w }) => w.reduce((sum, x, i) => sum + J[i] * x * x, 0);
  const [h, e] = [momentum(motion), energy(motion)];
  motion = advance({ J }, motion, 30);
  near(momentum(motion), h, 1e-7);
  assert.ok(Math.abs(energy(motion) - e) < 1e-7);
});

test("motions agree with the engine: a free body and a heavy top", needsCommand, () => {
  const load = 1.4, J = [1, 1.3, 0.5], w = [0.5, -0.2, 5];
  for (const torque of [undefined, weight(load)]) {
    const file = path.join(os.tmpdir(), `affinor-${process.pid}.toml`);
    fs.writeFileSync(file, `space = "so3"\nmetric = "diag(1, 1.3, 0.5)"\n[initial]\nelement = [[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]]\nvelocity = [0.5, -0.2, 5]\n${torque ? `[forces]\npotential = "${load}*R33"\n` : ""}[integrator]\nmethod = "rkmk4"\nstep = 0.0005\n[output]\nend = 3\nevery = 1\n`);
    const csv = affinor("simulate", file, "--format", "csv"), names = csv.split("\n")[0].split(","), last = rows(csv).at(-1);
    fs.rmSync(file);
    const value = (name) => last[names.indexOf(name)];
    const motion = advance({ J, torque }, { g: so3.exp([Math.atan2(0.6, 0.8), 0, 0]), w }, 3);
    near(motion.w, [1, 2, 3].map((i) => value(`Omega${i}`)), 1e-6);
    const g = ["qw", "qx", "qy", "qz"].map(value), sign = Math.sign(g.reduce((sum, x, i) => sum + x * motion.g[i], 0));
    near(motion.g, g.map((x) => sign * x), 1e-6);
  }
});

test("polhodes are curves of constant energy and momentum, and the film stays on its own", () => {
  const [a, b, d] = MOMENTS;
  for (const c of [a + 0.2 * (b - a), b, d - 0.4 * (d - b)]) {
    for (const line of level(c)) {
      for (const x of line) {
        assert.ok(Math.abs(so3.norm(x) - 1) < 1e-9);
        assert.ok(Math.abs(x.reduce((sum, part, i) => sum + MOMENTS[i] * part * part, 0) - c) < 1e-9);
      }
    }
  }
  const run = bookFilm(1), energy = (w) => w.reduce((sum, x, i) => sum + MOMENTS[i] * x * x, 0), first = energy(run.at(0).w);
  assert.ok(Math.abs(energy(run.at(20).w) - first) < 1e-7);
  // an earlier time begins anew, with the same motion
  const later = run.at(5).w;
  run.at(1);
  near(run.at(5).w, later, 1e-9);
});

test("a screw is the flow of its twist", () => {
  for (const pitch of [-0.1, 0, 0.15]) {
    const [omega, velocity] = twist(pitch), x = vector(), h = 1e-5, at = (theta) => screw(pitch, theta).place(x);
    for (const theta of [0, 1, 4]) {
      near(so3.scale(so3.add(at(theta + h), at(theta - h), -1), 1 / (2 * h)), so3.add(velocity, so3.cross(omega, at(theta))), 1e-8);
    }
  }
});

test("the shortest rotation takes one direction to the other", () => {
  for (let k = 0; k < 30; k++) {
    const [a, b] = [so3.unit(vector()), so3.unit(vector())];
    near(inSpace(between(a, b), a), b, 1e-12);
  }
  near(inSpace(between([0, 0, 1], [0, 0, -1]), [0, 0, 1]), [0, 0, -1], 1e-12);
});

test("lambda is a fraction in lowest terms, and only the ends return every vector unturned", () => {
  assert.deepEqual([0, 6, 8, 12, 16, 24].map(fraction), ["0", "1/4", "1/3", "1/2", "2/3", "1"]);
  for (let k = 0; k < 10; k++) {
    const p = vector(1.7);
    for (const lambda of [0, 1]) assert.ok(turned(p, lambda).turn < 1e-5);
    assert.ok(turned(p, 0.5).turn > 0.01);
  }
});

test("a step of transport on the three balls takes less than 10 ms of processor time", async () => {
  const { default: spec } = await import("../page/explore/parallel.js"), { start } = await import("../page/explore/stage.js"), { Camera } = await import("../page/explore/scene.js");
  const state = start(spec), camera = new Camera(), draw = (k) => { state.points.p = [2 * Math.sin(k), Math.cos(k), 0.5]; return spec.draw(state, camera, "x"); };
  for (let k = 0; k < 50; k++) draw(k);
  const before = process.cpuUsage();
  for (let k = 0; k < 100; k++) draw(k);
  const { user, system } = process.cpuUsage(before), each = (user + system) / 1000 / 100;
  console.log(`a step takes ${each.toFixed(2)} ms of processor time`);
  assert.ok(each < 10, String(each));
});
