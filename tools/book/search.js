"use strict";
// Finds sections that contain all words, or words that begin with them. The index is loaded at the first search.
(() => {
  const MOST = 30; // results
  const AROUND = 70; // letters beside the first match
  const dialog = document.getElementById("search");
  const input = dialog.querySelector("input");
  const list = dialog.querySelector("ol");
  const status = dialog.querySelector("p");

  // Removes accents, so that painleve finds Painlevé. Each letter stays one letter, so positions are kept.
  const bare = (letter) => letter.normalize("NFD")[0].toLowerCase();
  const plain = (text) => Array.from(text, bare).join("");
  let entries = null;

  function load() {
    if (entries) return Promise.resolve();
    return new Promise((done) => {
      const script = document.createElement("script");
      script.src = `${window.bookRoot}assets/index.js`;
      script.onload = () => {
        entries = window.bookIndex.map((entry) => (
          { ...entry, letters: Array.from(entry.text), plain: plain(entry.text),
            title: plain(`${entry.section} ${entry.page}`) }));
        done();
      };
      document.head.append(script);
    });
  }

  function starts(text, word) {
    const found = [];
    for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
      if (at === 0 || !/[\p{L}\p{N}]/u.test(text[at - 1]) || !/[\p{L}\p{N}]/u.test(word[0])) found.push(at);
    }
    return found;
  }

  function results(words) {
    const found = [];
    for (const entry of entries) {
      const inText = words.map((word) => starts(entry.plain, word));
      const inTitle = words.map((word) => starts(entry.title, word).length);
      if (!words.every((_, k) => inText[k].length || inTitle[k])) continue;
      const score = words.reduce((sum, _, k) => sum + 10 * Math.min(inTitle[k], 1) + Math.min(inText[k].length, 5), 0);
      found.push({ entry, score, at: Math.min(...inText.map((places) => places[0] ?? Infinity)) });
    }
    return found.sort((a, b) => b.score - a.score);
  }

  function snippet({ letters, plain: text }, at, words) {
    const line = document.createElement("p");
    if (!Number.isFinite(at)) at = 0;
    const first = Math.max(0, at - AROUND);
    const last = Math.min(letters.length, at + 2 * AROUND);
    const marked = new Array(last - first).fill(false);
    for (const word of words) {
      for (const place of starts(text, word)) {
        for (let k = place; k < place + word.length; ++k) if (k >= first && k < last) marked[k - first] = true;
      }
    }
    line.append(first ? "… " : "");
    for (let k = first; k < last;) {
      let end = k;
      while (end < last && marked[end - first] === marked[k - first]) ++end;
      const part = letters.slice(k, end).join("");
      if (marked[k - first]) {
        const mark = document.createElement("mark");
        mark.textContent = part;
        line.append(mark);
      } else {
        line.append(part);
      }
      k = end;
    }
    line.append(last < letters.length ? " …" : "");
    return line;
  }

  function item({ entry, at }, words) {
    const link = document.createElement("a");
    link.href = window.bookRoot + entry.url;
    const title = document.createElement("strong");
    title.textContent = entry.section;
    link.append(title);
    if (entry.page !== entry.section) {
      const page = document.createElement("span");
      page.textContent = entry.page;
      link.append(" ", page);
    }
    link.append(snippet(entry, at, words));
    const row = document.createElement("li");
    row.append(link);
    return row;
  }

  function search() {
    const words = plain(input.value).split(/\s+/).filter(Boolean);
    const found = words.length ? results(words) : [];
    list.replaceChildren(...found.slice(0, MOST).map((result) => item(result, words)));
    status.textContent = !words.length ? "" : found.length > MOST ? `the best ${MOST} of ${found.length} sections`
      : found.length === 1 ? "1 section" : found.length ? `${found.length} sections` : "nothing found";
  }

  async function open() {
    if (!dialog.open) dialog.showModal();
    input.select();
    await load();
    search();
  }

  function move(step) {
    const links = [...list.querySelectorAll("a")];
    const next = links.indexOf(document.activeElement) + step;
    if (next < 0) input.focus();
    else if (links[next]) links[next].focus();
  }

  document.getElementById("find").addEventListener("click", open);
  document.addEventListener("keydown", (event) => {
    const writes = /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
    if (event.key === "/" && !writes && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      open();
    }
  });
  input.addEventListener("input", () => { if (entries) search(); });
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown") move(1);
    else if (event.key === "ArrowUp") move(document.activeElement === input ? 0 : -1);
    else if (event.key === "Enter" && document.activeElement === input) list.querySelector("a")?.click();
    else return;
    event.preventDefault();
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog || event.target.closest("a")) dialog.close();
  });
})();
