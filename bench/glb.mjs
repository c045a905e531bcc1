// Reads shape.glb and pca.glb by gltf-transform, and compares them with shape.json and pca.json; see glb.R.
import { NodeIO } from "@gltf-transform/core";
import fs from "fs";

const most = 1e-5;  // greatest difference, as a share of the greatest co-ordinate

function worst(found, wanted) {
  const flat = wanted.flat();
  if (flat.length !== found.length) return Infinity;
  return Math.max(...flat.map((v, i) => Math.abs(v - found[i]))) / Math.max(...flat.map(Math.abs));
}

function told(what, value, right) {
  console.log(what, value);
  if (!right) process.exitCode = 1;
}

const io = new NodeIO();
let own = JSON.parse(fs.readFileSync("shape.json"));
let meshes = (await io.read("shape.glb")).getRoot().listMeshes();
let part = meshes[0].listPrimitives()[0];
let off = worst(part.getAttribute("POSITION").getArray(), own.model);
told("shape.glb: positions off by a share of", off, off <= most);
const same = Array.from(part.getIndices().getArray()).join() === own.it.flat().join();
told("triangles are equal:", same, same);
const named = own.curves.every(name => meshes.some(mesh => mesh.getName() === name));
told(`${meshes.length - 1} tubes, ${own.curves.length} curves, named alike:`, named, named);
own = JSON.parse(fs.readFileSync("pca.json"));
meshes = (await io.read("pca.glb")).getRoot().listMeshes();
part = meshes[0].listPrimitives()[0];
const mean = part.getAttribute("POSITION").getArray();
off = worst(mean, own.mean);
told("pca.glb: mean off by", off, off <= most);
told("morph targets:", meshes[0].getExtras().targetNames, part.listTargets().length === own.ends.length);
part.listTargets().forEach((target, i) => {
  const by = target.getAttribute("POSITION").getArray();
  const away = worst(Array.from(mean, (v, j) => v + by[j]), own.ends[i]);
  told(`target ${i + 1} off by`, away, away <= most);
});
