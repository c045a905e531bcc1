function (el, x, data) {
  "use strict";
  // Names of points and lines on hover, one printed by a click; layers that are hidden by their ticks.
  var rgl = el.rglinstance, box = el.closest(".crestline-scene");
  if (!rgl || !box) return;
  var tip = box.querySelector(".scene-tip"), said = box.querySelector(".scene-said"), hidden = {}, pressed = null;

  function nearest(event, reach) {
    var root = rgl.scene.rootSubscene, area = rgl.canvas.getBoundingClientRect(), found = null, best = reach * reach, depth = 0;
    rgl.getViewport(root);
    rgl.setprMatrix(root);
    rgl.setmvMatrix(root);
    var turn = new CanvasMatrix4(rgl.mvMatrix), all = new CanvasMatrix4(rgl.mvMatrix);
    all.multRight(rgl.prMatrix);
    for (var i = 0; i < data.of.length; i++) {
      if (hidden[data.within[data.of[i]]]) continue;
      var n = data.out.slice(3 * i, 3 * i + 3), at = data.at.slice(3 * i, 3 * i + 3);
      if (rglwidgetClass.multVM(n.concat(0), turn)[2] < -0.05) continue;
      var v = rglwidgetClass.multVM(at.concat(1), all),
          dx = area.left + (0.5 + 0.5 * v[0] / v[3]) * area.width - event.clientX,
          dy = area.top + (0.5 - 0.5 * v[1] / v[3]) * area.height - event.clientY, away = dx * dx + dy * dy;
      if (away < best) { best = away; found = i; depth = v[2] / v[3]; }
    }
    return found;
  }

  function place(i) {
    return [0, 1, 2].map(function (k) { return Number((data.at[3 * i + k] / data.scale + data.middle[k]).toPrecision(6)); });
  }

  rgl.canvas.addEventListener("pointermove", function (event) {
    var i = event.buttons ? null : nearest(event, 12), area = el.getBoundingClientRect();
    tip.hidden = i === null;
    if (i === null) return;
    tip.textContent = data.names[data.of[i]];
    tip.style.left = Math.min(event.clientX - area.left + 14, area.width - tip.offsetWidth - 4) + "px";
    tip.style.top = (event.clientY - area.top + 12) + "px";
  });
  rgl.canvas.addEventListener("pointerleave", function () { tip.hidden = true; });
  rgl.canvas.addEventListener("pointerdown", function (event) { pressed = [event.clientX, event.clientY]; }, true);
  // A press that does not drag; on the window, since rgl keeps the pointer events of its canvas.
  window.addEventListener("pointerup", function (event) {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) { pressed = null; return; }
    pressed = null;
    var i = nearest(event, 12);
    if (i === null) return;
    var name = data.names[data.of[i]], at = place(i);
    said.textContent = name + ": " + at.join(", ");
    console.log(said.textContent);
    if (window.Shiny && Shiny.setInputValue) Shiny.setInputValue(el.id + "_clicked", { name: name, at: at });
  }, true);

  // A slider of a component: vertices go by so much for each standard deviation.
  var slider = data.moves && box.parentNode.querySelector("input[type=range]"), mean = null;
  if (slider) slider.addEventListener("input", function () {
    var id = [].concat(data.layers[data.moves.layer])[0], obj = rgl.getObj(id), at = Number(slider.value), gl = rgl.gl;
    if (!obj.vOffsets) rgl.initObjId(id);
    var from = obj.vOffsets, n = data.moves.by.length / 3;
    if (!mean) mean = obj.values.slice();
    for (var i = 0; i < n; i++) for (var k = 0; k < 3; k++) {
      obj.values[i * from.stride + from.vofs + k] = mean[i * from.stride + from.vofs + k] + at * data.moves.by[3 * i + k];
      if (from.nofs >= 0) obj.values[i * from.stride + from.nofs + k] = mean[i * from.stride + from.nofs + k] + at * data.moves.normals[3 * i + k];
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, obj.buf);
    gl.bufferData(gl.ARRAY_BUFFER, obj.values, gl.DYNAMIC_DRAW);
    slider.parentNode.querySelector("output").textContent = (at > 0 ? "+" : "") + at.toFixed(1) + " sd";
    rgl.drawScene();
  });

  box.querySelectorAll("input[data-layer]").forEach(function (tick) {
    function show() {
      var ids = [].concat(data.layers[tick.dataset.layer] || []), root = rgl.scene.rootSubscene;
      hidden[tick.dataset.layer] = !tick.checked;
      ids.forEach(function (id) { if (tick.checked) rgl.addToSubscene(id, root); else rgl.delFromSubscene(id, root); });
      rgl.drawScene();
    }
    tick.addEventListener("change", show);
    if (!tick.checked) show();
  });
}
