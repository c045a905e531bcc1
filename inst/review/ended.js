// What a page says when R has ended it; a page of the app waits for the next one at the same address.
$(document).on("shiny:disconnected", function () {
  "use strict";
  var note = document.createElement("div"), again = window.location.search.indexOf("app=1") >= 0;
  note.id = "ended";
  var page = document.querySelector("[data-kept]"), kept = page ? " " + page.getAttribute("data-kept") : "";
  note.textContent = again ? "The next page comes at once." : "This page has ended: it can be closed." + kept;
  document.body.appendChild(note);
  if (!again) return;
  var left = 120, waiting = setInterval(function () {
    if (--left < 0) { clearInterval(waiting); note.textContent = "The app has ended: this page can be closed."; return; }
    fetch(window.location.href, { cache: "no-store" }).then(function (answer) {
      if (answer.ok) { clearInterval(waiting); window.location.reload(); }
    }).catch(function () {});
  }, 1000);
});
// A page that is left for another address in its tab ends as a closed one does.
window.addEventListener("pagehide", function () {
  "use strict";
  if (window.Shiny && Shiny.shinyapp && Shiny.shinyapp.$socket) Shiny.shinyapp.$socket.close();
});
