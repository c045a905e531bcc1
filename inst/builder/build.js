// What the page of a scheme does by itself: drags a landmark's ball, chooses a curve from the list, fills the forms.
(function () {
  "use strict";

  var page = window.crestlinePage, near = 12,  // pixels from a ball's middle within which it is taken
      balls = [], dragged = null;

  // Where a place of the scene is on the page, and how deep.
  function pixel(rgl, at) {
    var box = rgl.canvas.getBoundingClientRect(), w = rgl.user2window(at.concat(1), rgl.scene.rootSubscene);
    return { x: box.left + w[0] * box.width, y: box.top + (1 - w[1]) * box.height, depth: w[2] };
  }

  // The ball under the pointer whose surface faces the viewer.
  function ballAt(rgl, event) {
    var best = null, least = near;
    balls.forEach(function (ball) {
      var p = pixel(rgl, ball.at), away = Math.hypot(p.x - event.clientX, p.y - event.clientY),
          out = pixel(rgl, [0, 1, 2].map(function (i) { return ball.at[i] + ball.out[i]; }));
      if (away < least && out.depth <= p.depth) { best = ball; least = away; }
    });
    return best;
  }

  document.addEventListener("pointerdown", function (event) {
    var rgl = page.scene();
    if (event.button !== 0 || !rgl || event.target !== rgl.canvas) return;
    var ball = ballAt(rgl, event);
    if (!ball) return;
    dragged = { name: ball.name, x: event.clientX, y: event.clientY, mark: null };
    event.stopImmediatePropagation();
    event.preventDefault();
  }, true);

  document.addEventListener("mousedown", function (event) {
    if (dragged) event.stopImmediatePropagation();
  }, true);

  document.addEventListener("pointermove", function (event) {
    if (!dragged) return;
    event.stopImmediatePropagation();
    if (!dragged.mark && Math.hypot(event.clientX - dragged.x, event.clientY - dragged.y) > page.still) {
      dragged.mark = document.createElement("div");
      dragged.mark.id = "dragged";
      document.body.appendChild(dragged.mark);
    }
    if (!dragged.mark) return;
    dragged.mark.style.left = event.clientX + "px";
    dragged.mark.style.top = event.clientY + "px";
  }, true);

  document.addEventListener("pointerup", function (event) {
    var was = dragged;
    if (!was) return;
    dragged = null;
    event.stopImmediatePropagation();
    if (!was.mark) { Shiny.setInputValue("select", was.name, { priority: "event" }); return; }
    was.mark.remove();
    Shiny.setInputValue("drop", { name: was.name, ray: page.rayAt(page.scene(), event) }, { priority: "event" });
  }, true);

  document.addEventListener("click", function (event) {
    var row = event.target.closest("[data-curve], [data-patch]");
    if (!row) return;
    if (row.hasAttribute("data-patch")) { fill("patch_name", row.getAttribute("data-patch")); return; }
    Shiny.setInputValue("curve", row.getAttribute("data-curve"), { priority: "event" });
  });

  function fill(id, value) {
    var field = document.getElementById(id);
    if (!field || value === null || value === undefined || String(field.value) === String(value)) return;
    field.value = value;
    $(field).trigger("change");
  }

  // The names of all curves; chosen is the newest, or the one before.
  function offer(id, names, back) {
    var field = document.getElementById(id);
    field.replaceChildren.apply(field, names.map(function (name) { return new Option(name, name); }));
    field.value = names[names.length - back] || names[0] || "";
    $(field).trigger("change");
  }

  $(document).on("shiny:connected", function () {
    var curve = null, curves = "", count = 0;
    Shiny.addCustomMessageHandler("state", function (state) {
      balls = state.balls;
      if (balls.length !== count) { count = balls.length; fill("mark", state.mark); }
      if (String(state.curves) !== curves) {
        curves = String(state.curves);
        offer("curve_a", state.curves, 2);
        offer("curve_b", state.curves, 1);
        fill("curve_name", "");
        fill("patch_name", "");
      }
      if (JSON.stringify(state.curve) === curve) return;
      curve = JSON.stringify(state.curve);
      if (!state.curve) fill("curve_name", "");
      else Object.keys(state.curve).forEach(function (id) { fill(id, state.curve[id]); });
    });
  });
})();
