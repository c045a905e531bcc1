# Files of write_glb() read back by other programs: gltf-transform in Node, three.js in Chromium.
#   Rscript bench/glb.R FOLDER
# FOLDER has node_modules with @gltf-transform/core and three (npm install there). Needs Node,
# Python, chromote and a Chromium or Chrome. Writes screenshots into FOLDER.
suppressPackageStartupMessages(library(crestline))
options(rgl.useNULL = TRUE, chromote.headless = "new")
folder <- normalizePath(commandArgs(TRUE)[1])
reader <- normalizePath("bench/glb.mjs")
at <- function(name) file.path(folder, name)
json <- function(x, name) jsonlite::write_json(x, at(name), digits = NA)

# ---- A face with its curves, and two components of five stretched faces
data(humface, package = "Rvcg")
goal <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
face <- specimen(humface, goal, id = "humface")
shape <- fit_shape(face, settings = ridge_settings(error = FALSE), progress = FALSE)
model <- shape_mesh(shape)
xyz <- t(model$vb[1:3, ])
write_glb(shape, at("shape.glb"))
json(list(model = xyz, it = t(model$it) - 1,
          curves = names(Filter(Negate(is.null), shape$paths))), "shape.json")
by <- list(c(1, 1.1, 0.9), c(1.1, 1, 1), c(0.95, 1, 1.2), c(1, 0.9, 1), c(1.2, 1.1, 1))
faces <- simplify2array(lapply(by, function(b) sweep(xyz, 2, b, `*`)))
pca <- shape_pca(align(faces, "model", triangles = model$it))
write_glb(pca, at("pca.glb"), component = 1:2, sd = 2)
moved <- function(component, sd) t(shape_at(pca, component, sd, "mesh")$vb[1:3, ])
json(list(mean = moved(1, 0), ends = lapply(1:2, moved, 2)), "pca.json")

# ---- Node: it looks for its packages where its script is
file.copy(reader, at("glb.mjs"), overwrite = TRUE)
before <- setwd(folder)
status <- system2("node", "glb.mjs")
stopifnot(status == 0)

# ---- Chromium: a page of three.js, served on this machine only
port <- 8377
writeLines(sprintf('<!doctype html><meta charset="utf-8"><body style="margin:0">
<script type="importmap">
{"imports": {"three": "./node_modules/three/build/three.module.js"}}
</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "./node_modules/three/examples/jsm/loaders/GLTFLoader.js";
const asked = new URLSearchParams(location.search), drawer = new THREE.WebGLRenderer();
drawer.setSize(700, 600);
document.body.appendChild(drawer.domElement);
new GLTFLoader().load(asked.get("file"), function (found) {
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(30, 7 / 6, 1e-6, 10);
  scene.background = new THREE.Color(0xffffff);
  scene.add(found.scene, new THREE.HemisphereLight(0xffffff, 0x888888, 3));
  found.scene.traverse(o => { if (o.morphTargetInfluences) o.morphTargetInfluences[0] = %s; });
  const box = new THREE.Box3().setFromObject(found.scene);
  const size = box.getSize(new THREE.Vector3()).length();
  const middle = box.getCenter(new THREE.Vector3());
  camera.position.set(middle.x + 0.4 * size, middle.y, middle.z + 1.6 * size);
  camera.lookAt(middle);
  drawer.render(scene, camera);
  window.shown = size;
}, undefined, error => { window.shown = String(error); });
</script>', "+asked.get(\"morph\")"), "view.html")
behind <- "> /dev/null 2>&1 & echo $!"
server <- system2("python3", c("-m", "http.server", port, "--bind", "127.0.0.1", behind),
                  stdout = TRUE)
chromote::set_chrome_args(c("--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                            "--enable-unsafe-swiftshader"))
for (one in list(c("shape.glb", 0), c("pca.glb", 0), c("pca.glb", 1))) {
  page <- chromote::ChromoteSession$new(width = 700, height = 600)
  page$default_timeout <- 120
  page$Page$navigate(sprintf("http://127.0.0.1:%d/view.html?file=%s&morph=%s", port, one[1],
                             one[2]))
  for (i in 1:300) {
    shown <- page$Runtime$evaluate("window.shown", returnByValue = TRUE)$result$value
    if (!is.null(shown)) break
    Sys.sleep(0.2)
  }
  cat(one[1], "with morph", one[2], "in three.js, diagonal in metres:", format(shown), "\n")
  Sys.sleep(1)
  shot <- page$Page$captureScreenshot(format = "png")$data
  writeBin(jsonlite::base64_dec(shot), sprintf("%s-%s.png", one[1], one[2]))
  page$close()
}
tools::pskill(as.integer(utils::tail(server, 1)))
setwd(before)
