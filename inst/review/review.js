// What the page does by itself: tells a click from a drag, sends the click's ray, shifts the view, chooses from the list.
(function () {
  "use strict";

  var still = 4,  // pixels that the pointer may move between press and release for a click
      near = 12,  // pixels from a ball's middle within which it is taken
      speed = 0.0016,  // share by which a pixel of the wheel zooms; a notch has about 100
      most = 4, least = 0.02,  // of the zoom: shares of the whole scene that are seen
      balls = [], dragged = null, start = null;

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

  // Nearer or farther; the place under the pointer stays there.
  function zoom(rgl, event) {
    var par = rgl.getObj(rgl.scene.rootSubscene).par3d, box = rgl.canvas.getBoundingClientRect(), before = par.zoom, pixels,
        x = 2 * (event.clientX - box.left) / box.width - 1, y = 1 - 2 * (event.clientY - box.top) / box.height, moved = par.userProjection;
    pixels = event.deltaY * [1, 33, 400][event.deltaMode];
    par.zoom = Math.min(most, Math.max(least, before * Math.exp(speed * Math.max(-300, Math.min(300, pixels)))));
    moved = new CanvasMatrix4(moved);
    moved.translate((x - moved.m41) * (1 - before / par.zoom), (y - moved.m42) * (1 - before / par.zoom), 0);
    par.userProjection = moved;
    rgl.drawScene();
  }

  // The whole scene as at first, or from there turned about its vertical, by degrees.
  function turn(degrees) {
    var rgl = scene();
    if (!rgl || !start) return;
    var par = rgl.getObj(rgl.scene.rootSubscene).par3d, matrix = new CanvasMatrix4(start.matrix);
    matrix.rotate(degrees, 0, 1, 0);
    par.userMatrix = matrix;
    par.userProjection = new CanvasMatrix4(start.projection);
    par.zoom = start.zoom;
    rgl.drawScene();
  }

  function watch(view) {
    var pressed = null, shifted = null;
    view.addEventListener("wheel", function (event) {
      if (!scene()) return;
      event.preventDefault();
      event.stopPropagation();
      zoom(scene(), event);
    }, { capture: true, passive: false });
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
    var rgl = scene();
    if (event.button !== 0 || !rgl || event.target !== rgl.canvas) return;
    var ball = ballAt(rgl, event);
    if (!ball) return;
    dragged = { ball: ball, x: event.clientX, y: event.clientY, mark: null };
    event.stopImmediatePropagation();
    event.preventDefault();
  }, true);

  document.addEventListener("mousedown", function (event) {
    if (dragged) event.stopImmediatePropagation();
  }, true);

  document.addEventListener("pointermove", function (event) {
    if (!dragged) return;
    event.stopImmediatePropagation();
    if (!dragged.mark && Math.hypot(event.clientX - dragged.x, event.clientY - dragged.y) > still) {
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
    if (was.mark) {
      was.mark.remove();
      send("drop", { name: was.ball.name, ray: rayAt(scene(), event) });
    } else if (was.ball.chooses) send("select", was.ball.name);
    else send("ray", rayAt(scene(), event));
  }, true);

  function send(name, value) { Shiny.setInputValue(name, value, { priority: "event" }); }

  document.addEventListener("click", function (event) {
    // After a click of the mouse keys are those of the page again
    if (event.detail > 0 && event.target.closest("#buttons button, #turn button")) document.activeElement.blur();
    var row = event.target.closest("[data-landmark], [data-curve], [data-turn]");
    if (!row) return;
    if (row.hasAttribute("data-turn")) { row.blur(); turn(+row.getAttribute("data-turn")); return; }
    if (row.hasAttribute("data-landmark")) send("select", row.getAttribute("data-landmark"));
    else send("curve", row.getAttribute("data-curve"));
  });

  // "Done" asks where landmarks are missing: it is pressed once more, anything else takes the question back.
  var asked = null;
  document.addEventListener("click", function (event) {
    var done = event.target.closest("#done"), left = document.querySelectorAll(".row.landmark.missing").length;
    if (asked) {
      asked.button.textContent = asked.label;
      asked = null;
    } else if (done && left) {
      asked = { button: done, label: done.textContent };
      done.textContent = left + " to place: end?";
      event.stopImmediatePropagation();
      event.preventDefault();
    }
  }, true);

  // Keys press the buttons of the page, or go along the list.
  var keys = { Enter: "keep", Delete: "absent", Backspace: "absent", s: "snap", u: "undo", r: "redo", n: "following", p: "previous" };
  document.addEventListener("keydown", function (event) {
    var field = event.target.closest("input, select, textarea"), id = keys[event.key.length > 1 ? event.key : event.key.toLowerCase()];
    if (field || event.altKey) return;
    // A button that has the focus is pressed by Enter itself, and by no other button beside it
    if (event.key === "Enter" && event.target.closest("button, a, summary")) return;
    if (event.ctrlKey || event.metaKey) id = { z: "undo", y: "redo" }[event.key.toLowerCase()];
    else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      if (!document.getElementById("redo")) return;
      event.preventDefault();
      send("choose", event.key === "ArrowDown" ? 1 : -1);
      return;
    }
    if (/^[123]$/.test(event.key) && !event.ctrlKey && !event.metaKey) {
      var side = document.querySelectorAll("[data-turn]")[event.key - 1];
      if (side) turn(+side.getAttribute("data-turn"));
      return;
    }
    if (id === "absent" && document.querySelector(".row.curve.chosen")) id = "erase";
    var button = id && document.getElementById(id);
    if (!button) return;
    event.preventDefault();
    button.click();
  });

  // What is chosen can be seen in the list.
  $(document).on("shiny:value", function (event) {
    if (event.name === "list") setTimeout(function () {
      var list = document.getElementById("list"), row = list && list.querySelector(".row.chosen");
      var at = row ? row.offsetTop - list.offsetTop : 0, seen = list ? at - list.scrollTop : 0;
      if (row && (seen < 0 || seen > list.clientHeight - row.clientHeight)) list.scrollTop = at - list.clientHeight / 2;
    }, 50);
    if (event.name === "face") shown();
  });

  // rgl would turn the matrix of a shifted view over at every change of its objects: it is put back before they are drawn.
  function change(message) {
    var rgl = document.getElementById(message.elementId).rglinstance, root = rgl.getObj(rgl.scene.rootSubscene),
        kept = new CanvasMatrix4(root.par3d.userProjection);
    rglwidgetClass.prototype.sceneChangeHandler(Object.assign({}, message, { redrawScene: false }));
    root.par3d.userProjection = kept;
    rgl.drawScene();
  }

  // The surface is there once rgl has a canvas: then the server may send landmarks and curves.
  function shown() {
    var before = scene() && scene().scene;
    balls = [];
    var waiting = setInterval(function () {
      if (!scene() || !scene().canvas || !scene().scene || scene().scene === before) return;
      clearInterval(waiting);
      var par = scene().getObj(scene().scene.rootSubscene).par3d;
      start = { matrix: new CanvasMatrix4(par.userMatrix), projection: new CanvasMatrix4(par.userProjection), zoom: par.zoom };
      send("ready", Date.now());
    }, 50);
  }

  $(document).on("shiny:connected", function () {
    Shiny.addCustomMessageHandler("change", change);
    Shiny.addCustomMessageHandler("balls", function (sent) { balls = sent; });
    watch(document.getElementById("view"));
  });
})();
