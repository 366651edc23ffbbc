// Pixels and form factors by texture and by mesh against hemitex formfactors, triangles, and the measured times.
import {readFileSync} from "node:fs";

const scene = new URL("../../../data/cornell-box.obj", import.meta.url);

export default async function check(page, {close, equal, ok, value, until, open, address, answers, formFactors}) {
  await open("power=3&resolution=128");
  await until(async () => (await value("differences")) !== "", "the pictures are drawn");
  const [different, all] = (await value("differences")).match(/(\d+) of (\d+) pixels/).slice(1).map(Number);
  equal(all, 3 * 128 * 128, "pixels of the five faces");
  ok(different < all / 100, `${different} pixels differ`);
  const row = ["--texels", "8", "--from", "floor:4,4", "--resolution", "128", "--orientation", "aligned"];
  const [texture, mesh] = ["texture", "mesh"].map((way) => formFactors(...row, "--discretize", way));
  const sum = texture.reduce((total, factor, e) => total + Math.abs(factor - mesh[e]), 0);
  close(Number((await value("differences")).match(/by ([\d.]+) in all/)[1]), sum, 1e-6, "difference of form factors");

  await until(async () => (await value("measurement")).startsWith("The fastest"), "all is measured");
  const triangles = async () =>
    (await value("triangles")).match(/(\d+) elements: (\d+) triangles by texture, (\d+) by mesh/).slice(1).map(Number);
  const faces = readFileSync(scene, "utf8").match(/^f .*/gm);
  const ofScene = faces.reduce((triangles, face) => triangles + face.split(" ").length - 3, 0);
  const [few, byTexture, byMesh] = await triangles();
  equal(byTexture, ofScene, "triangles by texture");
  ok(byMesh >= 2 * few, "triangles by mesh");
  await page.getByRole("slider").focus();
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowRight");
  await until(async () => (await triangles())[0] > 200 * few, "128 x 128 elements per surface");
  const [many, stillByTexture, manyByMesh] = await triangles();
  equal(stillByTexture, ofScene, "triangles by texture of many elements");
  ok(manyByMesh >= 2 * many, "triangles by mesh of many elements");
  const ratio = Number((await value("times")).match(/([\d.e+]+) times/)[1]);
  console.log(`     ${many} elements: ${await value("times")}`);
  ok(ratio > 5, `the mesh takes ${ratio} times as long`);
  await until(async () => (await address()).includes("power=7"), "the number of elements is in the address");

  await answers([[2 * 1024 * 1024, "Not yet"], [ofScene, "Right"]]);
}
