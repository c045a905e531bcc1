// What the page of a scheme does by itself: fills the forms, chooses from the lists.
(function () {
  "use strict";

  document.addEventListener("click", function (event) {
    var row = event.target.closest("[data-patch]");
    if (row) fill("patch_name", row.getAttribute("data-patch"));
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
      if (state.count !== count) { count = state.count; fill("mark", state.mark); }
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
