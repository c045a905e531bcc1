// The list of a page's headings beside it, and a field that filters the reference. Stands in for pkgdown.js, whose
// libraries come from the network.
document.addEventListener("DOMContentLoaded", () => {
  const contents = document.getElementById("toc");
  if (contents) {
    const list = document.createElement("ul");
    document.querySelectorAll("main h2, main h3").forEach(heading => {
      const section = heading.id ? heading : heading.closest("[id]");
      if (!section || section.id === "main") return;
      const link = document.createElement("a");
      link.href = "#" + section.id;
      link.textContent = heading.textContent.trim();
      const item = document.createElement("li");
      if (heading.tagName === "H3") item.className = "inner";
      item.append(link);
      list.append(item);
    });
    contents.append(list);
  }
  const reference = document.querySelector(".template-reference-index main");
  if (reference) {
    const field = document.createElement("input");
    field.type = "search";
    field.className = "form-control";
    field.placeholder = "Find a function or a word";
    field.setAttribute("aria-label", field.placeholder);
    field.addEventListener("input", () => {
      const wanted = field.value.toLowerCase();
      reference.querySelectorAll("dl").forEach(entry => {
        entry.hidden = !entry.textContent.toLowerCase().includes(wanted);
      });
    });
    reference.querySelector(".page-header").after(field);
  }
});
