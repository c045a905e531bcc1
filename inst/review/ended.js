// What a page says when R has ended it; a page of the app waits for the next one at the same address.
$(document).on("shiny:disconnected", function () {
  "use strict";
  var note = document.createElement("div"), again = window.location.search.indexOf("app=1") >= 0;
  note.id = "ended";
  note.textContent = again ? "The next page comes at once." : "This page has ended: it can be closed.";
  document.body.appendChild(note);
  if (!again) return;
  var left = 120, waiting = setInterval(function () {
    if (--left < 0) { clearInterval(waiting); note.textContent = "The app has ended: this page can be closed."; return; }
    fetch(window.location.href, { cache: "no-store" }).then(function (answer) {
      if (answer.ok) { clearInterval(waiting); window.location.reload(); }
    }).catch(function () {});
  }, 1000);
});
