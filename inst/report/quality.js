// The table of parts (sorted, filtered) and the matrix of specimens by parts, from the columns in #data.
(function () {
  "use strict";
  const data = JSON.parse(document.getElementById("data").textContent);
  const order = { green: 0, amber: 1, red: 2 };
  const rows = data.part.map((_, i) => Object.fromEntries(Object.keys(data).map(key => [key, data[key][i]])));
  const specimens = [...new Set(data.specimen)];
  const columns = Object.keys(data).filter(key => key !== "level" && (specimens.length > 1 || key !== "specimen") &&
    data[key].some(value => value !== null));
  const numeric = new Set(columns.filter(key => data[key].some(value => typeof value === "number")));
  const at = id => document.getElementById(id);
  const step = 300;
  let sort = "grade", falling = true, limit = step;

  function element(name, className, text) {
    const made = document.createElement(name);
    if (className) made.className = className;
    if (text !== undefined && text !== null) made.textContent = text;
    return made;
  }

  function compare(a, b) {
    let x = a[sort], y = b[sort];
    if (sort === "grade") { x = order[x]; y = order[y]; }
    if (x === y) return 0;
    if (x === null) return 1;
    if (y === null) return -1;
    return (x < y ? -1 : 1) * (falling ? -1 : 1);
  }

  function chosen() {
    const grades = new Set([...document.querySelectorAll("input.grade:checked")].map(box => box.value));
    const level = at("level").value, specimen = at("specimen") ? at("specimen").value : "";
    const words = at("search").value.toLowerCase();
    return rows.filter(row => grades.has(row.grade) && (!level || row.level === level) && (!specimen || row.specimen === specimen) &&
      (!words || (row.part + " " + (row.why || "")).toLowerCase().includes(words))).sort(compare);
  }

  function cell(row, key) {
    if (key === "grade") {
      const made = element("td");
      made.append(element("span", "chip " + row.grade, row.grade));
      return made;
    }
    return element("td", key === "why" ? "why" : numeric.has(key) ? "n" : "", row[key]);
  }

  function show() {
    const found = chosen(), table = at("table");
    const head = element("tr");
    columns.forEach(key => {
      const made = element("th", (numeric.has(key) ? "n " : "") + (key === sort ? (falling ? "down" : "up") : ""), key);
      made.onclick = () => { falling = key === sort ? !falling : key === "grade"; sort = key; show(); };
      head.append(made);
    });
    const thead = element("thead"), tbody = element("tbody");
    thead.append(head);
    found.slice(0, limit).forEach(row => {
      const line = element("tr");
      columns.forEach(key => line.append(cell(row, key)));
      tbody.append(line);
    });
    table.replaceChildren(thead, tbody);
    at("found").textContent = found.length + " of " + rows.length + " parts";
    at("more").style.display = found.length > limit ? "inline-block" : "none";
  }

  function list(specimen, words) {
    if (at("specimen")) at("specimen").value = specimen;
    at("level").value = "";
    at("search").value = words;
    document.querySelectorAll("input.grade").forEach(box => { box.checked = true; });
    limit = step;
    show();
    at("parts").scrollIntoView({ behavior: "smooth" });
  }

  function gone(row) {
    return row.missing === 1 || (row.level === "curves" && row.length === null);
  }

  function matrix() {
    const level = at("matrix-level").value, here = rows.filter(row => row.level === level);
    const parts = [...new Set(here.map(row => row.part))];
    const cells = new Map(here.map(row => [row.specimen + "\n" + row.part, row]));
    const thead = element("thead"), tbody = element("tbody"), head = element("tr");
    head.append(element("th"));
    parts.forEach(part => { const made = element("th"); made.append(element("div", "", part)); head.append(made); });
    thead.append(head);
    specimens.forEach(specimen => {
      const line = element("tr");
      const lost = rows.find(row => row.specimen === specimen && row.level === "specimen" && row.grade === "red");
      line.append(element("th", "", specimen));
      parts.forEach(part => {
        const row = cells.get(specimen + "\n" + part), made = element("td", row ? row.grade + (gone(row) ? " gone" : "") : lost ? "red gone" : "");
        if (row) {
          made.title = specimen + ", " + part + ": " + row.grade + (row.why ? "\n" + row.why : "");
          made.onclick = () => list(specimen, part);
        } else if (lost) {
          made.title = specimen + ": " + lost.why;
          made.onclick = () => list(specimen, "");
        }
        line.append(made);
      });
      tbody.append(line);
    });
    at("matrix").replaceChildren(thead, tbody);
  }

  document.querySelectorAll(".filters select, .filters input").forEach(input => {
    input.addEventListener("input", () => { limit = step; show(); });
  });
  document.querySelectorAll("a[data-specimen]").forEach(link => {
    link.addEventListener("click", event => { event.preventDefault(); list(link.dataset.specimen, ""); });
  });
  at("more").onclick = () => { limit += 10 * step; show(); };
  if (at("matrix")) { at("matrix-level").onchange = matrix; matrix(); }
  show();
})();
