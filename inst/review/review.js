// What the page does by itself: tells a click from a drag, sends the click's ray, shifts the view, chooses from the list.
(function () {
  "use strict";

  var still = 4;  // pixels that the pointer may move between press and release for a click

  function scene() {
    var view = document.getElementById("face");
    return view && view.rglinstance;
  }

  // From where and towards what the eye looks at a place of the page, in the co-ordinates of the scene.
  function rayAt(rgl, event) {
    var root = rgl.scene.rootSubscene, box = rgl.canvas.getBoundingClientRect(),
        x = 2 * (event.clientX - box.left) / box.width - 1, y = 1 - 2 * (event.clientY - box.top) / box.height, back;
    rgl.getViewport(root);
    rgl.setprMatrix(root);
    rgl.setmvMatrix(root);
    back = new CanvasMatrix4(rgl.mvMatrix);
    back.multRight(rgl.prMatrix);
    back.invert();
    function place(depth) {
      var v = rglwidgetClass.multVM([x, y, depth, 1], back);
      return [v[0] / v[3], v[1] / v[3], v[2] / v[3]];
    }
    return { from: place(-1), towards: place(1) };
  }

  function shift(rgl, start, event) {
    var root = rgl.getObj(rgl.scene.rootSubscene), box = rgl.canvas.getBoundingClientRect(),
        moved = new CanvasMatrix4(start.projection);
    moved.translate(2 * (event.clientX - start.x) / box.width, -2 * (event.clientY - start.y) / box.height, 0);
    root.par3d.userProjection = moved;
    rgl.drawScene();
  }

  function watch(view) {
    var pressed = null, shifted = null;
    view.addEventListener("pointerdown", function (event) {
      var rgl = scene();
      pressed = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
      if (event.button !== 2) return;
      shifted = { x: event.clientX, y: event.clientY,
                  projection: new CanvasMatrix4(rgl.getObj(rgl.scene.rootSubscene).par3d.userProjection) };
      event.stopPropagation();
    }, true);
    document.addEventListener("pointermove", function (event) {
      if (shifted) shift(scene(), shifted, event);
    }, true);
    view.addEventListener("pointerup", function (event) {
      var click = pressed && event.button === 0 && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) <= still;
      pressed = null;
      if (click) Shiny.setInputValue("ray", rayAt(scene(), event), { priority: "event" });
    }, true);
    document.addEventListener("pointerup", function () { shifted = null; }, true);
    view.addEventListener("contextmenu", function (event) { event.preventDefault(); });
  }

  // What the script of another page needs of this one.
  window.crestlinePage = { scene: scene, rayAt: rayAt, still: still };

  document.addEventListener("click", function (event) {
    var row = event.target.closest("[data-landmark]");
    if (row) Shiny.setInputValue("select", row.getAttribute("data-landmark"), { priority: "event" });
  });

  // The surface is there once rgl has a canvas: then the server may send landmarks and curves.
  $(document).on("shiny:connected", function () {
    var waiting = setInterval(function () {
      if (!scene() || !scene().canvas || !scene().scene) return;
      clearInterval(waiting);
      watch(document.getElementById("view"));
      Shiny.setInputValue("ready", true);
    }, 50);
  });

  $(document).on("shiny:disconnected", function () {
    var note = document.createElement("div");
    note.id = "ended";
    note.textContent = "This page has ended: it can be closed.";
    document.body.appendChild(note);
  });
})();
