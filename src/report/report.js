"use strict";

// Tables: a click on a heading sorts by it, a second one the other way round. Equal rows keep their order.
for (const table of document.querySelectorAll("table.sortable")) {
  const headings = [...table.tHead.rows[0].cells];
  headings.forEach((heading, column) => {
    heading.querySelector("button").addEventListener("click", () => {
      const descending = heading.getAttribute("aria-sort") === "ascending";
      for (const other of headings) other.removeAttribute("aria-sort");
      heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
      const key = row => row.cells[column].dataset.value ?? row.cells[column].textContent;
      const order = (a, b) => {
        const x = key(a), y = key(b), p = Number(x), q = Number(y);
        const numbers = x.trim() !== "" && y.trim() !== "" && !Number.isNaN(p) && !Number.isNaN(q);
        return numbers ? p - q : x.localeCompare(y, "en", { numeric: true });
      };
      const rows = [...table.tBodies[0].rows].sort((a, b) => descending ? order(b, a) : order(a, b));
      table.tBodies[0].append(...rows);
    });
  });
}

